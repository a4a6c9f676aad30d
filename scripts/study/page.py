"""The page of the worked studies."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from reproduction import estimates

from . import ideal
from .machines import Carriage, Press, acceleration, ideal_press, lifting
from .runs import Case, Fit, Outcome, Spatial, alone, fits, hydraulic_work, loosest, middle, names, pump

rejected_cost = 3.0  # of a crosshead that fails at its test, beside making it; relative to making the loosest


@dataclass
class Found:
    """All that the studies have found."""

    rigid: list[Outcome]  # of the pump, a fit each
    compliant: list[Outcome]
    tightened: list[dict[str, Outcome]]  # the loosest fit, the middle one
    parts: dict[str, dict[str, float]]  # of the loosest
    before: list[Outcome]  # of the crosshead alone
    space: list[Spatial]
    worn: list[Spatial]
    presses: list[Press]
    carriages: list[Carriage]
    verdicts: list[dict[str, str]]  # of rigid members, compliant ones, those in space, worn ones


def share(met: np.ndarray) -> str:
    """Per cent with its interval."""
    found = estimates.share(met, np.ones_like(met))
    return f"{100 * found.mean:.1f} % ({100 * found.low:.1f} … {100 * found.high:.1f})"


def quantile(values: np.ndarray, at: float) -> float:
    """Of what is there."""
    return float(np.quantile(values, at))


def price(cost: float, kept: float) -> float:
    """Of one good crosshead: all that are made, and what the rejected cost on top, over the good.

    >>> price(1.0, 0.5)
    5.0
    """
    return (cost + (1 - kept) * rejected_cost) / kept if kept > 0 else float("inf")


def cheapest(outcomes: list[Outcome], impact_limit: float | None = None) -> Fit:
    """The fit whose good parts cost least, with the case's limits or another one for impacts."""
    def kept(out: Outcome) -> float:
        quiet = out.meet[0] if impact_limit is None else out.impacts <= impact_limit
        return float(np.mean(quiet & out.meet[1]))

    return min(zip(fits, outcomes, strict=True), key=lambda pair: price(pair[0].cost, kept(pair[1])))[0]


def limits_of(outcomes: list[Outcome]) -> tuple[float, float]:
    """The least and the largest limit of impacts with which the same fit stays the cheapest [J]."""
    case, best = outcomes[0].case, cheapest(outcomes).name
    grid = case.impact_limit * np.linspace(0.2, 2, 361)
    same = np.array([cheapest(outcomes, limit).name == best for limit in grid])
    here = int(np.argmin(np.abs(grid - case.impact_limit)))
    low, high = (np.flatnonzero(~same[: here + 1]), np.flatnonzero(~same[here:]))
    return float(grid[low[-1] + 1 if low.size else 0]), float(grid[here + high[0] - 1 if high.size else -1])


def helps_most(tightened: dict[str, Outcome]) -> str:
    """The input whose scatter is best halved."""
    return names[max((key for key in tightened if key), key=lambda key: float(np.mean(tightened[key].good)))]


def fits_table(rigid: list[Outcome], compliant: list[Outcome]) -> str:
    """A row a fit."""
    rows = []
    for fit, stiff, soft in zip(fits, rigid, compliant, strict=True):
        rows.append(f"| {fit.name} | {fit.least:g} … {fit.most:g} | {1e3 * np.mean(stiff.impacts):.2f}, {1e3 * quantile(stiff.impacts, 0.95):.2f} "
                    f"| {1e3 * np.mean(soft.impacts):.2f} | {quantile(soft.peaks, 0.5):.0f}, {quantile(soft.peaks, 0.95):.0f} "
                    f"| {100 * np.mean(stiff.meet[0]):.1f} % | {share(stiff.good)} | {price(fit.cost, float(np.mean(stiff.good))):.2f} |")
    return "\n".join(rows)


