"""Figures of tolerance studies: quantiles, yields, and what drives the scatter."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

import slideway

from slideway.distribution import bounds, steps

from .columns import Array, Column
from .numbers import counted, percent, scaled, unit_words
from .traces import MOST_POINTS, Figure, Trace, Variant, colour_of, packed, rows, text

Kinds = tuple[tuple[str, str, str], ...]  # name in the file, in words, colour


def quantiles(every: list[Column], limits: dict[str, Any], trials: int) -> Figure | None:
    """Distribution function of each quantity, with quantiles, their intervals and the scene's limits; shares of `trials` members."""
    variants = []
    for one in every:
        if len(one.quantiles) < 6 or not one.high > one.low:
            continue
        factor, named = scaled(max(abs(one.low), abs(one.high)), one.unit)
        edges = {name: float(edge) for name, edge in limits.get(one.name, {}).items()}
        data = _function(one, trials, factor, list(edges.values())) + [_quantiles(one, trials, factor)]
        unit = "" if named == "1" else f" [{text(unit_words(named))}]"
        layout = rows([f"share of {trials:,} that ran [%]"], f"{text(one.name)}{unit}")
        layout["yaxis"] |= {"range": [-2, 102]}
        layout["shapes"] = [_line(edge * factor) for edge in edges.values()]
        layout["annotations"] = [_label(edge * factor, _kept(one, name, edge, trials)) for name, edge in edges.items()]
        variants.append(Variant(one.name, data, {**layout, "hovermode": "closest", "showlegend": False}))
    if not variants:
        return None
    caption = "Distribution functions; all shares are of the members that ran, and those that failed lie beyond the end of the curve. "
    if all(one.values is not None for one in every):
        caption += "Each step is a member"
        caption += f"; of so many, {MOST_POINTS:,} are drawn." if trials > MOST_POINTS else "."
    else:
        caption += "The members are not stored: the function lies in the band, and is known at its corners."
    caption += " Dots: quantiles of the members that finished; bars: their 95 % intervals, as far as the design allows some."
    return Figure("quantiles", "Distribution functions", caption, variants, choice="Quantity")


def _function(one: Column, trials: int, factor: float, edges: list[float]) -> list[Trace]:
    """Steps at the stored members, or the band between the bounds that a histogram gives."""
    style = {"type": "scatter", "mode": "lines", "hoverinfo": "x+y"}
    colour = colour_of(one.name)
    if one.values is None:
        if one.histogram is None:
            return []
        x, low, high = bounds(one.histogram.edges, one.histogram.counts, trials)
        lines = [{**style, "x": packed(x * factor, "f8"), "y": packed(y), "line": {"color": colour, "width": 1}} for y in (low, high)]
        return [lines[0], {**lines[1], "fill": "tonexty", "fillcolor": f"{colour}/0.35"}]
    x, y = steps(one.values, trials)
    kept = np.arange(x.size)
    if x.size > MOST_POINTS:
        # Members at the limits stay, so that the curve has there what the file says.
        beside = [k for edge in edges for k in (np.searchsorted(x, edge, side="right") - 1, np.searchsorted(x, edge))]
        kept = np.unique(np.concatenate([np.linspace(0, x.size - 1, MOST_POINTS).round(), np.clip(beside, 0, x.size - 1)]).astype(int))
    ends = (np.concatenate([x[:1], x[kept]]) * factor, np.concatenate([[0.0], y[kept]]))
    # Eight bytes: a value rounded to four might pass to the other side of a limit.
    return [{**style, "x": packed(ends[0], "f8"), "y": packed(ends[1], "f8"), "line": {"color": colour, "shape": "hv", "width": 1.5}}]


def _quantiles(one: Column, trials: int, factor: float) -> Trace:
    """Quantiles as dots at their shares of the members that ran, with intervals."""
    value = np.array(list(one.quantiles.values())) * factor
    share = np.array(list(one.quantiles)) * 100 * one.count / max(trials, 1)
    marker = {"color": colour_of(one.name), "size": 6}
    trace: Trace = {"type": "scatter", "mode": "markers", "name": "quantile", "x": packed(value), "y": packed(share), "marker": marker}
    if one.quantile_intervals:
        ends = np.array(list(one.quantile_intervals.values())) * factor
        trace["error_x"] = _interval(value, ends, f"{colour_of(one.name)}/0.6")
    return trace


def _kept(one: Column, name: str, edge: float, trials: int) -> str:
    """Name of a limit, and how many of the members that ran are on its right side."""
    if one.values is None:
        return f"limit ({name})"
    kept = int((one.values >= edge if name == "min" else one.values <= edge).sum())
    return f"limit ({name}), kept by {percent(kept / max(trials, 1), 3)}"


