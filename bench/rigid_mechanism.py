"""The mechanism of scenes/planar_rigid.toml for bench/rigid_peers.py, and springs and dampers that return a given share of a speed."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

crank, rod, half_length, half_height, clearance, restitution = 0.153, 0.306, 0.05, 0.025, 1e-3, 0.4
wall = half_height + clearance
corner_radius = 1e-4  # of the spheres at the block's corners, which raises a corner of a block tilted by ψ by half of it times ψ², at most 2e-5 clearances
start_speeds = 150.0, -225.0, 75.0  # of the joints' relative angles [rad/s]
pressed_mass = 0.095  # of the block at its walls, which changes from 0.091 to 0.098 kg over a turn
samples, end = 50, 0.05


class Link(NamedTuple):
    """A body on a hinge at `at` of the body before it, whose centre is `centre` from that hinge."""

    name: str
    at: float
    mass: float
    inertia: float
    centre: float


links = Link("crank", 0, 0.038, 7.4e-5, crank / 2), Link("rod", crank, 0.038, 5.9e-4, rod / 2), Link("block", rod, 0.076, 2.7e-6, 0)
corners = tuple((x * half_length, y * (half_height - corner_radius)) for x in (-1, 1) for y in (-1, 1))


def height(first: float, second: float) -> float:
    """Of the block, from the relative angles of crank and rod."""
    return crank * math.sin(first) + rod * math.sin(first + second)


def where_it_falls_to(wanted: float, falling: Callable[[float], float], low: float, high: float) -> float:
    """The argument at which a falling function has a value, by halving.

    >>> round(where_it_falls_to(0.25, lambda x: 1 - x, 0, 1), 9)
    0.75
    """
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if falling(middle) > wanted else (low, middle)
    return (low + high) / 2


def damping_ratio(e: float) -> float:
    """Of a spring and damper that only push, so that they let go before the spring is relaxed.

    >>> round(damping_ratio(1.0), 6)
    0.0
    """

    def rebound(ratio: float) -> float:
        root = math.sqrt(1 - ratio**2)
        return math.exp(-ratio / root * (math.pi - math.atan2(2 * ratio * root, 1 - 2 * ratio**2)))

    return where_it_falls_to(e, rebound, 0.0, 0.999)


def hunt_crossley_dissipation(e: float, speed: float) -> float:
    """Of a force k x (1 + d x') that returns e of this speed; it returns more of lower ones.

    >>> d = hunt_crossley_dissipation(0.4, 0.5)
    >>> before, after = d * 0.5, d * 0.2  # the work of both halves is equal: d v - ln(1 + d v) before, and with -v after
    >>> abs(before - math.log(1 + before) + after + math.log(1 - after)) < 1e-9
    True
    """

    def excess(d: float) -> float:
        return d * speed * (1 + e) - math.log1p(d * speed) + math.log1p(-d * e * speed)

    return where_it_falls_to(0, excess, 1e-6 / speed, (1 - 1e-12) / (e * speed))
