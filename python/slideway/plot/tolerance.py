"""Distributions of quantities, and what they depend on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from ..arguments import text
from ..distribution import bounds, drawn, ran, steps, whose
from ..errors import SlidewayError
from ..members import finished
from ..palette import class_colours, colours, grey, limit_colour
from ..results import groups, holds_all, path_of
from ..results import open as open_result
from ..scenes import scene
from .style import axis, finish, label, of_result, scaled, variable, words_of


@of_result
def quantiles(result: xr.Dataset, name: str | None = None, ax: Axes | None = None) -> Axes:
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
    group = _group(result, "statistics")
    trials = ran(result) if {"status", "status_value"} & set(result.variables) else result.sizes.get("member", 0)
    if name in result.data_vars and "member" in result[name].dims:
        data = result[name]
        if "sample" in data.dims:
            raise SlidewayError(f"{name} is a series over the time; see slideway.plot.time_series")
        factor, unit = scaled(str(data.attrs.get("units", "1")), data.values)
        ended = finished(result).values & drawn(result) if "status" in result else np.full(data.sizes["member"], True)
        curves = [(steps(data.isel(entry.place).values[ended], trials), entry) for entry in _components(data, ("member",))]
        if not any(x.size for (x, _), _ in curves):
            raise SlidewayError("no member finished; see slideway.statuses(result)")
        ax = axis(ax)
        for (x, y), entry in curves:
            ax.step(factor * x, y, where="post", color=entry.colour, lw=1.3, label=entry.label or f"{ended.sum()} {whose(result)}")
        for (x, y), entry in curves:
            ax.vlines(factor * x[:1], 0, y[:1], color=entry.colour, lw=1.3)
    elif group is not None and f"{name}_quantile" in group:
        edge = group[f"{name}_bin_edge"]
        factor, unit = scaled(str(edge.attrs["units"]), edge.values)
        ax = axis(ax)
        for entry in _components(group[f"{name}_quantile"], ("probability",)):
            _draw_bounds(ax, group, name, entry, factor, trials)
    else:
        variable(result, name)
        raise SlidewayError(f"{name} is no quantity of members; see study.quantities")
    if group is not None and f"{name}_quantile" in group:
        for entry in _components(group[f"{name}_quantile"], ("probability",)):
            _draw_quantiles(ax, group, name, entry, factor, trials)
    _draw_limits(ax, result, name, factor, trials)
    ax.set_ylim(-2, 102)
    return finish(ax, label(words_of(name), unit), f"share of the {trials} {whose(result)} that ran [%]")


@of_result
def sensitivity(result: xr.Dataset, name: str | None = None, component: str | None = None, ax: Axes | None = None) -> Axes:
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
    group = result if "input" in result.dims else _group(result, "sensitivity")
    if group is None and result.encoding.get("source") and not holds_all(result):
        raise SlidewayError("sensitivities are of all members of the file; plot them from the whole result")
    if group is None:
        raise SlidewayError('this result has no sensitivities; use study.kind = "tolerance" with keys in study.vary')
    name = _first_quantity(result, group) if name is None else text(name, "name")
    kinds = {"total": "total", "first": "first order"} if f"{name}_first" in group else {"rank_correlation": "rank correlation"}
    if not any(f"{name}_{kind}" in group for kind in kinds):
        raise SlidewayError(f'the sensitivities have no {name}; add "{name}" to study.quantities')
    own = group[f"{name}_{next(iter(kinds))}"]
    entry = _component(own, component)
    if not np.isfinite(own.isel(entry.place).values).any():
        full = f"{name}[{entry.label}]" if entry.label else name
        why = [reason.removeprefix(full) for reason in str(group.attrs.get("without_index", "")).split("; ") if reason.startswith(full + " ")]
        raise SlidewayError(f"{full} has no sensitivities{', for it' + why[0] if why else ''}; plot a quantity that varies")
    order = np.argsort(np.abs(own.isel(entry.place).values))
    inputs = own["input"].values[order]
    place = np.arange(order.size)
    height = 0.8 / len(kinds)
    ax = axis(ax)
    for i, (kind, words) in enumerate(kinds.items()):
        values = group[f"{name}_{kind}"].isel(entry.place).values[order]
        at = place + ((len(kinds) - 1) / 2 - i) * height
        ax.barh(at, values, height, color=colours[i], alpha=0.8, label=words if len(kinds) == 2 else None)  # else the axis says it
        interval = f"{name}_{kind}_interval"
        if interval in group:
            low, high = group[interval].isel(entry.place).values[order].T
            reach = np.nan_to_num(np.maximum([values - low, high - values], 0))  # none where an end is not known
            ax.errorbar(values, at, xerr=reach, fmt="none", color="#222222", lw=1)
    ax.axvline(0, color=grey, lw=1)
    ax.set_yticks(place, inputs)
    what = words_of(name) + (f" [{entry.label}]" if entry.label else "")
    finish(ax, f"{'Sobol index' if len(kinds) == 2 else 'rank correlation'} of {what}", "")
    ax.grid(False, axis="y")
    return ax


def _group(result: xr.Dataset, name: str) -> xr.Dataset | None:
    """A group of the result's file, if it has one and the result is all of the file."""
    if not result.encoding.get("source") or name not in groups(result) or not holds_all(result):
        return None
    with open_result(path_of(result), group=name) as group:
        return group.load()


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


