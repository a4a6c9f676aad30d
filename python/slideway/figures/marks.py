"""Figures as data: what is drawn over which axes, in which units, with which intervals. :mod:`slideway.plot` draws them by matplotlib, pages by plotly."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from ..palette import colours, grey

Array = NDArray[Any]
Place = Union[Sequence[float], Array]  # x and y


@dataclass(frozen=True)
class Axis:
    """One of the two axes.

    Attributes:
        ticks: names of places, instead of numbers.
        tight: ends where the data end.
        linear: of a logarithmic axis with both signs, up to where it is linear.
    """

    words: str
    unit: str = ""
    log: bool = False
    low: float | None = None
    high: float | None = None
    ticks: Mapping[float, str] | None = None
    tight: bool = False
    linear: float = 0.0

    @property
    def label(self) -> str:
        """"y [µm]", or the words alone of a number without unit."""
        return f"{self.words} [{self.unit}]" if self.unit else self.words


def named(names: Sequence[str]) -> dict[float, str]:
    """Names of the places 0, 1, ... of an axis."""
    return dict(enumerate(names))


@dataclass(frozen=True)
class Curve:
    """Points that are joined (`dash`), marked (`marker`), or both.

    Attributes:
        low, high: ends of the points' intervals along `along`, NaN where an end is not known.
        steps: the value of a point holds up to the next one.
        order: what has more lies above; left out: as the kind of mark does.
    """

    x: Array
    y: Array
    label: str | None = None
    colour: str = colours[0]
    opacity: float = 1.0
    width: float = 1.2
    dash: str = "-"
    marker: str = ""
    size: float = 4.0
    hollow: bool = False
    low: Array | None = None
    high: Array | None = None
    along: str = "y"
    steps: bool = False
    order: float | None = None


@dataclass(frozen=True)
class Cloud:
    """Many points; `size` is their area in square points."""

    x: Array
    y: Array
    label: str | None = None
    colour: str = colours[0]
    opacity: float = 1.0
    size: float = 4.0


@dataclass(frozen=True)
class Band:
    """The area between two curves."""

    x: Array
    low: Array
    high: Array
    label: str | None = None
    colour: str = colours[0]
    opacity: float = 0.25
    width: float = 0.0


@dataclass(frozen=True)
class Bars:
    """A histogram that is counted: edges (n + 1), heights (n) above a base; outlined where several lie over one another."""

    edges: Array
    heights: Array
    label: str | None = None
    colour: str = colours[0]
    opacity: float = 0.7
    base: float = 0.0
    outlined: bool = False


@dataclass(frozen=True)
class Rows:
    """Horizontal bars at the named places of the y axis, of which the last is on top, with the ends of their intervals."""

    values: Array
    label: str | None = None
    colour: str = colours[0]
    low: Array | None = None
    high: Array | None = None


@dataclass(frozen=True)
class Level:
    """A line across the axes at a value of x or y, with half the width of the interval about it."""

    value: float
    of: str = "y"
    label: str | None = None
    colour: str = grey
    width: float = 1.0
    dash: str = "-"
    half: float = 0.0


@dataclass(frozen=True)
class Density:
    """How many points lie where."""

    x: Array
    y: Array
    label: str


@dataclass(frozen=True)
class Note:
    """A line of the legend that names nothing drawn."""

    label: str


@dataclass(frozen=True)
class Shape:
    """A polygon of points (n, 2): its area, where it has a `fill`, and its outline, where it has an `edge`."""

    points: Array
    label: str | None = None
    fill: str = "none"
    edge: str = "none"
    width: float = 1.0
    dash: str = "-"
    opacity: float = 1.0
    order: float | None = None


@dataclass(frozen=True)
class Text:
    """Words at a place.

    Attributes:
        across, up: which part of them is there, as matplotlib's ha and va.
        paper: the colour below them.
        inside: x and y are shares of the axes.
    """

    x: float
    y: float
    words: str
    colour: str = grey
    size: float | None = None
    across: str = "center"
    up: str = "center"
    paper: str = "none"
    italic: bool = False
    bold: bool = False
    turn: float = 0.0
    inside: bool = False
    order: float | None = None


@dataclass(frozen=True)
class Arrow:
    """From one place to another; `head` as matplotlib's arrowstyle, `size` of the head in points."""

    start: Place
    end: Place
    colour: str = "#222222"
    width: float = 1.3
    head: str = "-|>"
    size: float = 10.0
    order: float | None = None


@dataclass(frozen=True)
class Moving:
    """A mark of one piece that moves over the frames of a film.

    Attributes:
        shift: from where it is drawn (frames, 2).
        about: what it turns about and is stretched from.
        turn: anticlockwise, in degrees (frames).
        stretch: of its length along x (frames).
    """

    mark: Union[Curve, Shape]
    shift: Array
    about: Place = (0.0, 0.0)
    turn: Array | None = None
    stretch: Array | None = None


Mark = Union[Curve, Cloud, Band, Bars, Rows, Level, Density, Note, Shape, Text, Arrow, Moving]


@dataclass(frozen=True)
class Panel:
    """Marks over one pair of axes.

    Attributes:
        equal: both axes have one scale.
        stacked: bars of :class:`Rows` follow each other.
        legend: its place, as matplotlib's loc; left out: where nothing is covered; "none": no legend.
        margin: beside the data, as a share of them.
        right: marks of another axis at the right, over the same x.
        bare: a drawing, without axes, as large as the figure.
        seconds: of the film that :class:`Moving` marks make.
    """

    marks: Sequence[Mark]
    x: Axis
    y: Axis
    title: str = ""
    equal: bool = False
    stacked: bool = False
    legend: str = ""
    margin: float | None = None
    right: Panel | None = None
    bare: bool = False
    seconds: float = 0.0


def box(x: float, y: float, wide: float, high: float) -> Array:
    """Corners of a rectangle from its lower left one."""
    return np.array([[x, y], [x + wide, y], [x + wide, y + high], [x, y + high]])


def reach(values: Array, low: Array | None, high: Array | None) -> Array:
    """Lengths of bars down and up to the ends of intervals (2, n): none where an end is not known.

    >>> reach(np.array([1.0]), np.array([0.5]), np.array([np.nan])).tolist()
    [[0.5], [0.0]]
    """
    assert low is not None and high is not None
    return np.asarray(np.nan_to_num(np.maximum([values - low, high - values], 0)))
