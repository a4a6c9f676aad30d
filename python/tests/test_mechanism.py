"""Drawings of linkages: bodies and joints of the scene are there, where the program has them."""

from __future__ import annotations

import copy
import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import slideway
from conftest import Result, scenes
from slideway.figures.base import panel_of
from slideway.figures.marks import Curve, Moving, Panel, Shape, Text
from slideway.figures.mechanism import Sketch, film, panel, stored, told
from slideway.linkages import GROUND, SIDES, point, poses, turned
from slideway.program import call
from slideway.scene_files import scene_file

# A crank turns a rod; its wrist is on a block between leaning walls, and a carriage slides on the rod, with an arm on a journal.
scene: dict[str, Any] = {
    "schema": 1,
    "mechanism": {"kind": "linkage", "crank_speed": -20.0, "start_angle": "60 deg"},
    "drive": {"body": "crank"},
    "body": {
        "crank": {"mass": 0.3, "inertia": 1e-4, "center_x": 0.02},
        "rod": {"mass": 0.2, "inertia": 2e-4, "center_x": 0.06},
        "slider": {"mass": 0.1, "inertia": 1e-4},
        "carriage": {"mass": 0.1},
        "arm": {"mass": 0.1, "inertia": 1e-4, "center_x": 0.03, "center_y": 0.01, "angle": 1.0},
    },
    "link": {
        "shaft": {"kind": "revolute", "first": "ground", "second": "crank", "first_y": 0.01},
        "pin": {"kind": "revolute", "first": "crank", "first_x": 0.05, "second": "rod"},
        "wrist": {"kind": "revolute", "first": "rod", "first_x": 0.12, "second": "slider"},
        "guide": {"kind": "block", "first": "slider", "second": "ground", "second_x": 0.15, "direction": "10 deg", "length": 0.04, "height": 0.02,
                  "clearance": "0.1 mm", "stiffness": 1e8, "offset_y": 3e-5, "tilt": 0.002},
        "branch": {"kind": "prismatic", "first": "rod", "first_x": 0.1, "first_y": 0.03, "direction": "80 deg", "turn": 0.2, "second": "carriage", "position": 0.01},
        "hook": {"kind": "journal", "first": "arm", "second": "carriage", "second_x": 0.01, "clearance": 1e-4, "radius": 0.004, "offset_x": 4e-5, "offset_y": -6e-5},
    },
    "study": {"duration": 0.01, "samples": 11},
}  # fmt: skip


@pytest.fixture(scope="module")
def start(program: str) -> Sketch:
    with scene_file(scene) as file:
        return told(json.loads(call(program, ["check", file.path, "--json"])))


def words_of(drawn: Panel) -> set[str]:
    return {mark.words for mark in drawn.marks if isinstance(mark, Text) and not mark.inside}


def shapes_of(drawn: Panel) -> list[np.ndarray]:
    return [mark.points for mark in drawn.marks if isinstance(mark, Shape)]


def is_round(points: np.ndarray) -> bool:
    return len(points) > 20


def test_poses_close_the_joints_that_the_program_closes(start: Sketch) -> None:
    where = poses(start.scene, start.state)
    assert set(where) == {GROUND, *scene["body"]}
    for name, link in start.scene["link"].items():
        first, second = (where[link[side]].place(point(link, side)) for side in SIDES)
        apart = first - second
        if link["kind"] == "revolute":
            assert np.hypot(*apart) < 1e-12, name
        elif link["kind"] == "journal":
            assert apart == pytest.approx([4e-5, -6e-5], abs=1e-12)
        elif link["kind"] == "block":
            assert turned(apart, -np.deg2rad(10))[1] == pytest.approx(3e-5, abs=1e-12)
            assert where["slider"].angle - np.deg2rad(10) == pytest.approx(0.002, abs=1e-12)
        else:
            assert turned(apart, -(where["rod"].angle + np.deg2rad(80)))[1] == pytest.approx(0, abs=1e-12)
    centre = where["arm"].place(point(start.scene["body"]["arm"], "center"))
    assert centre == pytest.approx([start.state["arm_x"], start.state["arm_y"]])


