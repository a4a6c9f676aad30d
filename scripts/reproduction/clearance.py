"""What the clearance does to velocities and accelerations: Figs. 12 and 15."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from matplotlib.axes import Axes
from slideway.palette import colours
from slideway.plot.axes import finish

from .claims import LAWS, Claim, Finding, claim, growth, said
from .estimates import Change, difference, estimate
from .plan import CARRIAGE_CLEARANCES, CLEARANCES, MAPS, crank
from .sections import WINDOWS, Bench, Section, draw, wide_scale

Quantity = Callable[[Bench, str, str, str], np.ndarray]
"""Of bench, case, window and law: a value of each member."""

QUIET_SPEED = 1e-6  # m/s, of a slider that lies still: a thousandth of a clearance a radian
QUIET_ACCELERATION = 0.01  # m/s², a thousandth of g


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
        page.claims += [_growth(bench, window, place, f"{words}, {when}.", q, unit, floor) for place, words, q, unit, floor in _kinematics()]
    page.claims += [
        _growth(
            bench,
            "settled",
            "Fig. 15b",
            "The acceleration of the slider-crank grows with clearance, 0.15 and 0.22 mm included.",
            _across,
            "m/s²",
            QUIET_ACCELERATION,
            CLEARANCES,
        ),
        growth(
            "Fig. 15a",
            "The acceleration of the carriage (the experiment) grows with clearance.",
            list(CARRIAGE_CLEARANCES),
            {law: [_carriage(bench, case, "settled", law) for case in CARRIAGE_CLEARANCES.values()] for law in LAWS},
            "m/s²",
            floor=QUIET_ACCELERATION,
        ),
        _exception(bench, "slider-crank", ("0.15 mm", "0.22 mm", "0.3 mm"), _across, [crank(CLEARANCES[c]) for c in ("0.15 mm", "0.22 mm", "0.3 mm")]),
        _exception(bench, "carriage", tuple(CARRIAGE_CLEARANCES), _carriage, list(CARRIAGE_CLEARANCES.values())),
    ]
    page.figures = [
        draw("Fig. 12a: velocity across the way, rms, by clearance.", lambda law, ax: _chart(bench, law, ax, {"y": _vy, "z": _vz}, 1e3, "rms velocity [mm/s]")),
        draw(
            "Figs. 12b, 15: acceleration across the way, rms, by clearance.",
            lambda law, ax: _chart(bench, law, ax, {"y": _ay, "z": _az}, 1, "rms acceleration [m/s²]"),
        ),
        draw(
            "Fig. 12c: largest angular velocity of the rod, by clearance; the dotted line is the mechanism without clearance.",
            lambda law, ax: _rod_chart(bench, law, ax),
        ),
    ]
    page.tables = [bench.audit("crank", [(c, crank(v)) for c, v in CLEARANCES.items()], window, bench.scale.revolutions) for window in WINDOWS]
    return page


def _kinematics() -> list[tuple[str, str, Quantity, str, float]]:
    return [
        ("Fig. 12a", "Lateral velocity (rms of vz) grows with clearance", _vz, "mm/s", QUIET_SPEED),
        ("Fig. 12a", "Vertical velocity (rms of vy) grows with clearance", _vy, "mm/s", QUIET_SPEED),
        ("Fig. 12b", "Lateral acceleration (rms) grows with clearance", _az, "m/s²", QUIET_ACCELERATION),
        ("Fig. 12b", "Vertical acceleration (rms) grows with clearance", _ay, "m/s²", QUIET_ACCELERATION),
        ("Fig. 12c", "The rod's largest angular velocity grows with clearance", _rod, "rad/s", 0.0),
    ]


def _growth(bench: Bench, window: str, place: str, words: str, quantity: Quantity, unit: str, floor: float, cases: dict[str, float] = MAPS) -> Claim:
    columns = {law: [quantity(bench, crank(c), window, law) for c in cases.values()] for law in LAWS}
    return growth(place, words, list(cases), columns, unit, 1e3 if unit == "mm/s" else 1.0, floor)


def _exception(bench: Bench, of: str, labels: tuple[str, ...], quantity: Quantity, cases: list[str]) -> Claim:
    findings = {}
    for law in LAWS:
        below, here, above = (quantity(bench, case, "settled", law) for case in cases)
        into, out = difference(below, here).change, difference(here, above).change
        lines = tuple(f"{c}: {said(estimate(v), 'm/s²')}" for c, v in zip(labels, (below, here, above), strict=True))
        quiet = all(estimate(v).high < QUIET_ACCELERATION for v in (below, here, above))
        falls = into is Change.FALLS and out is Change.RISES
        findings[law] = Finding(lines, False if quiet or into in (Change.RISES, Change.SAME) else True if falls else None)
    return claim("Fig. 15a", f"0.22 mm is an exception, with less acceleration than the clearances beside it: {of}.", findings)


def _rms(rows: np.ndarray) -> np.ndarray:
    return np.asarray(np.sqrt(np.mean(rows**2, axis=1)))


def _vz(bench: Bench, case: str, window: str, law: str) -> np.ndarray:
    return _rms(bench.series("crank", case, window, law, "vz"))


def _vy(bench: Bench, case: str, window: str, law: str) -> np.ndarray:
    return _rms(bench.series("crank", case, window, law, "vy"))


def _az(bench: Bench, case: str, window: str, law: str) -> np.ndarray:
    return bench.values("crank", case, window, law, "rms_acceleration", "z")


def _ay(bench: Bench, case: str, window: str, law: str) -> np.ndarray:
    return bench.values("crank", case, window, law, "rms_acceleration", "y")


def _across(bench: Bench, case: str, window: str, law: str) -> np.ndarray:
    return np.asarray(np.hypot(_ay(bench, case, window, law), _az(bench, case, window, law)))


def _carriage(bench: Bench, case: str, window: str, law: str) -> np.ndarray:
    return np.asarray(np.hypot(*(bench.values("carriage", case, window, law, "rms_acceleration", along) for along in ("y", "z"))))


def _rod(bench: Bench, case: str, window: str, law: str) -> np.ndarray:
    return bench.values("crank", case, window, law, "peak_rod_angular_velocity")


def _chart(bench: Bench, law: str, ax: Axes, quantities: dict[str, Quantity], factor: float, words: str) -> None:
    for (axis_name, quantity), colour in zip(quantities.items(), colours):
        for (window, when), style in zip(WINDOWS.items(), ("--", "-")):
            _errors(ax, [factor * quantity(bench, crank(c), window, law) for c in CLEARANCES.values()], colour, style, f"{axis_name}, {when}")
    _finish(ax, words)


def _finish(ax: Axes, words: str) -> None:
    """From zero, or logarithmic where there are more than two decades to show."""
    values = np.concatenate([line.get_ydata() for line in ax.get_lines()])
    wide_scale(ax, values[values > 0])
    if ax.get_yscale() == "linear":
        ax.set_ylim(bottom=0)
    finish(ax, "clearance per side [mm]", words)


def _rod_chart(bench: Bench, law: str, ax: Axes) -> None:
    for (window, when), style in zip(WINDOWS.items(), ("--", "-")):
        _errors(ax, [_rod(bench, crank(c), window, law) for c in CLEARANCES.values()], colours[0], style, when)
    # At θ = 0 the rod turns with r ω/L.
    ax.axhline(0.05 * np.pi / 0.1422, color="#666666", ls=":", lw=1.2, label="without clearance")
    finish(ax, "clearance per side [mm]", "angular velocity of the rod [rad/s]")


def _errors(ax: Axes, columns: list[np.ndarray], colour: str, style: str, words: str) -> None:
    taken = [estimate(c) for c in columns]
    ax.errorbar(
        list(CLEARANCES.values()),
        [t.mean for t in taken],
        [t.half_width for t in taken],
        color=colour,
        ls=style,
        marker="o",
        ms=4,
        capsize=3,
        lw=1.3,
        label=words,
    )
