"""Figures drawn by matplotlib: the one place that knows it. On an axis, as the text of an SVG file, or as a PNG file."""

from __future__ import annotations

import io
import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Literal, cast

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import FuncAnimation
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.collections import Collection, PathCollection, QuadMesh
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.patches import Polygon, StepPatch
from matplotlib.ticker import NullLocator
from matplotlib.transforms import Bbox
from numpy.typing import ArrayLike

from ..arguments import shown
from ..errors import SlidewayError
from ..figures.marks import Array, Arrow, Band, Bars, Cloud, Curve, Density, Level, Mark, Moving, Note, Panel, Rows, Shape, Text, reach
from ..palette import grey

_corners: tuple[Literal["upper right", "upper left", "lower right", "lower left"], ...] = ("upper right", "upper left", "lower right", "lower left")
_room = 8  # pixels that a corner has to have beyond the legend, for layouts change when the next axes are filled
# Of pictures: narrow, with large letters, on white, and the same bytes each time.
_look: Any = {
    "svg.fonttype": "none",  # text stays text
    "svg.hashsalt": "slideway",
    "font.family": "sans-serif",
    "font.size": 11,
    "axes.titlesize": 11,
    "legend.fontsize": 10,
    "figure.facecolor": "white",
    "axes.facecolor": "white",
    "path.simplify_threshold": 0.5,
}


def axis(ax: Axes | None) -> Axes:
    """The axis given, or one of a new figure."""
    if ax is not None and not isinstance(ax, Axes):
        raise SlidewayError(f"ax is {shown(ax)}; give one axis of matplotlib, such as plt.subplots()[1]")
    return ax if ax is not None else plt.subplots(figsize=(7.2, 4.2), layout="constrained")[1]


def png(panel: Panel, height: float) -> bytes:
    """A panel as a PNG file, 775 pixels wide."""
    figure = Figure((6.2, height), layout="constrained")
    draw(panel, figure.subplots())
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=125, metadata={"Software": "slideway"})
    return stream.getvalue()


def animated(panels: Sequence[Panel], seconds: float, ax: Axes | None) -> FuncAnimation:
    """Panels one after the other on one axis, for so long in all."""
    shown_on = axis(ax)

    def show(number: int) -> list[Any]:
        shown_on.clear()
        draw(panels[number], shown_on)
        return []

    return FuncAnimation(cast("Figure", shown_on.figure), show, len(panels), interval=1e3 * seconds / len(panels))


