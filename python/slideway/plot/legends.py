"""Legends that cover no data: in an empty corner of the axes, or beside them."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import Collection, PathCollection, QuadMesh
from matplotlib.figure import Figure
from matplotlib.patches import StepPatch
from matplotlib.transforms import Bbox
from numpy.typing import ArrayLike

_corners: tuple[Literal["upper right", "upper left", "lower right", "lower left"], ...] = ("upper right", "upper left", "lower right", "lower left")
_room = 8  # pixels that a corner has to have beyond the legend, for layouts change when the next axes are filled


def place_legend(ax: Axes) -> None:
    """Draws the legend where nothing else is; where no corner is empty, to the right of the axes."""
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