def tightening_table(found: Found) -> str:
    """A row an input, after that of all as drawn."""
    loose, good = found.tightened
    drawn = price(middle.cost, float(np.mean(good[""].good)))

    def kept(outcome: Outcome) -> str:
        return f"{100 * np.mean(outcome.good):.1f} %"

    rows = [f"| as drawn | | | {kept(loose[''])} | {kept(good[''])} | |"]
    for key, name in names.items():
        passed = float(np.mean(good[key].good))
        worth = max(0.0, drawn * passed - rejected_cost * (1 - passed) - middle.cost)
        rows.append(f"| {name} | {100 * found.parts['damping_loss'][key]:.0f} % | {100 * found.parts['friction_loss'][key]:.0f} % "
                    f"| {kept(loose[key])} | {kept(good[key])} | {worth:.2f} |")
    return "\n".join(rows)


def half_width(tightened: list[dict[str, Outcome]]) -> float:
    """The largest distance of a share that meets both limits from an end of its interval."""
    far = 0.0
    for outcome in (outcome for each in tightened for outcome in each.values()):
        met = estimates.share(outcome.good, np.ones_like(outcome.good))
        far = max(far, met.mean - met.low, met.high - met.mean)
    return far


def before_table(root: Path, found: Found) -> str:
    """The crosshead alone beside the pump."""
    two, here = (found.before, found.rigid), fits.index(middle)
    cases: tuple[Case, Case] = (alone, pump)

    def row(what: str, *cells: str) -> str:
        return f"| {what} | {' | '.join(cells)} |"

    return "\n".join([
        row(f"lost to friction, {middle.name}, mJ per turn", *(f"{1e3 * np.mean(each[here].friction):.4g}" for each in two)),
        row("by the closed form (speed and friction as drawn)", *(f"{1e3 * ideal.friction_loss(root, 0.08, scale):.4g}" for scale in (0, ideal.area))),
        row("lost in impacts, mJ per turn", *(f"{1e3 * np.mean(each[here].impacts):.2f}" for each in two)),
        row("limits: impacts, friction, mJ per turn", *(f"{1e3 * case.impact_limit:.2g}, {1e3 * case.friction_limit:.0f}" for case in cases)),
        row("cheapest fit", *(cheapest(each).name for each in two)),
    ])


def space_table(root: Path, found: Found) -> str:
    """A row a misalignment, with the parallelism that a drawing asks for, and a row a depth of wear, with what the chord says."""
    def row(what: str, one: Spatial, chord: float | None) -> str:
        leans = f"{1e3 * np.median(one.leaning):.2f}" + ("" if chord is None else f" ({1e3 * chord:.2f})")
        return f"| {what} | {1e3 * np.median(one.impacts):.2f} | {np.median(one.peaks) / 1e3:.1f} | {leans} | {one.wedged} |"

    turned = [row(f"turned by {one.value:g} mrad ({300 * one.value / 1e3:.2f} mm over 100 mm)", one, None) for one in found.space]
    return "\n".join(turned + [row(f"worn by {one.value:g} µm", one, ideal.chord(root, one.value)) for one in found.worn])


def press_table(root: Path, presses: list[Press]) -> str:
    """A row a flywheel."""
    known = ideal_press(root, np.array([one.inertia for one in presses]))
    return "\n".join(f"| {one.inertia:g} | {100 * np.mean(one.drop):.1f} %, {100 * quantile(one.drop, 0.99):.1f} % | {100 * drop:.1f} % | {np.mean(one.peak):.1f} "
                     f"| {np.mean(one.heat):.2f} | {60 * np.mean(one.rate):.0f} |" for one, drop in zip(presses, known, strict=True))  # fmt: skip


def carriage_table(root: Path, carriages: list[Carriage]) -> str:
    """A row an interpolation."""
    return "\n".join(f"| `{one.interpolation}` | {max(acceleration(root, one.interpolation)):.2f} | {1e3 * lifting(root, one.interpolation):.0f} "
                     f"| {1e3 * one.lifts:.0f} |" for one in carriages)


