"""Contact forces."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from ..arguments import whole
from ..errors import SlidewayError
from ..palette import class_colours
from ..units import scaled
from .base import Members, chosen, drawn, kind_of, variable
from .marks import Axis, Bars, Mark, Note, Panel

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_classes = ("point", "line", "surface")


@drawn
def force_histogram(result: xr.Dataset, member: Members = None, ax: Axes | None = None, *, bins: int = 40) -> Panel:
    """How often which normal force acts, by the class of the contact mode (Fig. 11 of Qian et al. 2020).

    By the hardest contact of the moment: a surface, else a line, else a point. Both axes are logarithmic, for the rare contacts of
    lines and surfaces have the largest forces. All shares, those of the legend too, are of all samples.

    Args:
        member: number of a member, or several; left out: all.
        bins: of the forces.

    Raises:
        SlidewayError: normal_force, surfaces, lines or points are not in the result, or nothing touches.

    >>> slideway.plot.force_histogram(slideway.example()).get_xlabel()
    'normal force [N]'
    """
    # Corners between two walls touch at points or with a face.
    lines = () if kind_of(result) == "planar_slider_crank" else ("lines",)
    missing = [name for name in ("normal_force", "surfaces", *lines, "points") if name not in result]
    if missing and "sample" in result.dims:
        listed = ", ".join(f'"{name}"' for name in missing)
        raise SlidewayError(f"this result lacks {listed}; add to study.quantities, with study.samples_per_revolution = 200 or more")
    members, bins = chosen(result, member), whole(bins, "bins", 1, 10000)

    def taken(name: str) -> np.ndarray:
        return np.asarray(variable(result, name).sel(member=members).values, dtype=float).ravel()

    force = taken("normal_force")
    there = np.isfinite(force)
    line = taken("lines") > 0 if lines else np.zeros_like(there)
    surface, point = taken("surfaces") > 0, taken("points") > 0
    of_class = {"surface": surface, "line": line & ~surface, "point": point & ~line & ~surface}
    touching = surface | line | point
    pushing = touching & (force > 0)  # damping takes the force of some contacts that open
    if not pushing.any():
        raise SlidewayError("the slider touches nothing at any sample; run it longer or with more samples")
    factor, unit = scaled(str(result["normal_force"].attrs["units"]), force)
    # The thousandth of the samples that grazes with least force would stretch the axis over many decades, and is left out.
    low, high = np.quantile(force[pushing], (0.001, 1.0))
    edges = factor * np.geomspace(max(low, 1e-6 * high), high * 1.0001, bins + 1)
    least = 100 / there.sum()  # one sample
    marks: list[Mark] = []
    for name in _classes:
        counts = np.histogram(factor * force[of_class[name]], edges)[0] * least
        share = of_class[name].sum() / there.sum()
        heights = np.maximum(counts, 0.5 * least)
        marks.append(Bars(edges, heights, f"{name}, {share:.2%} of the time", class_colours[name], base=0.5 * least, outlined=True))
    marks.append(Note(f"free flight, {1 - touching.sum() / there.sum():.2%}"))
    return Panel(marks, Axis("normal force", unit, log=True), Axis("share of all samples", "%", log=True, low=0.5 * least))
