"""The drawings of the mechanism: side view and contact segment (docs/explanation/model.md sections 1 and 3)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import slideway
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon, Rectangle
from slideway.palette import colours, grey, limit_colour
from slideway.report.contact import APEX_SIGNS
from slideway.way import rod_reach

from .figures import run
from .style import as_svg

dark = "#222222"
body = "#cfe1f1"  # of the slider
way_tone = "#d9d9d9"
_shown_gap = 8.0  # mm, in place of the 0.1 mm that the scene has


def _scene(root: Path) -> dict[str, Any]:
    """The standard scene with all its values in SI units, as a run of a moment resolves it."""
    return slideway.scene(run(root, "scenes/slider_crank_0.1mm.toml", "paper", study__revolutions=1e-3))


def canvas(height: float) -> tuple[Figure, Axes]:
    figure = plt.figure(figsize=(5.4, height))
    ax = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    ax.set_aspect("equal")
    ax.axis("off")
    return figure, ax


def arrow(ax: Axes, start: tuple[float, float], end: tuple[float, float], colour: str = dark, both: bool = False) -> None:
    ax.annotate("", end, start, arrowprops={"arrowstyle": "<|-|>" if both else "-|>", "color": colour, "lw": 1.3, "shrinkA": 0, "shrinkB": 0})


def named(ax: Axes, words: str, at: tuple[float, float], to: tuple[float, float] | None = None, **options: object) -> None:
    """A name, with a thin line to what it names."""
    if to is not None:
        ax.plot(*zip(at, to, strict=True), color=grey, lw=0.8, zorder=6)
    ax.text(*at, words, ha="center", va="center", zorder=7, bbox={"fc": "white", "ec": "none", "pad": 1.5}, **options)  # type: ignore[arg-type]


def mechanism(root: Path) -> str:
    """The slider-crank from the side: crank, rod, slider and way, with the clearance drawn 80 times too wide."""
    scene = _scene(root)
    crank, rod = (1e3 * scene["mechanism"][key] for key in ("crank_length", "rod_length"))
    joint = scene["joint"]
    length, width = 1e3 * joint["slider_length"], 1e3 * joint["way_width"]
    angle = np.deg2rad(50)
    pin = (crank * np.cos(angle), crank * np.sin(angle))
    x, y, tilt = float(rod_reach(crank, rod, angle)), 0.0, np.deg2rad(-4)
    figure, ax = canvas(3.1)
    ax.set_xlim(-66, 236)
    ax.set_ylim(-84, 89)
    ax.add_patch(Rectangle((88, -width / 2), 140, width, fc=way_tone, ec=dark, lw=1.2, zorder=1))
    turn = np.array([[np.cos(tilt), -np.sin(tilt)], [np.sin(tilt), np.cos(tilt)]])
    inner, outer = width / 2 + _shown_gap, width / 2 + _shown_gap + 9
    for side in (1, -1):
        corners = np.array([[-length / 2, inner], [length / 2, inner], [length / 2, outer], [-length / 2, outer]]) * [1, side]
        ax.add_patch(Polygon(corners @ turn.T + [x, y], fc=body, ec=colours[0], lw=1.4, zorder=2))
    ends = np.array([[-length / 2, -inner], [-length / 2, inner], [length / 2, inner], [length / 2, -inner]]) @ turn.T + [x, y]
    for pair in ((0, 1), (2, 3)):
        ax.plot(*ends[list(pair)].T, color=colours[0], lw=1, ls=":", zorder=3)
    ax.plot(*ends.T, "o", color=limit_colour, ms=5, zorder=5)
    circle = np.linspace(0, 2 * np.pi, 90)
    ax.plot(crank * np.cos(circle), crank * np.sin(circle), color=grey, lw=0.8, ls=(0, (4, 4)))
    ax.plot([0, pin[0]], [0, pin[1]], color=dark, lw=4.5, solid_capstyle="round", zorder=4)
    ax.plot([pin[0], x], [pin[1], y], color=colours[1], lw=3.2, solid_capstyle="round", zorder=4)
    for point in ((0, 0), pin, (x, y)):
        ax.add_patch(Circle(point, 2.6, fc="white", ec=dark, lw=1.3, zorder=5))
    for start, end, words, at in (((0, 0), (62, 0), "X", (68, 0)), ((0, 0), (0, 66), "Y", (0, 73))):
        arrow(ax, start, end)
        named(ax, words, at, style="italic")
    ax.plot(0, 0, "o", ms=2.2, color=dark, zorder=6)
    named(ax, "Z", (-8, -7), style="italic")
    own = np.array([[30, 0], [0, 42]]) @ turn.T + [x, y]
    for end, words, shift in ((own[0], "X of K", (16, -14)), (own[1], "Y of K", (0, 6))):
        arrow(ax, (x, y), tuple(end), colours[3])
        named(ax, words, (end[0] + shift[0], end[1] + shift[1]), color=colours[3], style="italic")
    named(ax, "crank", (-14, 46), (pin[0] * 0.55, pin[1] * 0.62))
    named(ax, "rod", (100, 52), (pin[0] + 0.5 * (x - pin[0]), pin[1] * 0.5))
    named(ax, "slider", (x - 42, -46), (x - 16, -inner - 3))
    named(ax, "way", (102, -30), (106, -width / 2 + 3))
    named(ax, "an apex", (x + 42, 50), tuple(ends[2]), color=limit_colour)
    ax.plot([x + 7, x + 7], [-width / 2 - 1, -inner + 1], color=limit_colour, lw=3.5, solid_capstyle="butt", zorder=4)
    named(ax, f"clearance c, drawn {_shown_gap / (1e3 * joint['clearance_y']):.0f} times too wide", (150, -70), (x + 7, -width / 2 - 4))
    return as_svg(figure)


def apices(root: Path) -> str:
    """The contact segment in isometric view, with its eight apices."""
    joint = _scene(root)["joint"]
    half = 500 * np.array([joint["slider_length"], joint["way_width"], joint["way_depth"]])
    cosine, sine = np.cos(np.pi / 6), np.sin(np.pi / 6)

    def flat(points: np.ndarray) -> np.ndarray:
        """X to the right and up, Y up, Z to the left and towards the reader."""
        points = np.asarray(points, dtype=float)
        return np.stack([(points[..., 0] - points[..., 2]) * cosine, points[..., 1] + (-points[..., 0] - points[..., 2]) * sine], -1)

    figure, ax = canvas(3.9)
    ax.set_xlim(-56, 56)
    ax.set_ylim(-45, 43)
    at = flat(APEX_SIGNS * half)
    for first in range(4):  # the way goes on at both ends
        for apex, end in ((first, 0.6), (first + 4, -0.6)):
            ax.plot(*np.stack([at[apex], flat(APEX_SIGNS[apex] * half + [end * 2 * half[0], 0, 0])]).T, color=grey, lw=1, ls="--", zorder=4 if end > 0 else 1)
    faces = {"X": [k for k in range(4)], "Y": [0, 3, 7, 4], "Z": [0, 1, 5, 4]}
    for name, tone in (("X", "#b9cfe4"), ("Y", "#e3eef8"), ("Z", body)):
        ax.add_patch(Polygon(at[faces[name]], fc=tone, ec=colours[0], lw=1.4, zorder=2))
    for pair in ((6, 5), (6, 7), (6, 2)):
        ax.plot(*at[list(pair)].T, color=colours[0], lw=1, ls=":", zorder=3)
    ax.plot(*at.T, "o", color=limit_colour, ms=7, zorder=5)
    for number, (point, away) in enumerate(zip(at, at - at.mean(0), strict=True), start=1):
        shift = 5.5 * away / max(np.hypot(*away), 1) if np.hypot(*away) > 1 else np.array([4.0, 4.0])
        ax.text(*(point + shift), f"P{number}", ha="center", va="center", color=limit_colour, weight="bold", fontsize=12, zorder=7,
                bbox={"fc": "white", "ec": "none", "pad": 0.6, "alpha": 0.75})
    for words, place in (("Y face", [12, half[1], -5]), ("Z face", [-9, 2, half[2]]), ("way", [-38, half[1] + 5, 0])):
        ax.text(*flat(np.array(place)), words, ha="center", va="center", color=grey, zorder=6)
    origin = flat(np.zeros(3))
    for direction, name in (([34, 0, 0], "X"), ([0, 26, 0], "Y"), ([0, 0, 30], "Z")):
        end = flat(np.array(direction))
        arrow(ax, tuple(origin), tuple(end), colours[3])
        ax.text(*(end * 1.12), name, ha="center", va="center", color=colours[3], style="italic", zorder=7)
    return as_svg(figure)
