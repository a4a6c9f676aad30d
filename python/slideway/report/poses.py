"""Where a member's slider lies in its way, from the stored samples and the resolved scene."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

import slideway
from slideway import way
from slideway.ideal import drive_kind

from . import contact
from .contact import Array

STATES = {"spatial": ("y", "z", "roll", "yaw", "pitch"), "planar": ("y", "pitch")}


@dataclass(frozen=True)
class Joint:
    """Sizes of the joint that the drawings and contacts need, all in metres."""

    planar: bool
    length: float  # L_k
    width: float  # w_a along Y; of the planar block its height
    depth: float  # w_b along Z
    gap_y: float  # per side
    gap_z: float


@dataclass(frozen=True)
class Poses:
    """A member's samples up to its end, in way coordinates; angles are small, so roll, yaw and pitch add like a vector's components.

    All arrays are (n); touching is (n, 16) or, of a planar block, (n, 4), and modes is (n, 3).
    """

    joint: Joint
    samples: NDArray[np.int64]  # which of the file's samples these are
    time: Array  # [s]
    y: Array  # [m]
    z: Array
    roll: Array  # [rad]
    yaw: Array
    pitch: Array
    touching: NDArray[np.bool_]
    modes: NDArray[np.int64]  # surfaces, lines, points
    x: Array | None  # along the way, inertial [m]; None where neither file nor mechanism gives it
    crank: Array | None  # crank angle [rad]; None without a crank
    links: tuple[float, float] | None  # lengths of crank and rod [m]


def why_none(result: xr.Dataset) -> str | None:
    """Why there are no poses in this result, in one line; None where there are some."""
    if "status" not in result:
        return 'The members are not stored (study.store = "statistics"), so there is no time series to draw.'
    if "sample" not in result.sizes or result.sizes["sample"] == 0:
        return "The file holds no time series; an ensemble with study.samples_per_revolution (or study.samples) has one."
    scene = slideway.scene(result)
    shaped = [name for name in ("way_profile", "way_ends") if name in scene]
    if shaped:
        return f"The drawing knows straight ways without ends, and the scene has [{shaped[0]}]."
    kind = scene.get("mechanism", {}).get("kind")
    planar = kind == "planar_slider_crank"
    missing = [name for name in STATES["planar" if planar else "spatial"] if name not in result]
    if missing:
        return f"The time series lack {', '.join(missing)}, which place the slider in its way."
    if kind == "free_slider" and "x" not in result and way.may_be_misaligned(result):
        return "The time series lack x, which places the slider in its turned way."
    return None


def poses(result: xr.Dataset, member: int) -> Poses:
    """Poses and contacts of one member, by its number in the ensemble (model.md sections 1, 3, 6 and 7).

    Samples behind a member's end hold no numbers and are left out.
    """
    scene = slideway.scene(result, member=member)
    joint = _joint(scene)
    row = result.sel(member=member)
    states = {name: row[name].values for name in STATES["planar" if joint.planar else "spatial"]}
    kept = np.flatnonzero(np.all([np.isfinite(column) for column in states.values()], axis=0))
    states = {name: column[kept] for name, column in states.items()}
    time = row["time"].values[kept]
    stored = {name: row[name].values[kept] for name in ("x", "crank_angle") if name in row}
    crank, links = _crank(scene, time, stored.get("crank_angle"))
    y, pitch = states["y"], states["pitch"]
    zero = np.zeros_like(y)
    if joint.planar:
        touching = contact.planar_depths(y, pitch, joint.length, joint.width, joint.gap_y) > 0
        x = stored.get("x", way.along(scene, time, y, zero, crank))
        return Poses(joint, kept, time, y, zero, zero, zero, pitch, touching, contact.planar_modes(touching), x, crank, links)
    x = stored.get("x", way.along(scene, time, y, states["z"], crank))
    place = way.place(scene, x, y, states["z"])
    if place is None:
        raise slideway.SlidewayError("x is not stored, so where the slider lies in a turned way is unknown; ask why_none first")
    attitude = way.rotation(states["roll"], states["yaw"], pitch)
    if way.misaligned(scene):
        attitude = way.frame(scene)[1].T @ attitude
    touching = contact.spatial_depths(place[:, 1], place[:, 2], attitude, *_sizes(joint)) > 0
    return Poses(
        joint=joint, samples=kept, time=time, y=place[:, 1], z=place[:, 2], roll=attitude[:, 2, 1], yaw=attitude[:, 0, 2], pitch=attitude[:, 1, 0],
        touching=touching, modes=contact.spatial_modes(touching), x=x, crank=crank, links=links,
    )  # fmt: skip


def _sizes(joint: Joint) -> tuple[float, float, float, float, float]:
    return joint.length, joint.width, joint.depth, joint.gap_y, joint.gap_z


def _joint(scene: dict[str, Any]) -> Joint:
    sizes = scene["joint"]
    if scene["mechanism"]["kind"] == "planar_slider_crank":
        return Joint(True, sizes["slider_length"], sizes["slider_height"], 0.0, sizes["clearance_y"], 0.0)
    return Joint(False, sizes["slider_length"], sizes["way_width"], sizes["way_depth"], way.mean_clearance(sizes, "y"), way.mean_clearance(sizes, "z"))


def _crank(scene: dict[str, Any], time: Array, stored: Array | None) -> tuple[Array | None, tuple[float, float] | None]:
    """Crank angle [rad] and lengths of crank and rod [m]: stored, or of constant speed (model.md section 6)."""
    mechanism = scene["mechanism"]
    if "rod_length" not in mechanism:
        return None, None
    links = (float(mechanism["crank_length"]), float(mechanism["rod_length"]))
    if stored is not None:
        return stored, links
    if drive_kind(scene) != "speed":
        return None, None
    return mechanism.get("start_angle", 0.0) + mechanism["crank_speed"] * time, links