def test_every_body_and_joint_of_a_scene_is_named_and_drawn(start: Sketch) -> None:
    drawn = panel(start)
    assert words_of(drawn) == {*scene["body"], *scene["link"]}
    where = poses(start.scene, start.state)
    rings = [(float(mark.x[0]), float(mark.y[0])) for mark in drawn.marks if isinstance(mark, Curve) and mark.hollow]
    expected = [1e3 * where[link["first"]].place(point(link, "first")) for link in start.scene["link"].values() if link["kind"] == "revolute"]
    assert rings == [pytest.approx(tuple(place)) for place in expected]
    crosses = [(float(mark.x[0]), float(mark.y[0])) for mark in drawn.marks if isinstance(mark, Curve) and mark.marker == "X"]
    assert crosses == [pytest.approx(tuple(1e3 * where[name].place(point(body, "center")))) for name, body in start.scene["body"].items()]


@pytest.mark.parametrize("name", scene["link"])
def test_a_drawing_lacks_the_joint_that_a_scene_lacks(start: Sketch, name: str) -> None:
    whole, less = panel(start), copy.deepcopy(start.scene)
    del less["link"][name]
    if {"shaft": "crank", "pin": "rod", "wrist": "slider", "branch": "carriage"}.get(name):
        return  # what hangs on it would be nowhere
    drawn = panel(Sketch(less, start.state))
    assert words_of(whole) - words_of(drawn) == {name}
    assert len(drawn.marks) < len(whole.marks)


def test_clearances_are_drawn_by_one_factor(start: Sketch) -> None:
    drawn = panel(start)
    (note,) = [mark.words for mark in drawn.marks if isinstance(mark, Text) and mark.inside]
    times = float(note.split("×")[1])
    assert times > 3
    bearing, journal = [points for points in shapes_of(drawn) if is_round(points)]
    middles = [points[:-1].mean(0) for points in (bearing, journal)]
    radii = [np.hypot(*(points[0] - middle)) for points, middle in zip((bearing, journal), middles, strict=True)]
    assert radii[0] == pytest.approx(4.0)
    assert radii[0] - radii[1] == pytest.approx(0.1 * times)
    assert middles[1] - middles[0] == pytest.approx([0.04 * times, -0.06 * times])
    # Corners of the block stay between its walls, as far from them as they are, so many times.
    (block,) = [points for points in shapes_of(drawn) if len(points) == 4 and np.hypot(*(points[1] - points[0])) == pytest.approx(40)]
    walls = [mark for mark in drawn.marks if isinstance(mark, Curve) and mark.width == 2.0]
    ends = np.concatenate([np.transpose([wall.x, wall.y]) for wall in walls])
    across, middle = turned([0.0, 1.0], np.deg2rad(10)), ends.mean(0)
    assert np.abs((ends - middle) @ across) == pytest.approx(np.full(4, 10 + 0.1 * times))
    tilt = np.arctan2(*(block[1] - block[0])[::-1]) - np.deg2rad(10)
    assert tilt == pytest.approx(0.002 * times)
    assert (block.mean(0) - middle) @ across == pytest.approx(0.03 * times)


def test_a_slide_is_a_box_on_a_line_of_the_other_body(start: Sketch) -> None:
    drawn, where = panel(start), poses(start.scene, start.state)
    rod, line = where["rod"], turned([1.0, 0.0], where["rod"].angle + np.deg2rad(80))
    begin = 1e3 * rod.place([0.1, 0.03])
    (rail,) = [mark for mark in drawn.marks if isinstance(mark, Curve) and mark.dash == "-."]
    for end in np.transpose([rail.x, rail.y]):
        assert turned([0.0, 1.0], np.arctan2(line[1], line[0])) @ (end - begin) == pytest.approx(0, abs=1e-9)
    middles = [points.mean(0) for points in shapes_of(drawn) if len(points) == 4]
    assert any(middle == pytest.approx(begin + 1e3 * start.state["carriage_displacement"] * line) for middle in middles)


