"""The worked studies (scripts/study, docs/tutorial/study.md) against what can be known without slideway, and their page against members of other draws."""

from __future__ import annotations

import doctest
import math
import re
import sys
from typing import Any

import numpy as np
import pytest
import slideway
from conftest import root
from scipy.stats import norm, truncnorm

sys.path.insert(0, str(root / "scripts"))

from study import ideal, machines, page, runs  # noqa: E402

PAGE = (root / "docs/tutorial/study.md").read_text(encoding="utf-8")
AS_DRAWN = {"friction.kinetic": 0.08, "mechanism.crank_speed": "600 rpm"}  # as the closed forms have them


def rows(title: str) -> dict[str, list[str]]:
    """The cells of the table below this heading, by their first."""
    after = PAGE[PAGE.index(f"# {title}\n") :]
    table = re.search(r"^\|.*\n\|---.*\n((?:\|.*\n)+)", after, re.MULTILINE)
    assert table
    lines = [[cell.strip() for cell in line.strip("|").split("|")] for line in table[1].splitlines()]
    return {line[0]: line[1:] for line in lines}


def numbers(cell: str) -> list[float]:
    return [float(number) for number in re.findall(r"[\d.]+", cell)]


def crosshead(fit: runs.Fit, vary: dict[str, Any], members: int, quantities: list[str], **settings: Any) -> Any:
    keys = runs.scatter({"joint.clearance_y": fit.clearance()} | vary) | settings
    return slideway.run(root / "scenes/crosshead.toml", progress=False, threads=2,
                        set=keys | {"study.members": members, "study.verify": 0, "study.quantities": quantities})  # fmt: skip


def held(names: dict[str, Any]) -> dict[str, Any]:
    return {key: {"dist": "const", "value": value} for key, value in names.items()}


def test_examples_in_docstrings_hold(program: str) -> None:
    for module in (page, runs):
        assert doctest.testmod(module).failed == 0, module.__name__


@pytest.mark.parametrize("scale", [ideal.area, 0.0])
def test_friction_and_work_are_those_of_the_mechanism_without_clearance(program: str, scale: float) -> None:
    found = crosshead(runs.middle, held(AS_DRAWN | {"load.plunger.scale": scale}), 8, ["friction_loss", "load_work"], **{"contact.law": "rigid"})
    assert found.friction_loss.values / runs.turns == pytest.approx(ideal.friction_loss(root, 0.08, scale), rel=6e-3)
    one = ideal.turn(root, 0.08, scale)
    work = float(np.mean(one.push * one.velocity)) * 2 * math.pi / ideal.speed
    assert found.load_work.values / runs.turns == pytest.approx(work, rel=1e-3)
    if scale:
        assert -work == pytest.approx(runs.hydraulic_work, rel=1e-3)


def test_a_tight_crosshead_bears_the_side_force_and_no_more(program: str) -> None:
    found = crosshead(runs.fits[0], held(AS_DRAWN | {"load.plunger.scale": ideal.area}), 8, ["peak_normal_force"], **{"study.duration": "0.2 s"})
    assert np.median(found.peak_normal_force) == pytest.approx(np.max(np.abs(ideal.turn(root, 0.08).side)), rel=0.01)


def test_the_share_that_meets_the_friction_limit_is_that_of_the_two_scatters() -> None:
    # Friction of a turn is nearly a straight line in the coefficient, and in the pressure.
    scales = norm(ideal.area, 1e-5).ppf((np.arange(200) + 0.5) / 200)
    low, high = (ideal.friction_loss(root, value) for value in (0.07, 0.09))
    slope, bare = (high - low) / 0.02, ideal.friction_loss(root, 0.08, 0.0)
    limits = 0.08 + (runs.pump.friction_limit - (bare + (ideal.friction_loss(root, 0.08) - bare) * scales / ideal.area)) / slope
    meet = 100 * float(np.mean(truncnorm(-3, 3, 0.08, 0.01).cdf(limits)))
    for fit in ("H7/g6", "H8/f7", "H8/e8"):
        share, low, high = numbers(rows("Which fit for the crosshead of a pump?")[fit][5])
        assert abs(share - meet) < 1.5 * (high - low) / 2, fit


