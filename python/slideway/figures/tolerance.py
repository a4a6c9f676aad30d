"""Distributions of quantities, and what they depend on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from ..arguments import text
from ..columns import Column, columns, group_of
from ..distribution import bounds, ran, steps, whose
from ..errors import SlidewayError
from ..palette import class_colours, colours, limit_colour
from ..results import holds_all
from ..scenes import scene
from ..units import scaled
from .base import Axes, drawn, variable, words_of
from .marks import Axis, Band, Curve, Level, Mark, Panel, Rows, named


@drawn
def quantiles(result: xr.Dataset, name: str | None = None, ax: Axes | None = None) -> Panel:
    """The distribution function of a quantity, quantiles with their 95 % intervals, and the scene's limits.

    All shares are of the members that ran, of a saltelli design those of A and B; members that failed meet no limit and lie beyond
    the end of the curve. Stored members give
    the empirical distribution function, a step at each of them. Of a file with statistics alone a band is drawn, in which the
    function lies: the histogram knows it at the edges of its bins. A quantity with several values per member has a curve for each.
    Of a selection of members there are no quantiles, for those of the file are of all.

    Args:
        name: of the quantity; left out: the first of study.quantities.

    Raises:
        SlidewayError: there is no such quantity, or no member finished.

    >>> slideway.plot.quantiles(slideway.example(), "peak_normal_force").get_ylabel()
    'share of the 12 members that ran [%]'
    """
    name = _first_quantity(result, None) if name is None else text(name, "name")
    if name in result.data_vars and {"member", "sample"} <= set(result[name].dims):
        raise SlidewayError(f"{name} is a series over the time; see slideway.plot.time_series")
    every = columns(result, [name])
    if not every:
        variable(result, name)
        raise SlidewayError(f"{name} is no quantity of members; see study.quantities")
    if not any(one.count for one in every):
        raise SlidewayError("no member finished; see slideway.statuses(result)")
    trials = ran(result) if {"status", "status_value"} & set(result.variables) else result.sizes.get("member", 0)
    return distribution(every, *limits_of(result), trials, whose(result))


def limits_of(result: xr.Dataset) -> tuple[dict[str, Any], dict[str, int]]:
    """The scene's limits by the names of columns, and how many members the file says to meet each."""
    group = group_of(result, "yield")
    met = {} if group is None else dict(zip(map(str, group["limit"].values), map(int, group["met"].values), strict=True))
    return scene(result).get("study", {}).get("limits", {}) if "scene" in result.attrs else {}, met


def distribution(every: Sequence[Column], limits: Mapping[str, Any], met: Mapping[str, int], trials: int, whose: str) -> Panel:
    """The distribution functions of columns of one quantity, as shares of `trials` members."""
    factor, unit = scaled(every[0].unit, [(one.low, one.high) for one in every])
    tints = [class_colours.get(one.component, colours[k % len(colours)]) for k, one in enumerate(every)]
    curves: list[Mark] = []
    dots: list[Mark] = []
    for one, colour in zip(every, tints, strict=True):
        if one.values is not None:
            x, y = steps(one.values, trials)
            x, y = np.concatenate([x[:1], x]), np.concatenate([np.zeros(min(x.size, 1)), y])
            curves.append(Curve(factor * x, y, one.component or f"{one.values.size} {whose}", colour, width=1.3, steps=True))
        elif one.histogram is not None:
            x, low, high = bounds(one.histogram.edges, one.histogram.counts, trials)
            curves.append(Band(factor * x, low, high, one.component or "bounds: members are not stored", colour, 0.4, 0.5))
        if one.of_file:
            values, shares = np.array(list(one.quantiles.values())), 100 * one.count / max(trials, 1) * np.array(list(one.quantiles))
            low, high = np.array([one.quantile_intervals.get(p, (np.nan, np.nan)) for p in one.quantiles]).T
            dots.append(Curve(factor * values, shares, None if one.component else "quantiles, 95 % intervals", colour, width=1.0, dash="", marker="o", size=3.5,
                              low=factor * low, high=factor * high, along="x"))  # fmt: skip
    name = words_of(every[0].name if len(every) == 1 else every[0].name.partition("[")[0])
    levels = [level for one in every for level in _limits(one, limits.get(one.name, {}), met, trials, factor)]
    return Panel([*curves, *dots, *levels], Axis(name, unit), Axis(f"share of the {trials} {whose} that ran", "%", low=-2, high=102))


