"""Figures as plain data for plotly.js: traces with packed numbers, axes in rows, colours by the page's names."""

from __future__ import annotations

import base64
import html
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from slideway.escapes import escaped
from slideway.palette import class_colours

MOST_POINTS = 5000  # of a trace

Trace = dict[str, Any]


@dataclass(frozen=True)
class Variant:
    """One of the pictures that a figure shows in turn."""

    label: str
    data: list[Trace]
    layout: dict[str, Any]


@dataclass(frozen=True)
class Figure:
    """A figure of the page: variants to choose from, and what to know when one looks at it."""

    name: str  # of its element
    title: str
    caption: str
    variants: list[Variant]
    height: int = 380  # [px]
    choice: str = "Show"  # label of the choice between variants
    notes: list[str] = field(default_factory=list)


def packed(values: ArrayLike, kind: str = "f4") -> dict[str, str]:
    """Numbers as plotly.js and the animation read them: {"dtype", "bdata"}, little-endian, base64; f4 holds seven digits.

    >>> from slideway.report.traces import packed
    >>> packed([1, 2], "u1")
    {'dtype': 'u1', 'bdata': 'AQI='}
    """
    array = np.ascontiguousarray(values, dtype=np.dtype(kind).newbyteorder("<"))
    return {"dtype": kind, "bdata": base64.b64encode(array.tobytes()).decode("ascii")}


def colour_of(name: str) -> str:
    """Colour of a quantity by its component, as the plots of slideway.plot have it.

    >>> from slideway.report.traces import colour_of
    >>> colour_of("mode_time[free]"), colour_of("peak_tilt")
    ('@free', '@c1')
    """
    component = name.rpartition("[")[2].removesuffix("]")
    return f"@{component}" if component in class_colours else "@c1"


def text(words: object) -> str:
    """Text of a file for plotly.js, which reads some HTML in labels."""
    return html.escape(escaped(str(words)))


def thinned(values: NDArray[Any], most: int = MOST_POINTS) -> NDArray[np.int64]:
    """Which points of a long series to draw: of each stretch the least and the largest, in their order.

    >>> from slideway.report.traces import thinned
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


def line(x: ArrayLike, y: ArrayLike, name: str, colour: str, axis: int = 1, **more: Any) -> Trace:
    """A line, thinned where it is long."""
    xs, ys = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    kept = thinned(ys)
    style = {"color": colour, "width": more.pop("width", 1.3), "dash": more.pop("dash", "solid")}
    return {"type": "scatter", "mode": "lines", "name": text(name), "x": packed(xs[kept]), "y": packed(ys[kept]), "line": style, **on_row(axis), **more}


def points(x: ArrayLike, y: ArrayLike, name: str, colour: str, axis: int = 1, size: float = 4, **more: Any) -> Trace:
    """A cloud of points; of more than the page bears, an even choice."""
    xs, ys = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    if len(xs) > MOST_POINTS:
        kept = np.linspace(0, len(xs) - 1, MOST_POINTS).round().astype(int)
        xs, ys = xs[kept], ys[kept]
    marker = {"color": colour, "size": size, **more.pop("marker", {})}
    return {"type": "scatter", "mode": "markers", "name": text(name), "x": packed(xs), "y": packed(ys), "marker": marker, **on_row(axis), **more}


def band(x: ArrayLike, low: ArrayLike, high: ArrayLike, name: str, colour: str, axis: int = 1) -> list[Trace]:
    """The area between two curves, as one entry of the legend."""
    bare = {"width": 0.0, "hoverinfo": "skip", "legendgroup": name}
    edge = line(x, low, name, colour, axis, showlegend=False, **bare)
    return [edge, line(x, high, name, colour, axis, fill="tonexty", fillcolor=colour, **bare)]


def on_row(axis: int) -> dict[str, str]:
    """That a trace belongs to a row of :func:`rows`, from 1; all share the x axis."""
    return {} if axis == 1 else {"yaxis": f"y{axis}"}


def rows(titles: list[str], x_title: str, **x_axis: Any) -> dict[str, Any]:
    """Layout of rows one above the other, the first on top, on one x axis."""
    count = len(titles)
    gap = 0.06 if count > 1 else 0.0
    height = (1 - gap * (count - 1)) / count
    layout: dict[str, Any] = {"xaxis": {"title": {"text": x_title}, "anchor": "y" if count == 1 else f"y{count}", **x_axis}}
    for row, title in enumerate(titles, start=1):
        top = 1 - (row - 1) * (height + gap)
        key = "yaxis" if row == 1 else f"yaxis{row}"
        layout[key] = {"title": {"text": title}, "domain": [max(top - height, 0.0), top]}
    return layout


def bars_of(edges: ArrayLike, counts: ArrayLike, name: str, colour: str, axis: int = 1, **more: Any) -> Trace:
    """A histogram that is already counted."""
    sides, heights = np.asarray(edges, dtype=float), np.asarray(counts, dtype=float)
    return {
        "type": "bar",
        "name": text(name),
        "x": packed((sides[:-1] + sides[1:]) / 2),
        "width": packed(np.diff(sides)),
        "y": packed(heights),
        "marker": {"color": colour, "line": {"color": "@paper", "width": 0.5}},
        **on_row(axis),
        **more,
    }


def bins(values: ArrayLike, most: int = 60) -> NDArray[np.float64]:
    """Edges of bins for a histogram: Freedman-Diaconis, at least 8 and no more than the picture bears."""
    there = np.asarray(values, dtype=float)
    there = there[np.isfinite(there)]
    if len(there) == 0:
        return np.array([0.0, 1.0])
    width = 2 * float(np.subtract(*np.percentile(there, [75, 25]))) / len(there) ** (1 / 3)
    count = np.ptp(there) / width if width > 0 else most
    return np.histogram_bin_edges(there, int(np.clip(count, min(8, len(there)), most)))


def vertical(x: float, label: str, colour: str = "@bad") -> tuple[dict[str, Any], dict[str, Any]]:
    """A line across all rows at x with a label at its top: a shape and an annotation."""
    shape = {"type": "line", "x0": x, "x1": x, "yref": "paper", "y0": 0, "y1": 1, "line": {"color": colour, "dash": "dash", "width": 1.5}}
    note = {"x": x, "y": 1, "yref": "paper", "yanchor": "bottom", "text": text(label), "showarrow": False, "font": {"color": colour}}
    return shape, note
