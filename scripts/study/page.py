"""The page of the worked studies."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from . import ideal
from .machines import Carriage, Press, acceleration, ideal_press, lifting
from .runs import Case, Fit, Outcome, Spatial, alone, fits, hydraulic_work, interval, loosest, middle, names, pump

rejected_cost = 3.0  # of a crosshead that fails at its test, beside making it; relative to making the loosest


@dataclass
class Found:
    """All that the studies have found."""

    rigid: list[Outcome]  # of the pump, a fit each
    compliant: list[Outcome]
    tightened: list[dict[str, Outcome]]  # the loosest fit, the middle one
    parts: dict[str, dict[str, float]]  # of the loosest
    before: list[Outcome]  # of the crosshead alone
    before_compliant: Outcome  # the middle fit
    before_tightened: dict[str, Outcome]
    space: list[Spatial]
    worn: list[Spatial]
    presses: list[Press]
    carriages: list[Carriage]
    verdicts: list[dict[str, str]]  # of rigid members, compliant ones, those in space, worn ones


def share(met: np.ndarray) -> str:
    """Per cent with its interval."""
    count, of = int(np.sum(met)), met.size
    low, high = interval(count, of)
    return f"{100 * count / of:.1f} % ({100 * low:.1f} … {100 * high:.1f})"


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
                    f"| {1e3 * np.mean(soft.impacts):.2f}, {1e3 * quantile(soft.impacts, 0.95):.2f} | {quantile(soft.peaks, 0.5):.0f}, {quantile(soft.peaks, 0.95):.0f} "
                    f"| {share(stiff.meet[0])} | {share(stiff.good)} | {price(fit.cost, float(np.mean(stiff.good))):.2f} |")
    return "\n".join(rows)


def tightening_table(found: Found) -> str:
    """A row an input, after that of all as drawn."""
    loose, good = found.tightened
    drawn = price(middle.cost, float(np.mean(good[""].good)))
    rows = [f"| as drawn | | | {share(loose[''].meet[0])} | {share(loose[''].good)} | {share(good[''].good)} | |"]
    for key, name in names.items():
        kept = float(np.mean(good[key].good))
        worth = max(0.0, drawn * kept - rejected_cost * (1 - kept) - middle.cost)
        rows.append(f"| {name} | {100 * found.parts['damping_loss'][key]:.0f} % | {100 * found.parts['friction_loss'][key]:.0f} % "
                    f"| {share(loose[key].meet[0])} | {share(loose[key].good)} | {share(good[key].good)} | {worth:.2f} |")
    return "\n".join(rows)


def before_table(root: Path, found: Found) -> str:
    """The crosshead alone beside the pump."""
    two, here = (found.before, found.rigid), fits.index(middle)
    soft = (found.before_compliant, found.compliant[here])
    cases: tuple[Case, Case] = (alone, pump)

    def row(what: str, *cells: str) -> str:
        return f"| {what} | {' | '.join(cells)} |"

    return "\n".join([
        row(f"lost to friction, {middle.name}, mJ per turn", *(f"{1e3 * np.mean(each[here].friction):.4g}" for each in two)),
        row("by the closed form (speed and friction as drawn)", *(f"{1e3 * ideal.friction_loss(root, 0.08, scale):.4g}" for scale in (0, ideal.area))),
        row("lost in impacts, mJ per turn", *(f"{1e3 * np.mean(each[here].impacts):.2f}" for each in two)),
        row("peak force with compliant corners, N, median", *(f"{quantile(each.peaks, 0.5):.0f}" for each in soft)),
        row("limits: impacts, friction, mJ per turn", *(f"{1e3 * case.impact_limit:.2g}, {1e3 * case.friction_limit:.0f}" for case in cases)),
        row("meet both: " + ", ".join(fit.name for fit in fits), *(", ".join(f"{100 * np.mean(out.good):.0f} %" for out in each) for each in two)),
        row("cheapest fit", *(cheapest(each).name for each in two)),
        row(f"{middle.name}: scatter to halve first", helps_most(found.before_tightened), helps_most(found.tightened[1])),
    ])


def space_table(root: Path, found: Found) -> str:
    """A row a misalignment, with the parallelism that a drawing asks for, and a row a depth of wear, with what the chord says."""
    def row(what: str, one: Spatial, chord: float | None) -> str:
        leans = f"{1e3 * np.median(one.leaning):.2f}" + ("" if chord is None else f" ({1e3 * chord:.2f})")
        return (f"| {what} | {1e3 * np.median(one.impacts):.2f} | {np.median(one.friction):.3f} | {np.median(one.peaks) / 1e3:.1f} | {leans} "
                f"| {share(np.arange(one.members) < one.wedged)} |")  # fmt: skip

    turned = [row(f"out of line by {one.value:g} mrad ({300 * one.value / 1e3:.2f} mm over 100 mm)", one, None) for one in found.space]
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
    here, loose = fits.index(best), found.tightened[0]
    least, most = limits_of(rigid)
    fewer = np.mean([b.evaluations for b in compliant]) / np.mean([a.evaluations for a in rigid])
    apart = max(abs(float(np.mean(b.impacts) / np.mean(a.impacts)) - 1) for a, b in zip(rigid, compliant, strict=True))
    everyone = [*rigid, *compliant, *found.before, found.before_compliant]
    growth = np.log(np.mean(rigid[3].impacts) / np.mean(rigid[0].impacts)) / np.log((fits[3].least + fits[3].most) / (fits[0].least + fits[0].most))
    side = np.max(np.abs(ideal.turn(root, 0.08).side))
    tight = max(float(np.mean(out.good)) for out in loose.values())
    former = sum(int(np.sum((out.impacts <= alone.impact_limit) & (out.friction <= alone.friction_limit))) for out in rigid)
    new, deepest = found.space[0], found.worn[-1]
    enough = next((one for one in found.presses if quantile(one.drop, 0.99) <= 0.1), found.presses[-1])
    heights = [lifting(root, one.interpolation) for one in found.carriages]
    return f"""# Worked studies: the crosshead of a pump, a press, a carriage