@dataclass(frozen=True)
class _Entry:
    """One of the values of a quantity that has several, or its only one."""

    place: dict[str, int]
    label: str
    colour: str


def _components(data: xr.DataArray, dims: tuple[str, ...]) -> list[_Entry]:
    """The values of a quantity beyond these dimensions."""
    other = [str(d) for d in data.dims if d not in dims]
    if not other:
        return [_Entry({}, "", colours[0])]
    labels = [str(entry) for entry in data[other[0]].values]
    return [_Entry({other[0]: i}, entry, class_colours.get(entry, colours[i % len(colours)])) for i, entry in enumerate(labels)]


def _component(data: xr.DataArray, wanted: str | None) -> _Entry:
    entries = _components(data, ("input",))
    for entry in entries:
        if wanted is None or entry.label == wanted:
            return entry
    raise SlidewayError(f"there is no component {wanted}, but {', '.join(e.label for e in entries) or 'one value alone'}")


def _draw_bounds(ax: Axes, group: xr.Dataset, name: str, entry: _Entry, factor: float, trials: int) -> None:
    """The band in which the distribution function lies."""
    edges = group[f"{name}_bin_edge"].isel(entry.place).values
    edges = edges[np.isfinite(edges)]
    x, low, high = bounds(edges, group[f"{name}_bin_count"].isel(entry.place).values[: max(edges.size - 1, 0)], trials)
    ax.fill_between(factor * x, low, high, color=entry.colour, alpha=0.4, lw=0.5, label=entry.label or "bounds: members are not stored")


def _draw_quantiles(ax: Axes, group: xr.Dataset, name: str, entry: _Entry, factor: float, trials: int) -> None:
    """Quantiles of the members that finished, as shares of those that ran, and the ends of their intervals that are known."""
    values = group[f"{name}_quantile"].isel(entry.place).values
    low, high = group[f"{name}_quantile_interval"].isel(entry.place).transpose("bound", "probability").values
    share = 100 * int(group[f"{name}_count"].isel(entry.place)) / max(trials, 1)
    # Without caps: an end that is not known would have one at the quantile.
    reach = np.nan_to_num(np.maximum([values - low, high - values], 0))
    ax.errorbar(factor * values, share * group["probability"].values, xerr=factor * reach, fmt="o", ms=3.5, color=entry.colour, lw=1,
                label=None if entry.label else "quantiles, 95 % intervals")


def _draw_limits(ax: Axes, result: xr.Dataset, name: str, factor: float, trials: int) -> None:
    """Limits of the quantity, and how many of the members that ran keep to them."""
    limits = scene(result).get("study", {}).get("limits", {}) if "scene" in result.attrs else {}
    for limited, ends in limits.items():
        stem, _, component = str(limited).removesuffix("]").partition("[")
        if stem != name:
            continue
        low, high = float(ends.get("min", -np.inf)), float(ends.get("max", np.inf))
        kept = _kept(result, name, component, low, high)
        share = f", kept by {kept / max(trials, 1):.1%}" if kept is not None else ""
        for value in (low, high):
            if np.isfinite(value):
                ax.axvline(factor * value, color=limit_colour, lw=1.5, ls="--", label="limit" + share)


def _kept(result: xr.Dataset, name: str, component: str, low: float, high: float) -> int | None:
    """How many members finished within the limits; None where neither members nor the file say."""
    if name in result and "member" in result[name].dims:
        entries = [entry for entry in _components(result[name], ("member",)) if entry.label == component]
        values = result[name].isel(entries[0].place).values if entries else np.array([])
        return int((finished(result).values & drawn(result) & (values >= low) & (values <= high)).sum()) if entries else None
    group = _group(result, "yield")
    named = f"{name}[{component}]" if component else name
    return int(group["met"].sel(limit=named)) if group is not None and named in group["limit"].values else None
