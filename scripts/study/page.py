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

`scripts/study.sh` makes this page. A small pump has a crosshead 25 mm high on a way, driven at 600 rpm by a crank of
30 mm. Its drawing gives a fit, friction scatters, so does the restitution of the impacts, and nobody knows where the
crank stands at the start. Two limits are set for a turn: {1e3 * impact_limit:.1f} mJ lost in impacts (above that the
pump is heard) and {1e3 * friction_limit:.0f} mJ lost to friction. Which fit, and which tolerance is worth money?

| what scatters | how |
|---|---|
| clearance | between the limits of the fit (ISO 286-1, 18 to 30 mm), normal, limits at three standard deviations |
| friction | 0.08, standard deviation 0.01, from 0.05 to 0.11 |
| restitution | 0.4 to 0.7, uniform |
| speed | 600 rpm, standard deviation 6 |

## Four fits
{rigid[0].members:,} crossheads a fit over ten turns with [rigid contacts](rigid.md), {compliant[0].members} with contacts that
give way; 95 % intervals.

| fit | clearance, µm | impacts, mJ a turn: mean, 95 % | the same, compliant | keep the limit of impacts | keep both | price of a good one |
|---|---|---|---|---|---|---|
{fits_table(rigid, compliant)}

![Distributions of the energy lost in impacts for four fits, with rigid and compliant contacts, and the limit](pictures/study.svg)

The price counts making a crosshead ({", ".join(f"{fit.name} {fit.cost:g}" for fit in fits)}) and {rejected_cost:g} for one that fails its
test, over the good ones. These numbers are assumptions: put yours into `scripts/study/runs.py`. With them **{best.name}** is the cheapest.

- Impacts follow the clearance; friction hardly notices it. A tighter fit cannot help a crosshead that fails by friction.
- Rigid and compliant contacts agree on the mean energy of impacts within {100 * apart:.0f} %. Rigid members come {faster:.0f} times faster here, where most of
  the time is flight and sliding; with less motion between impacts it is 75 times ([rigid.md](rigid.md#what-it-costs)).
- Peak forces are left out on purpose. They belong to the contact's stiffness: the compliant corners of this page reach
  {quantile(compliant[2].peaks, 0.5):.0f} N in {middle.name}, the same crosshead in space with its steel faces {np.median(space[0].peaks) / 1e3:.1f} kN (below). Set a
  limit on energy or impulse, or measure the stiffness first.

## Which tolerance to tighten
{middle.name}, total Sobol indices (the share of the variance that would be gone with this input known), and what halving each scatter
alone does. As drawn, {share(int(np.sum(base.good)), base.good.size)} keep both limits.

| input | of impacts | of friction | halved: keep the limit of impacts | keep that of friction | keep both |
|---|---|---|---|---|---|
{tightening_table(bought, parts)}

Halving the scatter of **{names[first]}** buys most: {share(int(np.sum(after.good)), after.good.size)} keep both. The others buy little while that one stays as
it is.

## What being wrong costs
Were {fits[3].name} built instead of {middle.name}, {100 * (1 - np.mean(rigid[3].good)):.0f} % would fail instead of {100 * (1 - np.mean(rigid[2].good)):.0f} %,
and a good crosshead would cost {price(fits[3], rigid[3]):.2f} instead of {price(middle, rigid[2]):.2f}. {fits[0].name} would lose
{100 * (1 - np.mean(rigid[0].good)):.0f} % all the same, to friction, and cost {price(fits[0], rigid[0]):.2f}.

## Alignment
The same crosshead in space (`scenes/crosshead_space.toml`, {space[0].peaks.size} members, two turns, steel faces that give way), its way
turned in yaw and pitch:

| misalignment, mrad (1 sd) | parallelism on the drawing, mm over 100 mm (3 sd) | impacts, mJ a turn | friction, mJ a turn | peak force, kN | wedged |
|---|---|---|---|---|---|
{space_table(space)}

Medians over the members; wedged are those that lose more than five times the median. As long as the slider has room,
misalignment costs nothing. Once the way is turned by as much as the clearance allows, some crossheads do not fit: no
mean tells it, and a limit on parallelism is what prevents it.

## How far to trust it
Of {sum(out.members for out in rigid + compliant):,} planar members {failed} failed. `slideway run scenes/crosshead.toml --set contact.law=rigid` repeats some of them
with tolerances a hundred times tighter and says `resolved`. Intervals are of chance alone. Restitution and friction of such a joint are guesses until they
are measured, and the study shows that the yield hangs on one of them. One corner model is not another: see
[where rigid and compliant contacts part](rigid.md#is-it-what-a-stiff-contact-comes-to).
"""