def test_the_drive_turns_as_the_scene_says(start: Sketch) -> None:
    backwards = Sketch({**start.scene, "mechanism": {**start.scene["mechanism"], "crank_speed": 20.0}}, start.state)

    def turning(sketch: Sketch) -> float:
        (arc,) = [mark for mark in panel(sketch).marks if isinstance(mark, Curve) and mark.order == 7]
        x, y = arc.x - 0.0, arc.y - 10.0
        return float(np.sign(x[0] * y[1] - y[0] * x[1]))

    assert (turning(start), turning(backwards)) == (-1.0, 1.0)


def test_a_scene_can_be_drawn_at_an_angle(program: str) -> None:
    for angle in ("30 deg", np.pi / 6):
        drawn = panel_of(slideway.plot.mechanism, scene, angle=angle)
        rings = [np.array([mark.x[0], mark.y[0]]) for mark in drawn.marks if isinstance(mark, Curve) and mark.hollow]
        assert rings[1] - rings[0] == pytest.approx([50 * np.cos(np.pi / 6), 50 * np.sin(np.pi / 6)])


def test_a_stored_state_is_drawn_with_its_members_clearance(result_of: Result) -> None:
    result = result_of("linkage")
    at = result.sel(member=2).isel(sample=7)
    drawn = panel_of(slideway.plot.mechanism, result, member=2, time=float(at["time"]))
    assert drawn.title == f"member 2 at {float(at['time']):.6g} s"
    times = float(next(mark.words for mark in drawn.marks if isinstance(mark, Text) and mark.inside).split("×")[1])
    bearing, journal = [points for points in shapes_of(drawn) if is_round(points)][:2]
    place = journal[:-1].mean(0) - bearing[:-1].mean(0)
    assert place == pytest.approx([1e3 * times * float(at["crank_pin_x"]), 1e3 * times * float(at["crank_pin_y"])], abs=1e-6)
    assert np.hypot(*(bearing[0] - bearing[:-1].mean(0))) == pytest.approx(10.2)


def test_a_film_moves_what_the_bodies_do(result_of: Result) -> None:
    run = stored(result_of("linkage"), 1)
    moving = [mark for mark in film(run, 11, 2.0).marks if isinstance(mark, Moving)]
    crank = moving[0]
    some = np.unique(np.linspace(0, run.state["time"].size - 1, 11).round().astype(int))
    assert crank.turn == pytest.approx(np.rad2deg(run.state["crank_angle"][some] - run.state["crank_angle"][0]))
    assert len(moving) >= 2 * 3 + 1 + 2 * 3  # bodies with their mass centres, the pin, journals in their bearings
    animation = slideway.plot.animation(result_of("linkage"), frames=3)
    animation._draw_was_started = True  # type: ignore[attr-defined]
    assert len(list(animation.new_frame_seq())) == 3


def test_what_cannot_be_drawn_is_said(result_of: Result, program: str) -> None:
    with pytest.raises(slideway.SlidewayError, match="draws linkages, and this is a slider_crank"):
        slideway.plot.mechanism(result_of("ensemble"))
    with pytest.raises(slideway.SlidewayError, match="of a scene give the angle"):
        slideway.plot.mechanism(scene, time=0.1)
    with pytest.raises(slideway.SceneError, match=r"^link\.guide\.[a-z_]+ .*stays open by .* beyond its clearance"):
        slideway.plot.mechanism({**scene, "link": {**scene["link"], "guide": {**scene["link"]["guide"], "second_y": 1.0}}})


