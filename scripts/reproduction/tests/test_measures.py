"""Measures of the figures, against algebra."""

import numpy as np
import pytest
from reproduction.maps import CRANK, ROD, SPEED, along, correlation_dimension


def test_x_and_vx_are_those_of_a_rigid_rod() -> None:
    y, z, vy, vz = 3e-4, -2e-4, 0.02, -0.03

    def place(t: float) -> float:
        """x of the slider's end of the rod, whose other end is the pin; the slider moves straight on."""
        pin_x, pin_y = CRANK * np.cos(SPEED * t), CRANK * np.sin(SPEED * t)
        return pin_x + np.sqrt(ROD**2 - (y + vy * t - pin_y) ** 2 - (z + vz * t) ** 2)

    x, vx = along(np.array([y]), np.array([z]), np.array([vy]), np.array([vz]))
    step = 1e-5
    assert x[0] == pytest.approx(place(0.0) - CRANK - ROD, rel=1e-8)
    assert vx[0] == pytest.approx((place(step) - place(-step)) / (2 * step), rel=1e-6)


def test_dimension_of_a_filled_plane_a_curve_and_a_point() -> None:
    random = np.random.default_rng(1)
    assert correlation_dimension(random.random((800, 2))) == pytest.approx(2, abs=0.2)
    angle = 2 * np.pi * random.random(800)
    assert correlation_dimension(np.stack([np.cos(angle), np.sin(angle)], axis=1)) == pytest.approx(1, abs=0.1)
    assert np.isnan(correlation_dimension(np.zeros((50, 2))))
