"""The energy audit in plain words (model.md section 8): how much energy the contact law and the method made, and what that means."""

from __future__ import annotations

import math
from dataclasses import dataclass

import xarray as xr

import slideway
from slideway.columns import Column, column, columns
from slideway.ideal import drive_kind
from slideway.way import mean_clearance, play

from .findings import by_column, sweep_of
from .numbers import amount, counted, percent

CLEAN = 1e-3  # of the work: a residual that no conclusion of a study depends on
SMALL = 1e-2  # one that a few members may have


def joules(energy: float) -> str:
    """An energy in words."""
    return amount(energy, "J", 3)


@dataclass(frozen=True)
class Verdict:
    """What the audit says."""

    grade: str  # good, warn, bad, none
    headline: str
    sentences: list[str]


@dataclass(frozen=True)
class Balance:
    """Means over the members that finished, in joules; NaN where the file lacks the quantity."""

    residual: float
    largest: float  # magnitude of any member's residual
    work: float  # of the drive
    loads: float  # their work; 0 where the scene has none, as what follows of what it has not
    ground: float  # work of its motion
    friction: float
    damping: float  # of contacts
    dampers: float  # what those of springs and stops take
    film: float  # what the oil takes
    change: float  # of the mechanical energy, E(t) - E(0)
    duration: float  # of a member [s]
    reference: float = math.nan  # an energy of the mechanism itself, which none of the above has to reach
    reference_name: str = ""

    @property
    def gained(self) -> float:
        """What all works and the residual have put in."""
        return self.work + self.loads + self.ground + self.residual

    @property
    def lost(self) -> float:
        """What friction and everything that damps took."""
        return self.friction + self.damping + self.dampers + self.film

    @property
    def scale_named(self) -> tuple[float, str]:
        """What the residual is compared with, and its name: the largest energy that is known; NaN where none is.

        The work and the losses of a mechanism without friction are residuals themselves, so they alone are no measure.
        """
        sizes = (
            (abs(self.work), "the drive's work"),
            (abs(self.loads), "the loads' work"),
            (abs(self.ground), "the work of the ground's motion"),
            (self.lost, "what friction and damping took"),
            (self.damping, "what damping took"),
            (abs(self.change), "the change of the mechanical energy"),
            (self.reference, self.reference_name),
        )
        known = [named for named in sizes if named[0] > 0]
        return max(known, key=lambda named: named[0]) if known else (math.nan, "")

    @property
    def complete(self) -> bool:
        """Whether a term is there that would be large if the mechanism turned over much more than its reference energy."""
        return any(abs(work) > 0 for work in (self.work, self.loads, self.ground)) or any(map(math.isfinite, (self.lost, self.change)))

    @property
    def scale(self) -> float:
        """See :attr:`scale_named` [J]."""
        return self.scale_named[0]

    @property
    def scale_name(self) -> str:
        """See :attr:`scale_named`."""
        return self.scale_named[1]


def balance(result: xr.Dataset, every: list[Column]) -> Balance | None:
    """The terms of the audit; None where the file lacks energy_residual, or no member finished."""
    residual = column(every, "energy_residual")
    if residual is None or residual.count == 0:
        return None
    scene = slideway.scene(result)

    def mean(name: str, is_there: bool = True) -> float:
        one = column(every, name)
        return (one.mean if one else math.nan) if is_there else 0.0

    work = mean("drive_work", scene["mechanism"]["kind"] != "free_slider" and drive_kind(scene) != "free")
    works = work, mean("load_work", "load" in scene), mean("ground_work", "ground_motion" in scene)
    losses = mean("spring_loss", "spring" in scene or "stop" in scene), mean("film_loss", "film" in scene)
    if "status" in result:
        duration = float(result["end_time"].values[slideway.finished(result).values].mean())
    else:
        duration = float(scene["study"].get("duration", math.nan))
    largest = max(abs(residual.low), abs(residual.high))
    damped = mean("friction_loss"), mean("damping_loss"), *losses
    return Balance(residual.mean, largest, *works, *damped, mean("energy_change"), duration, *_reference(result))


def _reference(result: xr.Dataset) -> tuple[float, str]:
    """M g c of a slider that falls through its gap, of a planar one ½ m (r ω)² [J], and its name; NaN without the sizes."""
    scene = slideway.scene(result, derived=True)
    mechanism, joint = scene["mechanism"], scene.get("joint", {})
    mass = float(mechanism.get("slider_mass", math.nan))
    if mechanism["kind"] == "planar_slider_crank":
        speed = mechanism.get("crank_length", math.nan) * mechanism.get("crank_speed", math.nan)
        return mass * speed**2 / 2, "the slider's kinetic energy at the speed of the crank pin"
    gap = play(mean_clearance(joint, "y"))
    fall = mechanism.get("gravity", math.nan) * gap
    if fall == 0:  # without weight nothing else has a size where all energies are rounding
        return mass * (gap * max(1.0, abs(mechanism.get("crank_speed", 0.0)))) ** 2, "the slider's energy at a clearance a radian"
    return mass * fall, "the weight's energy across the gap"