Three machines and a question each. `scripts/study.sh` runs the studies and writes this page; a test holds them against closed forms.

## Which fit for the crosshead of a pump?
A crosshead is the slider that guides the rod of a pump. This one is 25 mm high; a crank of 30 mm drives it at 600 rpm against the pressure that an indicator
has recorded over a turn (`scenes/crosshead.toml`): 29 bar on a plunger of 25 mm, {hydraulic_work:.0f} J of hydraulic work. Per turn it may lose {100 * pump.friction_limit / hydraulic_work:.0f} % of that to friction
({pump.friction_limit:.2f} J, or {10 * pump.friction_limit:.0f} W of heat in the guide) and a ten thousandth in impacts ({1e3 * pump.impact_limit:.1f} mJ; above it the pump is heard). Which fit should the drawing give, and which
tolerance is worth its price? The clearance scatters between the limits of the fit (ISO 286-1, 18 to 30 mm; normal, limits at three standard deviations),
friction from 0.05 to 0.11 (0.08, standard deviation 0.01), restitution from 0.4 to 0.7, the speed by 1 % and the pressure by 2 % (standard deviations).

For each fit {rigid[0].members:,} crossheads ran ten turns with [rigid contacts](rigid.md), and {compliant[0].members} with compliant ones: steel corners of 0.5 mm radius with
the same restitution. They start at a random angle while the pump sucks. Brackets are 95 % intervals of sampling.

| fit | clearance, µm | lost in impacts, mJ per turn: mean, 95 % quantile | the same, compliant | peak force, compliant, N: median, 95 % | meet the impact limit | meet both limits | cost per good part |
|---|---|---|---|---|---|---|---|
{fits_table(rigid, compliant)}

![Distributions of the energy lost in impacts for four fits, with rigid and compliant contacts, and the limit](pictures/study.svg)

The cost per good part is that of making all parts ({", ".join(f"{fit.name} {fit.cost:g}" for fit in fits)} each) plus {rejected_cost:g} for each part that fails its
test, divided by the number of good parts. These prices are assumptions: put yours into `scripts/study/runs.py` and `page.py`. With them **{best.name}** is
the cheapest, with any impact limit from {1e3 * least:.1f} to {1e3 * most:.1f} mJ; {fits[3].name} instead would cost {price(fits[3].cost, float(np.mean(rigid[3].good))):.2f}, not {price(best.cost, float(np.mean(rigid[here].good))):.2f}.

- Twice a turn the side force changes its sign and throws the crosshead across its gap: as the pressure rises, and at the dead centre before it falls. What
  these impacts take grows with the clearance to the power {growth:.2f}; a side force that rises steadily gives 4/3.
- Friction takes μ ∫ |N| dx, N being the side force of the mechanism without clearance. The fit does not matter to it.
- Rigid and compliant contacts agree on the mean energy of impacts within {100 * apart:.0f} %, the rigid ones with {fewer:.0f} times fewer right-hand sides.
- The side force is {side:.0f} N at most. In a tight fit that is the peak force; in {fits[3].name} impacts exceed it, and by how much the stiffness of the corners decides.

### What the pressure changes
| | crosshead alone, as this page studied it before | with the pressure |
|---|---|---|
{before_table(root, found)}

