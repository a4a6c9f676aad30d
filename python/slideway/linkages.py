"""Where the bodies of a mechanism are in a state: that of a linkage, or of another mechanism told as one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]
GROUND = "ground"
SIDES = ("first", "second")


def turned(points: Any, angle: Any) -> Array:
    """Points (…, 2), turned anticlockwise by angles (…).

    >>> turned([1.0, 0.0], np.pi / 2).round(9).tolist()
    [0.0, 1.0]
    """
    x, y = np.moveaxis(np.asarray(points, dtype=float), -1, 0)
    cos, sin = np.cos(angle), np.sin(angle)
    return np.stack(np.broadcast_arrays(cos * x - sin * y, sin * x + cos * y), -1)


@dataclass(frozen=True)
class Pose:
    """Of a body's own axes: where they begin (…, 2) [m], and their angle (…) [rad]."""

    at: Array
    angle: Array

    def place(self, point: Any) -> Array:
        """A point of the body along the ground's axes."""
        return self.at + turned(point, self.angle)


def point(table: Mapping[str, Any], name: str) -> Array:
    """What a table has as <name>_x and <name>_y, else 0."""
    return np.array([float(table.get(f"{name}_{axis}", 0.0)) for axis in "xy"])


def poses(scene: Mapping[str, Any], state: Mapping[str, Any]) -> dict[str, Pose]:
    """Of the ground and all bodies of a linkage, in the order in which they hang on one another.

    Args:
        scene: resolved, of :func:`slideway.scene`.
        state: its variables by name, numbers or arrays over time.

    >>> link = {"kind": "revolute", "first": "ground", "second": "crank"}
    >>> scene = {"body": {"crank": {"mass": 1.0}}, "link": {"shaft": link}}
    >>> poses(scene, {"crank_angle": np.pi / 2})["crank"].place([0.05, 0.0]).round(9).tolist()
    [0.0, 0.05]
    """
    links = list(scene["link"].values())
    found = {GROUND: Pose(np.zeros(2), np.zeros(()))}
    for name, body in scene["body"].items():
        if f"{name}_x" in state:
            angle = np.asarray(state[f"{name}_angle"])
            found[name] = Pose(np.stack([state[f"{name}_x"], state[f"{name}_y"]], -1) - turned(point(body, "center"), angle), angle)
    # As the program grows its tree: where a linkage stays open, that tells where.
    driven = scene.get("drive", {}).get("body")
    links.sort(key=lambda link: (driven not in (link["first"], link["second"]) or GROUND not in (link["first"], link["second"]), link["kind"] != "prismatic"))
    while hung := next((one for link in links if (one := _hung(link, state, found))), None):
        found |= hung
    return found


def _hung(link: Mapping[str, Any], state: Mapping[str, Any], found: Mapping[str, Pose]) -> dict[str, Pose]:
    """The body that an ideal joint holds on one whose pose is known."""
    for own, other in ((1, 0), (0, 1)):
        body, on = link[SIDES[own]], link[SIDES[other]]
        if body in found or on not in found:
            continue
        angle, place = found[on].angle, found[on].place(point(link, SIDES[other]))
        if link["kind"] == "revolute" and f"{body}_angle" in state:
            angle = np.asarray(state[f"{body}_angle"])
        elif link["kind"] == "prismatic" and own == 1:
            line = turned([1.0, 0.0], angle + link.get("direction", 0.0))
            place = place + np.asarray(state[f"{body}_displacement"])[..., None] * line
            angle = angle + link.get("turn", 0.0)
        else:
            continue
        return {body: Pose(place - turned(point(link, SIDES[own]), angle), angle)}
    return {}
