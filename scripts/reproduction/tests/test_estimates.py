"""Intervals and what differences say, on numbers whose answer is known."""

import doctest

import numpy as np
import pytest
from reproduction import claims, estimates, maps, plan
from reproduction.estimates import Change, difference, estimate, grows, share


def around(mean: float, sd: float, count: int = 40) -> np.ndarray:
    """Numbers with exactly this mean and standard deviation."""
    shape = np.linspace(-1, 1, count)
    return mean + sd * (shape - shape.mean()) / shape.std(ddof=1)


def test_examples_in_docstrings_hold() -> None:
    for module in (claims, estimates, maps, plan):
        assert doctest.testmod(module).failed == 0, module.__name__


def test_estimate_has_students_interval_and_leaves_failures_out() -> None:
    taken = estimate(np.append(around(10, 2, 16), np.nan))
    assert taken.count == 16
    assert taken.mean == pytest.approx(10)
    # t of 15 degrees of freedom is 2.1314, and sd/sqrt(16) is 1/2
    assert taken.half_width == pytest.approx(2.1314 * 0.5, rel=1e-3)
    assert estimate(np.array([np.nan])).count == 0


def test_difference_has_welchs_interval() -> None:
    found = difference(around(10, 1, 10), around(20, 3, 20))
    # variances 1/10 and 9/20; freedom 0.55²/(0.1²/9 + 0.45²/19) = 25.7, rounded down, t = 2.0595
    assert found.mean == pytest.approx(10)
    assert found.half_width == pytest.approx(2.0595 * np.sqrt(0.55), rel=1e-3)


@pytest.mark.parametrize(
    ("second", "change"),
    [
        (around(12, 1), Change.RISES),
        (around(8, 1), Change.FALLS),
        (around(10, 0.1), Change.SAME),
        (around(10.2, 0.1), Change.SAME),  # for certain another mean, but by less than 5 %
        (around(10.6, 3), Change.UNDECIDED),
    ],
)
def test_difference_is_judged_by_its_interval_and_a_margin(second: np.ndarray, change: Change) -> None:
    assert difference(around(10, 0.5), second).change is change


def test_a_few_that_ring_do_not_make_all_rise() -> None:
    second = around(9.9, 0.1, 40)
    second[:6] = around(100, 1, 6)
    assert second.mean() > 20
    assert difference(around(10, 0.1), second).change is Change.UNDECIDED


def test_one_member_decides_nothing() -> None:
    assert difference(np.array([1.0]), np.array([2.0])).change is Change.UNDECIDED


def test_growth_falls_nowhere() -> None:
    assert grows([around(1, 0.01), around(2, 0.01), around(3, 0.01)]) is True
    assert grows([around(1, 0.01), around(4, 0.01), around(3, 0.01)]) is False
    assert grows([around(3, 0.01), around(3, 0.01)]) is False
    assert grows([around(1, 5), around(1.5, 5)]) is None


def test_share_has_wilsons_interval() -> None:
    none = share(np.zeros(32, bool), np.ones(32, bool))
    # none of n: upper end z²/(n + z²)
    assert (none.mean, none.low) == (0, 0)
    assert none.high == pytest.approx(1.96**2 / (32 + 1.96**2), rel=1e-3)
    assert share(np.ones(4, bool), np.zeros(4, bool)).high == 1