def picture(panels: Sequence[Panel], columns: int = 1, height: float = 3.4, below: int = 0, width: float = 5.4, **options: Any) -> str:
    """Panels beside and below each other, as SVG without dates, names of programs or fonts of one machine.

    Args:
        height, width: in inches; a telephone's 390 pixels shrink the usual width by a quarter.
        below: what panels show is named below all of them, in so many columns; 0: in a corner of each.
        options: of matplotlib's subplots, such as sharex.
    """
    with matplotlib.rc_context(_look):
        figure = Figure((width, height), layout=None if panels[0].bare else "constrained")
        FigureCanvasSVG(figure)
        if panels[0].bare:
            axes = [figure.add_axes((0.0, 0.0, 1.0, 1.0))]
        else:
            axes = list(figure.subplots(-(-len(panels) // columns), columns, squeeze=False, **options).flat)
        for panel, ax in zip(panels, axes, strict=True):
            draw(replace(panel, title="", legend="none" if below else panel.legend), ax)
            ax.set_title(panel.title, loc="left")
        if below:
            named = dict(pair for ax in axes for pair in zip(*reversed(ax.get_legend_handles_labels()), strict=True))
            figure.legend(named.values(), named.keys(), loc="outside lower center", ncols=below, frameon=False)
        text = io.StringIO()
        figure.savefig(text, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    svg = re.sub(r"<metadata>.*?</metadata>\s*", "", text.getvalue(), flags=re.DOTALL)
    svg = re.sub(r"font-family: [^;\"]*", "font-family: sans-serif", svg)
    svg = "\n".join(line.rstrip() for line in svg.splitlines()) + "\n"
    moving = [mark for mark in panels[0].marks if isinstance(mark, Moving)]
    return _film(svg, figure.axes[0], moving, panels[0].seconds) if moving else svg


def _film(svg: str, ax: Axes, moving: Sequence[Moving], seconds: float) -> str:
    """An SVG whose moving marks do move. Lengths are points there, and y goes down."""
    figure = ax.figure.canvas.figure
    size = (ax.transData.transform((1, 1)) - ax.transData.transform((0, 0))) * [1, -1] * 72 / figure.dpi

    def moves(kind: str, values: Array) -> str:
        frames = ";".join(" ".join(f"{round(float(value), 2) + 0.0:g}" for value in np.atleast_1d(frame)) for frame in values)
        return f'<animateTransform attributeName="transform" type="{kind}" dur="{seconds:g}s" repeatCount="indefinite" values="{frames}"/>'

    for number, mark in enumerate(moving):
        x, y = ax.transData.transform(mark.about) * 72 / figure.dpi
        y = figure.bbox.height * 72 / figure.dpi - y
        before = f'<g>{moves("translate", mark.shift * size)}<g transform="translate({x:.2f} {y:.2f})"><g>'
        before += moves("rotate", -mark.turn) if mark.turn is not None else ""
        before += moves("scale", np.column_stack([mark.stretch, np.ones_like(mark.stretch)])) if mark.stretch is not None else ""
        whole = rf'{before}<g transform="translate({-x:.2f} {-y:.2f})">\1</g></g></g></g>'
        svg = re.sub(rf'<g id="film{number}">(.*?)</g>', whole, svg, count=1, flags=re.DOTALL)
    return svg


def draw(panel: Panel, ax: Axes | None) -> Axes:
    """Draws a panel on an axis, or on one of a new figure."""
    ax = axis(ax)
    rows = [mark for mark in panel.marks if isinstance(mark, Rows)]
    for number, bars in enumerate(rows):
        _rows(ax, bars, len(rows), number)
    with matplotlib.rc_context({"lines.solid_capstyle": "butt"} if panel.bare else {}):
        for mark in panel.marks:
            _mark(ax, mark)
    for name, side in (("x", panel.x), ("y", panel.y)):
        if side.log or side.linear:
            (ax.set_xscale if name == "x" else ax.set_yscale)(**{"value": "symlog", "linthresh": side.linear} if side.linear else {"value": "log"})
        if side.ticks is not None:
            ax.set(**{f"{name}ticks": list(side.ticks), f"{name}ticklabels": list(side.ticks.values())})
            (ax.xaxis if name == "x" else ax.yaxis).set_minor_locator(NullLocator())
        if side.low is not None or side.high is not None:
            ax.set(**{f"{name}lim": (side.low, side.high)})
    if panel.x.tight:
        ax.margins(x=0)
    if panel.margin is not None:
        ax.margins(panel.margin)
    if panel.equal:
        ax.set_aspect("equal", adjustable="box")
    if any(isinstance(mark, Shape) for mark in panel.marks):
        ax.autoscale_view()  # which patches do not ask for
    if panel.right is not None:
        _right(ax, panel.right)
    if panel.title:
        ax.set_title(panel.title)
    if panel.bare:
        ax.axis("off")
        return ax
    _frame(ax, panel.x.label, panel.y.label)
    if rows:
        ax.grid(False, axis="y")
    if panel.legend == "":
        place_legend(ax)
    elif panel.legend != "none":
        ax.legend(loc=cast("Any", panel.legend), frameon=False, fontsize="small")
    return ax


def _mark(ax: Axes, mark: Mark) -> None:
    order: dict[str, Any] = {} if getattr(mark, "order", None) is None else {"zorder": mark.order}  # type: ignore[union-attr]
    match mark:
        case Curve():
            style: dict[str, Any] = {"color": mark.colour, "alpha": mark.opacity, "lw": mark.width, "ls": mark.dash or "none", "marker": mark.marker or None,
                     "ms": mark.size, "label": mark.label, "drawstyle": "steps-post" if mark.steps else "default", **order}  # fmt: skip
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
        case Density():
            image = ax.hist2d(mark.x, mark.y, bins=120, cmap="viridis_r", norm=LogNorm())[3]
            ax.figure.colorbar(image, ax=ax, label=mark.label)
        case Note():
            ax.plot([], [], " ", label=mark.label)
        case Shape():
            ax.add_patch(Polygon(mark.points, fill=mark.fill != "none", fc=mark.fill, ec=mark.edge, lw=mark.width, ls=mark.dash, alpha=mark.opacity,
                                 label=_once(ax, mark.label), **order))  # fmt: skip
        case Text():
            ax.text(mark.x, mark.y, mark.words, color=mark.colour, fontsize=mark.size, ha=mark.across, va=mark.up, rotation=mark.turn, linespacing=1.15,
                    style="italic" if mark.italic else "normal", weight="bold" if mark.bold else "normal", **order,
                    bbox=None if mark.paper == "none" else {"fc": mark.paper, "ec": "none", "pad": 1.0},
                    transform=ax.transAxes if mark.inside else ax.transData)  # fmt: skip
        case Arrow():
            ax.annotate("", tuple(mark.end), tuple(mark.start), **order, arrowprops={
                "arrowstyle": mark.head, "color": mark.colour, "lw": mark.width, "shrinkA": 0, "shrinkB": 0, "mutation_scale": mark.size})  # fmt: skip
            ax.update_datalim(np.array([mark.start, mark.end]))
        case Moving():
            others = set(ax.get_children())
            _mark(ax, mark.mark)
            (piece,) = (child for child in ax.get_children() if child not in others)
            piece.set_gid(f"film{sum(str(child.get_gid()).startswith('film') for child in others)}")
            piece.set_clip_on(False)  # where it is at first, it would be clipped wherever it is


def _rows(ax: Axes, mark: Rows, count: int, number: int) -> None:
    height = 0.8 / count
    at = np.arange(mark.values.size) + ((count - 1) / 2 - number) * height
    ax.barh(at, mark.values, height, color=mark.colour, alpha=0.8, label=mark.label)
    if mark.low is not None:
        ax.errorbar(mark.values, at, xerr=reach(mark.values, mark.low, mark.high), fmt="none", color="#222222", lw=1)


def _right(ax: Axes, panel: Panel) -> None:
    """Another axis at the right, in the colour of its first mark."""
    other = ax.twinx()
    for mark in panel.marks:
        _mark(other, mark)
    other.set_ylabel(panel.y.label, color=getattr(panel.marks[0], "colour", grey))
    other.set_ylim(panel.y.low, panel.y.high)


def _once(ax: Axes, label: str | None) -> str | None:
    """A name that the legend does not have yet."""
    return None if label in ax.get_legend_handles_labels()[1] else label


def _frame(ax: Axes, x: str, y: str) -> None:
    """Labels and a light grid."""
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    ax.grid(True, color="#DDDDDD", lw=0.6)
    ax.set_axisbelow(True)
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)


def place_legend(ax: Axes) -> None:
    """Draws the legend, where there is something to tell, in a corner where nothing else is; where none is empty, to the right of the axes."""
    if not ax.get_legend_handles_labels()[1]:
        return
    style: dict[str, Any] = {"frameon": False, "fontsize": "small"}
    figure = ax.figure.canvas.figure
    _lay_out(figure)
    for corner in _corners:
        legend = ax.legend(loc=corner, **style)
        if not covered(ax, legend.get_window_extent().padded(_room)):
            return
    legend = ax.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0, **style)
    if figure.get_layout_engine() is None:
        # Nobody else leaves room for it. A second plot on the same axes starts again from their whole place.
        cell = ax.get_subplotspec()
        place = ax.get_position() if cell is None else cell.get_position(figure)
        wide = legend.get_window_extent().width / (place.width * figure.bbox.width)
        ax.set_position((place.x0, place.y0, place.width * max(0.97 - wide, 0.3), place.height))


def _lay_out(figure: Figure) -> None:
    """Gives axes the places and limits that they will be drawn with, in half the time of drawing them."""
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.execute(figure)
    for ax in figure.axes:
        ax.apply_aspect()
        ax.get_xlim()  # limits follow the data once somebody asks for them


def covered(ax: Axes, box: Bbox) -> bool:
    """Whether a box of the screen meets any line, area, bar or point of the axes.

    >>> import matplotlib.pyplot as plt
    >>> ax = plt.subplots()[1]
    >>> line = ax.plot([0, 1], [0, 1])
    >>> whole = ax.get_window_extent()
    >>> covered(ax, whole), covered(ax, Bbox.from_bounds(whole.x0 + 5, whole.y1 - 25, 20, 20))
    (True, False)
    """
    for line in ax.lines:
        path = line.get_path()
        if np.size(path.vertices) and line.get_transform().transform_path(path).intersects_bbox(box, filled=False):
            return True
        if line.get_marker() not in (None, "None", "", " ") and _any_in(line.get_transform().transform(path.vertices), box):
            return True
    for patch in ax.patches:
        filled = patch.get_fill() or isinstance(patch, StepPatch)
        if patch.get_transform().transform_path(patch.get_path()).intersects_bbox(box, filled=filled):
            return True
    return any(_meets(collection, box) for collection in ax.collections) or bool(ax.images)


def _meets(collection: Collection, box: Bbox) -> bool:
    if isinstance(collection, QuadMesh):
        return True
    if isinstance(collection, PathCollection):
        return _any_in(collection.get_offset_transform().transform(collection.get_offsets()), box)
    transform = collection.get_transform()
    return any(transform.transform_path(path).intersects_bbox(box, filled=True) for path in collection.get_paths())


def _any_in(points: ArrayLike, box: Bbox) -> bool:
    return bool(box.count_contains(np.asarray(points, dtype=float)))
