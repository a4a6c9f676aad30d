"""Springs and dampers of bench/rigid_mechanism.py return what they shall, by small steps through an impact."""

from __future__ import annotations

import doctest
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import rigid_mechanism


def rebound(force: Callable[[float, float], float], speed: float, step: float) -> float:
    """Share of its speed with which a unit mass leaves; `force` of depth and its rate."""
    depth, rate = 0.0, speed
    while True:
        middle_depth, middle_rate = depth + step / 2 * rate, rate - step / 2 * force(depth, rate)
        depth, rate = depth + step * middle_rate, rate - step * force(middle_depth, middle_rate)
        if force(depth, rate) <= 0:
            return -rate / speed


@pytest.mark.parametrize("share", [0.2, 0.4, 0.9])
@pytest.mark.parametrize("speed", [0.05, 0.5])
def test_linear_spring_returns_the_same_share_of_every_speed(share: float, speed: float) -> None:
    ratio = rigid_mechanism.damping_ratio(share)
    assert rebound(lambda depth, rate: depth + 2 * ratio * rate, speed, 1e-4) == pytest.approx(share, abs=2e-4)


@pytest.mark.parametrize("share", [0.2, 0.4, 0.9])
def test_hunt_and_crossley_returns_its_share_of_its_speed_and_more_of_lower_ones(share: float) -> None:
    dissipation = rigid_mechanism.hunt_crossley_dissipation(share, 0.5)

    def force(depth: float, rate: float) -> float:
        return depth * (1 + dissipation * rate)

    assert rebound(force, 0.5, 1e-4) == pytest.approx(share, abs=1e-3)
    assert rebound(force, 0.1, 1e-4) > share + 0.02


def test_examples_in_docstrings_hold() -> None:
    assert doctest.testmod(rigid_mechanism).failed == 0