With the pressure friction takes {np.mean(rigid[2].friction) / np.mean(found.before[2].friction):.0f} times and impacts take {np.mean(rigid[2].impacts) / np.mean(found.before[2].impacts):.0f} times as much: of {sum(out.impacts.size for out in rigid):,} pumps {former} would keep the former limits.
A study without the load sets other limits and ends with another fit. That friction's scatter decides the yield, it says too.

### Which tolerance to tighten
Total Sobol indices for {loosest.name} (the share of the variance that would remain if all other inputs were known), and what halving the scatter of each input
alone does to it and to {middle.name}. Last column: what halving may cost per crosshead in {middle.name} before it does not pay.

| input | share of impact losses | of friction losses | {loosest.name}, halved: meet the impact limit | meet both | {middle.name}, halved: meet both | worth |
|---|---|---|---|---|---|---|
{tightening_table(found)}

For {loosest.name} halving the scatter of **{helps_most(loose)}** helps most, but were it free a good part would still cost {price(loosest.cost, tight):.2f}. For {middle.name}
that of **{helps_most(found.tightened[1])}** is worth most.

### A way out of line, a worn way
The same crosshead in space (`scenes/crosshead_space.toml`, {new.members} members each, two turns, faces as elastic beds), its way turned by random angles in yaw
and pitch (standard deviations; in brackets the parallelism on a drawing), or out of line by 0.1 mrad and worn. The pressure always holds the slider to the
same face. By Archard's law (depth as pressure times sliding distance) that face wears hollow, most at mid stroke, as `scenes/crosshead_wear.csv` says.
Losses, forces and lean are medians; the lean is the slider's pitch under pressure, in brackets the slope of its chord over the hollow. Members count as
wedged if they lose more than five times the median in impacts, or fail.

| way | lost in impacts, mJ per turn | to friction, J per turn | peak force, kN | leans, mrad | wedged |
|---|---|---|---|---|---|
{space_table(root, found)}

![Side force and wear over the slider's way; lean of the slider over a turn for three depths](pictures/study_worn.svg)

- Losses are those of the plane ({1e3 * quantile(rigid[2].impacts, 0.5):.2f} mJ, {quantile(rigid[2].friction, 0.5):.3f} J). Misalignment costs nothing until some sliders do not fit, which medians do not show.
- Friction does not feel the wear. The slider bridges the hollow with its ends and leans, which the plunger's seal has to bear; with {deepest.value:g} µm impacts take
  {np.median(deepest.impacts) / np.median(new.impacts):.1f} times as much as on a new way. Peak forces are largest between flat new faces, which meet all at once: they tell stiffness, not health.

## How heavy a flywheel?
The press of [jobs](jobs.md#press-with-motor-and-flywheel), whose workpiece scatters by 5 %: with which flywheel does a stroke take at most a tenth of the speed
in 99 % of {enough.before.size} presses, and what does the motor gain? The closed form is the energy of the press without clearance over the crank's angle.

| flywheel, kg m² | a stroke takes: mean, 99 % quantile | closed form | motor's peak torque, N m | its rms, N m | strokes a minute |
|---|---|---|---|---|---|
{press_table(root, found.presses)}

**{enough.inertia:g} kg m²** are enough. The heavier wheel takes the peaks off the motor, hardly its heat: the mean torque is what the strokes ask for.

## How tall a tool?
The carriage of [jobs](jobs.md#carriage-on-a-measured-profile) is 40 mm long and carries a mass at some height above the way. As it speeds up and brakes,
its weight must hold both ends down. The profile has 17 measured rows; the acceleration depends on what stands between them:

| `interpolation` | peak acceleration, m/s² | an end lifts above, mm, by moments | in the runs, in steps of 5 mm |
|---|---|---|---|
{carriage_table(root, found.carriages)}

![Speed drop of the press over its flywheel, and lean of the carriage over its height, with what the closed forms say](pictures/study_machines.svg)

What one assumes between the rows moves the answer by {100 * (max(heights) / min(heights) - 1):.0f} %. Measure faster where the speed changes, or stay below the least.

## How far to trust it
Of {sum(out.members for out in everyone):,} planar members {sum(out.failed for out in everyone)} failed. Some members of each kind (rigid, compliant, in space, worn by 40 µm) ran again with tolerances a hundred
times tighter, half of these by another method: of losses and peak forces {trust(found.verdicts)}. The intervals contain the error of
sampling alone. Restitution and friction of such a joint are guesses until they are measured, and the yield depends on one of them. Rigid and compliant
corners are different models: [where they agree](rigid.md#agreement-with-stiff-compliant-contacts).
"""
