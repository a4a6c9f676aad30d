"""The frame of the slide way, which a scene's [way] moves and turns (model.md section 1)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from .ideal import drive_kind, ideal, off_pin, rod_reach
from .scenes import scene, varied

Array = NDArray[np.float64]
_keys = ("offset_y", "offset_z", "roll", "yaw", "pitch")
# Signs (along X, Y, Z) of the apices P1 ... P8 (model.md section 3).
APEX_SIGNS = np.array([[1, 1, 1], [1, -1, 1], [1, -1, -1], [1, 1, -1], [-1, 1, 1], [-1, -1, 1], [-1, -1, -1], [-1, 1, -1]], dtype=float)
_places = ("way.", "joint.clearance_y_", "joint.clearance_z_")  # keys that say where the faces lie


def rotation(roll: Any, yaw: Any, pitch: Any) -> Array:
    """Rz(pitch) Ry(yaw) Rx(roll) of each sample (model.md section 1).

    Args:
        roll, yaw, pitch: angles about X, Y, Z [rad], of one shape (...).

    Returns:
        (..., 3, 3); columns are the body's axes.

    >>> bool(np.allclose(rotation(0.0, 0.0, np.pi / 2) @ [1, 0, 0], [0, 1, 0]))
    True
    """
    (sx, cx), (sy, cy), (sz, cz) = ((np.sin(a), np.cos(a)) for a in (roll, yaw, pitch))
    rows = ((cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx), (sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx), (-sy, cy * sx, cy * cx))
    return np.stack([np.stack(np.broadcast_arrays(*row), -1) for row in rows], -2)


def face_clearances(joint: Mapping[str, Any], axis: str) -> tuple[float, float]:
    """Clearances [m] of the faces on the sides of + and − of "y" or "z"; NaN where the joint has none.

    >>> face_clearances({"clearance_y": 1e-4, "clearance_y_plus": 2e-5}, "y")
    (2e-05, 0.0001)
    """
    common = joint.get(f"clearance_{axis}", np.nan)
    return float(joint.get(f"clearance_{axis}_plus", common)), float(joint.get(f"clearance_{axis}_minus", common))


def mean_clearance(joint: Mapping[str, Any], axis: str) -> float:
    """Half the play along "y" or "z" [m]."""
    return sum(face_clearances(joint, axis)) / 2


def play(clearance: float) -> float:
    """What movements in the joint are measured by [m]: its clearance, or its preload (model.md 16); NaN of none.

    >>> play(1e-4), play(-2e-6), play(0.0)
    (0.0001, 2e-06, 1e-07)
    """
    return max(abs(clearance), 1e-7)


def _middle(resolved: Mapping[str, Any]) -> Array:
    """From the way's axis to the middle between its faces, along its axes [m] (model.md 16)."""
    shifts = [(minus - plus) / 2 for plus, minus in (face_clearances(resolved.get("joint", {}), axis) for axis in ("y", "z"))]
    return np.nan_to_num(np.array([0.0, *shifts]))


def misaligned(resolved: Mapping[str, Any]) -> bool:
    """Whether the way lies or points elsewhere than it should, or its faces have different clearances."""
    return any(resolved.get("way", {}).values()) or bool(_middle(resolved).any())


def frame(resolved: Mapping[str, Any]) -> tuple[Array, Array]:
    """Where the middle between the way's faces passes through, u_l [m], and its attitude A_l, columns the way's axes.

    >>> point, attitude = frame({"mechanism": {"kind": "carriage"}, "way": {"offset_y": 2e-3}})
    >>> point.tolist()
    [0.0, 0.002, 0.0]
    """
    offset_y, offset_z, roll, yaw, pitch = (float(resolved.get("way", {}).get(key, 0.0)) for key in _keys)
    mechanism = resolved["mechanism"]
    reach = float(mechanism.get("rod_length", 0.0))
    attitude = rotation(roll, yaw, pitch)
    return np.array([reach, offset_y, offset_z]) + attitude @ _middle(resolved), attitude


def along(resolved: Mapping[str, Any], time: Array, y: Array, z: Array, crank: Array | None = None) -> Array | None:
    """x [m] that follows from the mechanism: of a rod that reaches from the crank pin, or of the motion that drives it.

    Args:
        time [s]; y, z: of the slider's centre, inertial [m]; crank: angle [rad], of constant speed where it is left out.

    Returns:
        None of a slider that nothing holds along the way, whose crank's angle is not known, or whose pin is not in its hole's centre.
    """
    if off_pin(resolved):
        return None
    mechanism = resolved["mechanism"]
    if "rod_length" not in mechanism:
        return ideal(resolved, "x", time)
    if crank is None and drive_kind(resolved) != "speed":
        return None
    angle = mechanism.get("start_angle", 0.0) + mechanism["crank_speed"] * time if crank is None else crank
    return rod_reach(mechanism["crank_length"], mechanism["rod_length"], angle, y, z)


def place(resolved: Mapping[str, Any], x: Array | None, y: Array, z: Array) -> Array | None:
    """The slider's centre in the way's frame [m], p = A_lᵀ (u − u_l), (..., 3); None where that takes an x that is not known.

    >>> tilted = {"mechanism": {"kind": "carriage"}, "way": {"offset_y": 2e-3, "pitch": np.pi / 6}}
    >>> place(tilted, np.array([1.0]), np.array([2e-3]), np.array([0.0])).round(3).tolist()
    [[0.866, -0.5, 0.0]]
    """
    way = resolved.get("way", {})
    if x is None and (way.get("yaw") or way.get("pitch")):
        return None
    point, attitude = frame(resolved)
    inertial = np.stack([np.zeros_like(y) if x is None else x, y, z], -1)
    return inertial if not misaligned(resolved) else np.asarray((inertial - point) @ attitude)


def may_be_misaligned(result: xr.Dataset) -> bool:
    """Whether the way of any member can lie elsewhere than it should."""
    resolved = scene(result) if "scene" in result.attrs else {}
    return misaligned(resolved) or any(key.startswith(_places) for key in varied(result) if resolved)


def across(result: xr.Dataset, members: Sequence[int]) -> tuple[Array, Array] | None:
    """y and z of members from their way's axis [m], (members, samples); None where the result lacks a series that this takes."""
    if "y" not in result or "z" not in result:
        return None
    rows = result.sel(member=list(members))
    ys, zs = rows["y"].values, rows["z"].values
    if not may_be_misaligned(result):
        return ys, zs
    time = rows["time"].values
    # What members share is read once: reading a scene takes longer than turning a series.
    own = any(key.startswith((*_places, "mechanism.")) for key in varied(result))
    common = None if own else scene(result)
    found = []
    for k, (number, y, z) in enumerate(zip(members, ys, zs, strict=True)):
        resolved = scene(result, number) if common is None else common
        crank = rows["crank_angle"].values[k] if "crank_angle" in rows else None
        x = rows["x"].values[k] if "x" in rows else along(resolved, time[k] if time.ndim > 1 else time, y, z, crank)
        there = place(resolved, x, y, z)
        if there is None:
            return None
        found.append(there[:, 1:])
    in_way = np.array(found)
    return in_way[..., 0], in_way[..., 1]