def test_the_program_draws_what_it_checks(program: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SLIDEWAY_PYTHON", sys.executable)

    def check(name: str, *more: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run([program, "check", scenes / "four_bar_journals.toml", "--draw", tmp_path / name, *more], capture_output=True, text=True, check=False)

    done = check("four_bar.svg")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.splitlines()[-1] == f"drawing      {tmp_path}/four_bar.svg"
    text = (tmp_path / "four_bar.svg").read_text()
    assert all(f">{name}</text>" in text for name in ("crank", "coupler", "rocker", "shaft", "crank_pin", "coupler_pin", "post"))
    again = check("four_bar.svg")
    assert again.returncode == 4
    assert "--force" in again.stderr
    assert check("four_bar.svg", "--force").returncode == 0
    assert check("four_bar.png").returncode == 0
    assert (tmp_path / "four_bar.png").read_bytes().startswith(b"\x89PNG")
    assert check("four_bar.gif").returncode == 2
    # What does not go together is seen too, with the joint that is open.
    wrong = check("open.svg", "--set", "link.post.second_x=0.5")
    assert wrong.returncode == 2
    assert "stays open by" in wrong.stderr
    assert "ends are" in (tmp_path / "open.svg").read_text()


def test_a_page_about_a_linkage_speaks_of_its_joints(result_of: Result) -> None:
    from slideway.report.page import html_of

    page = html_of(result_of("linkage")).split("<main")[1].split("The resolved scene")[0]
    assert "Journals in their bearings" in page
    assert "data:image/svg+xml" in page
    words = re.sub(r'"data:[^"]*"', "", page)
    assert "crank_pin (journal of crank and coupler" in words
    assert re.findall(r"\b(?:slider|way|apex|apices|faces?|corners?)\b", words) == []


def test_poses_follow_arrays_over_time(start: Sketch) -> None:
    state = {name: np.array([value, value]) for name, value in start.state.items()}
    for name, pose in poses(start.scene, state).items():
        if name != GROUND:
            assert pose.at.shape == (2, 2)
            assert pose.at[1] == pytest.approx(poses(start.scene, start.state)[name].at)


def test_results_without_series_say_what_to_do(result_of: Result) -> None:
    with pytest.raises(slideway.SlidewayError, match="no time series"):
        slideway.plot.mechanism(result_of("linkage").drop_dims("sample"))


def test_forces_of_joints_are_quantities(program: str) -> None:
    pin = {"kind": "journal", "first": "pendulum", "second": "ground", "clearance": 1e-4, "radius": 0.01, "offset_y": -1e-4}
    hanging = {
        "schema": 1, "mechanism": {"kind": "linkage"}, "link": {"pin": pin}, "contact": {"restitution": 0.5},
        "body": {"pendulum": {"mass": 2.0, "inertia": 0.01, "center_x": 0.1, "angle": "-90 deg"}},
        "study": {"duration": 0.5, "samples": 2001, "quantities": ["peak_force_pin", "mean_force_pin", "pin_force"]},
    }  # fmt: skip
    result = slideway.run(hanging, program=program, progress=False)
    # What the bearing pushes it by is its weight and what its momentum gains; it pushes upwards alone.
    speed = result["pendulum_vy"].values[0]
    assert float(result["mean_force_pin"][0]) == pytest.approx(2.0 * (9.81 + (speed[-1] - speed[0]) / 0.5), rel=1e-3)
    most = float(result["pin_force"].max())
    assert most <= float(result["peak_force_pin"][0]) < 1.5 * most


def test_a_linkages_joints_are_explained(result_of: Result) -> None:
    result = result_of("linkage")
    at = result.sel(member=1).isel(sample=20)
    found = slideway.explain(result, member=1, time=float(at["time"]))
    assert [(one["joint"], one["first"], one["second"]) for one in found.joints] == [
        ("crank_pin", "crank", "coupler"), ("coupler_pin", "coupler", "rocker"), ("post", "rocker", "ground")]  # fmt: skip
    crank_pin = found.table().loc["crank_pin"]
    assert [crank_pin["x"], crank_pin["y"]] == pytest.approx([float(at["crank_pin_x"]), float(at["crank_pin_y"])], rel=1e-6)
    for one in found.joints:
        assert one["depth"] == pytest.approx(np.hypot(one["x"], one["y"]) - float(slideway.scene(result, 1)["link"][one["joint"]]["clearance"]))
        assert one["force_x"] * one["x"] + one["force_y"] * one["y"] == pytest.approx(-one["normal_force"] * np.hypot(one["x"], one["y"]))
        assert one["touches"] == (one["normal_force"] > 0)
    assert found.pairs == ()
