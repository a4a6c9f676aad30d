"""Orbits in the play of the joint, and their sections."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.patches import Rectangle

from ..arguments import text
from ..errors import SlidewayError
from ..palette import colours, grey
from ..sampling import coarse_words, too_coarse
from ..scenes import scene
from ..sections import sections
from ..way import across, mean_clearance, may_be_misaligned
from .style import Members, axis, chosen, finish, label, most_lines, of_result, scaled, variable, words_of


@of_result
def orbit_yz(result: xr.Dataset, member: Members = None, ax: Axes | None = None) -> Axes:
    """The slider's centre across the way, within the clearance (Fig. 13 of Qian et al. 2020).

    Up to eight members are lines from a dot, where they start; points where samples are far coarser than contacts. Of more
    members the time that all of them spend is a map. Where the scene's [way] moves or turns the way, y and z are from its axis,
    and the axes say so.

    Args:
        member: number of a member, or several; left out: all.

    Raises:
        SlidewayError: the result has no y and z, or nothing in them.

    >>> slideway.plot.orbit_yz(slideway.example(), member=[0, 1]).get_xlabel()
    'z [µm]'
    """
    y, z = variable(result, "y"), variable(result, "z")
    members = chosen(result, member)
    turned = across(result, members)
    ys, zs = turned if turned is not None else (y.sel(member=members).values, z.sel(member=members).values)
    if not np.isfinite(ys).any():
        raise SlidewayError("these members have no samples, for they failed before the first; see slideway.statuses(result)")
    factor, unit = scaled("m", np.concatenate([ys.ravel(), zs.ravel()]))
    ax, many = axis(ax), len(members) > most_lines
    for width, height in _gaps(result, members) if turned is not None else ():
        ax.add_patch(Rectangle((-factor * width, -factor * height), 2 * factor * width, 2 * factor * height, fill=False,
                               ec=grey, ls="--", label=None if ax.patches or many else "clearance"))
    if not many:
        coarse = too_coarse(result, members)
        style = {"ls": "none", "marker": ".", "ms": 2.5, "mew": 0} if coarse else {"lw": 0.6}
        for number, row_y, row_z, colour in zip(members, ys, zs, colours, strict=False):
            ax.plot(factor * row_z, factor * row_y, color=colour, alpha=0.8, label=f"member {number}" if len(members) > 1 else None, **style)
            ax.plot(factor * row_z[:1], factor * row_y[:1], "o", ms=4, color=colour)
        if coarse:
            ax.plot([], [], " ", label=coarse_words(result))
    else:
        there = np.isfinite(ys) & np.isfinite(zs)
        image = ax.hist2d(factor * zs[there], factor * ys[there], bins=120, cmap="viridis_r", norm=LogNorm())[3]
        ax.figure.colorbar(image, ax=ax, label=f"samples of {len(members)} members" + "; dashed: clearance" * bool(ax.patches))
    ax.set_aspect("equal", adjustable="box")
    ax.autoscale_view()
    origin = " from the way's axis" if turned is not None and may_be_misaligned(result) else ""
    return finish(ax, label(f"z{origin}", unit), label(f"y{origin}", unit))


@of_result
def poincare(result: xr.Dataset, x: str = "y", y: str = "vy", member: Members = None, ax: Axes | None = None) -> Axes:
    """Sections of the orbits: a few points are a periodic motion, a cloud is an irregular one (Fig. 17 of Qian et al. 2020).

    Args:
        x, y: states of the sections, one for each axis.
        member: number of a member, or several; left out: all.

    Raises:
        SlidewayError: the result has no sections, or no such state.

    >>> slideway.plot.poincare(slideway.example(), member=0).get_ylabel()
    'vy [mm/s]'
    """
    rows = sections(result)
    for name in (x, y):
        if text(name, "x or y") not in rows:
            raise SlidewayError(f"the sections have no {name}, but {', '.join(str(v) for v in rows.data_vars)}")
    members = chosen(result, member)
    here = np.isin(rows["member"].values, members)
    xs, ys, owners = rows[x].values[here], rows[y].values[here], rows["member"].values[here]
    (fx, unit_x), (fy, unit_y) = scaled(rows[x].attrs["units"], xs), scaled(rows[y].attrs["units"], ys)
    size = float(np.clip(3000 / max(xs.size, 1), 1.5, 14))
    ax = axis(ax)
    if len(members) <= most_lines:
        for number, colour in zip(members, colours, strict=False):
            own = owners == number
            ax.scatter(fx * xs[own], fy * ys[own], s=size, color=colour, lw=0, label=f"member {number}, {own.sum()} sections")
    else:
        ax.scatter(fx * xs, fy * ys, s=size, color=colours[0], alpha=0.6, lw=0, rasterized=xs.size > 20000,
                   label=f"{len(members)} members, {xs.size} sections")
    return finish(ax, label(words_of(x), unit_x), label(words_of(y), unit_y))


def _gaps(result: xr.Dataset, members: list[int]) -> set[tuple[float, float]]:
    """Clearances along z and y [m] of few members, or of all where they are the same."""
    shown = members if len(members) <= most_lines else [members[0], members[len(members) // 2], members[-1]]
    joints = [scene(result, m).get("joint", {}) for m in shown]
    gaps = {gap for gap in ((mean_clearance(j, "z"), mean_clearance(j, "y")) for j in joints) if not np.isnan(gap).any()}
    return gaps if len(members) <= most_lines or len(gaps) == 1 else set()
