"""Figures drawn by matplotlib."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.patches import Rectangle
from matplotlib.ticker import NullLocator

from ..arguments import shown
from ..errors import SlidewayError
from ..figures.marks import Band, Bars, Box, Cloud, Curve, Density, Level, Mark, Note, Panel, Rows, reach
from ..palette import grey
from .legends import place_legend


def axis(ax: Axes | None) -> Axes:
    """The axis given, or one of a new figure."""
    if ax is not None and not isinstance(ax, Axes):
        raise SlidewayError(f"ax is {shown(ax)}; give one axis of matplotlib, such as plt.subplots()[1]")
    return ax if ax is not None else plt.subplots(figsize=(7.2, 4.2), layout="constrained")[1]


def draw(panel: Panel, ax: Axes | None) -> Axes:
    """Draws a panel on an axis, or on one of a new figure."""
    ax = axis(ax)
    rows = [mark for mark in panel.marks if isinstance(mark, Rows)]
    for number, bars in enumerate(rows):
        _rows(ax, bars, len(rows), number)
    for mark in panel.marks:
        _mark(ax, mark)
    for name, side in (("x", panel.x), ("y", panel.y)):
        if side.log:
            ax.set(**{f"{name}scale": "log"})
        if side.ticks is not None:
            ax.set(**{f"{name}ticks": list(side.ticks), f"{name}ticklabels": list(side.ticks.values())})
            (ax.xaxis if name == "x" else ax.yaxis).set_minor_locator(NullLocator())
        if side.low is not None or side.high is not None:
            ax.set(**{f"{name}lim": (side.low, side.high)})
    if panel.x.tight:
        ax.margins(x=0)
    if panel.equal:
        ax.set_aspect("equal", adjustable="box")
        ax.autoscale_view()
    if panel.title:
        ax.set_title(panel.title)
    return finish(ax, panel.x.label, panel.y.label, rows=bool(rows))


def _mark(ax: Axes, mark: Mark) -> None:
    match mark:
        case Curve():
            style: dict[str, Any] = {"color": mark.colour, "alpha": mark.opacity, "lw": mark.width, "ls": mark.dash or "none", "marker": mark.marker or None,
                     "ms": mark.size, "label": mark.label, "drawstyle": "steps-post" if mark.steps else "default"}  # fmt: skip
            if mark.behind:
                style["zorder"] = 1
            if mark.hollow:
                style["mfc"] = "white"
            if mark.low is not None:
                # Without caps: an end that is not known would have one at the point.
                bars = reach(mark.x if mark.along == "x" else mark.y, mark.low, mark.high)
                ax.errorbar(mark.x, mark.y, elinewidth=1, **style | {f"{mark.along}err": bars})
            else:
                ax.plot(mark.x, mark.y, mew=0 if mark.marker and not mark.dash and mark.size < 4 else None, **style)
        case Cloud():
            ax.scatter(mark.x, mark.y, s=mark.size, color=mark.colour, alpha=mark.opacity, lw=0, label=mark.label, rasterized=mark.x.size > 20000)
        case Band():
            ax.fill_between(mark.x, mark.low, mark.high, color=mark.colour, alpha=mark.opacity, lw=mark.width, label=mark.label)
        case Bars(outlined=True):
            ax.stairs(mark.heights, mark.edges, baseline=mark.base, fill=True, color=mark.colour, alpha=0.3)
            ax.stairs(mark.heights, mark.edges, baseline=mark.base, color=mark.colour, lw=1.3, label=mark.label)
        case Bars():
            ax.bar(mark.edges[:-1], mark.heights, np.diff(mark.edges), align="edge", color=mark.colour, alpha=mark.opacity, edgecolor="white", lw=0.5,
                   label=mark.label)  # fmt: skip
        case Level():
            across, along = (ax.axvline, ax.axvspan) if mark.of == "x" else (ax.axhline, ax.axhspan)
            label = _once(ax, mark.label)
            if mark.half > 0:
                along(mark.value - mark.half, mark.value + mark.half, color=mark.colour, alpha=0.25, lw=0, label=None if mark.width else label)
            if mark.width:
                across(mark.value, color=mark.colour, lw=mark.width, ls=mark.dash, label=label, zorder=1 if mark.dash == ":" else None)
        case Box():
            ax.add_patch(Rectangle((-mark.x, -mark.y), 2 * mark.x, 2 * mark.y, fill=False, ec=grey, ls="--", label=_once(ax, mark.label)))
        case Density():
            image = ax.hist2d(mark.x, mark.y, bins=120, cmap="viridis_r", norm=LogNorm())[3]
            ax.figure.colorbar(image, ax=ax, label=mark.label)
        case Note():
            ax.plot([], [], " ", label=mark.label)


def _rows(ax: Axes, mark: Rows, count: int, number: int) -> None:
    height = 0.8 / count
    at = np.arange(mark.values.size) + ((count - 1) / 2 - number) * height
    ax.barh(at, mark.values, height, color=mark.colour, alpha=0.8, label=mark.label)
    if mark.low is not None:
        ax.errorbar(mark.values, at, xerr=reach(mark.values, mark.low, mark.high), fmt="none", color="#222222", lw=1)


def _once(ax: Axes, label: str | None) -> str | None:
    """A name that the legend does not have yet."""
    return None if label in ax.get_legend_handles_labels()[1] else label


def finish(ax: Axes, x: str, y: str, rows: bool = False) -> Axes:
    """Labels, a light grid and, where there is something to tell, a legend that covers no data."""
    frame(ax, x, y)
    if rows:
        ax.grid(False, axis="y")
    if ax.get_legend_handles_labels()[1]:
        place_legend(ax)
    return ax


def frame(ax: Axes, x: str, y: str) -> None:
    """Labels and a light grid."""
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    ax.grid(True, color="#DDDDDD", lw=0.6)
    ax.set_axisbelow(True)
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)