def trust(verdicts: list[dict[str, str]]) -> str:
    """What the runs say of their own numbers."""
    doubtful = [f"{quantity} of {what} ({verdict.replace('_', ' ')})"
                for what, said in zip(("rigid members", "compliant ones", "those in space", "worn ones"), verdicts, strict=True)
                for quantity, verdict in said.items() if verdict != "resolved"]
    return "each is `resolved`" if not doubtful else "each is `resolved` but " + ", ".join(doubtful)


def page(root: Path, found: Found) -> str:
    """All of it as Markdown."""
    rigid, compliant, best = found.rigid, found.compliant, cheapest(found.rigid)
    loose = found.tightened[0]
    least, most = limits_of(rigid)
    fewer = np.mean([b.evaluations for b in compliant]) / np.mean([a.evaluations for a in rigid])
    apart = max(abs(float(np.mean(b.impacts) / np.mean(a.impacts)) - 1) for a, b in zip(rigid, compliant, strict=True))
    everyone = [*rigid, *compliant, *found.before]
    growth = np.log(np.mean(rigid[3].impacts) / np.mean(rigid[0].impacts)) / np.log((fits[3].least + fits[3].most) / (fits[0].least + fits[0].most))
    side = np.max(np.abs(ideal.turn(root, 0.08).side))
    tight = max(float(np.mean(out.good)) for out in loose.values())
    former = sum(int(np.sum((out.impacts <= alone.impact_limit) & (out.friction <= alone.friction_limit))) for out in rigid)
    new, deepest = found.space[0], found.worn[-1]
    enough = next((one for one in found.presses if quantile(one.drop, 0.99) <= 0.1), found.presses[-1])
    heights = [lifting(root, one.interpolation) for one in found.carriages]
    return f"""# Worked studies: the crosshead of a pump, a press, a carriage

`scripts/study.sh` runs the studies and writes this page; a test holds them against closed forms.

## Which fit for the crosshead of a pump?
A crank of 30 mm drives a crosshead, 25 mm high, at 600 rpm against the pressure that an indicator has recorded over a turn (`scenes/crosshead.toml`): 29 bar
on a plunger of 25 mm, {hydraulic_work:.0f} J of hydraulic work. Per turn it may lose {100 * pump.friction_limit / hydraulic_work:.0f} % of that to friction ({pump.friction_limit:.2f} J)
and a ten thousandth in impacts ({1e3 * pump.impact_limit:.1f} mJ; above it the pump is heard).
The limits of the fit (ISO 286-1, 18 to 30 mm) are three standard deviations of the clearance. Friction is 0.08 with a standard deviation of 0.01, restitution
0.4 to 0.7; speed scatters by 1 %, pressure by 2 %.

For each fit {rigid[0].members:,} crossheads ran ten turns with [rigid contacts](../how_to/rigid.md), and {compliant[0].members} with compliant ones:
steel corners of 0.5 mm radius with the same restitution. Brackets are 95 % intervals of sampling.

| fit | clearance, µm | lost in impacts, mJ per turn: mean, 95 % quantile | compliant: mean | peak force, compliant, N: median, 95 % | meet the impact limit | meet both limits | cost per good part |
|---|---|---|---|---|---|---|---|
{fits_table(rigid, compliant)}

![Energy lost in impacts for four fits, rigid and compliant, and the limit](../pictures/study.svg)

The cost per good part is that of making all ({", ".join(f"{fit.name} {fit.cost:g}" for fit in fits)}) plus {rejected_cost:g} for each that fails its test, divided by the
number of good ones. With these prices, which are assumptions, **{best.name}** is
the cheapest, with any impact limit from {1e3 * least:.1f} to {1e3 * most:.1f} mJ.

- Impacts take energy that grows with the clearance to the power {growth:.2f} (a steadily rising side force: 4/3). To friction, μ ∫ |N| dx, the fit does not matter.
- Rigid and compliant contacts agree on the mean energy of impacts within {100 * apart:.0f} %, the rigid ones with {fewer:.0f} times fewer right-hand sides.
- The side force, {side:.0f} N at most, is the peak force in a tight fit. In {fits[3].name} impacts exceed it, by how much depends on the stiffness of the corners.

### What the pressure changes
| | crosshead alone | with the pressure |
|---|---|---|
{before_table(root, found)}

Without the load the study ends with another fit: of {sum(out.impacts.size for out in rigid):,} pumps {former} would keep its limits.

### Which tolerance to tighten
Total Sobol indices for {loosest.name}, what meets both limits when the scatter of
one input is halved (± {100 * half_width(found.tightened):.1f} points at most), and what halving may cost per crosshead in {middle.name} before it does not pay.

| input | share of impact losses | of friction losses | {loosest.name}, halved | {middle.name}, halved | worth |
|---|---|---|---|---|---|
{tightening_table(found)}

For {loosest.name} halving the scatter of **{helps_most(loose)}** helps most, but were it free a good part would still cost {price(loosest.cost, tight):.2f}. For {middle.name}
that of **{helps_most(found.tightened[1])}** is worth most.

### A way out of line, a worn way
The crosshead in space (`scenes/crosshead_space.toml`, faces as elastic beds, {new.members} members each, two turns): its way turned by random angles in yaw and pitch
(standard deviations; in brackets the parallelism on a drawing), or turned by 0.1 mrad and worn hollow by Archard's law where the pressure holds the slider
(`scenes/crosshead_wear.csv`). Numbers are medians. The lean is the slider's pitch under pressure, in brackets the slope of its chord over the hollow.
Wedged members lose more than five times the median in impacts, or fail.

| way | lost in impacts, mJ per turn | peak force, kN | leans, mrad | wedged, of {new.members} |
|---|---|---|---|---|
{space_table(root, found)}

![Side force and wear over the way; lean over a turn for three depths](../pictures/study_worn.svg)

- Misalignment costs nothing until some sliders do not fit; friction ({quantile(rigid[2].friction, 0.5):.3f} J) feels neither it nor wear.
- The worn way's slider leans, which the plunger's seal has to bear; with {deepest.value:g} µm impacts take {np.median(deepest.impacts) / np.median(new.impacts):.1f} times as much as on a new way.
- Peak forces are largest between flat new faces, which meet all at once: they tell stiffness, not health.

## How heavy a flywheel?
The press of [jobs](../how_to/jobs.md#press-with-motor-and-flywheel), whose workpiece scatters by 5 %: with which flywheel does a stroke take
at most a tenth of the speed in 99 % of {enough.before.size} presses? The closed form is the energy of the press without clearance over the crank's angle.

| flywheel, kg m² | a stroke takes: mean, 99 % quantile | closed form | motor's peak torque, N m | its rms, N m | strokes a minute |
|---|---|---|---|---|---|
{press_table(root, found.presses)}

**{enough.inertia:g} kg m²** are enough. A heavier wheel takes the peaks off the motor, hardly its heat.

## How tall a tool?
The carriage of [jobs](../how_to/jobs.md#carriage-on-a-measured-profile), 40 mm long, carries a mass above the way; its weight must hold both ends
down. The acceleration depends on what stands between the 17 measured rows of the profile:

| `interpolation` | peak acceleration, m/s² | an end lifts above, mm, by moments | in the runs, in steps of 5 mm |
|---|---|---|---|
{carriage_table(root, found.carriages)}

![Speed drop of the press over its flywheel, lean of the carriage over its height](../pictures/study_machines.svg)

The interpolation moves the answer by {100 * (max(heights) / min(heights) - 1):.0f} %. Measure faster where the speed changes, or stay below the least.

## How far to trust it
Of {sum(out.members for out in everyone):,} planar members {sum(out.failed for out in everyone)} failed. Some members of each kind (rigid, compliant, in space, worn by 40 µm) ran again with tolerances a hundred times
tighter, half of these by another method: of losses and peak forces {trust(found.verdicts)}. Intervals are of sampling alone. Restitution and friction
of such a joint are guesses until they are measured; rigid and compliant corners are
[different models](../how_to/rigid.md#agreement-with-stiff-compliant-contacts).
"""
