"""What the clearance does to velocities and accelerations: Figs. 12 and 15."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

import numpy as np
from slideway.figures.marks import Axis, Curve, Level, Panel
from slideway.palette import colours

from .claims import Claim, Finding, claim, said
from .estimates import Change, difference, estimate
from .plan import CARRIAGE_CLEARANCES, CLEARANCES, MAPS, crank
from .sections import WINDOWS, Bench, Quantity, Section, draw, measured, values, wide_range

QUIET_SPEED = 1e-6  # m/s, of a slider that lies still: a thousandth of a clearance a radian
QUIET_ACCELERATION = 0.01  # m/s², a thousandth of g
CRANKS = {words: crank(clearance) for words, clearance in CLEARANCES.items()}
CRANKS_OF_MAPS = {words: crank(clearance) for words, clearance in MAPS.items()}


def _rms(rows: np.ndarray) -> np.ndarray:
    return np.asarray(np.sqrt(np.mean(rows**2, axis=1)))


vy, vz = measured("vy", _rms), measured("vz", _rms)
ay, az, across = values("rms_acceleration", "y"), values("rms_acceleration", "z"), values("rms_acceleration", "y", "z")
of_carriage = values("rms_acceleration", "y", "z", family="carriage")
rod = values("peak_rod_angular_velocity")
KINEMATICS: tuple[tuple[str, str, Quantity, str, float], ...] = (
    ("Fig. 12a", "Lateral velocity (rms of vz) grows with clearance", vz, "mm/s", QUIET_SPEED),
    ("Fig. 12a", "Vertical velocity (rms of vy) grows with clearance", vy, "mm/s", QUIET_SPEED),
    ("Fig. 12b", "Lateral acceleration (rms) grows with clearance", az, "m/s²", QUIET_ACCELERATION),
    ("Fig. 12b", "Vertical acceleration (rms) grows with clearance", ay, "m/s²", QUIET_ACCELERATION),
    ("Fig. 12c", "The rod's largest angular velocity grows with clearance", rod, "rad/s", 0.0),
)


def section(bench: Bench) -> Section:
    """Judges Fig. 12 (clearances of Fig. 17) and Fig. 15 (with 0.15 and 0.22 mm)."""
    page = Section(
        "Fig. 12 and Fig. 15: velocities and accelerations grow with clearance",
        [
            'The paper shows the slider\'s velocity and acceleration "in the z-direction" and the angular velocity of the rod. Its axes are named '
            "inconsistently (model.md 10), so both the vertical (y) and the lateral (z) motion are judged.",
            "Each claim is judged twice: over the first two revolutions from starts scattered within the clearance, as the paper's plots begin at t = 0, "
            "and over the next two, when what the start brought along is gone.",
        ],
    )
    for window, when in WINDOWS.items():
        for place, words, quantity, unit, floor in KINEMATICS:
            factor = 1e3 if unit == "mm/s" else 1.0
            page.claims.append(bench.growth(place, f"{words}, {when}.", quantity, CRANKS_OF_MAPS, window, unit, factor, floor))
    crank_words = "The acceleration of the slider-crank grows with clearance, 0.15 and 0.22 mm included."
    carriage_words = "The acceleration of the carriage (the experiment) grows with clearance."
    page.claims += [
        bench.growth("Fig. 15b", crank_words, across, CRANKS, "settled", "m/s²", floor=QUIET_ACCELERATION),
        bench.growth("Fig. 15a", carriage_words, of_carriage, CARRIAGE_CLEARANCES, "settled", "m/s²", floor=QUIET_ACCELERATION),
        _exception(bench, "slider-crank", across, {words: CRANKS[words] for words in ("0.15 mm", "0.22 mm", "0.3 mm")}),
        _exception(bench, "carriage", of_carriage, CARRIAGE_CLEARANCES),
    ]
    page.figures = [
        draw("Fig. 12a: velocity across the way, rms, by clearance.", partial(_chart, bench, {"y": vy, "z": vz}, 1e3, "rms velocity [mm/s]")),
        draw("Figs. 12b, 15: acceleration across the way, rms, by clearance.", partial(_chart, bench, {"y": ay, "z": az}, 1, "rms acceleration [m/s²]")),
        draw("Fig. 12c: largest angular velocity of the rod, by clearance; the dotted line is the mechanism without clearance.", partial(_rod_chart, bench)),
    ]
    page.tables = [bench.audit("crank", list(CRANKS.items()), window, bench.scale.revolutions) for window in WINDOWS]
    return page


def _exception(bench: Bench, of: str, quantity: Quantity, cases: Mapping[str, str]) -> Claim:
    def finding(law: str) -> Finding:
        below, here, above = (quantity(bench, case, "settled", law) for case in cases.values())
        into, out = difference(below, here).change, difference(here, above).change
        lines = tuple(f"{c}: {said(estimate(v), 'm/s²')}" for c, v in zip(cases, (below, here, above), strict=True))
        quiet = all(estimate(v).high < QUIET_ACCELERATION for v in (below, here, above))
        falls = into is Change.FALLS and out is Change.RISES
        return Finding(lines, False if quiet or into in (Change.RISES, Change.SAME) else True if falls else None)

    return claim("Fig. 15a", f"0.22 mm is an exception, with less acceleration than the clearances beside it: {of}.", finding)


def _chart(bench: Bench, quantities: dict[str, Quantity], factor: float, words: str, law: str) -> Panel:
    """From zero, or logarithmic where there are more than two decades to show."""
    curves = [_means(bench, quantity, window, law, colour, dash, f"{name}, {when}", factor) for (name, quantity), colour in zip(quantities.items(), colours)
              for (window, when), dash in zip(WINDOWS.items(), ("--", "-"))]  # fmt: skip
    ends = np.concatenate([end for curve in curves for end in (curve.low, curve.high)])
    wide = wide_range(ends[ends > 0])
    return Panel(curves, Axis("clearance per side", "mm"), Axis(words, log=wide, low=None if wide else 0))


def _rod_chart(bench: Bench, law: str) -> Panel:
    curves = [_means(bench, rod, window, law, colours[0], dash, when) for (window, when), dash in zip(WINDOWS.items(), ("--", "-"))]
    # At θ = 0 the rod turns with r ω/L.
    free = Level(0.05 * np.pi / 0.1422, label="without clearance", dash=":", width=1.2)
    return Panel([*curves, free], Axis("clearance per side", "mm"), Axis("angular velocity of the rod", "rad/s"))


def _means(bench: Bench, quantity: Quantity, window: str, law: str, colour: str, dash: str, words: str, factor: float = 1.0) -> Curve:
    taken = [estimate(factor * quantity(bench, case, window, law)) for case in CRANKS.values()]
    mean, low, high = np.array([(t.mean, t.low, t.high) for t in taken]).T
    return Curve(np.array(list(CLEARANCES.values())), mean, words, colour, dash=dash, marker="o", low=low, high=high)
