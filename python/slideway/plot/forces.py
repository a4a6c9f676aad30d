"""Contact forces."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from ..errors import SlidewayError
from .style import Members, axis, chosen, colours, finish, label, scaled, variable

_classes = ("point", "line", "surface")


def force_histogram(result: xr.Dataset, member: Members = None, ax: Axes | None = None, *, bins: int = 40) -> Axes:
    """How often which normal force acts, by the class of the contact mode (Fig. 11 of Qian et al. 2020).

    Bars are shares of the samples in contact, piled by the hardest contact of the moment: a surface, else a line, else a point.
    Forces are on a logarithmic axis. The legend has the share of all samples in each class.

    Args:
        member: number of a member, or several; left out: all.
        bins: of the forces.

    Raises:
        SlidewayError: normal_force, surfaces, lines or points are not in the result, or nothing touches.

    >>> slideway.plot.force_histogram(slideway.example()).get_xlabel()
    'normal force [N]'
    """
    names = [name for name in ("normal_force", "surfaces", "lines", "points") if name not in result]
    if "lines" in names and result.attrs.get("scene", "").find('kind = "planar_slider_crank"') >= 0:
        names.remove("lines")  # corners between two walls touch at points or with a face
    if names and "sample" in result.dims:
        listed = ", ".join(f'"{name}"' for name in names)
        raise SlidewayError(f"this result lacks {listed}; add to study.quantities, with study.samples_per_revolution = 200 or more")
    members = chosen(result, member)

    def taken(name: str) -> np.ndarray:
        return np.asarray(variable(result, name).sel(member=members).values, dtype=float).ravel()

    force = taken("normal_force")
    there = np.isfinite(force)
    touching = there & (force > 0)
    if not touching.any():
        raise SlidewayError("the slider touches nothing at any sample; run it longer or with more samples")
    lines = taken("lines") > 0 if "lines" in result else np.zeros_like(there)
    surface = taken("surfaces") > 0
    of_class = {"surface": touching & surface, "line": touching & lines & ~surface}
    of_class["point"] = touching & ~of_class["surface"] & ~of_class["line"]
    factor, unit = scaled(str(result["normal_force"].attrs["units"]), force)
    # The few samples that graze with next to no force would stretch the axis over many decades.
    low, high = np.quantile(force[touching], (0.001, 1.0))
    edges = factor * np.geomspace(max(low, 1e-6 * high), high * 1.0001, bins + 1)
    ax = axis(ax)
    base = np.zeros(bins)
    for name, colour in zip(_classes, colours, strict=False):
        counts = np.histogram(np.clip(factor * force[of_class[name]], edges[0], None), edges)[0] * 100 / touching.sum()
        share = of_class[name].sum() / there.sum()
        ax.bar(edges[:-1], counts, np.diff(edges), base, align="edge", color=colour, label=f"{name}, {share:.1%} of the time")
        base += counts
    ax.plot([], [], " ", label=f"free flight, {1 - touching.sum() / there.sum():.1%}")
    ax.set_xscale("log")
    return finish(ax, label("normal force", unit), "share of samples in contact [%]")