def _interval(values: Array, ends: Array, colour: str) -> dict[str, Any]:
    """Error bars from values (n) to ends (n, 2), none where an end is unknown; without caps, which would stand there all the same."""
    up, down = (np.nan_to_num(np.clip(part, 0, None)) for part in (ends[:, 1] - values, values - ends[:, 0]))
    return {"type": "data", "symmetric": False, "array": packed(up), "arrayminus": packed(down), "color": colour, "thickness": 1.2, "width": 0}


def _line(x: float) -> dict[str, Any]:
    return {"type": "line", "x0": x, "x1": x, "yref": "paper", "y0": 0, "y1": 1, "line": {"color": "@bad", "dash": "dash"}}


def _label(x: float, name: str) -> dict[str, Any]:
    return {"x": x, "y": 1, "yref": "paper", "yanchor": "bottom", "text": text(name), "showarrow": False, "font": {"color": "@bad"}}


def yields(result: xr.Dataset) -> list[tuple[str, int, int, float, float, float]]:
    """Of each limit and of all: name, members that meet it, members that ran, share, ends of its interval (NaN for none)."""
    if "yield" not in slideway.groups(result) or not slideway.results.holds_all(result):
        return []
    with slideway.open(slideway.results.path_of(result), group="yield") as group:
        trials = int(group["trials"])
        table = []
        for k, name in enumerate(group["limit"].values.tolist()):
            one = group.isel(limit=k)
            bounds = [f"{sign} {float(one[end]):g}" for sign, end in (("≥", "low"), ("≤", "high")) if np.isfinite(one[end])]
            unit = str(one["unit_name"].values)
            words = f"{name} {' and '.join(bounds)} {'' if unit == '1' else unit}".strip()
            low, high = one["share_interval"].values.tolist()
            table.append((words, int(one["met"]), trials, float(one["share"]), low, high))
        low, high = group["all_share_interval"].values.tolist()
        table.append(("all limits", int(group["all_met"]), trials, float(group["all_share"]), low, high))
    return table


def sensitivity(result: xr.Dataset) -> Figure | None:
    """Which inputs drive each quantity: Sobol indices, or rank correlations where the design has none."""
    if "sensitivity" not in slideway.groups(result) or not slideway.results.holds_all(result):
        return None
    with slideway.open(slideway.results.path_of(result), group="sensitivity") as opened:
        group = opened.load()
    inputs = [text(name) for name in group["input"].values.tolist()]
    kinds: Kinds = (("first", "first order: alone", "@c2"), ("total", "total: with all that it interacts with", "@c1"))
    if not any(str(name).endswith("_total") for name in group):
        kinds = (("rank_correlation", "rank correlation", "@c1"),)
    variants = []
    for name in [str(name)[: -len(kinds[0][0]) - 1] for name in group if str(name).endswith(f"_{kinds[0][0]}")]:
        variable = group[f"{name}_{kinds[0][0]}"]
        others = [str(d) for d in variable.dims if d != "input"]
        labels = _labels(result, others[0], variable.sizes[others[0]]) if others else [None]
        for k, label in enumerate(labels):
            one = group if label is None else group.isel({others[0]: k})
            data = _bars(one, name, kinds, inputs)
            if data:
                layout = {
                    "xaxis": {"title": {"text": "share of the variance" if len(kinds) > 1 else "rank correlation"}},
                    "yaxis": {"automargin": True},
                    "barmode": "group",
                    "hovermode": "closest",
                }
                variants.append(Variant(name if label is None else f"{name}[{label}]", data, layout))
    if not variants:
        return None
    without = str(group.attrs.get("without_index", ""))
    if len(kinds) > 1:
        caption = (
            f"Sobol indices of {counted(int(group['rows_used']), 'row')} of the design, bars: 95 % intervals. "
            "The total less the first is what an input does together with others."
        )
    else:
        caption = "Spearman's rank correlation of input and quantity, from −1 to 1, bars: 95 % intervals where the design allows some."
    if without:
        caption += f" Without an index: {text(without)}."
    return Figure("sensitivity", "What drives the scatter", caption, variants, height=140 + 42 * len(inputs), choice="Quantity")


def _labels(result: xr.Dataset, dimension: str, size: int) -> list[str]:
    return [str(v) for v in result[dimension].values] if dimension in result.coords else [str(k) for k in range(size)]


def _bars(one: xr.Dataset, name: str, kinds: Kinds, inputs: list[str]) -> list[Trace]:
    order = np.argsort(np.abs(one[f"{name}_{kinds[-1][0]}"].values), kind="stable")  # the strongest on top
    data = []
    for kind, words, colour in reversed(kinds):
        values = one[f"{name}_{kind}"].values[order]
        if not np.isfinite(values).any():
            return []
        ends = one[f"{name}_{kind}_interval"].values[order]
        trace: Trace = {"type": "bar", "orientation": "h", "name": words, "y": [inputs[k] for k in order], "x": packed(values), "marker": {"color": colour}}
        if np.isfinite(ends).any():
            trace["error_x"] = _interval(values, ends, "@muted")
        data.append(trace)
    return data
