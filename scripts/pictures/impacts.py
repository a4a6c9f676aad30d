"""The picture of rigid contacts (docs/how_to/rigid.md)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import slideway
from slideway.palette import colours, limit_colour
from slideway.plot.axes import frame

from .style import as_svg, axes_of

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
    figure, (above, below) = axes_of(2, height=5.4)
    for line, width, colour, words, is_rigid in (("-", 1.8, colours[0], "rigid", True), (":", 1.6, colours[1], "compliant, 1e8 N/m$^{1.5}$", False)):
        time, height, _ = _height(root, is_rigid, 0.05, 1001)
        above.plot(time, height, line, lw=width, color=colour, label=words)
    above.axhline(1, color="#444444", lw=0.8)
    above.axhline(-1, color="#444444", lw=0.8)
    above.text(50, 1.04, "upper wall", ha="right", va="bottom", color="#444444")
    above.text(50, -1.06, "lower wall", ha="right", va="top", color="#444444")
    above.set_ylim(-1.35, 1.35)
    above.set_xlim(0, 50)
    above.legend(frameon=False, loc="center left")
    frame(above, "time [ms]", "height over clearance")

    time, height, e = _height(root, True, 0.0105, 105_001)
    gap = np.maximum(1 - height, 1e-9)
    inside = gap[1:-1]
    touches = np.flatnonzero((inside < gap[:-2]) & (inside <= gap[2:]) & (time[1:-1] > 2))[:9] + 1
    over = end_of_bounces(time[touches[:6]], e)
    # Few points where a bounce is round, many where it touches.
    near = np.unique(np.logspace(0, 4, 30).astype(int))
    shown = np.unique(np.clip(np.concatenate([np.arange(0, touches[-1], 400), *[touches + sign * k for k in near for sign in (1, -1)], touches]), 0, touches[-1]))
    below.semilogy(time[shown], gap[shown], color=colours[0], lw=1.4)
    below.axvline(over, color=limit_colour, lw=1.4, ls="--", label="end by the sum of all bounces")
    below.text(over + 0.12, 0.03, "rests on\nthe wall", color="#444444", va="top")
    below.set_xlim(2, 10.5)
    below.set_ylim(3e-7, 1)
    below.legend(loc="lower left", framealpha=1, edgecolor="white")
    frame(below, "time [ms]", "distance over clearance")
    return as_svg(figure)
