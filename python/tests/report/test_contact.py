"""Penetrations and modes against the golden values of model.md, and against what the program stored."""

from __future__ import annotations

import csv
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import slideway
import xarray as xr
from slideway.ideal import ideal
from slideway.report import contact, poses
from slideway.way import rotation

golden = Path(__file__).resolve().parents[3] / "tests" / "golden"
PAIRS = [f"pen_{axis}_P{k}" for axis in "yz" for k in range(1, 9)]
MODES = ["surfaces", "lines", "points"]
STATES = ["y", "z", "roll", "yaw", "pitch"]


def table(name: str) -> list[dict[str, str]]:
    with open(golden / name, newline="") as file:
        return list(csv.DictReader(file))


def numbers(rows: list[dict[str, str]], names: list[str]) -> np.ndarray:
    return np.array([[float(row[name]) for name in names] for row in rows])


@pytest.mark.parametrize("name", ["rhs_paper.csv", "rhs_conservative.csv", "rhs_kelvin_voigt.csv", "rhs_foundation.csv"])
def test_penetrations_are_the_golden_ones(name: str) -> None:
    rows = table(name)
    y, z, roll, yaw, pitch = numbers(rows, STATES).T
    gaps = numbers(rows, ["joint.clearance_y", "joint.clearance_z"])
    attitude = rotation(roll, yaw, pitch)
    for k, (gap_y, gap_z) in enumerate(gaps):
        one = slice(k, k + 1)
        depths = contact.spatial_depths(y[one], z[one], attitude[one], 0.04, 0.02, 0.03, gap_y, gap_z)
        expected = numbers(rows[one], PAIRS)
        assert np.abs(depths - expected).max() <= 2e-8 * np.abs(expected).max()
        assert contact.spatial_modes(depths > 0).tolist() == numbers(rows[one], MODES).astype(int).tolist()


def scene_of(row: dict[str, str]) -> str:
    groups: dict[str, list[str]] = {}
    for key, value in row.items():
        group, dot, name = key.partition(".")
        if dot:
            groups.setdefault(group, []).append(f'{name} = "{value}"' if name == "law" else f"{name} = {float(value)!r}")
    groups["mechanism"].append('kind = "slider_crank"')
    return "\n".join(f"[{group}]\n" + "\n".join(lines) for group, lines in groups.items())


def test_poses_in_a_misaligned_way_touch_as_the_golden_ones() -> None:
    rows = table("rhs_parameters.csv")
    assert any(float(row["way.pitch"]) != 0 for row in rows)
    for row in rows:
        result = xr.Dataset(
            {name: (("member", "sample"), [[float(row[name])]]) for name in STATES},
            coords={"member": [0], "time": ("sample", [float(row["t"])])},
            attrs={"scene": scene_of(row)},
        )
        assert poses.poses(result, 0).modes.tolist() == [[int(float(row[name])) for name in MODES]]


def test_modes_are_those_that_the_program_stored(result_of: Callable[[str], xr.Dataset]) -> None:
    with result_of("single") as result:
        pose = poses.poses(result, 0)
        stored = np.stack([result[name].values[0] for name in MODES], 1)
        assert stored.any()
        assert (pose.modes == stored).all()


def test_the_place_along_the_way_is_the_stored_one(result_of: Callable[[str], xr.Dataset]) -> None:
    with result_of("single") as result:
        stored = result["x"].values[0]
        computed = poses.poses(result.drop_vars("x"), 0).x
        assert computed is not None
        assert np.abs(computed - stored).max() < 1e-12


def test_a_planar_block_touches_with_the_corners_that_are_beyond_the_walls() -> None:
    gap, length = 1e-3, 0.1
    tilt = 2 * gap / length  # lifts a corner by the clearance
    y = np.array([0.0, 0.0, 1.1e-3, -0.5e-3])
    pitch = np.array([0.0, 1.1 * tilt, 0.0, 0.6 * tilt])
    touching = contact.planar_depths(y, pitch, length, 0.05, gap) > 0
    #                               none, two opposite, the upper face, the lower corner behind
    assert touching.tolist() == [[False] * 4, [True, False, False, True], [True, True, False, False], [False, False, False, True]]
    assert contact.planar_modes(touching).tolist() == [[0, 0, 0], [0, 0, 2], [1, 0, 0], [0, 0, 1]]


def test_a_carriage_moves_as_prescribed() -> None:
    v, stroke, turn = 0.06, 0.15, 0.02
    carriage = {"mechanism": {"kind": "carriage", "carriage_speed": v, "stroke": stroke, "reversal_time": turn}}
    run = stroke / v
    time = np.linspace(0, 2 * (run + turn), 200001)[:-1]  # before it begins anew
    phase = np.mod(time, run + turn)
    speed = np.where(phase < run, v, v * np.cos(np.pi * (phase - run) / turn))
    speed *= np.where(time >= run + turn, -1, 1)
    place = np.concatenate([[0], np.cumsum((speed[1:] + speed[:-1]) / 2 * np.diff(time))])
    assert np.abs(ideal(carriage, "x", time) - place).max() < 1e-7


def test_there_are_no_poses_without_time_series(result_of: Callable[[str], xr.Dataset]) -> None:
    with result_of("lyapunov") as result:
        assert "samples_per_revolution" in str(poses.why_none(result))
    with result_of("stored") as result:
        assert "not stored" in str(poses.why_none(result))
    with result_of("single") as result:
        assert poses.why_none(result) is None
        assert "pitch" in str(poses.why_none(result.drop_vars("pitch")))
        assert slideway.scene(result)["mechanism"]["kind"] == "slider_crank"
