"""Orbits in the play of the joint, and their sections."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from ..arguments import text
from ..errors import SlidewayError
from ..palette import colours
from ..sampling import coarse_words, too_coarse
from ..scenes import scene
from ..sections import sections
from ..units import scaled
from ..way import across, may_be_misaligned, mean_clearance
from .base import Members, chosen, drawn, most_lines, variable, words_of
from .marks import Array, Axis, Box, Cloud, Curve, Density, Mark, Note, Panel

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@drawn
def orbit_yz(result: xr.Dataset, member: Members = None, ax: Axes | None = None) -> Panel:
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
    ys, zs, many = factor * ys, factor * zs, len(members) > most_lines
    gaps = _gaps(result, members) if turned is not None else set()
    marks: list[Mark] = [Box(factor * width, factor * height, None if many else "clearance") for width, height in gaps]
    if not many:
        coarse = too_coarse(result, members)
        style: dict[str, Any] = {"dash": "", "marker": ".", "size": 2.5} if coarse else {"width": 0.6}
        for number, y_of, z_of, colour in zip(members, ys, zs, colours, strict=False):
            marks.append(Curve(z_of, y_of, f"member {number}" if len(members) > 1 else None, colour, 0.8, **style))
            marks.append(Curve(z_of[:1], y_of[:1], colour=colour, dash="", marker="o"))
        marks += [Note(coarse_words(result))] if coarse else []
    else:
        there = np.isfinite(ys) & np.isfinite(zs)
        marks.append(Density(zs[there], ys[there], f"samples of {len(members)} members" + "; dashed: clearance" * bool(gaps)))
    origin = " from the way's axis" if turned is not None and may_be_misaligned(result) else ""
    return Panel(marks, Axis(f"z{origin}", unit), Axis(f"y{origin}", unit), equal=True)


@drawn
def poincare(result: xr.Dataset, x: str = "y", y: str = "vy", member: Members = None, ax: Axes | None = None) -> Panel:
    """Sections of the orbits: a few points are a periodic motion, a cloud is an irregular one (Fig. 17 of Qian et al. 2020).

    Args:
        x, y: states of the sections, one for each axis.
        member: number of a member, or several; left out: all.

    Raises:
        SlidewayError: the result has no sections, or no such state.

    >>> slideway.plot.poincare(slideway.example(), member=0).get_ylabel()
    'vy [mm/s]'
    """
    rows = rows_of(result, x, y)
    members = chosen(result, member)
    rows = rows.isel(section=np.isin(rows["member"].values, members))
    (xs, x_axis), (ys, y_axis) = at_sections(rows, x), at_sections(rows, y)
    size = float(np.clip(3000 / max(xs.size, 1), 1.5, 14))
    if len(members) > most_lines:
        return Panel([Cloud(xs, ys, f"{len(members)} members, {xs.size} sections", opacity=0.6, size=size)], x_axis, y_axis)
    of = {number: rows["member"].values == number for number in members}
    clouds = [Cloud(xs[own], ys[own], f"member {number}, {own.sum()} sections", colour, size=size)
              for (number, own), colour in zip(of.items(), colours, strict=False)]  # fmt: skip
    return Panel(clouds, x_axis, y_axis)


def rows_of(result: xr.Dataset, *names: str) -> xr.Dataset:
    """The sections of a result, which have these states."""
    rows = sections(result)
    for name in names:
        if text(name, "the name of a state") not in rows:
            raise SlidewayError(f"the sections have no {name}, but {', '.join(str(v) for v in rows.data_vars)}")
    return rows


def at_sections(rows: xr.Dataset, name: str, where: str = "") -> tuple[Array, Axis]:
    """A state at the sections in a handy unit, and its axis."""
    factor, unit = scaled(str(rows[name].attrs["units"]), rows[name].values)
    return factor * rows[name].values, Axis(words_of(name) + where, unit)


def _gaps(result: xr.Dataset, members: list[int]) -> set[tuple[float, float]]:
    """Clearances along z and y [m] of few members, or of all where they are the same."""
    shown = members if len(members) <= most_lines else [members[0], members[len(members) // 2], members[-1]]
    joints = [scene(result, m).get("joint", {}) for m in shown]
    gaps = {gap for gap in ((mean_clearance(j, "z"), mean_clearance(j, "y")) for j in joints) if not np.isnan(gap).any()}
    return gaps if len(members) <= most_lines or len(gaps) == 1 else set()
