"""A press with its flywheel and a carriage on a measured profile: members of the scenes of examples/jobs, and what can be known without them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import slideway
from scipy.interpolate import CubicSpline, PchipInterpolator

g = 9.81

# Of examples/jobs/press.toml.
crank, rod, masses, torque, no_load, bearings, force, friction = 0.03, 0.15, 2.8, 20.0, 16.0, 0.02, 3000.0, 0.08
# Of examples/jobs/carriage.toml.
length, height, rubbing = 0.04, 0.02, 0.1


@dataclass
class Press:
    """Members with one flywheel, in their last strokes."""

    inertia: float  # of motor and flywheel [kg m2]
    before: np.ndarray  # crank speed, its largest in a stroke [rad/s]
    after: np.ndarray  # its smallest
    peak: np.ndarray  # the motor's torque [N m]
    heat: np.ndarray  # root of its mean square
    rate: np.ndarray  # strokes a second

    @property
    def drop(self) -> np.ndarray:
        """Share of the speed that a stroke takes."""
        return 1 - self.after / self.before


def press(root: Path, inertia: float, members: int) -> Press:
    """Ten seconds, of which the last five whole strokes count."""
    result = slideway.run(root / "examples/jobs/press.toml", progress=False, set={
        'study.vary."drive.inertia"': {"dist": "const", "value": inertia}, "study.members": members, "study.verify": 0, "study.duration": "10 s",
        "study.samples": 5001, "study.quantities": ["energy_residual", "crank_angle", "crank_angular_velocity"]})  # fmt: skip
    found = []
    for angle, speed in zip(result.crank_angle.values, result.crank_angular_velocity.values, strict=True):
        turn = np.floor(angle / (2 * np.pi))
        last = (turn >= turn[-1] - 5) & (turn < turn[-1])
        gives = torque * (1 - speed[last] / no_load)
        found.append((np.max(speed[last]), np.min(speed[last]), np.max(gives), np.sqrt(np.mean(gives**2)), 5 / (0.002 * np.sum(last))))
    return Press(inertia, *np.array(found).T)


def ideal_press(root: Path, inertia: np.ndarray, steps: int = 3600, turns: int = 40) -> np.ndarray:
    """The drop of a press without clearance, by its energy over the crank's angle; the slider's weight and the workpiece rub."""
    rows = np.loadtxt(root / "examples/jobs/press.csv", delimiter=",", skiprows=1)
    angle = 2 * np.pi * (np.arange(steps) + 0.5) / steps
    lean = crank * np.sin(angle) / rod
    gain = -crank * np.sin(angle) - crank * np.cos(angle) * lean / np.sqrt(1 - lean**2)  # dx/d(angle)
    resists = force * PchipInterpolator(*rows.T)(np.degrees(angle)) * np.abs(gain)
    rubs = friction * np.abs(masses * g * gain - resists * np.abs(lean) / np.sqrt(1 - lean**2) * np.sign(gain))
    energy = 0.5 * inertia * 13.0**2
    for turn in range(turns):
        speeds = []
        for slope, load in zip(gain, resists + rubs, strict=True):
            speed = np.sqrt(2 * energy / (inertia + masses * slope**2))
            energy = energy + (torque * (1 - speed / no_load) - bearings * speed - load) * 2 * np.pi / steps
            if turn == turns - 1:
                speeds.append(speed)
    return 1 - np.min(speeds, axis=0) / np.max(speeds, axis=0)


@dataclass
class Carriage:
    """Carriages with tools whose centre of mass is at these heights above their way's axis, between whose measured speeds one kind of curve runs."""

    interpolation: str
    heights: np.ndarray  # [m]
    leaning: np.ndarray  # largest pitch [rad]

    @property
    def lifts(self) -> float:
        """The first height at which an end of the carriage leaves its way [m]."""
        return float(self.heights[np.argmax(self.leaning > 1e-4)])


def carriage(root: Path, interpolation: str, heights: np.ndarray) -> Carriage:
    """There and back, from rest on the way."""
    result = slideway.run(root / "examples/jobs/carriage.toml", progress=False, set={
        "drive.interpolation": interpolation, "study.design": "grid", "study.members": len(heights), "study.verify": 0, "initial.y": "-30 um",
        "study.vary": {"slider.mass_center_y": {"dist": "values", "values": list(heights)}}, "study.quantities": ["peak_tilt"]})  # fmt: skip
    return Carriage(interpolation, heights, result.peak_tilt.sel(axis="pitch").values)


def acceleration(root: Path, interpolation: str) -> tuple[float, float]:
    """Of the profile: the largest while it speeds up, and while it brakes [m/s2]."""
    time, speed = np.loadtxt(root / "examples/jobs/carriage.csv", delimiter=",", skiprows=1).T * [[1], [1e-3]]
    at = np.linspace(time[0], time[-1], 24_000, endpoint=False) + 5e-5
    # Three periods, for the slopes at the ends of the middle one.
    time, speed = np.concatenate([time[:-1] + shift for shift in (-time[-1], 0, time[-1])]), np.tile(speed[:-1], 3)
    if interpolation == "linear":
        value, rate = np.interp(at, time, speed), (np.diff(speed) / np.diff(time))[np.searchsorted(time, at) - 1]
    else:
        curve = PchipInterpolator(time, speed) if interpolation == "monotone" else CubicSpline(time, speed)
        value, rate = curve(at), curve(at, 1)
    return float(np.max(rate * np.sign(value))), float(np.max(-rate * np.sign(value)))


def lifting(root: Path, interpolation: str) -> float:
    """The height at which the weight no longer holds the carriage down, by moments about its end: friction of the face helps while it brakes [m]."""
    faster, slower = acceleration(root, interpolation)
    return g / 2 * min((length - rubbing * height) / faster, (length + rubbing * height) / slower)
