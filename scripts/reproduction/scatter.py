"""What clearance and speed do to the slider's place and to the forces: Figs. 13 and 14."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np
import slideway
from slideway.figures.base import panel_of
from slideway.figures.marks import Axis, Cloud, Curve, Mark, Panel, named
from slideway.palette import colours

from .claims import said
from .estimates import estimate
from .plan import SPEEDS
from .sections import WINDOWS, Bench, Quantity, Section, Table, by_law, draw, measured, values

CLEARED = {"0.1 mm": "0.1mm", "0.5 mm": "0.5mm"}
GAPS = {"0.1mm": 1e-4, "0.5mm": 5e-4, "0.1mm_1.22pi": 1e-4, "0.1mm_2pi": 1e-4}  # m
MASS = 7800 * 0.04 * 0.02 * 0.03  # kg, the slider of Table 6
QUIET_PLACE = 1e-7  # m, a thousandth of 0.1 mm
QUIET_FORCE = 0.01 * MASS * 9.81  # N, a hundredth of its weight
SD = {axis: measured(axis, lambda rows: rows.std(axis=1)) for axis in ("y", "z")}
PEAK = values("peak_normal_force")
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
    for words, quantity in (("Vertical scatter (sd of y)", SD["y"]), ("Lateral scatter (sd of z)", SD["z"]), ("The peak of the vertical position", _highest)):
        _add(page, bench, "Fig. 13", words, quantity, "µm", 1e6, QUIET_PLACE)
    caption = "Fig. 13: the centre of the slider across the way, {}, two revolutions of one start when settled; dashed: the clearance."
    page.figures = [draw(caption.format(words), partial(_orbit, bench, case), 4.6) for words, case in ALL.items()]

    def cells(case: str, window: str, law: str) -> list[str]:
        return [said(estimate(sd(bench, case, window, law) / GAPS[case]), "") for sd in SD.values()]

    page.tables = [_by_window("Scatter in units of the clearance per side.", list(SD), cells), _audit(bench)]
    return page


def _by_window(caption: str, columns: Sequence[str], cells: Callable[[str, str, str], list[str]]) -> Table:
    rows = {f"{words}, {when}": partial(cells, case, window) for words, case in ALL.items() for window, when in WINDOWS.items()}
    return by_law(caption, "case", columns, rows)


def forces(bench: Bench) -> Section:
    """Judges Fig. 14: peaks, and fluctuation as what it does to the slider, M times its rms acceleration across the way."""
    page = Section(
        "Fig. 14: contact forces",
        [
            "Peak force: the largest sum of the normal forces at any step. Fluctuation: the slider's mass times its rms acceleration across the way, an integral over "
            "all steps, which no sampling can miss. The moments of the paper's peaks (0.4 and 0.75 s) are those of one orbit, and nothing is to be compared there."
        ],
    )
    _add(page, bench, "Fig. 14", "Peak contact force", PEAK, "N", 1.0, 0.0)
    fluctuation = values("rms_acceleration", "y", "z", factor=MASS)
    _add(page, bench, "Fig. 14", "Fluctuation of the contact force", fluctuation, "N", 1.0, QUIET_FORCE)
    page.figures = [
        draw("Fig. 14: normal force over two revolutions from the start, 0.1 mm, π rad/s: samples of all starts.", partial(_samples, bench, "0.1mm")),
        draw("Fig. 14: peak force of each start.", partial(_dots, bench)),
    ]
    page.tables = [_contacts(bench), _audit(bench)]
    return page


def _contacts(bench: Bench) -> Table:
    def cells(case: str, window: str, law: str) -> list[str]:
        landings = bench.values("crank", case, window, law, "contact_onsets") / bench.scale.revolutions
        duration = float(bench.result("crank", case, window, law)["time"].values[-1])
        flight = bench.values("crank", case, window, law, "mode_time", "free") / duration
        return [said(estimate(landings), ""), said(estimate(flight), "", 100)]

    return _by_window("Does the slider leave its way?", ("landings a revolution", "in flight [%]"), cells)


def _add(page: Section, bench: Bench, figure: str, words: str, quantity: Quantity, unit: str, factor: float, floor: float) -> None:
    for window, when in WINDOWS.items():
        for panels, between, cases in (("a, b", "from 0.1 to 0.5 mm", CLEARED), ("a, c, d", "from π over 1.22π to 2π rad/s", SPEEDS)):
            page.claims.append(bench.growth(f"{figure}{panels}", f"{words} grows {between}, {when}.", quantity, cases, window, unit, factor, floor))


def _audit(bench: Bench) -> Table:
    return bench.audit("crank", list(ALL.items()), "settled", bench.scale.revolutions)


def _highest(bench: Bench, case: str, window: str, law: str) -> np.ndarray:
    """Rise above the way's lower side, where y = −c [m]: what a peak adds to lying still."""
    return np.asarray(bench.series("crank", case, window, law, "y").max(axis=1) + GAPS[case])


def _orbit(bench: Bench, case: str, law: str) -> Panel:
    result = bench.result("crank", case, "settled", law)
    return panel_of(slideway.plot.orbit_yz, result, member=int(result["member"].values[0]))


def _samples(bench: Bench, case: str, law: str) -> Panel:
    time = bench.result("crank", case, "start", law)["time"].values
    force = bench.series("crank", case, "start", law, "normal_force")
    there = force > 1e-3
    samples = Cloud(np.broadcast_to(time, force.shape)[there], force[there], opacity=0.5, size=2)
    return Panel([samples], Axis("time", "s", tight=True), Axis("normal force", "N", log=True))


def _dots(bench: Bench, law: str) -> Panel:
    marks: list[Mark] = []
    for shift, ((window, when), colour) in zip((-0.12, 0.12), zip(WINDOWS.items(), colours)):
        for place, case in enumerate(ALL.values()):
            forces = PEAK(bench, case, window, law)
            marks.append(Cloud(np.full(forces.size, place + shift), forces, when if place == 0 else None, colour, 0.4, 9))
            marks.append(Curve(place + shift + np.array([-0.09, 0.09]), np.full(2, np.nanmean(forces)), colour=colour, width=2))
    return Panel(marks, Axis("", ticks=named([words.replace(", ", "\n") for words in ALL])), Axis("peak normal force", "N", log=True))
