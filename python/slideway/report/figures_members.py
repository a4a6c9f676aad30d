"""Figures of quantities over members: histograms, shares of time by contact, the balance of energy."""

from __future__ import annotations

import math

import numpy as np

from .columns import Column
from .energy import Balance, joules
from .numbers import counted, number, percent, scaled, unit_words
from .traces import Figure, Variant, bars_of, bins, colour_of, packed, rows, text

CLASSES = ("free", "point", "line", "surface")


def histograms(every: list[Column]) -> Figure | None:
    """How each quantity scatters over the members; None where there are hardly any."""
    variants = []
    for one in every:
        if one.count < 5 or not one.high > one.low:
            continue
        if one.histogram is not None:
            edges, counts = one.histogram.edges, one.histogram.counts
        elif one.values is not None:
            edges = bins(one.values)
            counts = np.histogram(one.values, edges)[0].astype(float)
        else:
            continue
        factor, named = scaled(max(abs(one.low), abs(one.high)), one.unit)
        data = [bars_of(edges * factor, counts, one.name, colour_of(one.name))]
        unit = "" if named == "1" else f" [{text(unit_words(named))}]"
        layout = rows(["members"], f"{text(one.name)}{unit}")
        mean = one.mean * factor
        layout |= {"bargap": 0, "shapes": [_mark(mean)], "annotations": [_named(mean, "mean")]}
        variants.append(Variant(one.name, data, layout))
    if not variants:
        return None
    caption = "Counts of the members that finished."
    return Figure("histograms", "How quantities scatter", caption, variants, choice="Quantity")


def _mark(x: float) -> dict[str, object]:
    return {"type": "line", "x0": x, "x1": x, "yref": "paper", "y0": 0, "y1": 1, "line": {"color": "@c2", "width": 2}}


def _named(x: float, name: str) -> dict[str, object]:
    return {"x": x, "y": 1, "yref": "paper", "yanchor": "bottom", "text": f"{name} {number(x)}", "showarrow": False}


def mode_shares(every: list[Column]) -> Figure | None:
    """Which share of the time was spent in which contact, on average over the members."""
    times = {one.name[len("mode_time[") : -1]: one for one in every if one.name.startswith("mode_time[")}
    total = sum(one.mean for one in times.values())
    if not times or not total > 0:
        return None
    data = []
    for name in [name for name in CLASSES if name in times]:
        share = times[name].mean / total
        data.append(
            {
                "type": "bar",
                "orientation": "h",
                "name": f"{name}: {percent(share)}",
                "y": ["time"],
                "x": [100 * share],
                "marker": {"color": f"@{name}"},
                "hovertemplate": f"{name}: {percent(share)}, {number(times[name].mean)} s<extra></extra>",
            }
        )
    layout = {
        "barmode": "stack",
        "legend": {"traceorder": "normal"},
        "xaxis": {"title": {"text": "share of the time [%]"}, "range": [0, 100]},
        "yaxis": {"visible": False},
        "hovermode": "closest",
    }
    count = next(iter(times.values())).count
    caption = f"By the stiffest contact at each time; free is flight without any. Mean of {counted(count, 'member')}."
    return Figure("modes", "Time by contact mode", caption, [Variant("all", data, layout)], height=210)


def energy_balance(terms: Balance, whose: str) -> Figure | None:
    """Where energy came from and where it went; None where the file lacks a term."""
    kept = terms.gained - terms.lost
    if not math.isfinite(kept):
        return None
    parts = [
        ("drive", terms.work, "@c1", "came from"),
        ("loads", terms.loads, "@c1/0.6", "came from"),
        ("ground's motion", terms.ground, "@c1/0.35", "came from"),
        ("made by law and method", terms.residual, "@bad", "came from"),
        ("friction", terms.friction, "@c2", "went to"),
        ("contact damping", terms.damping, "@c3", "went to"),
        ("dampers of springs and stops", terms.dampers, "@c3/0.6", "went to"),
        ("oil film", terms.film, "@c3/0.35", "went to"),
        ("motion, height, springs", kept, "@c4", "went to"),
    ]
    data = []
    for name, amount, colour, side in parts:
        if amount == 0:
            continue
        if amount < 0:
            side, amount = ("came from" if side == "went to" else "went to"), -amount
        data.append(
            {
                "type": "bar",
                "orientation": "h",
                "name": name,
                "y": [side],
                "x": packed([1e3 * amount]),
                "marker": {"color": colour},
                "hovertemplate": f"{name}: {joules(amount)}<extra></extra>",
            }
        )
    layout = {
        "barmode": "stack",
        "legend": {"traceorder": "normal"},
        "xaxis": {"title": {"text": "mJ per member"}},
        "yaxis": {"categoryorder": "array", "categoryarray": ["went to", "came from"]},
        "hovermode": "closest",
    }
    caption = f"Means over {whose}. Both bars are as long as each other, for the residual is what closes the balance."
    return Figure("balance", "Balance of energy", caption, [Variant("all", data, layout)], height=250)
