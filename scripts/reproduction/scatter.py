"""What clearance and speed do to the slider's place and to the forces: Figs. 13 and 14."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
import slideway
from matplotlib.axes import Axes
from slideway.palette import colours
from slideway.plot.axes import finish

from .claims import LAW_WORDS, LAWS, Claim, growth, said
from .estimates import estimate
from .plan import SPEEDS
from .sections import WINDOWS, Bench, Section, Table, draw

Quantity = Callable[[Bench, str, str, str], np.ndarray]
CLEARED = {"0.1 mm": "0.1mm", "0.5 mm": "0.5mm"}
GAPS = {"0.1mm": 1e-4, "0.5mm": 5e-4, "0.1mm_1.22pi": 1e-4, "0.1mm_2pi": 1e-4}  # m
MASS = 7800 * 0.04 * 0.02 * 0.03  # kg, the slider of Table 6
QUIET_PLACE = 1e-7  # m, a thousandth of 0.1 mm
QUIET_FORCE = 0.01 * MASS * 9.81  # N, a hundredth of its weight
ALL = {"0.1 mm, π rad/s": "0.1mm", "0.5 mm, π rad/s": "0.5mm", "0.1 mm, 1.22π rad/s": "0.1mm_1.22pi", "0.1 mm, 2π rad/s": "0.1mm_2pi"}


def positions(bench: Bench) -> Section:
    """Judges Fig. 13: scatter of y and z over time, the standard deviation of each start about its own mean."""
    page = Section(
        "Fig. 13: the slider's place",
        [
            "Larger clearance and higher speed are said to make the slider's place scatter more. Scatter is the standard deviation over time of y "
            "(vertical) and z (lateral). Of larger clearance that alone says little, for there is more room: the table has it in units of the clearance too. Under the conservative law the highest place of a start is that where it starts."
        ],
    )
    _add(
        page,
        bench,
        [
            ("Fig. 13{}", "Vertical scatter (sd of y)", _sd("y"), "µm", 1e6, QUIET_PLACE),
            ("Fig. 13{}", "Lateral scatter (sd of z)", _sd("z"), "µm", 1e6, QUIET_PLACE),
            ("Fig. 13{}", "The peak of the vertical position", _highest, "µm", 1e6, QUIET_PLACE),
        ],
    )
    page.figures = [
        draw(
            f"Fig. 13: the centre of the slider across the way, {words}, two revolutions of one start when settled; dashed: the clearance.",
            partial(_orbit, bench, case),
            4.6,
        )
        for words, case in ALL.items()
    ]
    rows = []
    for words, case in ALL.items():
        for window, when in WINDOWS.items():
            rows.append([f"{words}, {when}", *(said(estimate(_sd(axis)(bench, case, window, law) / GAPS[case]), "") for law in LAWS for axis in ("y", "z"))])
    page.tables = [
        Table("Scatter in units of the clearance per side.", ["case", *(f"{LAW_WORDS[law]}: {axis}" for law in LAWS for axis in ("y", "z"))], rows),
        _audit(bench),
    ]
    return page


def forces(bench: Bench) -> Section:
    """Judges Fig. 14: peaks, and fluctuation as what it does to the slider, M times its rms acceleration across the way."""
    page = Section(
        "Fig. 14: contact forces",
        [
            "Peak force: the largest sum of the normal forces at any step. Fluctuation: the slider's mass times its rms acceleration across the way, an integral over "
            "all steps, which no sampling can miss. The moments of the paper's peaks (0.4 and 0.75 s) are those of one orbit, and nothing is to be compared there."
        ],
    )
    _add(
        page,
        bench,
        [("Fig. 14{}", "Peak contact force", _peak, "N", 1.0, 0.0), ("Fig. 14{}", "Fluctuation of the contact force", _fluctuation, "N", 1.0, QUIET_FORCE)],
    )
    page.figures = [
        draw(
            "Fig. 14: normal force over two revolutions from the start, 0.1 mm, π rad/s: samples of all starts.",
            lambda law, ax: _samples(bench, law, ax, "0.1mm"),
        ),
        draw("Fig. 14: peak force of each start.", lambda law, ax: _dots(bench, law, ax)),
    ]
    page.tables = [_contacts(bench), _audit(bench)]
    return page


def _contacts(bench: Bench) -> Table:
    rows = []
    for words, case in ALL.items():
        for window, when in WINDOWS.items():
            row = [f"{words}, {when}"]
            for law in LAWS:
                landings = bench.values("crank", case, window, law, "contact_onsets") / bench.scale.revolutions
                duration = float(bench.result("crank", case, window, law)["time"].values[-1])
                flight = bench.values("crank", case, window, law, "mode_time", "free") / duration
                row += [said(estimate(landings), ""), said(estimate(flight), "", 100)]
            rows.append(row)
    columns = ("landings a revolution", "in flight [%]")
    return Table("Does the slider leave its way?", ["case", *(f"{LAW_WORDS[law]}: {w}" for law in LAWS for w in columns)], rows)


def _add(page: Section, bench: Bench, quantities: list[tuple[str, str, Quantity, str, float, float]]) -> None:
    for place, words, quantity, unit, factor, floor in quantities:
        for window, when in WINDOWS.items():
            page.claims.append(
                _claim(bench, place.format("a, b"), f"{words} grows from 0.1 to 0.5 mm, {when}.", quantity, window, CLEARED, unit, factor, floor)
            )
            page.claims.append(
                _claim(bench, place.format("a, c, d"), f"{words} grows from π over 1.22π to 2π rad/s, {when}.", quantity, window, SPEEDS, unit, factor, floor)
            )


def _claim(bench: Bench, place: str, words: str, quantity: Quantity, window: str, cases: dict[str, str], unit: str, factor: float, floor: float) -> Claim:
    return growth(place, words, list(cases), {law: [quantity(bench, case, window, law) for case in cases.values()] for law in LAWS}, unit, factor, floor)


def _audit(bench: Bench) -> Table:
    return bench.audit("crank", list(ALL.items()), "settled", bench.scale.revolutions)


def _sd(axis: str) -> Quantity:
    return lambda bench, case, window, law: bench.series("crank", case, window, law, axis).std(axis=1)


def _highest(bench: Bench, case: str, window: str, law: str) -> np.ndarray:
    """Rise above the way's lower side, where y = −c [m]: what a peak adds to lying still."""
    return np.asarray(bench.series("crank", case, window, law, "y").max(axis=1) + GAPS[case])


