"""How pictures look and how they are written: narrow, with large letters, on white, and the same bytes each time."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from io import StringIO
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from slideway.figures.marks import Panel
from slideway.palette import colours
from slideway.plot.axes import draw

matplotlib.use("svg")
matplotlib.rcParams.update({
    "svg.fonttype": "none",  # text stays text
    "svg.hashsalt": "slideway",
    "font.family": "sans-serif",
    "font.size": 11,
    "axes.titlesize": 11,
    "legend.fontsize": 10,
    "figure.facecolor": "white",
    "axes.facecolor": "white",
    "path.simplify_threshold": 0.5,
})

largest = 200_000  # bytes of a picture
law_colours = {"paper": colours[1], "conservative": colours[0]}
law_names = {"paper": "law as published (paper)", "conservative": "conservative law"}

Picture = Callable[[Path], str | bytes]  # makes the text of an SVG file, or a PNG file; its argument is the root of the repository


def axes_of(rows: int = 1, columns: int = 1, height: float = 3.4, **options: object) -> tuple[Figure, list[Axes]]:
    """A figure of 5.4 inches, which a telephone's 390 pixels shrink by a quarter."""
    figure, axes = plt.subplots(rows, columns, figsize=(5.4, height), layout="constrained", squeeze=False, **options)  # type: ignore[arg-type]
    return figure, list(axes.flat)


def picture(panels: Sequence[Panel], columns: int = 1, height: float = 3.4, below: int = 0, **options: object) -> str:
    """Panels beside and below each other, as SVG. What they show is named in a corner of each, or below all of them in so many columns."""
    figure, axes = axes_of(-(-len(panels) // columns), columns, height, **options)
    for panel, ax in zip(panels, axes, strict=True):
        draw(replace(panel, title=""), ax)
        ax.set_title(panel.title, loc="left")
    if below:
        named = dict(pair for ax in axes for pair in zip(*reversed(ax.get_legend_handles_labels()), strict=True))
        for ax in axes:
            if ax.get_legend():
                ax.get_legend().remove()
        figure.legend(named.values(), named.keys(), loc="outside lower center", ncols=below, frameon=False)
    return as_svg(figure)


def as_svg(figure: Figure) -> str:
    """The figure as SVG without dates, names of programs or fonts of one machine."""
    text = StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    plt.close(figure)
    svg = re.sub(r"<metadata>.*?</metadata>\s*", "", text.getvalue(), flags=re.DOTALL)
    svg = re.sub(r"font-family: [^;\"]*", "font-family: sans-serif", svg)
    return "\n".join(line.rstrip() for line in svg.splitlines()) + "\n"
