"""Contact forces by mode: Fig. 11."""

from __future__ import annotations

from functools import partial

import numpy as np
import slideway
from slideway.figures.base import by_contact, panel_of
from slideway.figures.marks import Axis, Cloud, Panel
from slideway.palette import class_colours

from .claims import LAWS, Claim, Finding, claim, said
from .estimates import Change, difference, estimate
from .sections import WINDOWS, Bench, Section, by_law, draw, wide_range

CLASSES = ("point", "line", "surface")


def section(bench: Bench) -> Section:
    """Judges Fig. 11: the slider-crank with 0.15 mm at π rad/s, one revolution after it has settled."""
    page = Section(
        "Fig. 11: contact forces by mode",
        [
            "The paper draws columns of force over time, by contact mode. Which force stands at which moment belongs to one orbit; shares of time and forces "
            "of each mode belong to the mechanism. A moment is counted by its hardest contact: a surface, else a line, else a point."
        ],
    )
    forces = {law: _forces(bench, law) for law in LAWS}
    page.claims = [*(_occur(bench, w) for w in WINDOWS), _differ(forces), *(_peaks(bench, w) for w in WINDOWS)]
    page.figures = [
        draw("How often which force acts.", partial(_histogram, bench)),
        draw("Fig. 11: the force over a revolution, one start, coloured by mode.", partial(_strip, bench)),
    ]

    def cells(mode: str, law: str) -> list[str]:
        force = "0" if mode == "free" else said(estimate(forces[law][mode]), "") if np.isfinite(forces[law][mode]).any() else "at no sample"
        return [said(estimate(_share(bench, law, mode)), "%", 100), force]

    rows = {mode: partial(cells, mode) for mode in ("free", *CLASSES)}
    page.tables = [
        by_law("Contact modes of a revolution.", "mode", ("time", "mean force while it lasts [N]"), rows),
        bench.audit("crank", [("0.15 mm", "0.15mm")], "settled", bench.scale.revolutions),
    ]
    return page


def _share(bench: Bench, law: str, mode: str, window: str = "settled") -> np.ndarray:
    times = {m: bench.values("crank", "0.15mm", window, law, "mode_time", m) for m in ("free", *CLASSES)}
    return times[mode] / sum(times.values())


def _classes(bench: Bench, law: str) -> dict[str, np.ndarray]:
    """Which samples are in which class, member × sample."""
    surface, line, point = (bench.series("crank", "0.15mm", "dense", law, f"{mode}s") > 0 for mode in ("surface", "line", "point"))
    return by_contact(surface, line, point)


def _forces(bench: Bench, law: str) -> dict[str, np.ndarray]:
    """Mean force of each member in each class [N]; NaN where no sample has it."""
    force = bench.series("crank", "0.15mm", "dense", law, "normal_force")
    found = {}
    for mode, there in _classes(bench, law).items():
        counts = there.sum(axis=1)
        found[mode] = np.where(counts > 0, np.where(there, force, 0).sum(axis=1) / np.maximum(counts, 1), np.nan)
    return found


def _occur(bench: Bench, window: str) -> Claim:
    def finding(law: str) -> Finding:
        shares = {mode: estimate(_share(bench, law, mode, window)) for mode in CLASSES}
        answer = True if all(s.low > 0 for s in shares.values()) else False if any(s.mean == 0 for s in shares.values()) else None
        return Finding(tuple(f"{mode}: {said(s, '% of the time', 100)}" for mode, s in shares.items()), answer)

    return claim("Fig. 11, 4.6", f"The contact switches between points, lines and surfaces: all three occur, {WINDOWS[window]}.", finding)


def _differ(forces: dict[str, dict[str, np.ndarray]]) -> Claim:
    """Mean forces of each member in its modes, from mode to mode."""

    def finding(law: str) -> Finding:
        there = [mode for mode in CLASSES if np.isfinite(forces[law][mode]).sum() >= 2]
        lines = tuple(f"{mode}: {said(estimate(forces[law][mode]), 'N')}" for mode in there)
        changes = {difference(forces[law][a], forces[law][b]).change for a, b in zip(there, there[1:])}
        return Finding(lines or ("no contact at any sample",), True if changes & {Change.RISES, Change.FALLS} else False if changes == {Change.SAME} else None)

    return claim("4.2.3", "The contact force differs between the modes, when settled.", finding)


def _peaks(bench: Bench, window: str) -> Claim:
    def finding(law: str) -> Finding:
        peak = bench.values("crank", "0.15mm", window, law, "peak_normal_force")
        ratio = estimate(peak / bench.values("crank", "0.15mm", window, law, "mean_normal_force"))
        lines = (f"peak force {said(estimate(peak), 'N')}", f"peak over mean: {said(ratio, '')}")
        return Finding(lines, True if ratio.low > 10 else False if ratio.high < 10 else None)

    words = "The force changes abruptly: impacts, more than ten times the mean force, stand out of it"
    return claim("4.2.3, 4.5", f"{words}, {WINDOWS[window]}.", finding)


def _histogram(bench: Bench, law: str) -> Panel:
    return panel_of(slideway.plot.force_histogram, bench.result("crank", "0.15mm", "dense", law))


def _strip(bench: Bench, law: str) -> Panel:
    time = bench.result("crank", "0.15mm", "dense", law)["time"].values
    force = bench.series("crank", "0.15mm", "dense", law, "normal_force")[0]
    here = {mode: there[0] & (force > 0) for mode, there in _classes(bench, law).items()}
    clouds = [Cloud(time[on], force[on], mode, class_colours[mode], size=5) for mode, on in here.items() if on.any()]
    return Panel(clouds, Axis("time", "s"), Axis("normal force", "N", log=wide_range(force[force > 0])))
