"""The crosshead: its fits, rigid and compliant, what tightening a tolerance buys, misalignment, wear."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import slideway

from .ideal import pressed, speed

turns = 10  # of scenes/crosshead.toml
hydraulic_work = 81.0  # of a turn, by the indicator diagram [J]
names = {"joint.clearance_y": "clearance", "friction.kinetic": "friction", "contact.restitution": "restitution", "mechanism.crank_speed": "speed",
         "load.plunger.scale": "pressure"}  # fmt: skip


@dataclass(frozen=True)
class Case:
    """A pump or a crosshead alone, and what it may lose."""

    vary: Mapping[str, Any]  # beside what scenes/crosshead.toml has
    impact_limit: float  # [J] a turn
    friction_limit: float


pump = Case({}, 1e-4 * hydraulic_work, 0.02 * hydraulic_work)
# The study as it was before slideway had loads.
alone = Case({"load.plunger.scale": {"dist": "const", "value": 0}, "mechanism.start_angle": {"dist": "unif", "low": 0, "high": "360 deg"}}, 0.8e-3, 68e-3)


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
middle, loosest = fits[2], fits[3]


@dataclass
class Outcome:
    """Losses of the members that finished, a turn [J], and what they took."""

    case: Case
    impacts: np.ndarray
    friction: np.ndarray
    evaluations: float  # right-hand sides of a member, the mean
    members: int
    failed: int
    peaks: np.ndarray = field(default_factory=lambda: np.empty(0))  # [N]

    @property
    def meet(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Whether a member keeps the limit of impacts, that of friction, both."""
        quiet, cool = self.impacts <= self.case.impact_limit, self.friction <= self.case.friction_limit
        return quiet, cool, quiet & cool

    @property
    def good(self) -> np.ndarray:
        """Members that keep both limits."""
        return self.meet[2]


def scatter(vary: Mapping[str, Any]) -> dict[str, Any]:
    """As settings of a scene."""
    return {f'study.vary."{key}"': value for key, value in vary.items()}


def outcome(root: Path, case: Case, vary: Mapping[str, Any], rigid: bool, members: int) -> Outcome:
    """Of scenes/crosshead.toml with other scatter."""
    quantities = ["damping_loss", "friction_loss"] + ([] if rigid else ["peak_normal_force"])
    keys = scatter(case.vary | vary) | {"study.members": members, "study.verify": 0, "study.quantities": quantities}
    result = slideway.run(root / "scenes/crosshead.toml", progress=False, set=keys | ({"contact.law": "rigid"} if rigid else {}))
    ended = result.where(result.status == 0, drop=True)
    peaks = np.empty(0) if rigid else ended.peak_normal_force.values
    evaluations = float(result.rhs_evaluations.mean())
    return Outcome(case, ended.damping_loss.values / turns, ended.friction_loss.values / turns, evaluations, members, members - ended.sizes["member"], peaks)


def by_fit(root: Path, case: Case, rigid: bool, members: int) -> list[Outcome]:
    """All four fits."""
    return [outcome(root, case, {"joint.clearance_y": fit.clearance()}, rigid, members) for fit in fits]


def halved(root: Path, case: Case, fit: Fit, members: int) -> dict[str, Outcome]:
    """A fit as it is (""), and with each scatter halved around the same mean."""
    varied: dict[str, dict[str, Any]] = {
        "": {},
        "joint.clearance_y": {"joint.clearance_y": fit.clearance(0.5)},
        "friction.kinetic": {"friction.kinetic": {"dist": "truncnorm", "mean": 0.08, "sd": 0.005, "low": 0.065, "high": 0.095}},
        "contact.restitution": {"contact.restitution": {"dist": "unif", "low": 0.475, "high": 0.625}},
        "mechanism.crank_speed": {"mechanism.crank_speed": {"dist": "norm", "mean": "600 rpm", "sd": "3 rpm"}},
        "load.plunger.scale": {"load.plunger.scale": {"dist": "norm", "mean": 4.909e-4, "sd": 5e-6}},
    }
    return {key: outcome(root, case, {"joint.clearance_y": fit.clearance()} | vary, True, members)
            for key, vary in varied.items() if key not in case.vary}  # fmt: skip