def test_the_page_has_the_fits_of_other_draws(program: str) -> None:
    table, grown = rows("Which fit for the crosshead of a pump?"), []
    for fit in runs.fits:
        _, impacts, _, _, quiet, both, cost = table[fit.name]
        found = crosshead(fit, {}, 192, ["damping_loss", "friction_loss"], **{"contact.law": "rigid", "study.seed": 7})
        lost = 1e3 * found.damping_loss.values / runs.turns
        assert abs(numbers(impacts)[0] - lost.mean()) < 4 * lost.std() / math.sqrt(192), fit.name
        share = numbers(quiet)[0] / 100
        assert abs(share - np.mean(lost <= 1e3 * runs.pump.impact_limit)) <= 4 * math.sqrt(share * (1 - share) / 192), fit.name
        assert float(cost) == pytest.approx(page.price(fit.cost, numbers(both)[0] / 100), abs=0.02)
        grown.append(numbers(impacts)[0])
    # A side force that rises steadily: a gap that is four times as wide takes 4^(4/3) times the work.
    wider = (runs.fits[3].least + runs.fits[3].most) / (runs.fits[0].least + runs.fits[0].most)
    assert math.log(grown[3] / grown[0]) / math.log(wider) == pytest.approx(4 / 3, abs=0.08)
    best = min(runs.fits, key=lambda fit: float(table[fit.name][6]))
    assert f"**{best.name}** is\nthe cheapest" in PAGE
    before = rows("What the pressure changes")
    assert before["cheapest fit"][1] == best.name
    for cells in zip(before["lost to friction, H8/e8, mJ per turn"], before["by the closed form (speed and friction as drawn)"], strict=True):
        assert numbers(cells[0])[0] == pytest.approx(numbers(cells[1])[0], rel=0.01)


def test_the_worn_face_is_that_of_archard() -> None:
    table = np.loadtxt(root / "scenes/crosshead_wear.csv", delimiter=",", skiprows=1)
    assert table[:, 1] == pytest.approx(ideal.wear(root, 1e-3 * table[:, 0]), abs=1e-4)
    # The face above is hardly pressed: of it nothing is said.
    one = ideal.turn(root, 0.08)
    assert one.side.max() < 0.1 * -one.side.min()


def test_on_a_worn_way_the_crosshead_leans_by_the_chord(program: str) -> None:
    straight = held({"way.yaw": 0, "way.pitch": 0, "way_profile.wear.scale": 80})
    found = runs.spatial(root, 80, straight, 4)
    assert found.leaning == pytest.approx(ideal.chord(root, 80), rel=0.03)
    assert found.friction == pytest.approx(ideal.friction_loss(root, 0.08), rel=6e-3)
    leans, chord = numbers(rows("A way out of line, a worn way")["worn by 80 µm"][2])
    assert chord == pytest.approx(1e3 * ideal.chord(root, 80), abs=0.006)
    assert leans == pytest.approx(np.median(found.leaning) * 1e3, abs=0.05)


def test_a_stroke_takes_of_the_flywheel_what_energy_says(program: str) -> None:
    table = rows("How heavy a flywheel?")
    known = machines.ideal_press(root, np.array([float(inertia) for inertia in table]))
    for (inertia, cells), drop in zip(table.items(), known, strict=True):
        assert numbers(cells[1])[0] == pytest.approx(100 * drop, abs=0.06)
        assert numbers(cells[0])[0] == pytest.approx(100 * drop, rel=0.02), inertia
    first = machines.press(root, 0.3, 16)
    assert np.mean(first.drop) == pytest.approx(known[0], rel=0.05)  # of few draws
    assert 60 * np.mean(first.rate) == pytest.approx(numbers(table["0.3"][4])[0], rel=0.02)


def test_a_carriage_lifts_where_moments_say(program: str) -> None:
    for interpolation, cells in rows("How tall a tool?").items():
        moments = 1e3 * machines.lifting(root, interpolation.strip("`"))
        assert numbers(cells[1])[0] == pytest.approx(moments, abs=0.6)
        assert 0 <= numbers(cells[2])[0] - moments < 10
    height = machines.lifting(root, "spline")
    lower, higher = machines.carriage(root, "spline", np.array([height - 0.01, height + 0.015])).leaning
    assert lower < 1e-4 < higher
