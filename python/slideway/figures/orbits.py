"""Orbits in the play of the joint, their sections, and what changes with a parameter."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from ..arguments import text
from ..errors import SlidewayError
from ..palette import colours, grey
from ..sampling import coarse_words, too_coarse
from ..scenes import scene
from ..sections import sections
from ..units import lowered, scaled
from ..way import across, may_be_misaligned, mean_clearance
from .base import Axes, Members, chosen, drawn, exponent_of, most_lines, variable, words_of
from .marks import Array, Axis, Cloud, Curve, Density, Level, Mark, Note, Panel, Shape, box


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
    marks: list[Mark] = [Shape(factor * box(-w, -h, 2 * w, 2 * h), None if many else "clearance", edge=grey, dash="--") for w, h in gaps]
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
def journal(result: xr.Dataset, link: str, member: Members = None, ax: Axes | None = None) -> Panel:
    """Where the journal of a linkage goes in its bearing: beyond the circle, its clearance, it is pressed into it.

    Args:
        link: which one, `[link.<name>]` in the scene; its series must be in the result, as ``<name>_x`` and ``<name>_y``.
        member: number of a member, or several; left out: all, of which eight are drawn.

    Raises:
        SlidewayError: the result has no such series, or no such journal.

    >>> pin = {"first": "ground", "second": "pendulum", "kind": "journal", "clearance": 1e-4, "radius": 0.01}
    >>> scene = {"schema": 1, "mechanism": {"kind": "linkage"}, "link": {"pin": pin}, "study": {"duration": 0.1, "samples": 101},
    ...          "body": {"pendulum": {"mass": 1, "inertia": 0.01, "center_x": 0.1}}}
    >>> scene["study"]["quantities"] = ["pin_x", "pin_y"]
    >>> slideway.plot.journal(slideway.run(scene), "pin").get_ylabel()
    'y of pin [µm]'
    """
    members = chosen(result, member)[:most_lines]
    x, y = (variable(result, f"{text(link, 'the name of a link')}_{axis}").sel(member=members).values for axis in "xy")
    gaps = {scene(result, number).get("link", {}).get(link, {}).get("clearance") for number in members}
    if None in gaps:
        raise SlidewayError(f"the scene's {link} is no journal with clearance")
    factor, unit = scaled("m", np.concatenate([x.ravel(), y.ravel()]))
    turn = np.linspace(0, 2 * np.pi, 181)
    circle = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    marks: list[Mark] = [Shape(factor * gap * circle, "clearance" if i == 0 else None, edge=grey, dash="--") for i, gap in enumerate(sorted(gaps))]
    for number, x_of, y_of, colour in zip(members, x, y, colours, strict=False):
        marks.append(Curve(factor * x_of, factor * y_of, f"member {number}" if len(members) > 1 else None, colour, 0.8, width=0.6))
    return Panel(marks, Axis(f"x of {link}", unit), Axis(f"y of {link}", unit), equal=True)


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


@drawn
def bifurcation(result: xr.Dataset, name: str = "y", ax: Axes | None = None) -> Panel:
    """A state at the sections over the parameter of a sweep.

    Args:
        name: of the state.

    Raises:
        SlidewayError: the result is no sweep, or its sections have no such state.

    >>> slideway.plot.bifurcation(slideway.example(), "vy").get_xlabel()
    'joint.clearance [µm]'
    """
    key, parameter = _parameter(result)
    rows = rows_of(result, name)
    at = parameter.sel(member=rows["member"].values).values
    factor, unit = scaled(str(parameter.attrs["units"]), at)
    values, y = at_sections(rows, name, " at the sections")
    return Panel([Cloud(factor * at, values, opacity=0.7, size=float(np.clip(4000 / max(values.size, 1), 0.6, 12)))], Axis(key, unit), y)


@drawn
def exponent_sweep(result: xr.Dataset, ax: Axes | None = None, *, exponent: int = 1) -> Panel:
    """A Lyapunov exponent over the parameter of a sweep: each member, and the median of each column.

    Raises:
        SlidewayError: the result is no sweep, or has no exponents.

    >>> slideway.plot.exponent_sweep(slideway.example()).get_ylabel()
    'λ₁ [1/s]'
    """
    key, parameter = _parameter(result)
    values, at = exponent_of(variable(result, "lyapunov_exponent"), exponent).values, parameter.values
    half = exponent_of(result["lyapunov_exponent_half_width"], exponent).values if "lyapunov_exponent_half_width" in result else np.nan * values
    factor, unit = scaled(str(parameter.attrs["units"]), at)
    members = Curve(factor * at, values, "members", opacity=0.5, dash="", marker="o", size=3, low=values - half, high=values + half)
    return Panel([Level(0.0), members, medians(factor, at, values)], Axis(key, unit), Axis(f"λ{lowered(exponent)}", "1/s"))


def medians(factor: float, at: np.ndarray, values: np.ndarray) -> Curve:
    """The medians of the columns, joined; `factor` brings the parameter into the unit of its axis."""
    columns, middle = medians_of(at, values)
    there = np.isfinite(middle)
    return Curve(factor * columns[there], middle[there], "median of the column", colours[1], width=1.4)


def medians_of(at: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The columns of a sweep, and of each the median of the members that have a number, NaN where none has."""
    columns = np.unique(at)
    parts = (values[(at == column) & np.isfinite(values)] for column in columns)
    return columns, np.array([np.median(part) if part.size else np.nan for part in parts])


def _parameter(result: xr.Dataset) -> tuple[str, xr.DataArray]:
    """The key that a sweep changes, and its value of each member."""
    name = str(result.attrs.get("sweep_parameter", ""))
    if not name:
        raise SlidewayError('this result is no sweep; use study.kind = "sweep"')
    if name not in result:
        raise SlidewayError(f"this result has lost {name}, which its sweep changes; keep the variable")
    return str(scene(result)["study"]["parameter"]), result[name]
