"""Figures drawn by plotly.js, in the one place that knows it: panels as its traces and layout, with packed numbers and colours by the page's names."""

from __future__ import annotations

import base64
import html
import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from slideway.escapes import escaped
from slideway.figures.marks import Axis, Band, Bars, Cloud, Curve, Level, Mark, Note, Panel, Rows, Shape, reach
from slideway.palette import names_of_colours

MOST_POINTS = 5000  # of a trace

Trace = dict[str, Any]


@dataclass(frozen=True)
class Variant:
    """One of the pictures that a figure shows in turn: panels one above the other, over one x axis."""

    label: str
    panels: Sequence[Panel]


@dataclass(frozen=True)
class Figure:
    """A figure of the page: variants to choose from, and what to know when one looks at it."""

    name: str  # of its element
    title: str
    caption: str
    variants: list[Variant]
    height: int = 380  # [px]
    choice: str = "Show"  # label of the choice between variants


def library() -> str:
    """The text of plotly.js, which reads what :func:`plot` makes."""
    from plotly.offline import get_plotlyjs  # takes its time

    return str(get_plotlyjs())


def packed(values: ArrayLike, kind: str = "f4") -> dict[str, str]:
    """Numbers as plotly.js and the animation read them: {"dtype", "bdata"}, little-endian, base64; f4 holds seven digits.

    >>> packed([1, 2], "u1")
    {'dtype': 'u1', 'bdata': 'AQI='}
    """
    array = np.ascontiguousarray(values, dtype=np.dtype(kind).newbyteorder("<"))
    return {"dtype": kind, "bdata": base64.b64encode(array.tobytes()).decode("ascii")}


def text(words: object) -> str:
    """Text of a file for plotly.js, which reads some HTML in labels."""
    return html.escape(escaped(str(words)))


def colour(of: str, opacity: float = 1.0) -> str:
    """A colour of the palette as the page knows it.

    >>> colour("#0b6bb8", 0.5), colour("#8b96a2"), colour("#123456")
    ('@c1/0.5', '@free', '#123456')
    """
    return f"@{names_of_colours[of]}" + (f"/{opacity:g}" if opacity < 1 else "") if of in names_of_colours else of


