"""The picture of rigid contacts (docs/how_to/rigid.md)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import slideway
from slideway.figures.marks import Axis, Curve, Level, Mark, Panel, Text
from slideway.palette import colours, limit_colour
from slideway.plot.axes import picture

_dark = "#444444"
_soft = 1e8  # [N/m^1.5], so soft that the difference shows


def _height(root: Path, rigid: bool, duration: float, samples: int) -> tuple[np.ndarray, np.ndarray, float]:
    """Times [ms], heights of the slider in clearances, and its coefficient of restitution."""
    # Of one mechanism: the rigid scene has friction and a spin beside it.
    name = "scenes/planar_rigid.toml" if rigid else "scenes/planar_flores.toml"
    keys = {"friction.enabled": False, "initial.wz": 0} if rigid else {"contact.point_stiffness": _soft}
    result = slideway.run(root / name, progress=False, set=keys | {
        "study.duration": duration, "study.samples": samples, "study.quantities": ["y"], "study.verify": 0})  # fmt: skip
    scene = slideway.scene(result)
    return 1e3 * result["time"].values, result["y"].values[0] / scene["joint"]["clearance_y"], scene["contact"]["restitution"]


def end_of_bounces(touches: np.ndarray, e: float) -> float:
    """When bounces are over that last e times as long as the one before, by the time between two touches.

    >>> float(end_of_bounces(np.array([0.0, 1.0]), 0.5))
    2.0
    """
    return touches[-1] + (touches[-1] - touches[-2]) * e / (1 - e)


def rigid(root: Path) -> str:
    """A slider between its walls, rigid and compliant, and its bounces before it rests on the upper wall."""
    soft = Curve(*_height(root, False, 0.05, 1001)[:2], "compliant, 1e8 N/m$^{1.5}$", colours[1], width=1.6, dash=":")
    bounces: list[Mark] = [Curve(*_height(root, True, 0.05, 1001)[:2], "rigid", width=1.8), soft]
    for side, words, up in ((1, "upper wall", "bottom"), (-1, "lower wall", "top")):
        bounces += [Level(side, colour=_dark, width=0.8), Text(50, 1.05 * side, words, _dark, across="right", up=up)]
    above = Panel(bounces, Axis("time", "ms", low=0, high=50), Axis("height over clearance", low=-1.35, high=1.35))

    time, height, e = _height(root, True, 0.0105, 105_001)
    gap = np.maximum(1 - height, 1e-9)
    inside = gap[1:-1]
    touches = np.flatnonzero((inside < gap[:-2]) & (inside <= gap[2:]) & (time[1:-1] > 2))[:9] + 1
    over = end_of_bounces(time[touches[:6]], e)
    # Few points where a bounce is round, many where it touches.
    near = np.unique(np.logspace(0, 4, 30).astype(int))
    shown = np.unique(np.clip(np.concatenate([np.arange(0, touches[-1], 400), *[touches + sign * k for k in near for sign in (1, -1)], touches]), 0, touches[-1]))
    falling: list[Mark] = [Curve(time[shown], gap[shown], width=1.4), Level(over, "x", "end by the sum of all bounces", limit_colour, 1.4, "--")]
    falling.append(Text(over + 0.12, 0.03, "rests on\nthe wall", _dark, across="left", up="top"))
    below = Panel(falling, Axis("time", "ms", low=2, high=10.5), Axis("distance over clearance", log=True, low=3e-7, high=1))
    return picture([above, below], height=5.8, below=2)
