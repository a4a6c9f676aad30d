"""Drawings as data, and those of the mechanism: side view and contact segment (docs/explanation/model.md sections 1 and 3)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import slideway
from slideway.figures.marks import Arrow, Axis, Curve, Mark, Panel, Place, Shape, Text, box
from slideway.palette import colours, grey, limit_colour
from slideway.plot.axes import picture
from slideway.way import APEX_SIGNS, rod_reach

from .figures import run

dark = "#222222"
body = "#cfe1f1"  # of the slider
way_tone = "#d9d9d9"
faces = (([0, 1, 2, 3], "#b9cfe4"), ([0, 3, 7, 4], "#e3eef8"), ([0, 1, 5, 4], body))  # that an isometric view shows: X, Y, Z
_shown_gap = 8.0  # mm, in place of the 0.1 mm that the scene has


def arc(centre: Place, radius: float, start: float = 0.0, end: float = 360.0) -> np.ndarray:
    """Places from one angle to another, in degrees."""
    angle = np.deg2rad(np.linspace(start, end, 61))
    return np.array(centre) + radius * np.stack([np.cos(angle), np.sin(angle)], 1)


def flat(points: object) -> np.ndarray:
    """An isometric view: X to the right and towards the reader, Y up, Z to the left and towards the reader."""
    points = np.asarray(points, dtype=float)
    return np.stack([(points[..., 0] - points[..., 2]) * np.cos(np.pi / 6), points[..., 1] - (points[..., 0] + points[..., 2]) * 0.5], -1)


class Sheet:
    """A drawing of 5.4 inches across; its lower left corner may be elsewhere than at 0."""

    def __init__(self, width: float, height: float, corner: Place = (0.0, 0.0)) -> None:
        self.width, self.height, self.corner = width, height, corner
        self.marks: list[Mark] = []

    def line(self, points: object, colour: str, width: float = 1.0, dash: str = "-", order: float = 2) -> None:
        self.marks.append(Curve(*np.transpose(points), None, colour, 1.0, width, dash, order=order))  # type: ignore[arg-type]

    def dots(self, points: object, colour: str, size: float, order: float = 5, marker: str = "o", hollow: bool = False) -> None:
        at = np.atleast_2d(points).T  # type: ignore[arg-type]
        self.marks.append(Curve(*at, colour=colour, dash="", marker=marker, size=size, hollow=hollow, order=order))

    def shape(self, points: np.ndarray, fill: str, edge: str = "none", width: float = 1.2, order: float = 1, dash: str = "-", opacity: float = 1.0) -> None:
        self.marks.append(Shape(points, None, fill, edge, width, dash, opacity, order))

    def arrow(self, start: Place, end: Place, colour: str = dark, order: float = 3) -> None:
        self.marks.append(Arrow(start, end, colour, order=order))

    def text(self, words: str, at: Place, to: Place | None = None, colour: str = dark, order: float = 7, **options: Any) -> None:
        """Words, with a thin line to what they name."""
        if to is not None:
            self.line([at, to], grey, 0.8, order=order - 1)
        self.marks.append(Text(*at, words, colour, order=order, **options))  # type: ignore[misc]

    def svg(self) -> str:
        across, up = (Axis("", low=low, high=low + size) for low, size in zip(self.corner, (self.width, self.height), strict=True))
        return picture([Panel(self.marks, across, up, bare=True)], height=self.height / self.width * 5.4)


def _scene(root: Path) -> dict[str, Any]:
    """The standard scene with all its values in SI units, as a run of a moment resolves it."""
    return slideway.scene(run(root, "scenes/slider_crank_0.1mm.toml", "paper", study__revolutions=1e-3))


def mechanism(root: Path) -> str:
    """The slider-crank from the side: crank, rod, slider and way, with the clearance drawn 80 times too wide."""
    scene = _scene(root)
    crank, rod = (1e3 * scene["mechanism"][key] for key in ("crank_length", "rod_length"))
    joint = scene["joint"]
    length, width = 1e3 * joint["slider_length"], 1e3 * joint["way_width"]
    angle = np.deg2rad(50)
    pin = (crank * np.cos(angle), crank * np.sin(angle))
    x, y, tilt = float(rod_reach(crank, rod, angle)), 0.0, np.deg2rad(-4)
    sheet = Sheet(302, 173, (-66, -84))
    sheet.shape(box(88, -width / 2, 140, width), way_tone, dark)
    turn = np.array([[np.cos(tilt), -np.sin(tilt)], [np.sin(tilt), np.cos(tilt)]])
    inner = width / 2 + _shown_gap
    for side in (1, -1):
        sheet.shape(box(-length / 2, inner, length, 9) * [1, side] @ turn.T + [x, y], body, colours[0], 1.4, 2)
    ends = box(-length / 2, -inner, length, 2 * inner)[[0, 3, 2, 1]] @ turn.T + [x, y]
    for pair in ((0, 1), (2, 3)):
        sheet.line(ends[list(pair)], colours[0], 1, ":", 3)
    sheet.dots(ends, limit_colour, 5)
    sheet.line(arc((0, 0), crank), grey, 0.8, "--")
    sheet.line([(0, 0), pin], dark, 4.5, order=4)
    sheet.line([pin, (x, y)], colours[1], 3.2, order=4)
    for point in ((0, 0), pin, (x, y)):
        sheet.shape(arc(point, 2.6), "white", dark, 1.3, 5)
    for end, words, at in (((62, 0), "X", (68, 0)), ((0, 66), "Y", (0, 73))):
        sheet.arrow((0, 0), end)
        sheet.text(words, at, paper="white", italic=True)
    sheet.dots((0, 0), dark, 2.2, 6)
    sheet.text("Z", (-8, -7), paper="white", italic=True)
    for end, words, shift in zip(np.array([[30, 0], [0, 42]]) @ turn.T + [x, y], ("X of K", "Y of K"), ((16, -14), (0, 6)), strict=True):
        sheet.arrow((x, y), end, colours[3])
        sheet.text(words, end + shift, colour=colours[3], paper="white", italic=True)
    sheet.text("crank", (-14, 46), (pin[0] * 0.55, pin[1] * 0.62), paper="white")
    sheet.text("rod", (100, 52), (pin[0] + 0.5 * (x - pin[0]), pin[1] * 0.5), paper="white")
    sheet.text("slider", (x - 42, -46), (x - 16, -inner - 3), paper="white")
    sheet.text("way", (102, -30), (106, -width / 2 + 3), paper="white")
    sheet.text("an apex", (x + 42, 50), ends[2], limit_colour, paper="white")
    sheet.line([(x + 7, -width / 2 - 1), (x + 7, -inner + 1)], limit_colour, 3.5, order=4)
    times = _shown_gap / (1e3 * joint["clearance_y"])
    sheet.text(f"clearance c, drawn {times:.0f} times too wide", (150, -70), (x + 7, -width / 2 - 4), paper="white")
    return sheet.svg()


def apices(root: Path) -> str:
    """The contact segment in isometric view, with its eight apices."""
    joint = _scene(root)["joint"]
    half = 500 * np.array([joint["slider_length"], joint["way_width"], joint["way_depth"]])
    sheet = Sheet(112, 88, (-56, -45))
    at = flat(APEX_SIGNS * half)
    for apex, signs in enumerate(APEX_SIGNS):  # the way goes on at both ends
        sheet.line([at[apex], flat(signs * half + [signs[0] * 1.2 * half[0], 0, 0])], grey, 1, "--", 4 if signs[0] > 0 else 1)
    for ring, tone in faces:
        sheet.shape(at[ring], tone, colours[0], 1.4, 2)
    for pair in ((6, 5), (6, 7), (6, 2)):
        sheet.line(at[list(pair)], colours[0], 1, ":", 3)
    sheet.dots(at, limit_colour, 7)
    for number, (point, away) in enumerate(zip(at, at - at.mean(0), strict=True), start=1):
        shift = 5.5 * away / max(np.hypot(*away), 1) if np.hypot(*away) > 1 else np.array([4.0, 4.0])
        sheet.text(f"P{number}", point + shift, colour=limit_colour, size=12, bold=True, paper="#ffffffc0")
    for words, place in (("Y face", [12, half[1], -5]), ("Z face", [-9, 2, half[2]]), ("way", [-38, half[1] + 5, 0])):
        sheet.text(words, flat(place), colour=grey)
    for direction, name in (([34, 0, 0], "X"), ([0, 26, 0], "Y"), ([0, 0, 30], "Z")):
        sheet.arrow((0, 0), flat(direction), colours[3])
        sheet.text(name, flat(direction) * 1.12, colour=colours[3], italic=True)
    return sheet.svg()
