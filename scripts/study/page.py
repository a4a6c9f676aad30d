"""The page of the worked study."""

from __future__ import annotations

import numpy as np

from .runs import Fit, Misaligned, Outcome, fits, friction_limit, impact_limit, interval, middle, names

rejected_cost = 3.0  # of a crosshead that fails at its test, beside making it; relative to making the loosest


def share(count: int, of: int) -> str:
    """Per cent with its interval."""
    low, high = interval(count, of)
    return f"{100 * count / of:.1f} % ({100 * low:.1f} … {100 * high:.1f})"


def quantile(values: np.ndarray, at: float) -> float:
    """Of what is there."""
    return float(np.quantile(values, at))


def price(fit: Fit, out: Outcome) -> float:
    """Of one good crosshead: all that are made, and what the rejected cost on top, over the good."""
    kept = float(np.mean(out.good))
    return (fit.cost + (1 - kept) * rejected_cost) / kept if kept > 0 else float("inf")


def fits_table(rigid: list[Outcome], compliant: list[Outcome]) -> str:
    """A row a fit."""
    rows = []
    for fit, stiff, soft in zip(fits, rigid, compliant, strict=True):
        impacts = int(np.sum(stiff.impacts <= impact_limit))
        rows.append(f"| {fit.name} | {fit.least:g} … {fit.most:g} | {1e3 * np.mean(stiff.impacts):.3f}, {1e3 * quantile(stiff.impacts, 0.95):.3f} "
                    f"| {1e3 * np.mean(soft.impacts):.3f}, {1e3 * quantile(soft.impacts, 0.95):.3f} | {share(impacts, stiff.impacts.size)} "
                    f"| {share(int(np.sum(stiff.good)), stiff.good.size)} | {price(fit, stiff):.2f} |")
    return "\n".join(rows)


def tightening_table(bought: dict[str, Outcome], parts: dict[str, dict[str, float]]) -> str:
    """A row a key."""
    rows = []
    for key, name in names.items():
        out = bought[key]
        rows.append(f"| {name} | {100 * parts['damping_loss'][key]:.0f} % | {100 * parts['friction_loss'][key]:.0f} % "
                    f"| {share(int(np.sum(out.impacts <= impact_limit)), out.good.size)} | {share(int(np.sum(out.friction <= friction_limit)), out.good.size)} "
                    f"| {share(int(np.sum(out.good)), out.good.size)} |")
    return "\n".join(rows)


def space_table(space: list[Misaligned]) -> str:
    """A row a misalignment."""
    return "\n".join(f"| {one.angle:g} | {300 * one.angle / 1e3:.2f} | {np.median(one.impacts) * 1e3:.2f} "
                     f"| {np.median(one.friction) * 1e3:.1f} | {np.median(one.peaks) / 1e3:.1f} | {share(one.wedged, one.members)} |" for one in space)


