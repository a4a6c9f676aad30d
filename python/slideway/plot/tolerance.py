"""Distributions of quantities, and what they depend on."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from ..errors import SlidewayError
from ..members import finished
from ..results import groups
from ..results import open as open_result
from ..scenes import scene
from .style import axis, class_colours, colours, finish, grey, label, scaled, variable, words_of


def quantiles(result: xr.Dataset, name: str | None = None, ax: Axes | None = None) -> Axes:
    """The distribution of a quantity: its share of members below a value, quantiles with 95 % intervals, and the scene's limits.

    Of a file without statistics the curve is that of the members that finished. A quantity with several values per member has a
    curve for each.

    Args:
        name: of the quantity; left out: the first of study.quantities.

    Raises:
        SlidewayError: there is no such quantity, or no member finished.

    >>> slideway.plot.quantiles(slideway.example(), "peak_normal_force").get_ylabel()
    'members [%]'
    """
    name = _first_quantity(result, None) if name is None else name
    group = _group(result, "statistics")
    ax = axis(ax)
    if group is not None and f"{name}_quantile" in group:
        edge = group[f"{name}_bin_edge"]
        factor, unit = scaled(str(edge.attrs["units"]), edge.values)
        for entry, colour in _components(group[f"{name}_quantile"], ("probability",)):
            _draw_statistics(ax, group, name, entry, factor, colour)
    else:
        data = variable(result, name)
        if "member" not in data.dims:
            raise SlidewayError(f"{name} is no quantity of members; see study.quantities")
        if "sample" in data.dims:
            raise SlidewayError(f"{name} is a series over the time; see slideway.plot.time_series")
        factor, unit = scaled(str(data.attrs.get("units", "1")), data.values)
        ended = finished(result).values if "status" in result else np.full(data.sizes["member"], True)
        for entry, colour in _components(data, ("member",)):
            values = np.sort(data.sel(entry).values[ended])
            values = values[np.isfinite(values)]
            if values.size == 0:
                raise SlidewayError("no member finished; see slideway.statuses(result)")
            ax.step(factor * values, 100 * np.arange(1, values.size + 1) / values.size, where="post", color=colour, lw=1.3,
                    label=_name_of(entry) or f"{values.size} members")
    _draw_limits(ax, result, name, factor)
    ax.set_ylim(-2, 102)
    return finish(ax, label(words_of(name), unit), "members [%]")


def sensitivity(result: xr.Dataset, name: str | None = None, component: str | None = None, ax: Axes | None = None) -> Axes:
    """What a quantity depends on: Sobol indices of a saltelli design, rank correlations of others, with 95 % intervals.

    Args:
        result: of a tolerance study, or its group "sensitivity".
        name: of the quantity; left out: the first.
        component: of a quantity with several values per member, one of its labels ("free", "P1", "x"); left out: the first.

    Raises:
        SlidewayError: the result has no group "sensitivity", or no such quantity.

    >>> import xarray as xr
    >>> group = xr.Dataset({"wear_rank_correlation": ("input", [0.8, -0.2])}, coords={"input": ["way.roll", "friction.kinetic"]})
    >>> [text.get_text() for text in slideway.plot.sensitivity(group, "wear").get_yticklabels()]
    ['friction.kinetic', 'way.roll']
    """
    group = result if "input" in result.dims else _group(result, "sensitivity")
    if group is None:
        raise SlidewayError('this result has no sensitivities; use study.kind = "tolerance" with keys in study.vary')
    name = _first_quantity(result, group) if name is None else name
    kinds = {"total": "total", "first": "first order"} if f"{name}_first" in group else {"rank_correlation": "rank correlation"}
    if not any(f"{name}_{kind}" in group for kind in kinds):
        raise SlidewayError(f'the sensitivities have no {name}; add "{name}" to study.quantities')
    own = group[f"{name}_{next(iter(kinds))}"]
    entry = _component(own, component)
    order = np.argsort(np.abs(own.sel(entry).values))
    inputs = own["input"].values[order]
    place = np.arange(order.size)
    height = 0.8 / len(kinds)
    ax = axis(ax)
    for i, (kind, words) in enumerate(kinds.items()):
        values = group[f"{name}_{kind}"].sel(entry).values[order]
        at = place + ((len(kinds) - 1) / 2 - i) * height
        ax.barh(at, values, height, color=colours[i], alpha=0.8, label=words)
        interval = f"{name}_{kind}_interval"
        if interval in group:
            low, high = group[interval].sel(entry).values[order].T
            ax.errorbar(values, at, xerr=[np.maximum(values - low, 0), np.maximum(high - values, 0)], fmt="none", color="#222222",
                        lw=1, capsize=2)
    ax.axvline(0, color=grey, lw=1)
    ax.set_yticks(place, inputs)
    what = words_of(name) + (f" [{_name_of(entry)}]" if entry else "")
    finish(ax, f"{'Sobol index' if len(kinds) == 2 else 'rank correlation'} of {what}", "", "lower right" if len(kinds) == 2 else None)
    ax.grid(False, axis="y")
    return ax


def _group(result: xr.Dataset, name: str) -> xr.Dataset | None:
    """A group of the result's file, if it has one."""
    if not result.encoding.get("source") or name not in groups(result):
        return None
    return open_result(result.encoding["source"], group=name)


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