def thinned(values: NDArray[Any], most: int = MOST_POINTS) -> NDArray[np.int64]:
    """Which points of a long series to draw: of each stretch the least and the largest, in their order.

    >>> spike = np.zeros(10000); spike[4321] = 1.0
    >>> kept = thinned(spike, 100)
    >>> len(kept) <= 100, 4321 in kept
    (True, True)
    """
    if len(values) <= most:
        return np.arange(len(values))
    kept: list[int] = []
    for stretch in np.array_split(np.arange(len(values)), most // 2):
        there = stretch[np.isfinite(values[stretch])]
        if len(there):
            kept += [there[np.argmin(values[there])], there[np.argmax(values[there])]]
    return np.unique(kept)


def plot(panels: Sequence[Panel]) -> dict[str, Any]:
    """Data and layout of panels."""
    data: list[Trace] = []
    told: set[str] = set()  # names in the legend
    layout = _axes(panels) | {"shapes": [], "annotations": []}
    for row, panel in enumerate(panels, start=1):
        of_row = {} if row == 1 else {"yaxis": f"y{row}"}
        edges = [mark.value for mark in panel.marks if isinstance(mark, Level) and mark.of == "x"]
        for mark in panel.marks:
            if isinstance(mark, (Level, Shape)):
                shapes, notes = _shapes(mark, row)
                layout["shapes"] += shapes
                layout["annotations"] += notes
            else:
                label = getattr(mark, "label", None)
                named = {"name": text(label or panel.y.words), "showlegend": label is not None and label not in told, **of_row}
                data += [{**named, **trace} for trace in _traces(mark, panel, edges)]
                told.add(label or "")
        if panel.stacked:
            layout |= {"barmode": "stack", "legend": {"traceorder": "normal"}}
    if layout["annotations"]:
        layout["showlegend"] = False  # it would lie over them
    return {"data": data, "layout": layout}


def _axes(panels: Sequence[Panel]) -> dict[str, Any]:
    """Rows one above the other, the first on top, on the x axis of the last."""
    count, last = len(panels), panels[-1]
    gap = 0.06 if count > 1 else 0.0
    height = (1 - gap * (count - 1)) / count
    layout: dict[str, Any] = {"xaxis": {**_axis(last.x, text(last.x.label)), "anchor": "y" if count == 1 else f"y{count}"}}
    layout["hovermode"] = "x" if last.x.tight else "closest"
    for row, panel in enumerate(panels, start=1):
        top = 1 - (row - 1) * (height + gap)
        lines = [panel.y.label] if count == 1 else textwrap.wrap(panel.y.words, 16) + ([f"[{panel.y.unit}]"] if panel.y.unit else [])
        layout["yaxis" if row == 1 else f"yaxis{row}"] = {**_axis(panel.y, "<br>".join(map(text, lines))), "domain": [max(top - height, 0.0), top]}
    if last.equal:
        layout["yaxis"] |= {"scaleanchor": "x", "scaleratio": 1, "constrain": "domain"}
        layout["xaxis"] |= {"constrain": "domain"}
    return layout


def _axis(axis: Axis, title: str) -> dict[str, Any]:
    made: dict[str, Any] = {"title": {"text": title}}
    if axis.log:
        made["type"] = "log"
    if axis.low is not None or axis.high is not None:
        made["range"] = [None if end is None else float(np.log10(end) if axis.log else end) for end in (axis.low, axis.high)]
    return made


def _traces(mark: Mark, panel: Panel, edges: list[float]) -> list[Trace]:
    match mark:
        case Curve():
            kept = _kept(mark, edges)
            # Eight bytes: a value rounded to four might pass to the other side of a limit.
            trace: Trace = {"type": "scatter", "x": packed(mark.x[kept], "f8" if mark.steps else "f4"), "y": packed(mark.y[kept], "f8" if mark.steps else "f4")}
            trace["mode"] = "+".join(["lines"] * bool(mark.dash) + ["markers"] * bool(mark.marker))
            tint = colour(mark.colour, mark.opacity)
            if mark.dash:
                trace["line"] = {"color": tint, "width": max(mark.width, 0.8), "dash": _dashes[mark.dash]} | ({"shape": "hv"} if mark.steps else {})
            if mark.marker:
                trace["marker"] = {"color": tint, "size": 1.4 * mark.size, "symbol": "circle-open" if mark.hollow else "circle"}
            if mark.low is not None and mark.high is not None:
                values = (mark.x if mark.along == "x" else mark.y)[kept]
                trace[f"error_{mark.along}"] = _interval(values, mark.low[kept], mark.high[kept], colour(mark.colour, 0.6))
            return [trace]
        case Cloud():
            kept = np.arange(len(mark.x)) if len(mark.x) <= MOST_POINTS else np.linspace(0, len(mark.x) - 1, MOST_POINTS).round().astype(int)
            marker = {"color": colour(mark.colour, mark.opacity), "size": float(max(1.4 * np.sqrt(mark.size), 2.5))}
            return [{"type": "scatter", "mode": "markers", "x": packed(mark.x[kept]), "y": packed(mark.y[kept]), "marker": marker}]
        case Band():
            tint = colour(mark.colour, mark.opacity)
            bare = {"type": "scatter", "mode": "lines", "line": {"color": tint, "width": mark.width}, "hoverinfo": "skip", "legendgroup": text(mark.label)}
            low, high = ({**bare, "x": packed(mark.x[kept]), "y": packed(end[kept])} for end in (mark.low, mark.high) for kept in [thinned(end)])
            return [{**low, "showlegend": False}, {**high, "fill": "tonexty", "fillcolor": tint}]
        case Bars(outlined=True):
            line = {"color": colour(mark.colour), "width": 1.5, "shape": "hv"}
            heights = np.append(mark.heights, mark.heights[-1:])
            return [{"type": "scatter", "mode": "lines", "x": packed(mark.edges), "y": packed(heights), "line": line, "fill": "tozeroy",
                     "fillcolor": colour(mark.colour, 0.3)}]  # fmt: skip
        case Bars():
            marker = {"color": colour(mark.colour, mark.opacity), "line": {"color": "@paper", "width": 0.5}}
            middles, widths = (mark.edges[:-1] + mark.edges[1:]) / 2, np.diff(mark.edges)
            return [{"type": "bar", "x": packed(middles), "width": packed(widths), "y": packed(mark.heights), "marker": marker}]
        case Rows():
            names = [text(name) for name in (panel.y.ticks or {}).values()]
            trace = {"type": "bar", "orientation": "h", "y": names, "x": packed(mark.values), "marker": {"color": colour(mark.colour)}}
            if mark.low is not None and mark.high is not None and np.isfinite([mark.low, mark.high]).any():
                trace["error_x"] = _interval(mark.values, mark.low, mark.high, "@muted")
            return [trace]
        case Note():
            words = text(mark.label).replace("\n", "<br>")
            return [{"type": "scatter", "mode": "markers", "x": [None], "y": [None], "name": words, "marker": {"opacity": 0}, "hoverinfo": "skip"}]
    raise TypeError(f"pages have no {type(mark).__name__}")


_dashes = {"-": "solid", "--": "dash", ":": "dot"}


def _kept(curve: Curve, edges: list[float]) -> NDArray[np.int64]:
    """Which points of a long curve are drawn. Those of steps beside the limits stay, so that the curve has there what the file says."""
    if len(curve.x) <= MOST_POINTS:
        return np.arange(len(curve.x))
    if curve.steps:
        beside = [k for edge in edges for k in (np.searchsorted(curve.x, edge, side="right") - 1, np.searchsorted(curve.x, edge))]
        even = np.linspace(0, curve.x.size - 1, MOST_POINTS).round()
        return np.unique(np.concatenate([even, np.clip(beside, 0, curve.x.size - 1)]).astype(int))
    kept = thinned(curve.y)
    return kept if np.all(np.diff(curve.x) >= 0) else np.unique(np.concatenate([kept, thinned(curve.x)]))


def _interval(values: NDArray[Any], low: NDArray[Any], high: NDArray[Any], tint: str) -> dict[str, Any]:
    """Error bars; without caps, which would stand there even where an end is not known."""
    down, up = reach(values, low, high)
    return {"type": "data", "symmetric": False, "array": packed(up), "arrayminus": packed(down), "color": tint, "thickness": 1.2, "width": 0}


def _shapes(mark: Level | Shape, row: int) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """Lines across the panels with their names on top, and outlines."""
    if isinstance(mark, Shape):
        ring = "L".join(f"{x:.6g},{y:.6g}" for x, y in mark.points)
        return [{"type": "path", "path": f"M{ring}Z", "line": {"color": colour(mark.edge), "dash": "dot", "width": mark.width}}], []
    line = {"color": colour(mark.colour), "dash": _dashes[mark.dash], "width": mark.width}
    if mark.of == "y":
        across = {"xref": "paper", "x0": 0, "x1": 1, "yref": f"y{row}" if row > 1 else "y"}
        return [{"type": "line", **across, "y0": mark.value, "y1": mark.value, "line": line}], []
    up = {"yref": "paper", "y0": 0, "y1": 1}
    shapes: list[dict[str, Any]] = [{"type": "line", "x0": mark.value, "x1": mark.value, **up, "line": line}]
    if mark.half > 0:
        shapes.append({"type": "rect", "x0": mark.value - mark.half, "x1": mark.value + mark.half, **up, "line": {"width": 0},
                       "fillcolor": colour(mark.colour, 0.25)})  # fmt: skip
    if mark.label is None:
        return shapes, []
    return shapes, [{"x": mark.value, "y": 1, "yref": "paper", "yanchor": "bottom", "text": text(mark.label), "showarrow": False,
                     "font": {"color": colour(mark.colour)}}]  # fmt: skip