def page(rigid: list[Outcome], compliant: list[Outcome], bought: dict[str, Outcome], parts: dict[str, dict[str, float]], space: list[Misaligned]) -> str:
    """All of it as Markdown."""
    best = min(zip(fits, rigid, strict=True), key=lambda pair: price(*pair))[0]
    gains = {key: float(np.mean(out.good)) for key, out in bought.items() if key}
    first = max(gains, key=lambda key: gains[key])
    base, after = bought[""], bought[first]
    faster = np.mean([a.members / a.seconds for a in rigid]) / np.mean([b.members / b.seconds for b in compliant])
    apart = max(abs(float(np.mean(b.impacts) / np.mean(a.impacts)) - 1) for a, b in zip(rigid, compliant, strict=True))
    failed = sum(out.failed for out in rigid + compliant)
    return f"""# A worked study: which fit for a crosshead?

A crosshead is the slider that guides the piston rod of a pump. This one is 25 mm high, and a crank of 30 mm drives it at 600 rpm
(`scenes/crosshead.toml`). The drawing gives its fit. Friction and the restitution of impacts scatter, and the crank angle at the start is
random. Two limits apply per turn: {1e3 * impact_limit:.1f} mJ lost in impacts (above it the pump is heard) and {1e3 * friction_limit:.0f} mJ lost to friction. Which fit should the
drawing give, and which tolerance is worth its price? `scripts/study.sh` runs the study and writes this page.

| what scatters | how |
|---|---|
| clearance | between the limits of the fit (ISO 286-1, 18 to 30 mm), normal, limits at three standard deviations |
| friction coefficient | 0.08, standard deviation 0.01, from 0.05 to 0.11 |
| restitution | 0.4 to 0.7, uniform |
| speed | 600 rpm, standard deviation 6 |

## Four fits
For each fit {rigid[0].members:,} crossheads ran ten turns with [rigid contacts](rigid.md), and {compliant[0].members} with compliant ones: steel corners of 0.5 mm radius with
the same restitution. Brackets are 95 % intervals of sampling.

| fit | clearance, µm | lost in impacts, mJ per turn: mean, 95 % quantile | the same, compliant | meet the impact limit | meet both limits | cost per good part |
|---|---|---|---|---|---|---|
{fits_table(rigid, compliant)}

![Distributions of the energy lost in impacts for four fits, with rigid and compliant contacts, and the limit](pictures/study.svg)

*Solid: rigid contacts; dotted: compliant ones; vertical line: the limit.*

The cost per good part is that of making all parts ({", ".join(f"{fit.name} {fit.cost:g}" for fit in fits)} each) plus {rejected_cost:g} for each part that fails its
test, divided by the number of good parts. These prices are assumptions: put yours into `scripts/study/runs.py` and `page.py`. With them
**{best.name}** is the cheapest.

- Losses in impacts grow with the clearance; friction losses hardly depend on it. A tighter fit does not help a crosshead that fails by friction.
- Rigid and compliant contacts agree on the mean energy of impacts within {100 * apart:.0f} %. Rigid members run {faster:.0f} times faster here, where the
  crosshead mostly flies or slides; with more impacts per unit of time it can be 85 times ([rigid.md](rigid.md#what-it-costs)).
- The study sets no limit on peak forces, because they depend on the stiffness of the contact: the compliant corners of this page reach
  {quantile(compliant[2].peaks, 0.5):.0f} N in {middle.name} (median), the same crosshead in space with steel faces {np.median(space[0].peaks) / 1e3:.1f} kN (below). Limit the energy or the
  impulse, or measure the stiffness first.

## Which tolerance to tighten
For {middle.name}: total Sobol indices (the share of the variance that would remain if all other inputs were known), and what halving the scatter of
each input alone does. As drawn, {share(int(np.sum(base.good)), base.good.size)} meet both limits.

| input | share of impact losses | share of friction losses | halved: meet the impact limit | meet the friction limit | meet both |
|---|---|---|---|---|---|
{tightening_table(bought, parts)}

Halving the scatter of **{names[first]}** helps most: {share(int(np.sum(after.good)), after.good.size)} then meet both limits. The others help little as long as that
one stays as it is.

## What a wrong choice costs
With {fits[3].name} instead of {middle.name}, {100 * (1 - np.mean(rigid[3].good)):.0f} % would fail instead of {100 * (1 - np.mean(rigid[2].good)):.0f} %,
and a good crosshead would cost {price(fits[3], rigid[3]):.2f} instead of {price(middle, rigid[2]):.2f}. With {fits[0].name},
{100 * (1 - np.mean(rigid[0].good)):.0f} % would still fail, by friction, at a cost of {price(fits[0], rigid[0]):.2f}.

## Alignment
The same crosshead in space (`scenes/crosshead_space.toml`, {space[0].peaks.size} members, two turns, compliant steel faces), its way turned by random
angles in yaw and pitch:

| misalignment, mrad (1 sd) | parallelism on the drawing, mm over 100 mm (3 sd) | lost in impacts, mJ per turn | to friction, mJ per turn | peak force, kN | wedged |
|---|---|---|---|---|---|
{space_table(space)}

Losses and forces are medians over the members. A member counts as wedged if it loses more than five times the median in impacts, or fails.
Masses are those of the plane, and so are the losses: there, with rigid contacts, {1e3 * quantile(rigid[2].impacts, 0.5):.2f} mJ in impacts and {1e3 * quantile(rigid[2].friction, 0.5):.1f} mJ to friction.
As long as the slider has room, misalignment costs nothing. Once the way is turned by as much as the clearance allows, some crossheads do not
fit. Medians do not show this; a limit on parallelism prevents it.

## How far to trust it
Of {sum(out.members for out in rigid + compliant):,} planar members {failed} failed. `slideway run scenes/crosshead.toml --set contact.law=rigid` repeats some of them
with tolerances a hundred times tighter. Both losses are `resolved`; how often corners land is not (357 ± 1.8, off by 0.4 % in all members at rtol 1e-9,
where it is resolved), and no figure of this page rests on it. The intervals contain the error of sampling alone. Restitution and friction of such a joint
are guesses until they are measured, and the yield depends on one of them. Rigid and compliant corners are different models:
[where they agree](rigid.md#agreement-with-stiff-compliant-contacts).
"""
