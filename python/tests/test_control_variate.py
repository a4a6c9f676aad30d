"""Control variates: intervals that contain the mean as often as they say, gains in closed form, members that are matched."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import slideway
import xarray as xr

Draw = Callable[[np.random.Generator, int], tuple[np.ndarray, np.ndarray]]


def normal_pair(correlation: float) -> Draw:
    """Of zero mean."""

    def draw(random: np.random.Generator, count: int) -> tuple[np.ndarray, np.ndarray]:
        x = random.standard_normal(count)
        return correlation * x + math.sqrt(1 - correlation**2) * random.standard_normal(count), x

    return draw


def skewed_pair(random: np.random.Generator, count: int) -> tuple[np.ndarray, np.ndarray]:
    """A cubic in a gamma variable, with a scatter that grows with it; of zero mean."""
    x = random.gamma(4, 1, count)
    return x + 0.02 * x**3 - 4 - 0.02 * 120 + 0.1 * x * random.standard_normal(count), x


def shares(random: np.random.Generator, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Whether two correlated values are below the same limit; the first less the probability."""
    y, x = normal_pair(0.98)(random, count)
    return (y < 1) - 0.8413447460685429, (x < 1.02).astype(float)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("draw", "powers", "costly", "cheap", "low", "high"),
    [
        (normal_pair(0.95), 1, 10, 200, 0.938, 0.975),  # Student's t is that of the pairs, which is wide for the part known of all
        (normal_pair(0.99), 1, 20, 40, 0.938, 0.97),
        (normal_pair(0.0), 1, 20, 400, 0.938, 0.962),
        (normal_pair(-0.8), 1, 50, 1000, 0.938, 0.962),
        (skewed_pair, 3, 50, 500, 0.93, 0.962),
        (skewed_pair, 1, 200, 2000, 0.9, 0.962),
        (shares, 1, 50, 2000, 0.93, 0.962),
    ],
)
def test_interval_contains_the_mean_as_often_as_it_says(draw: Draw, powers: int, costly: int, cheap: int, low: float, high: float) -> None:
    random = np.random.default_rng(7)
    rounds = 2000  # chance scatters the share by 0.5 %
    hits = 0
    for _ in range(rounds):
        y, x = draw(random, cheap)
        found = slideway.control_variate(y[:costly], [x**power for power in range(1, powers + 1)])
        hits += found.low < 0 < found.high
    assert low < hits / rounds < high


def test_gain_is_that_of_the_best_division_of_two_levels() -> None:
    random = np.random.default_rng(3)
    correlation, ratio, costly = 0.98, 1 / 50, 4000
    best = correlation / math.sqrt((1 - correlation**2) * ratio)
    y, x = normal_pair(correlation)(random, round(costly * best))
    found = slideway.control_variate(y[:costly], x, cost_ratio=ratio)
    assert found.correlation == pytest.approx(correlation, abs=2e-3)
    assert found.cheap_per_costly == pytest.approx(best, rel=0.05)
    assert found.gain == pytest.approx(1 / (math.sqrt(1 - correlation**2) + correlation * math.sqrt(ratio)) ** 2, rel=0.05)


def test_several_controls_explain_what_each_alone_does_not() -> None:
    random = np.random.default_rng(4)
    a, b = random.standard_normal((2, 20000))
    y = 3 + a - 2 * b + 0.01 * random.standard_normal(20000)
    both = slideway.control_variate(y[:40], [a, b])
    assert both.mean == pytest.approx(3 + a.mean() - 2 * b.mean(), abs=0.01)
    assert both.correlation > 0.9999 > slideway.control_variate(y[:40], a).correlation
    assert both.high - both.low < 0.3 * (slideway.control_variate(y[:40], b).high - slideway.control_variate(y[:40], b).low)


def test_members_are_matched_by_their_numbers() -> None:
    random = np.random.default_rng(5)
    y, x = normal_pair(0.9)(random, 300)
    plain = slideway.control_variate(y[:30], x)
    order = random.permutation(300)
    shuffled = xr.DataArray(x[order], coords={"member": order}, dims="member")
    few = xr.DataArray(y[:30], coords={"member": np.arange(30)}, dims="member")
    assert slideway.control_variate(few, shuffled).mean == pytest.approx(plain.mean, rel=1e-12)
    # A member that failed with one of the two is no pair; one without a cheap value counts nowhere.
    cut = slideway.control_variate(few.drop_sel(member=4), shuffled.where(shuffled.member != 7, np.nan))
    without = np.delete(np.arange(300), 7)
    rows = np.delete(np.arange(30), [4, 7])
    again = xr.DataArray(x[without], coords={"member": without}, dims="member")
    expected = slideway.control_variate(xr.DataArray(y[rows], coords={"member": rows}, dims="member"), again)
    assert (cut.pairs, cut.cheap, cut.mean) == (28, 299, pytest.approx(expected.mean, rel=1e-12))


def test_cheap_members_that_are_the_costly_ones_change_nothing() -> None:
    y, x = normal_pair(0.9)(np.random.default_rng(6), 25)
    found = slideway.control_variate(y, x)
    assert found.mean == pytest.approx(y.mean(), rel=1e-12)
    line = np.polyval(np.polyfit(x, y, 1), x)
    variance = np.sum((y - line) ** 2) / 23 + np.var(line, ddof=1)
    assert (found.high - found.low) / 2 == pytest.approx(2.0687 * math.sqrt(variance / 25), rel=1e-3)  # Student's t of 23


def test_rigid_members_sharpen_the_mean_of_compliant_ones() -> None:
    scene = Path(__file__).resolve().parents[2] / "scenes/crosshead.toml"
    run = {"threads": 1, "study__duration": "0.1 s", "set": {"study.quantities": ["friction_loss"]}}
    whole = slideway.Ensemble(scene, study__members=256, **run).run().friction_loss
    rigid = slideway.Ensemble(scene, study__members=256, contact__law="rigid", **run).run().friction_loss
    found = slideway.control_variate(whole.isel(member=slice(0, 24)), rigid, cost_ratio=1 / 6)
    assert found.low < float(whole.mean()) < found.high
    assert found.correlation > 0.99
    alone = whole.values[:24]
    assert found.high - found.low < 0.5 * 2 * 2.0687 * alone.std(ddof=1) / math.sqrt(24)


@pytest.mark.parametrize(
    ("costly", "cheap", "named", "said"),
    [
        ([1.0, 2.0, 3.0], [1.0, 2.0, 3.0, 4.0], {}, "3 members"),
        (np.ones((4, 2)), np.ones(9), {}, "2 dimensions"),
        (np.ones(9), np.ones(9), {"cost_ratio": -1.0}, "cost_ratio"),
        (np.ones(9), np.ones(9), {"cost_ratio": float("nan")}, "cost_ratio"),
        (np.ones(9), [], {}, "cheap"),
    ],
)
def test_unusable_arguments_are_refused_in_a_line(costly: object, cheap: object, named: dict[str, float], said: str) -> None:
    with pytest.raises(slideway.SlidewayError, match=said):
        slideway.control_variate(costly, cheap, **named)  # type: ignore[arg-type]
