"""Numbers beneath the plots: spectra, integrals, ideal motions, Student's t."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import slideway
import xarray as xr
from slideway.ideal import ideal
from slideway.intervals import student_t
from slideway.signals import amplitude_spectrum, even_step, running_integral

crank = {"mechanism": {"kind": "slider_crank", "crank_length": 0.05, "rod_length": 0.1422, "crank_speed": 7.0, "start_angle": 0.3}}
yoke = {"mechanism": {"kind": "scotch_yoke", "crank_length": 0.05, "crank_speed": 7.0, "start_angle": 0.3}}
carriage = {"mechanism": {"kind": "carriage", "carriage_speed": 0.06, "stroke": 0.15, "reversal_time": 0.02}}


@pytest.mark.parametrize("count", [1000, 1001])
def test_spectrum_shows_amplitudes_of_sines(count: int) -> None:
    step = 1e-3
    time = step * np.arange(count)
    first, second = 40 / (count * step), 120 / (count * step)
    values = 5 + 3 * np.sin(2 * np.pi * first * time + 1) + 0.2 * np.cos(2 * np.pi * second * time)
    frequency, amplitude = amplitude_spectrum(values, step)
    np.testing.assert_allclose(frequency[[40, 120]], [first, second])
    np.testing.assert_allclose(amplitude[[0, 40, 120]], [0, 3, 0.2], atol=1e-12)


def test_spectrum_shows_an_alternation_once() -> None:
    values = np.where(np.arange(64) % 2 == 0, 2.0, -2.0)
    frequency, amplitude = amplitude_spectrum(values, 0.5)
    assert (frequency[-1], amplitude[-1]) == (1.0, pytest.approx(2.0))


def test_spectrum_of_a_few_samples_is_refused() -> None:
    with pytest.raises(slideway.SlidewayError, match="7 samples make no spectrum"):
        amplitude_spectrum(np.zeros(7), 1.0)


def test_uneven_samples_are_refused() -> None:
    with pytest.raises(slideway.SlidewayError, match="not evenly spaced"):
        even_step(np.array([0.0, 1.0, 3.0]))


def test_running_integral_of_a_parabola_has_its_closed_form() -> None:
    time = np.linspace(0, 2, 2001)
    np.testing.assert_allclose(running_integral(time**2, time), time**3 / 3, atol=1e-6)


@pytest.mark.parametrize("scene", [crank, carriage, yoke])
def test_ideal_velocity_and_acceleration_are_derivatives(scene: dict[str, dict[str, object]]) -> None:
    time = np.linspace(0, 9, 90001)
    x, vx, ax = (ideal(scene, name, time) for name in ("x", "vx", "ax"))
    assert x is not None and vx is not None and ax is not None
    # Where the carriage's acceleration jumps, a difference quotient means nothing.
    smooth = np.ones(time.size, bool) if scene is not carriage else np.abs(np.gradient(ax, time)) < 2000
    assert smooth.mean() > 0.9
    np.testing.assert_allclose(np.gradient(x, time)[1:-1], vx[1:-1], atol=1e-5)
    np.testing.assert_allclose(np.gradient(vx, time)[smooth][5:-5], ax[smooth][5:-5], atol=2e-3 if scene is not carriage else 0.5)


def test_ideal_slider_crank_keeps_the_rods_length() -> None:
    time = np.linspace(0, 1, 7)
    angle = 0.3 + 7.0 * time
    x = ideal(crank, "x", time)
    assert x is not None
    np.testing.assert_allclose(np.hypot(x - 0.05 * np.cos(angle), 0.05 * np.sin(angle)), 0.1422)


def test_ideal_carriage_is_back_after_a_period() -> None:
    stroke_time = 0.15 / 0.06
    x = ideal(carriage, "x", np.array([0.0, stroke_time, stroke_time + 0.02, 2 * stroke_time + 0.02, 2 * stroke_time + 0.04]))
    assert x is not None
    np.testing.assert_allclose(x, [0, 0.15, 0.15, 0, 0], atol=1e-15)


def test_nothing_is_ideal_without_a_drive() -> None:
    time = np.zeros(3)
    assert ideal({"mechanism": {"kind": "free_slider"}}, "x", time) is None
    assert ideal({"mechanism": {"kind": "a mechanism of a later version"}}, "x", time) is None
    assert ideal({"mechanism": {**crank["mechanism"], "kind": "planar_slider_crank", "crank": "free"}}, "x", time) is None
    for kind in ("profile", "torque", "free"):
        assert ideal({**crank, "drive": {"kind": kind}}, "x", time) is None
    assert ideal(crank, "normal_force", time) is None
    np.testing.assert_array_equal(ideal(crank, "y", time), 0)


def test_program_keeps_to_the_ideal_within_the_clearance(result_of: Callable[[str], xr.Dataset]) -> None:
    result = result_of("single")
    x = ideal(slideway.scene(result), "x", result.time.values)
    assert x is not None
    # κ, the rod's slope, turns a play of 0.1 mm across the way into at most r/√(L² − r²) of it along the way.
    assert float(np.abs(result.x.values[0] - x).max()) < 1.1e-4 * 0.05 / np.sqrt(0.1422**2 - 0.05**2)


@pytest.mark.parametrize(("freedom", "expected"), [(1, 12.7062), (2, 4.30265), (3, 3.18245), (5, 2.57058), (10, 2.22814), (100, 1.98397)])
def test_student_t_is_that_of_the_tables(freedom: int, expected: float) -> None:
    assert student_t(freedom) == pytest.approx(expected, rel=8e-3)
