"""A film of the slider in its way under both laws, as SVG that moves by itself."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import slideway
from slideway.figures.marks import Axis, Curve, Mark, Moving, Panel, Shape, Text, box
from slideway.palette import grey
from slideway.plot.axes import picture

from .drawings import arc, dark, way_tone
from .figures import law_colours, law_names, run

_scene = "scenes/slider_crank_0.1mm.toml"
_turns = 0.1  # revolutions, of two seconds
_frames = 320
_seconds = 9.0  # of the film
_enlarged = 45  # the slider's offsets and tilts
_row = 118  # mm, of each law's half


def _energy(root: Path, law: str) -> np.ndarray:
    """What the law has made by some moments of the film [mJ]."""
    made = [0.0]
    for share in (0.25, 0.5, 0.75, 1.0):
        result = run(root, _scene, law, study__samples_per_revolution=0, study__revolutions=share * _turns, study__quantities=["energy_residual"])
        made.append(1e3 * float(result["energy_residual"][0]))
    return np.array(made)


def _of_law(root: Path, law: str, up: float, made: np.ndarray, most: float) -> list[Mark]:
    """One mechanism in mm, its crank's bearing at a height; `most` is the energy [mJ] of a full bar."""
    result = run(root, _scene, law, study__samples_per_revolution=0, study__samples=_frames + 1, study__revolutions=_turns,
                 study__quantities=["x"])
    scene = slideway.scene(result)
    crank, joint = 1e3 * scene["mechanism"]["crank_length"], scene["joint"]
    width, length, gap = (1e3 * joint[key] for key in ("way_width", "slider_length", "clearance_y"))
    angle = scene["mechanism"].get("start_angle", 0.0) + scene["mechanism"]["crank_speed"] * result["time"].values
    x, y, pitch = (result[name].values[0] for name in ("x", "y", "pitch"))
    place = 1e3 * np.stack([x, _enlarged * y], 1) + [0, up]
    pin = crank * np.stack([np.cos(angle), np.sin(angle)], 1) + [0, up]
    half, inner, colour, middle = length / 2, width / 2 + _enlarged * gap, law_colours[law], (0.0, up)
    words = f"{made[-1]:.1f} mJ at the end" if made[-1] > 0.05 else "less than 0.001 mJ"
    bar = np.maximum(np.interp(np.linspace(0, 1, 61), np.linspace(0, 1, made.size), made) / most, 1e-3)

    def moved(mark: Curve | Shape, on: np.ndarray, turn: np.ndarray) -> Moving:
        """A mark as it is at first, and how what is on it moves and turns [rad] from there."""
        return Moving(mark, on - on[0], on[0], np.rad2deg(turn - turn[0]))

    def link(start: np.ndarray, end: np.ndarray, tone: str, thick: float) -> Moving:
        return moved(Curve(*np.stack([start[0], end[0]]).T, colour=tone, width=thick), start, np.unwrap(np.arctan2(*(end - start).T[::-1])))

    return [
        Shape(arc(middle, crank), edge=grey, dash="--"),
        Shape(box(120, up - width / 2, 106, width), fill=way_tone, edge="#444444"),
        *(moved(Shape(place[0] + box(-half, low, length, 8), fill=colour), place, _enlarged * pitch) for low in (inner, -inner - 8)),
        link(np.full_like(pin, middle), pin, dark, 5.4),
        link(pin, place, "#666666", 3.4),
        Shape(arc(middle, 3), fill="white", edge=dark, width=1.4, order=3),
        Text(55, up + 42, law_names[law], colour, across="left", up="baseline", bold=True),
        Text(55, up - 42, "energy made by the law", dark, across="left", up="baseline"),
        Shape(box(55, up - 52.5, 85, 6), edge=grey),
        Moving(Shape(box(55, up - 52.5, 85, 6), fill=colour), np.zeros((2, 2)), (55, up), stretch=bar),
        Text(145, up - 52, words, dark, across="left", up="baseline"),
    ]


def film(root: Path) -> str:
    """Both laws, one below the other."""
    made = {law: _energy(root, law) for law in law_names}
    most = 1.05 * max(float(row[-1]) for row in made.values())
    if abs(made["conservative"][-1]) >= 1e-3:
        raise slideway.SlidewayError("the conservative law made more than its picture says; correct the words of film.py")
    words = f"clearance drawn {_enlarged} times too wide, {_seconds / (2 * _turns):.0f} times slowed down"
    marks: list[Mark] = [Text(-49, 6, words, dark, across="left", up="baseline")]
    for law, up in zip(law_names, (17 + 1.5 * _row, 17 + 0.5 * _row), strict=True):
        marks += _of_law(root, law, up, made[law], most)
    height = 2 * _row + 17
    sheet = Panel(marks, Axis("", low=-56, high=234), Axis("", low=0, high=height), bare=True, seconds=_seconds)
    return picture([sheet], height=5.4 * height / 290)
