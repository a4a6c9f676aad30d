"""The runs of the worked study: fits of a crosshead, rigid and compliant, what tightening a tolerance buys, and misalignment."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import slideway

turns = 10  # of scenes/crosshead.toml
impact_limit, friction_limit = 0.8e-3, 68e-3  # [J] a turn
names = {"joint.clearance_y": "clearance", "friction.kinetic": "friction", "contact.restitution": "restitution", "mechanism.crank_speed": "speed"}


@dataclass
class Fit:
    """A fit of ISO 286-1 at 18 to 30 mm, and what it costs to make, relative to the loosest (an assumption)."""

    name: str
    least: float  # clearance between hole and way [um]
    most: float
    cost: float

    def clearance(self, scatter: float = 1) -> dict[str, Any]:
        """Of one side: normal with the limits at three standard deviations, cut there."""
        mean, half = (self.least + self.most) / 4, scatter * (self.most - self.least) / 4
        return {"dist": "truncnorm", "mean": f"{mean} um", "sd": f"{half / 3} um", "low": f"{mean - half} um", "high": f"{mean + half} um"}


fits = [Fit("H7/g6", 7, 41, 1.6), Fit("H8/f7", 20, 74, 1.25), Fit("H8/e8", 40, 106, 1.1), Fit("H9/d9", 65, 169, 1.0)]
middle = fits[2]


@dataclass
class Outcome:
    """Losses of the members that finished, a turn [J], and what it took."""

    impacts: np.ndarray
    friction: np.ndarray
    seconds: float
    members: int
    failed: int
    peaks: np.ndarray = field(default_factory=lambda: np.empty(0))  # [N]

    @property
    def good(self) -> np.ndarray:
        """Members that keep both limits."""
        return (self.impacts <= impact_limit) & (self.friction <= friction_limit)


def interval(count: int, of: int) -> tuple[float, float]:
    """Wilson's 95 % interval of a share.

    >>> [round(x, 3) for x in interval(90, 100)]
    [0.826, 0.945]
    """
    z = 1.959964
    share, spread = count / of, z * z / of
    centre, half = share + spread / 2, z * math.sqrt(share * (1 - share) / of + spread / (4 * of))
    return (centre - half) / (1 + spread), (centre + half) / (1 + spread)


def outcome(root: Path, vary: Mapping[str, Any], rigid: bool, members: int) -> Outcome:
    """Of scenes/crosshead.toml with other scatter."""
    keys: dict[str, Any] = {f'study.vary."{key}"': value for key, value in vary.items()} | {"study.members": members, "study.verify": 0}
    quantities = ["damping_loss", "friction_loss"]
    if rigid:
        keys["contact.law"] = "rigid"
    else:
        quantities.append("peak_normal_force")
    began = time.monotonic()
    result = slideway.run(root / "scenes/crosshead.toml", progress=False, set=keys | {"study.quantities": quantities})
    seconds = time.monotonic() - began
    ended = result.where(result.status == 0, drop=True)
    peaks = np.empty(0) if rigid else ended.peak_normal_force.values
    return Outcome(ended.damping_loss.values / turns, ended.friction_loss.values / turns, seconds, members, members - ended.sizes["member"], peaks)


def by_fit(root: Path, rigid: bool, members: int) -> list[Outcome]:
    """All four fits."""
    return [outcome(root, {"joint.clearance_y": fit.clearance()}, rigid, members) for fit in fits]


def halved(root: Path, members: int) -> dict[str, Outcome]:
    """The middle fit as it is (""), and with each scatter halved around the same mean."""
    scatter: dict[str, dict[str, Any]] = {
        "": {},
        "joint.clearance_y": {"joint.clearance_y": middle.clearance(0.5)},
        "friction.kinetic": {"friction.kinetic": {"dist": "truncnorm", "mean": 0.08, "sd": 0.005, "low": 0.065, "high": 0.095}},
        "contact.restitution": {"contact.restitution": {"dist": "unif", "low": 0.475, "high": 0.625}},
        "mechanism.crank_speed": {"mechanism.crank_speed": {"dist": "norm", "mean": "600 rpm", "sd": "3 rpm"}},
    }
    return {key: outcome(root, {"joint.clearance_y": middle.clearance()} | vary, True, members) for key, vary in scatter.items()}


def shares(root: Path, base: int) -> dict[str, dict[str, float]]:
    """Total Sobol indices of both losses by key, of the middle fit with rigid contacts."""
    result = slideway.run(root / "scenes/crosshead.toml", progress=False, set={
        "contact.law": "rigid", "study.design": "saltelli", "study.base": base, "study.verify": 0, "study.quantities": ["damping_loss", "friction_loss"]})
    found = result.slideway.sensitivity
    return {quantity: dict(zip(map(str, found.input.values), map(float, found[f"{quantity}_total"].values), strict=True))
            for quantity in ("damping_loss", "friction_loss")}


@dataclass
class Misaligned:
    """Members in space with so much misalignment."""

    angle: float  # standard deviation of yaw and pitch of the way [mrad]
    peaks: np.ndarray  # [N]
    impacts: np.ndarray  # [J] a turn
    friction: np.ndarray
    members: int

    @property
    def wedged(self) -> int:
        """Members without room in their way: they lose many times what the others do, or end with a status."""
        return int(np.sum(self.impacts > 5 * np.median(self.impacts))) + self.members - self.impacts.size


def misaligned(root: Path, angle: float, members: int) -> Misaligned:
    """Of scenes/crosshead_space.toml, two turns; members without room start inside the way, and are counted."""
    scatter = {"dist": "norm", "mean": 0, "sd": f"{angle} mrad"}
    result = slideway.run(root / "scenes/crosshead_space.toml", progress=False, max_failures="20%", any_start=True, set={
        'study.vary."way.yaw"': scatter, 'study.vary."way.pitch"': scatter, "study.members": members, "study.verify": 0})
    ended = result.where(result.status == 0, drop=True)
    return Misaligned(angle, ended.peak_normal_force.values, ended.damping_loss.values / 2, ended.friction_loss.values / 2, members)