def shares(root: Path, case: Case, fit: Fit, base: int) -> dict[str, dict[str, float]]:
    """Total Sobol indices of both losses by key, with rigid contacts."""
    quantities = ["damping_loss", "friction_loss"]
    result = slideway.run(root / "scenes/crosshead.toml", progress=False, set=scatter(case.vary | {"joint.clearance_y": fit.clearance()}) | {
        "contact.law": "rigid", "study.design": "saltelli", "study.base": base, "study.verify": 0, "study.quantities": quantities})
    found = result.slideway.sensitivity
    return {quantity: dict(zip(map(str, found.input.values), map(float, found[f"{quantity}_total"].values), strict=True)) for quantity in quantities}


@dataclass
class Spatial:
    """Members in space, on a way that is out of line or worn."""

    value: float  # standard deviation of yaw and pitch of the way [mrad], or depth of the wear [um]
    peaks: np.ndarray  # [N]
    impacts: np.ndarray  # [J] a turn
    friction: np.ndarray
    leaning: np.ndarray  # largest pitch of the slider against its way while the pressure holds it down, in the second turn [rad]
    members: int

    @property
    def wedged(self) -> int:
        """Members without room in their way: they lose many times what the others do, or end with a status."""
        return int(np.sum(self.impacts > 5 * np.median(self.impacts))) + self.members - self.impacts.size


def spatial(root: Path, value: float, vary: Mapping[str, Any], members: int) -> Spatial:
    """Of scenes/crosshead_space.toml, two turns; members without room start inside the way, and are counted."""
    result = slideway.run(root / "scenes/crosshead_space.toml", progress=False, max_failures="20%", any_start=True, set=scatter(vary) | {
        "study.members": members, "study.verify": 0, "study.samples": 801,
        "study.quantities": ["peak_normal_force", "friction_loss", "damping_loss", "pitch"]})  # fmt: skip
    ended = result.where(result.status == 0, drop=True)
    angle = np.degrees(ended.mechanism_start_angle.values[:, None] + speed * ended.time.values)
    held = (angle % 360 > pressed[0]) & (angle % 360 < pressed[1]) & (angle > 360 + pressed[0])
    leaning = np.max(np.where(held, np.abs(ended.pitch.values), 0), axis=1)
    return Spatial(value, ended.peak_normal_force.values, ended.damping_loss.values / 2, ended.friction_loss.values / 2, leaning, members)


def misaligned(root: Path, angle: float, members: int) -> Spatial:
    """Yaw and pitch of the way scatter by so many mrad."""
    turned = {"dist": "norm", "mean": 0, "sd": f"{angle} mrad"}
    return spatial(root, angle, {"way.yaw": turned, "way.pitch": turned}, members)


def worn(root: Path, depth: float, members: int) -> Spatial:
    """The way's lower face is worn by so many um."""
    return spatial(root, depth, {"way_profile.wear.scale": {"dist": "const", "value": depth}}, members)


def verdicts(root: Path, scene: str, settings: Mapping[str, Any], quantities: list[str], members: int, again: int) -> dict[str, str]:
    """What a run says of its own numbers after so many members ran again with other tolerances, half of them by another method."""
    said = slideway.resolution(slideway.run(root / "scenes" / scene, progress=False, set=dict(settings) | {
        "study.members": members, "study.verify": again, "study.quantities": quantities}))  # fmt: skip
    assert said is not None
    numbers = dict(zip(map(str, said.numbers.checked.values), map(str, said.numbers.verdict.values[0]), strict=True))
    return {quantity: next(verdict for name, verdict in numbers.items() if name.startswith(quantity)) for quantity in quantities}