def verdict(result: xr.Dataset, every: list[Column]) -> Verdict:
    """What the residual of the energy audit means for this result, in words."""
    terms = balance(result, every)
    if terms is None:
        if column(every, "energy_residual") is not None:
            return Verdict("none", "No energy audit", ["No member finished, so there is nothing to audit."])
        wanted = "energy_residual, drive_work, friction_loss and damping_loss"
        return Verdict("none", "No energy audit", [f"The scene did not ask for it; add {wanted} to study.quantities to have it."])
    scene = slideway.scene(result)
    law = scene.get("contact", {}).get("law")
    name = f"The contact law of {'joints' if 'link' in scene else 'corners'}" if law is None else f"The {law} law"
    if _switches(result, law):
        return _of_switching(terms, name)
    if law == "rigid":
        return _of_conserving(terms, "Rigid contacts hold no energy: restitution and friction take some, and both are in the balance.")
    return _of_conserving(
        terms,
        f"{name} derives its elastic forces from one potential, so by itself it makes no energy: friction and damping alone "
        "take some, and both are in the balance.",
    )


def _switches(result: xr.Dataset, law: str | None) -> bool:
    """Whether the contact law switches between modes of contact, as the program says; older files have one law that does."""
    return bool(result.attrs.get("contact_law_switches", law == "paper"))


def share(terms: Balance) -> float:
    """The largest residual of a member, as a part of what it is compared with; NaN where that is not known."""
    return terms.largest / terms.scale if terms.scale > 0 else math.nan


def _amount(terms: Balance) -> str:
    words = f"{joules(terms.residual)} per member on average (at most {joules(terms.largest)})"
    if terms.scale > 0:
        return f"{words}, {percent(terms.residual / terms.scale)} of {terms.scale_name} ({joules(terms.scale)})"
    return words


def _compared(terms: Balance) -> list[str]:
    """Why the residual is compared with what it is, where that is not the work."""
    if not terms.scale > 0 or terms.scale_name == "the drive's work":
        return []
    return [f"It is compared with {terms.scale_name}, the largest of the energies that are known here."]


def _of_conserving(terms: Balance, why: str) -> Verdict:
    part = share(terms)
    found = [f"The residual is {_amount(terms)}.", *_compared(terms), why]
    if math.isnan(part) or (part > CLEAN and not terms.complete):
        unknown = (
            "Whether that is much cannot be said without the drive's work and the losses; add drive_work, friction_loss and damping_loss to study.quantities."
        )
        return Verdict("none", f"Residual {joules(terms.residual)}", [*found, unknown])
    if part <= CLEAN:
        left = "What is left is the error of the integration; it falls with integrator.rtol and atol."
        return Verdict("good", f"Energy is kept to {percent(part)}", [*found, left])
    if part <= SMALL:
        mean = percent(abs(terms.residual) / terms.scale)
        left = "What is left is error of the integration, and in the worst member more than need be: smaller integrator.rtol and atol make it smaller."
        return Verdict("warn", f"Energy is kept to {mean} on average, {percent(part)} at worst", [*found, left])
    much = (
        "So this is no physics but error of the integration, and too much of it: use smaller integrator.rtol and atol, or "
        "another method, before trusting these results."
    )
    return Verdict("bad", f"The method made or lost up to {percent(part)}", [*found, much])


def _of_switching(terms: Balance, law: str) -> Verdict:
    part = share(terms)
    found = f"The residual is {_amount(terms)}."
    why = f"{law} switches between surface, line and point contact, and the force jumps where it does. Each mode by itself keeps energy, the jumps do not."
    if part <= CLEAN:
        hardly = "Here the modes hardly switched under load, so hardly any energy was made."
        return Verdict("good", f"Energy is kept to {percent(part)}", [found, *_compared(terms), why, hardly])
    if terms.duration > 0:
        found += f" That is {joules(terms.residual / terms.duration)} in each second."
    sentences = [found, *_compared(terms), why]
    if terms.residual > 0:
        made = percent(terms.residual / terms.scale) + f" of {terms.scale_name}" if terms.scale > 0 else joules(terms.residual)
        headline = f"The contact law made {made}"
        sentences.append(
            "So this is not physics: a real joint makes no energy. It is a property of the law, does not go away with smaller "
            "tolerances, and keeps the slider bouncing and flying."
        )
    else:
        headline = "Switching modes cost energy"
        sentences.append("Here they took more than they gave; that is a property of the law too, not physics.")
    if terms.residual > 0 and terms.damping > 0:
        sentences.append(f"Contact damping took {joules(terms.damping)}; the law made {joules(terms.residual)}.")
    sentences.append("Run the scene with --set contact.law=conservative to see what is left without it.")
    return Verdict("warn", headline, sentences)


@dataclass(frozen=True)
class Audit:
    """The audit of a result: what it says, and the balance to draw."""

    verdict: Verdict
    balance: Balance | None
    whose: str  # members whose means the balance has


def audit(result: xr.Dataset, every: list[Column]) -> Audit:
    """The audit of all members; of a sweep that of the column with the largest share, for columns are different mechanisms."""
    sweep = sweep_of(result)
    if sweep is None or column(every, "energy_residual") is None:
        return Audit(verdict(result, every), balance(result, every), "the members")
    audits = []
    for value, part in by_column(result, sweep).items():
        own = columns(part)
        terms = balance(part, own)
        size = share(terms) if terms else math.nan
        audits.append((-1.0 if math.isnan(size) else size, value, verdict(part, own), terms))
    _, value, worst, terms = max(audits, key=lambda audit: audit[0])
    whose = f"the members with {sweep.named(value)}"
    said = f"Column by column; this is the one with the largest share of {counted(len(audits), 'column')}, {sweep.named(value)}."
    return Audit(Verdict(worst.grade, worst.headline, [said, *worst.sentences]), terms, whose)
