"""The crosshead without clearance, in closed form and by quadrature: its side force, what friction takes in a turn, and where its way wears."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.interpolate import PchipInterpolator

# Of scenes/crosshead.toml.
crank, rod, length, speed = 0.03, 0.12, 0.04, 20 * math.pi  # [m], [m], [m], [rad/s]
rod_mass, rod_inertia, slider_mass, weight = 0.25, 4e-4, 0.35, 9.81
area = 4.909e-4  # of the plunger [m2]
pressed = (210, 345)  # crank angles between which the full pressure holds the slider against one face [deg]


@dataclass
class Turn:
    """A turn in equal steps of the crank's angle."""

    angle: np.ndarray  # [rad]
    x: np.ndarray  # of the slider [m]
    velocity: np.ndarray
    push: np.ndarray  # of the plunger, along X [N]
    side: np.ndarray  # of the way on the slider, upwards [N]


def turn(root: Path, friction: float, scale: float = area, steps: int = 3600) -> Turn:
    """Rod and slider have mass; the rod's moments about the crank's pin and the slider's forces give the side force, in which its friction is."""
    rows = np.loadtxt(root / "examples/jobs/indicator.csv", delimiter=",", skiprows=1)
    angle = 2 * np.pi * (np.arange(steps) + 0.5) / steps
    push = -scale * 1e5 * PchipInterpolator(*rows.T)(np.degrees(angle))
    sine, cosine = np.sin(angle), np.cos(angle)
    down = crank * sine / rod  # sine of the rod's angle below the way
    along = np.sqrt(1 - down**2)
    rate = crank * cosine * speed / (rod * along)
    gain = (rod * down * rate**2 - crank * sine * speed**2) / (rod * along)
    velocity = -crank * sine * speed - rod * down * rate
    acceleration = -crank * cosine * speed**2 - rod * (along * rate**2 + down * gain)
    middle_x = -crank * cosine * speed**2 - rod / 2 * (along * rate**2 + down * gain)
    middle_y = -crank * sine * speed**2 + rod / 2 * (down * rate**2 - along * gain)
    moment = rod * (along * slider_mass * weight + down * (slider_mass * acceleration - push))
    moment += rod_mass * rod / 2 * (along * (middle_y + weight) + down * middle_x) - rod_inertia * gain
    grip = friction * np.sign(velocity) * np.sign(moment)
    return Turn(angle, crank * cosine + rod * along, velocity, push, moment / (rod * (along - down * grip)))


def friction_loss(root: Path, friction: float, scale: float = area) -> float:
    """A turn, of a slider that always touches [J]."""
    one = turn(root, friction, scale)
    return float(friction * np.mean(np.abs(one.side * one.velocity)) * 2 * np.pi / speed)


def wear(root: Path, places: np.ndarray, friction: float = 0.08) -> np.ndarray:
    """Depth of the way's lower face by Archard's law: pressure times sliding distance, the pressure even over the slider's length; largest 1."""
    one = turn(root, friction)
    pressed = np.maximum(-one.side, 0) * np.abs(one.velocity)
    depth = np.array([np.sum(pressed[np.abs(one.x - place) <= length / 2]) for place in places])
    return depth / depth.max()


def chord(root: Path, depth: float) -> float:
    """Largest slope of a slider that lies on the worn face with both its ends, while it is pressed; the wear is so many um deep."""
    rows = np.loadtxt(root / "scenes/crosshead_wear.csv", delimiter=",", skiprows=1)
    one = turn(root, 0.08)
    angle = np.degrees(one.angle)
    x = one.x[(angle > pressed[0]) & (angle < pressed[1])]
    face = PchipInterpolator(*rows.T)
    return float(np.max(np.abs(face(1e3 * (x + length / 2)) - face(1e3 * (x - length / 2))))) * 1e-6 * depth / length
