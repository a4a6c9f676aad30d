"""Is the exponent positive: Fig. 19 and Eq. (19)."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Union

import numpy as np
import slideway
from slideway.figures.base import panel_of
from slideway.figures.chaos import fitted
from slideway.figures.marks import Axis, Curve, Mark, Panel
from slideway.palette import colours
from slideway.units import plus_minus

from .claims import LAWS, UNTOLD, Claim, Finding, Verdict, claim, said
from .estimates import estimate, share
from .plan import MAPS, crank
from .sections import Bench, Section, by_law, draw

Pair = tuple[slideway.SeriesStatistics, Union[slideway.SeriesStatistics, None]]
Series = dict[str, list[Pair]]  # by law
PERIOD = 2.0  # s, of a revolution at π rad/s
PRINTED = {"delay": 8, "window": 80, "dimension": 11}  # Eq. (19), samples


def section(bench: Bench) -> Section:
    """Judges Fig. 19 by neighbours that follow the equations, and by the paper's own method on x(t)."""
    page = Section(
        "Fig. 19: the largest Lyapunov exponent",
        [
            "The paper takes x(t) alone, finds delay and window by the C–C method, and fits a line to the mean logarithmic distance of neighbours (small data sets, "
            "Rosenstein et al. 1993). Neighbours that follow the equations, 1e-6 off each start and put back 2,000 times a revolution (docs/explanation/chaos.md), need no such choice.",
            "The sampling of the paper's series is not in the print, nor are the start, the clearance and the unit of P; so its numbers cannot be had from the same data.",
        ],
    )
    series = {law: _series(bench, law) for law in LAWS}
    page.claims = [_by_neighbours(bench, c) for c in MAPS.values()] + [_by_series(series), _by_line(series)] + _embedding(series)
    page.figures = [
        draw("How the exponent settles, 0.1 mm; linear within ±0.1 1/s, logarithmic beyond.", partial(_history, bench)),
        draw("Fig. 19: mean ln distance of neighbours of x(t), each start; the line is fitted to the first 80 samples.", partial(_divergence, series)),
    ]

    def cells(clearance: float, law: str) -> list[str]:
        values = _exponents(bench, clearance, law)
        return [said(estimate(values), ""), said(estimate(values), "", PERIOD), plus_minus(float(np.nanmedian(values)), np.nan)]

    rows = {words: partial(cells, c) for words, c in MAPS.items()}
    columns = ("λ₁ [1/s]", "λ₁ a revolution", "median [1/s]")
    revolutions = bench.scale.exponent_transient + bench.scale.exponent_revolutions
    page.tables = [
        by_law("Largest exponent by neighbours, the second half of the record.", "clearance", columns, rows),
        bench.audit("exponent", [(w, crank(c)) for w, c in MAPS.items()], "settled", revolutions),
    ]
    return page


def _exponents(bench: Bench, clearance: float, law: str) -> np.ndarray:
    """Second half of each member's record [1/s], after the transient of its start."""
    return bench.values("exponent", crank(clearance), "settled", law, "lyapunov_exponent_late")


def _mostly(hits: np.ndarray, there: np.ndarray) -> tuple[str, bool | None]:
    """A share of the starts in words, and whether it is most of them."""
    found = share(hits, there)
    words = f"{100 * found.mean:.0f} % of the {{}} [{100 * found.low:.0f}, {100 * found.high:.0f}]"
    return words, True if found.low > 0.5 else False if found.high < 0.5 else None


def _by_neighbours(bench: Bench, clearance: float) -> Claim:
    def finding(law: str) -> Finding:
        values = _exponents(bench, clearance, law)
        positive, answer = _mostly(values > 0, np.isfinite(values))
        taken = estimate(values)
        return Finding((f"λ₁ = {said(taken, '1/s')}", said(taken, "a revolution", PERIOD), f"above zero: {positive.format('starts')}"), answer)

    words = f"The largest exponent is positive, the motion chaotic, at {clearance:g} mm: neighbours that follow the equations, most starts."
    return claim("Fig. 19", words, finding)


def _series(bench: Bench, law: str) -> list[Pair]:
    """Of each member: the rules' own statistics of x(t), and those with the print's dimension and a line over its window."""
    result = bench.result("series", "0.1mm", "settled", law)
    found = []
    for member in result["member"].values[slideway.finished(result).values]:
        own = slideway.stats(result, "x", int(member))
        delay = _number(own, "delay")
        try:
            line = slideway.stats(result, "x", int(member), delay=delay, dimension=PRINTED["dimension"], fit=f"0..{PRINTED['window']}")
        except slideway.SlidewayError:
            line = None  # too few points for that embedding
        found.append((own, line))
    return found


def _of(series: Series, law: str, number: Callable[[slideway.SeriesStatistics], float]) -> np.ndarray:
    """A number of each series of a law."""
    return np.array([number(own) for own, _ in series[law]], dtype=float)


def _slope(statistics: slideway.SeriesStatistics | None) -> float:
    return np.nan if statistics is None or statistics.exponent is None else statistics.exponent


