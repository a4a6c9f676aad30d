"""A film of the slider in its way under both laws, as SVG that moves by itself."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import slideway
from slideway.palette import grey

from .figures import run
from .style import law_colours, law_names

_scene = "scenes/slider_crank_0.1mm.toml"
_turns = 0.1  # revolutions, of two seconds
_frames = 320
_seconds = 9.0  # of the film
_enlarged = 45  # the slider's offsets and tilts
_size = 2.0  # pixels a millimetre
_row = 236  # pixels
_origin = (112, 118)  # of a row: the crank's bearing


def _list(values: np.ndarray, digits: int = 1) -> str:
    """Values of an animation, short: -0.0 is 0."""
    return ";".join(f"{round(float(value), digits) + 0.0:.{digits}f}".removesuffix(".0") for value in values)


def _moves(attribute: str, values: np.ndarray) -> str:
    return f'<animate attributeName="{attribute}" dur="{_seconds:g}s" repeatCount="indefinite" values="{_list(values)}"/>'


def _turns_by(kind: str, values: str) -> str:
    return f'<animateTransform attributeName="transform" type="{kind}" dur="{_seconds:g}s" repeatCount="indefinite" values="{values}"/>'


def _energy(root: Path, law: str) -> np.ndarray:
    """What the law has made by some moments of the film [mJ]."""
    made = [0.0]
    for share in (0.25, 0.5, 0.75, 1.0):
        result = run(root, _scene, law, study__samples_per_revolution=0, study__revolutions=share * _turns, study__quantities=["energy_residual"])
        made.append(1e3 * float(result["energy_residual"][0]))
    return np.array(made)


def _film_row(root: Path, law: str, top: float, made: np.ndarray, most: float) -> list[str]:
    """One mechanism under one law; `most` is the energy [mJ] of a full bar."""
    result = run(root, _scene, law, study__samples_per_revolution=0, study__samples=_frames + 1, study__revolutions=_turns,
                 study__quantities=["x"])
    scene = slideway.scene(result)
    crank, speed = 1e3 * scene["mechanism"]["crank_length"], scene["mechanism"]["crank_speed"]
    joint = scene["joint"]
    width, length, gap = (1e3 * joint[key] for key in ("way_width", "slider_length", "clearance_y"))
    angle = scene["mechanism"].get("start_angle", 0.0) + speed * result["time"].values
    x, y, pitch = (result[name].values[0] for name in ("x", "y", "pitch"))
    at_x, at_y = _size * 1e3 * x, -_size * 1e3 * _enlarged * y
    tilt = -np.rad2deg(_enlarged * pitch)
    pin_x, pin_y = _size * crank * np.cos(angle), -_size * crank * np.sin(angle)
    half, inner, thick = _size * length / 2, _size * (width / 2 + _enlarged * gap), _size * 8
    colour = law_colours[law]
    places = ";".join(f"{_list([a])} {_list([b])}" for a, b in zip(at_x, at_y, strict=True))
    plates = "".join(f'<rect x="{-half:g}" y="{y0:g}" width="{2 * half:g}" height="{thick:g}" fill="{colour}"/>' for y0 in (-inner - thick, inner))
    bar = _list(np.maximum(made / most * 170, 0.0))
    return [
        f'<g transform="translate({_origin[0]} {top + _origin[1]:g})">',
        f'<circle r="{_size * crank:g}" fill="none" stroke="{grey}" stroke-dasharray="5 5"/>',
        f'<rect x="{_size * 120:g}" y="{-_size * width / 2:g}" width="{_size * 106:g}" height="{_size * width:g}" fill="#d9d9d9" stroke="#444"/>',
        f'<g>{_turns_by("translate", places)}<g>{_turns_by("rotate", _list(tilt))}{plates}</g></g>',
        f'<line x1="0" y1="0" stroke="#222" stroke-width="8" stroke-linecap="round">{_moves("x2", pin_x)}{_moves("y2", pin_y)}</line>',
        f'<line stroke="#666" stroke-width="5" stroke-linecap="round">{_moves("x1", pin_x)}{_moves("y1", pin_y)}'
        f'{_moves("x2", at_x)}{_moves("y2", at_y)}</line>',
        '<circle r="6" fill="#fff" stroke="#222" stroke-width="2"/>',
        f'<text x="{_size * 55:g}" y="-84" fill="{colour}" font-weight="bold">{law_names[law]}</text>',
        f'<text x="{_size * 55:g}" y="84">energy made by the law</text>',
        f'<rect x="{_size * 55:g}" y="93" width="170" height="12" fill="none" stroke="{grey}"/>',
        f'<rect x="{_size * 55:g}" y="93" height="12" fill="{colour}"><animate attributeName="width" dur="{_seconds:g}s" '
        f'repeatCount="indefinite" values="{bar}"/></rect>',
        f'<text x="{_size * 55 + 180:g}" y="104">{made[-1]:.1f} mJ at the end</text>' if made[-1] > 0.05 else
        f'<text x="{_size * 55 + 180:g}" y="104">less than 0.001 mJ</text>',
        "</g>",
    ]


def film(root: Path) -> str:
    """Both laws, one below the other."""
    made = {law: _energy(root, law) for law in law_names}
    most = 1.05 * max(float(row[-1]) for row in made.values())
    if abs(made["conservative"][-1]) >= 1e-3:
        raise slideway.SlidewayError("the conservative law made more than its picture says; correct the words of film.py")
    width, height = 580, 2 * _row + 34
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
        'font-family="sans-serif" font-size="17" fill="#222">',
        f'<rect width="{width}" height="{height}" rx="8" fill="#fff"/>',
    ]
    for number, law in enumerate(law_names):
        parts += _film_row(root, law, number * _row, made[law], most)
    slowed = _seconds / (2 * _turns)
    parts.append(f'<text x="14" y="{height - 12}">clearance drawn {_enlarged} times too wide, {slowed:.0f} times slowed down</text>')
    return "\n".join([*parts, "</svg>"]) + "\n"