def _limits(one: Column, ends: Mapping[str, Any], met: Mapping[str, int], trials: int, factor: float) -> list[Level]:
    """Limits of a column, and how many of the members that ran keep to them."""
    low, high = float(ends.get("min", -np.inf)), float(ends.get("max", np.inf))
    kept = met.get(one.name) if one.values is None else int(((one.values >= low) & (one.values <= high)).sum())
    words = "limit" + (f", kept by {kept / max(trials, 1):.1%}" if kept is not None else "")
    return [Level(factor * value, "x", words, limit_colour, 1.5, "--") for value in (low, high) if np.isfinite(value)]


@drawn
def sensitivity(result: xr.Dataset, name: str | None = None, component: str | None = None, ax: Axes | None = None) -> Panel:
    """What a quantity depends on: Sobol indices of a saltelli design, rank correlations of others, with 95 % intervals.

    Args:
        result: of a tolerance study, or its group "sensitivity".
        name: of the quantity; left out: the first.
        component: of a quantity with several values per member, one of its labels ("free", "P1", "x"); left out: the first.

    Raises:
        SlidewayError: the result has no group "sensitivity", no such quantity, or one that varies by no more than rounding.

    >>> import xarray as xr
    >>> group = xr.Dataset({"wear_rank_correlation": ("input", [0.8, -0.2])}, coords={"input": ["way.roll", "friction.kinetic"]})
    >>> [text.get_text() for text in slideway.plot.sensitivity(group, "wear").get_yticklabels()]
    ['friction.kinetic', 'way.roll']
    """
    group = result if "input" in result.dims else group_of(result, "sensitivity")
    if group is None and result.encoding.get("source") and not holds_all(result):
        raise SlidewayError("sensitivities are of all members of the file; plot them from the whole result")
    if group is None:
        raise SlidewayError('this result has no sensitivities; use study.kind = "tolerance" with keys in study.vary')
    name = _first_quantity(result, group) if name is None else text(name, "name")
    kinds = {"total": "total", "first": "first order"} if f"{name}_first" in group else {"rank_correlation": "rank correlation"}
    if not any(f"{name}_{kind}" in group for kind in kinds):
        raise SlidewayError(f'the sensitivities have no {name}; add "{name}" to study.quantities')
    own = group[f"{name}_{next(iter(kinds))}"]
    place, label = _place(own, component)
    values = own.isel(place).values
    if not np.isfinite(values).any():
        full = f"{name}[{label}]" if label else name
        why = [reason.removeprefix(full) for reason in str(group.attrs.get("without_index", "")).split("; ") if reason.startswith(full + " ")]
        raise SlidewayError(f"{full} has no sensitivities{', for it' + why[0] if why else ''}; plot a quantity that varies")
    order = np.argsort(np.abs(values), kind="stable")
    marks: list[Mark] = []
    for (kind, words), colour in zip(kinds.items(), colours, strict=False):
        interval = f"{name}_{kind}_interval"
        low, high = group[interval].isel(place).values[order].T if interval in group else (None, None)
        bars = group[f"{name}_{kind}"].isel(place).values[order]
        marks.append(Rows(bars, words if len(kinds) == 2 else None, colour, low, high))  # else the axis says it
    what = words_of(name) + (f" [{label}]" if label else "")
    x = Axis(f"{'Sobol index' if len(kinds) == 2 else 'rank correlation'} of {what}")
    return Panel([*marks, Level(0.0, "x")], x, Axis("", ticks=named([str(key) for key in own["input"].values[order]])))


def _place(data: xr.DataArray, wanted: str | None) -> tuple[dict[str, int], str]:
    """Where the values of a component lie, and its name; of the first where none is wanted."""
    other = next((str(d) for d in data.dims if d != "input"), None)
    labels = [str(entry) for entry in data[other].values] if other else [""]
    if wanted is not None and (other is None or wanted not in labels):
        raise SlidewayError(f"there is no component {wanted}, but {', '.join(labels) if other else 'one value alone'}")
    label = labels[0] if wanted is None else wanted
    return ({other: labels.index(label)} if other else {}), label


def _first_quantity(result: xr.Dataset, group: xr.Dataset | None) -> str:
    """The quantity that is shown if none is named."""
    named = scene(result).get("study", {}).get("quantities", []) if "scene" in result.attrs else []
    there = [str(v) for v in (group if group is not None else result).variables]
    for name in named:
        if group is None or any(v.startswith(name) for v in there):
            return str(name)
    if group is not None:
        return there[0].split("_rank")[0].split("_first")[0]
    raise SlidewayError("the scene names no quantities; add some to study.quantities, see slideway list")
