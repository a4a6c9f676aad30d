"""Where the way's faces lie: with clearances of their own as with an offset of the way."""

from __future__ import annotations

import math

import numpy as np
import slideway
from slideway import way
from slideway.ideal import ideal
from slideway.report.poses import poses

CARRIAGE = {"kind": "carriage", "carriage_speed": 0.06, "stroke": 0.15, "reversal_time": 0.02}


def test_faces_with_their_own_clearances_are_those_of_an_offset_way() -> None:
    turned = {"roll": 0.3, "yaw": 0.02, "pitch": -0.01}
    faces = {"mechanism": CARRIAGE, "way": turned, "joint": {"clearance_y_plus": 1e-5, "clearance_y_minus": 3e-5, "clearance_z": 2e-5, "clearance_z_minus": 6e-5}}
    middle = way.rotation(*turned.values()) @ np.array([0.0, 1e-5, 2e-5])
    point, _ = way.frame(faces)
    assert np.allclose(point, middle, atol=1e-18)
    assert way.misaligned({**faces, "way": {}})
    assert not way.misaligned({"mechanism": CARRIAGE, "joint": {"clearance_y": 1e-5, "clearance_z": 1e-5}})
    assert [way.mean_clearance(faces["joint"], axis) for axis in ("y", "z")] == [2e-5, 4e-5]
    assert math.isnan(way.mean_clearance({}, "y"))


def test_a_slider_that_lies_on_a_face_touches_it(program: str) -> None:
    # Onto the way's top from the middle of uneven faces: rigid, without bounce.
    result = slideway.run({
        "schema": 1, "mechanism": {"kind": "carriage"}, "contact": {"law": "rigid", "restitution": 0.0},
        "joint": {"clearance_y_plus": 2e-5, "clearance_y_minus": 8e-5},
        "study": {"members": 1, "duration": 0.05, "samples": 11, "verify": 0, "quantities": ["y", "z", "roll", "yaw", "pitch"]},
    }, progress=False)  # fmt: skip
    assert result.y.values[0, -1] == np.float64(-2e-5) or abs(result.y.values[0, -1] + 2e-5) < 1e-10
    across = way.across(result, [0])
    assert across is not None
    assert abs(across[0][0, -1] + 5e-5) < 1e-10  # from the middle, the mean clearance down
    shown = poses(result, 0)
    assert shown is not None
    assert shown.joint.gap_y == 5e-5
    assert abs(shown.y[-1] + 5e-5) < 1e-10


def test_nothing_follows_from_a_pin_that_lies_elsewhere() -> None:
    scene = {"mechanism": CARRIAGE, "slider": {"pin_y": 1e-3}}
    time = np.array([0.0, 0.1])
    assert ideal(scene, "x", time) is None
    assert way.along(scene, time, time, time) is None
    assert way.along({"mechanism": CARRIAGE, "slider": {"mass_center_x": 1e-3}}, time, time, time) is not None
