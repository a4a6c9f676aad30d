"""Frames of the slider in its way, for the drawings of assets/animation.js."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from slideway.way import play

from .members import chosen
from .poses import Joint, Poses
from .traces import packed

MOST_FRAMES = 2000
VISIBLE = 0.09  # of the way's smaller side: how large the magnified clearance is drawn


def magnification(joint: Joint) -> float:
    """By which factor gaps and tilts are drawn larger than bodies: one or two significant digits, at least 1.

    >>> from slideway.report.animation import magnification
    >>> from slideway.report.poses import Joint
    >>> magnification(Joint(False, 0.04, 0.02, 0.03, 1e-4, 1e-4))
    18.0
    """
    size = joint.width if joint.planar else min(joint.width, joint.depth)
    wanted = VISIBLE * size / max(play(joint.gap_y), play(joint.gap_z))
    return max(1.0, float(f"{wanted:.2g}"))


def frames(result: xr.Dataset, seen: dict[int, Poses]) -> dict[str, Any]:
    """All that the drawings need, as data for the page; lengths in mm, angles in rad.

    Each member has a frame per stored sample, of more than 2000 an even choice. touching holds a bit per apex-face pair, in
    the order of :func:`contact.spatial_depths` (or of the four corners).
    """
    joint = next(iter(seen.values())).joint
    return {
        "planar": joint.planar,
        "magnification": magnification(joint),
        "members": [_member(pose, label) for pose, label in zip(seen.values(), chosen(result).values(), strict=True)],
    }


def _member(pose: Poses, label: str) -> dict[str, Any]:
    count = len(pose.time)
    kept = np.unique(np.linspace(0, count - 1, min(count, MOST_FRAMES)).round().astype(int)) if count else np.arange(0)
    bits = (pose.touching[kept].astype(np.uint32) << np.arange(pose.touching.shape[1], dtype=np.uint32)).sum(1)
    joint = pose.joint
    states = {name: getattr(pose, name)[kept] for name in ("roll", "yaw", "pitch")}
    lengths = {name: getattr(pose, name)[kept] * 1e3 for name in ("y", "z")}
    extra: dict[str, Any] = {}
    if pose.x is not None:
        extra["x"] = packed(pose.x[kept] * 1e3)
    if pose.crank is not None and pose.links is not None:
        extra["crank"] = packed(np.mod(pose.crank[kept], 2 * np.pi))
        extra["links"] = [length * 1e3 for length in pose.links]
    return {
        "label": label,
        "count": len(kept),
        "of": count,
        "length": joint.length * 1e3,
        "width": joint.width * 1e3,
        "depth": joint.depth * 1e3,
        "gaps": [joint.gap_y * 1e3, joint.gap_z * 1e3],
        "time": packed(pose.time[kept], "f8"),
        **{name: packed(values) for name, values in {**lengths, **states}.items()},
        "touching": packed(bits, "u2"),
        "modes": packed(pose.modes[kept].ravel(), "u1"),
        **extra,
    }