def _peak(bench: Bench, case: str, window: str, law: str) -> np.ndarray:
    return bench.values("crank", case, window, law, "peak_normal_force")


def _fluctuation(bench: Bench, case: str, window: str, law: str) -> np.ndarray:
    return np.asarray(MASS * np.hypot(*(bench.values("crank", case, window, law, "rms_acceleration", along) for along in ("y", "z"))))


def _orbit(bench: Bench, case: str, law: str, ax: Axes) -> None:
    result = bench.result("crank", case, "settled", law)
    slideway.plot.orbit_yz(result, member=int(result["member"].values[0]), ax=ax)


def _samples(bench: Bench, law: str, ax: Axes, case: str) -> None:
    time = bench.result("crank", case, "start", law)["time"].values
    force = bench.series("crank", case, "start", law, "normal_force")
    there = force > 1e-3
    ax.plot(np.broadcast_to(time, force.shape)[there], force[there], ".", ms=1, color=colours[0], alpha=0.5, rasterized=True)
    ax.set_yscale("log")
    ax.margins(x=0)
    finish(ax, "time [s]", "normal force [N]")


def _dots(bench: Bench, law: str, ax: Axes) -> None:
    for shift, ((window, when), colour) in zip((-0.12, 0.12), zip(WINDOWS.items(), colours)):
        for place, case in enumerate(ALL.values()):
            values = _peak(bench, case, window, law)
            ax.plot(np.full(values.size, place + shift), values, "o", ms=3, alpha=0.4, mew=0, color=colour, label=when if place == 0 else None)
            ax.plot([place + shift - 0.09, place + shift + 0.09], [np.nanmean(values)] * 2, color=colour, lw=2)
    ax.set_yscale("log")
    ax.set_xticks(range(len(ALL)), [words.replace(", ", "\n") for words in ALL])
    finish(ax, "", "peak normal force [N]")