def _components(data: xr.DataArray, dims: tuple[str, ...]) -> list[tuple[dict[str, str], str]]:
    """The values of a quantity that has several: their labels and colours."""
    other = [str(d) for d in data.dims if d not in dims]
    if not other:
        return [({}, colours[0])]
    labels = [str(entry) for entry in data[other[0]].values]
    return [({other[0]: entry}, class_colours.get(entry, colours[i % len(colours)])) for i, entry in enumerate(labels)]


def _component(data: xr.DataArray, wanted: str | None) -> dict[str, str]:
    entries = [entry for entry, _ in _components(data, ("input",))]
    for entry in entries:
        if wanted is None or _name_of(entry) == wanted:
            return entry
    raise SlidewayError(f"there is no component {wanted}, but {', '.join(_name_of(e) for e in entries) or 'one value alone'}")


def _name_of(entry: dict[str, str]) -> str:
    return next(iter(entry.values()), "")


def _draw_statistics(ax: Axes, group: xr.Dataset, name: str, entry: dict[str, str], factor: float, colour: str) -> None:
    """The distribution as the file's statistics have it."""
    edges = group[f"{name}_bin_edge"].sel(entry).values
    counts = group[f"{name}_bin_count"].sel(entry).values
    used = np.isfinite(edges)
    total = int(counts.sum())
    below = np.concatenate([[0.0], np.cumsum(counts[: used.sum() - 1])]) * 100 / max(total, 1)
    ax.plot(factor * edges[used], below, color=colour, lw=1.3, label=_name_of(entry) or f"{total} members")
    values = group[f"{name}_quantile"].sel(entry).values
    low, high = group[f"{name}_quantile_interval"].sel(entry).transpose("bound", "probability").values
    ax.errorbar(factor * values, 100 * group["probability"].values,
                xerr=factor * np.array([np.maximum(values - low, 0), np.maximum(high - values, 0)]),
                fmt="o", ms=3.5, color=colour, lw=1, capsize=2.5, label="quantiles, 95 % intervals" if not entry else None)


def _draw_limits(ax: Axes, result: xr.Dataset, name: str, factor: float) -> None:
    """Limits of the quantity, and how many members keep to them."""
    group = _group(result, "yield")
    if group is None or "limit" not in group.coords:
        return
    for i, limited in enumerate(group["limit"].values):
        if str(limited).split("[")[0] != name:
            continue
        for end in ("low", "high"):
            value = float(group[end].values[i])
            if np.isfinite(value):
                ax.axvline(factor * value, color=colours[1], lw=1.5, ls="--",
                           label=f"limit, kept by {float(group['share'].values[i]):.1%}")