def _by_series(series: Series) -> Claim:
    def finding(law: str) -> Finding:
        chaotic = _of(series, law, lambda own: own.text.get("verdict", "").startswith("consistent with chaos")) > 0
        words, answer = _mostly(chaotic, np.ones(chaotic.size, bool))
        slopes = estimate(_of(series, law, _slope))
        lines = (
            f"consistent with chaos: {words.format('series')}",
            f"0–1 test K = {said(estimate(_of(series, law, lambda own: _leading(own, '0-1 test'))), '')}",
            f"a line is found in {slopes.count} of {len(series[law])}" + (f": {said(slopes, '1/s')}" if slopes.count else ""),
        )
        return Finding(lines, answer)

    return claim("Fig. 19, 4.7.2", "The series x(t) alone shows the chaos: exponential growth along a line, by rule, not by eye.", finding)


def _by_line(series: Series) -> Claim:
    def finding(law: str) -> Finding:
        taken = estimate(np.array([_slope(line) for _, line in series[law]]))
        answer = None if not np.isfinite(taken.half_width) else True if taken.low > 0 else False
        return Finding((f"slope {said(taken, '1/s')}", said(taken, "a revolution", PERIOD)), answer)

    words = "A positive slope shows the chaos: m = 11 and a line through the first 80 samples of the divergence of x(t)."
    found = claim("Fig. 19", words, finding)
    both = all(one.answer for one in found.findings.values())
    return replace(found, verdict=Verdict("positive where there is no chaos too: it shows nothing", "no")) if both else found


def _embedding(series: Series) -> list[Claim]:
    """Eq. (19) beside the same procedure on x(t)."""
    untold = Verdict("cannot be told from the scan: the sampling is not given", UNTOLD.kind)
    no_unit = Verdict("cannot be told: P has no unit; in seconds it is a tenth of a revolution, which is not the period of x(t)", UNTOLD.kind)

    def of(law: str, label: str) -> np.ndarray:
        return _of(series, law, lambda own: _number(own, label))

    def window(law: str) -> np.ndarray:
        return _of(series, law, _window)

    def delays(law: str) -> tuple[str, str]:
        step, delay = _step(series[law]), of(law, "delay")
        apart = said(estimate(delay * step / PRINTED["delay"]), "ms", 1e3)
        return f"{said(estimate(delay), 'samples')} of {1e3 * step:g} ms", f"8, were they {apart} apart"

    def windows(law: str) -> tuple[str, str]:
        return said(estimate(window(law)), "samples"), said(estimate(window(law) / of(law, "delay")), "delays")

    def dimensions(law: str) -> tuple[str, str]:
        formula, borne = estimate(window(law) / of(law, "delay") + 1), estimate(of(law, "dimension"))
        return f"m = {said(formula, '')} from the same formula", f"{said(borne, '')} that these points can bear"

    def periods(law: str) -> tuple[str, str]:
        period = _of(series, law, lambda own: _leading(own, "average period"))
        return said(estimate(period), "s"), said(estimate(period / PERIOD), "revolutions")

    every = (("τ = 8 samples", delays, untold), ("t_w = 80 samples, ten delays", windows, untold), ("m = t_w/τ + 1 = 11", dimensions, untold),
             ("P = 0.2147, the average period by FFT (no unit)", periods, no_unit))  # fmt: skip
    return [claim("Eq. (19)", f"{words}.", lambda law, lines=lines: Finding(lines(law), None), verdict) for words, lines, verdict in every]


def _step(series: Sequence[Pair]) -> float:
    own = series[0][0]
    return _found(r"every (\S+) s", own.text["points"])


def _number(statistics: slideway.SeriesStatistics, label: str) -> int:
    """The first whole number of a row."""
    return int(_found(r"(\d+)", statistics.text[label]))


def _window(statistics: slideway.SeriesStatistics) -> float:
    """The C–C method's window [samples]: where S_cor is least."""
    return _found(r"minimum of S_cor (\d+)", statistics.text["C-C method"])


def _found(pattern: str, text: str) -> float:
    found = re.search(pattern, text)
    return float(found[1]) if found else float("nan")


def _leading(statistics: slideway.SeriesStatistics, label: str) -> float:
    found = re.match(r"(?:K = )?(-?[\d.]+(?:e[-+]?\d+)?)", statistics.text.get(label, ""))
    return float(found[1]) if found else float("nan")


def _history(bench: Bench, law: str) -> Panel:
    panel = panel_of(slideway.plot.exponent_history, bench.result("exponent", "0.1mm", "settled", law))
    # A few starts that still ring, at 1e3, would hide on which side of zero the others are.
    return replace(panel, y=replace(panel.y, low=None, high=None, linear=0.1))


def _divergence(series: Series, law: str) -> Panel:
    marks: list[Mark] = []
    for number, (_, line) in enumerate(series[law]):
        if line is None:
            continue
        marks.append(Curve(line.time, line.mean_log_distance, "neighbours, each start" if number == 0 else None, opacity=0.7, width=0.8))
        if line.exponent is not None and line.fit is not None:
            marks.append(Curve(*fitted(line, *line.fit), "line over 80 samples" if number == 0 else None, colours[1], 0.7, 1.6))
    return Panel(marks, Axis("time", "s", tight=True), Axis("mean ln distance"))
