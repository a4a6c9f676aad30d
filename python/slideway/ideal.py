"""The mechanisms without clearance, whose slider keeps to the axis of the way."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

_on_axis = ("y", "z", "vy", "vz", "ay", "az", "roll", "yaw", "pitch", "wx", "wy", "wz")


def ideal(scene: Mapping[str, Any], variable: str, time: np.ndarray) -> np.ndarray | None:
    """What a series would be without clearance.

    Args:
        scene: a resolved scene (:func:`slideway.scene`).
        variable: name of the series.
        time: since the start of the run [s].

    Returns:
        Its values at these times in its own unit, or None where there is no ideal motion to compare with: of forces, of a
        slider that nothing drives along the way or whose pin is not in its hole's centre, or of what no part of the mechanism prescribes.

    >>> ideal(slideway.scene(slideway.example()), "x", np.array([0.0, 1.0])).round(4)
    array([0.1922, 0.0922])
    """
    if variable in _on_axis:
        return np.zeros_like(time)
    if off_pin(scene):
        return None
    mechanism = scene["mechanism"]
    motion = _motions.get(str(mechanism["kind"]))
    if motion is None or variable not in ("x", "vx", "ax") or drive_kind(scene) != "speed":
        return None
    return motion(mechanism, time)[("x", "vx", "ax").index(variable)]


def off_pin(scene: Mapping[str, Any]) -> bool:
    """Whether the slider of a resolved scene is moved elsewhere than at its hole's centre."""
    return any(value for key, value in scene.get("slider", {}).items() if key.startswith("pin_"))


def drive_kind(scene: Mapping[str, Any]) -> str:
    """What moves the mechanism of a resolved scene: "speed", "profile", "torque" or "free"; of earlier results too.

    >>> drive_kind(slideway.scene(slideway.example()))
    'speed'
    """
    if scene.get("mechanism", {}).get("crank") == "free":  # as results of format 2 before [drive] have it
        return "free"
    return str(scene.get("drive", {}).get("kind", "speed"))


def rod_reach(crank_length: float, rod_length: float, angle: np.ndarray, y: Any = 0.0, z: Any = 0.0) -> np.ndarray:
    """x of the end of a rod that starts at the crank pin [m]: r cos θ + √(L² − (y − r sin θ)² − z²).

    Args:
        crank_length r, rod_length L [m]; angle θ [rad]; y, z: of the rod's end [m], on the axis where they are left out.

    >>> rod_reach(3.0, 5.0, np.array([0.0, np.pi / 2])).tolist()
    [8.0, 4.0]
    """
    height = y - crank_length * np.sin(angle)
    return np.asarray(crank_length * np.cos(angle) + np.sqrt(np.maximum(rod_length**2 - height**2 - np.square(z), 0.0)))


def _slider_crank(mechanism: Mapping[str, Any], time: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x = r cos θ + D, D = √(L² − r² sin² θ), θ = θ0 + ωt, and its derivatives: D D' = −r² ω sin θ cos θ."""
    r, length, speed = (float(mechanism[key]) for key in ("crank_length", "rod_length", "crank_speed"))
    angle = float(mechanism.get("start_angle", 0.0)) + speed * time
    sine, cosine = np.sin(angle), np.cos(angle)
    reach = np.sqrt(length**2 - (r * sine) ** 2)
    reach_rate = -(r**2) * speed * sine * cosine / reach
    reach_acceleration = -((r * speed) ** 2 * (cosine**2 - sine**2) + reach_rate**2) / reach
    return rod_reach(r, length, angle), -r * speed * sine + reach_rate, -r * speed**2 * cosine + reach_acceleration


def _carriage(mechanism: Mapping[str, Any], time: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """From x = 0 at +v for T = stroke/v, then v cos(π τ/t_r) for 0 ≤ τ ≤ t_r, then the same with −v, and so on."""
    speed, stroke, turn = (float(mechanism[key]) for key in ("carriage_speed", "stroke", "reversal_time"))
    there = stroke / speed
    half = there + turn
    within = np.mod(time, half)
    sign = np.where(np.mod(np.floor_divide(time, half), 2) == 0, 1.0, -1.0)
    angle = np.pi * np.clip(within - there, 0.0, None) / turn
    way = np.minimum(within, there) * speed + speed * turn / np.pi * np.sin(angle)
    # A reversal ends where it began, so that each half period starts at an end of the stroke.
    x = np.where(sign > 0, way, stroke - way)
    return x, sign * speed * np.cos(angle), -sign * speed * np.pi / turn * np.sin(angle)


def _scotch_yoke(mechanism: Mapping[str, Any], time: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x = r cos θ, θ = θ0 + ωt."""
    r, speed = float(mechanism["crank_length"]), float(mechanism["crank_speed"])
    angle = float(mechanism.get("start_angle", 0.0)) + speed * time
    return r * np.cos(angle), -r * speed * np.sin(angle), -r * speed**2 * np.cos(angle)


_motions: dict[str, Callable[[Mapping[str, Any], np.ndarray], tuple[np.ndarray, np.ndarray, np.ndarray]]] = {
    "slider_crank": _slider_crank,
    "planar_slider_crank": _slider_crank,
    "carriage": _carriage,
    "scotch_yoke": _scotch_yoke,
}
