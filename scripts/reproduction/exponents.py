"""Is the exponent positive: Fig. 19 and Eq. (19)."""

from __future__ import annotations

import re
from typing import Union

import numpy as np
import slideway
from matplotlib.axes import Axes
from slideway.palette import colours
from slideway.plot.axes import finish

from .claims import LAW_WORDS, LAWS, UNTOLD, Claim, Finding, Verdict, claim, plus_minus, said
from .estimates import estimate, share
from .plan import MAPS, crank
from .sections import Bench, Section, Table, draw

Series = list[tuple[slideway.SeriesStatistics, Union[slideway.SeriesStatistics, None]]]
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
        draw("How the exponent settles, 0.1 mm; linear within ±0.1 1/s, logarithmic beyond.", lambda law, ax: _history(bench, law, ax)),
        draw(
            "Fig. 19: mean ln distance of neighbours of x(t), each start; the line is fitted to the first 80 samples.",
            lambda law, ax: _divergence(series[law], ax),
        ),
    ]
    rows = []
    for words, c in MAPS.items():
        row = [words]
        for law in LAWS:
            values = _exponents(bench, c, law)
            row += [said(estimate(values), ""), said(estimate(values), "", PERIOD), plus_minus(float(np.nanmedian(values)), np.nan)]
        rows.append(row)
    columns = ("λ₁ [1/s]", "λ₁ a revolution", "median [1/s]")
    revolutions = bench.scale.exponent_transient + bench.scale.exponent_revolutions
    page.tables = [
        Table(
            "Largest exponent by neighbours, the second half of the record.", ["clearance", *(f"{LAW_WORDS[law]}: {w}" for law in LAWS for w in columns)], rows
        ),
        bench.audit("exponent", [(w, crank(c)) for w, c in MAPS.items()], "settled", revolutions),
    ]
    return page


def _exponents(bench: Bench, clearance: float, law: str) -> np.ndarray:
    """Second half of each member's record [1/s], after the transient of its start."""
    return bench.values("exponent", crank(clearance), "settled", law, "lyapunov_exponent_late")


def _by_neighbours(bench: Bench, clearance: float) -> Claim:
    findings = {}
    for law in LAWS:
        values = _exponents(bench, clearance, law)
        positive = share(values > 0, np.isfinite(values))
        taken = estimate(values)
        lines = (
            f"λ₁ = {said(taken, '1/s')}",
            f"{said(taken, 'a revolution', PERIOD)}",
            f"above zero: {100 * positive.mean:.0f} % of the starts [{100 * positive.low:.0f}, {100 * positive.high:.0f}]",
        )
        findings[law] = Finding(lines, True if positive.low > 0.5 else False if positive.high < 0.5 else None)
    return claim(
        "Fig. 19", f"The largest exponent is positive, the motion chaotic, at {clearance:g} mm: neighbours that follow the equations, most starts.", findings
    )


def _series(bench: Bench, law: str) -> Series:
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


def _by_series(series: dict[str, Series]) -> Claim:
    findings = {}
    for law in LAWS:
        verdicts = [own.text.get("verdict", "").splitlines()[0] for own, _ in series[law]]
        chaotic = np.array([v.startswith("consistent with chaos") for v in verdicts])
        taken = share(chaotic, np.ones(chaotic.size, bool))
        slopes = estimate(np.array([own.exponent if own.exponent is not None else np.nan for own, _ in series[law]]))
        lines = [
            f"consistent with chaos: {100 * taken.mean:.0f} % of the series [{100 * taken.low:.0f}, {100 * taken.high:.0f}]",
            f"0–1 test K = {said(estimate(np.array([_leading(own, '0-1 test') for own, _ in series[law]])), '')}",
            f"a line is found in {slopes.count} of {len(series[law])}" + (f": {said(slopes, '1/s')}" if slopes.count else ""),
        ]
        findings[law] = Finding(tuple(lines), True if taken.low > 0.5 else False if taken.high < 0.5 else None)
    return claim("Fig. 19, 4.7.2", "The series x(t) alone shows the chaos: exponential growth along a line, by rule, not by eye.", findings)


def _by_line(series: dict[str, Series]) -> Claim:
    findings = {}
    for law in LAWS:
        slopes = np.array([line.exponent if line is not None and line.exponent is not None else np.nan for _, line in series[law]])
        taken = estimate(slopes)
        answer = None if not np.isfinite(taken.half_width) else True if taken.low > 0 else False
        findings[law] = Finding((f"slope {said(taken, '1/s')}", f"{said(taken, 'a revolution', PERIOD)}"), answer)
    words = "A positive slope shows the chaos: m = 11 and a line through the first 80 samples of the divergence of x(t)."
    both = all(finding.answer for finding in findings.values())
    return claim("Fig. 19", words, findings, Verdict("positive where there is no chaos too: it shows nothing", "no") if both else None)


def _embedding(series: dict[str, Series]) -> list[Claim]:
    """Eq. (19) beside the same procedure on x(t)."""
    step = {law: _step(series[law]) for law in LAWS}
    rows: list[tuple[str, dict[str, Finding], Verdict]] = []
    untold = Verdict("cannot be told from the scan: the sampling is not given", UNTOLD.kind)

    def counts(label: str) -> dict[str, np.ndarray]:
        return {law: np.array([_number(own, label) for own, _ in series[law]], dtype=float) for law in LAWS}

    delay = counts("delay")
    window = {law: np.array([_window(own) for own, _ in series[law]]) for law in LAWS}
    rows.append(
        (
            "τ = 8 samples",
            {
                law: Finding(
                    (
                        f"{said(estimate(delay[law]), 'samples')} of {1e3 * step[law]:g} ms",
                        f"8, were they {said(estimate(delay[law] * step[law] / PRINTED['delay']), 'ms', 1e3)} apart",
                    ),
                    None,
                )
                for law in LAWS
            },
            untold,
        )
    )
    rows.append(
        (
            "t_w = 80 samples, ten delays",
            {law: Finding((f"{said(estimate(window[law]), 'samples')}", f"{said(estimate(window[law] / delay[law]), 'delays')}"), None) for law in LAWS},
            untold,
        )
    )
    rows.append(
        (
            "m = t_w/τ + 1 = 11",
            {
                law: Finding(
                    (
                        f"m = {said(estimate(window[law] / delay[law] + 1), '')} from the same formula",
                        f"{said(estimate(counts('dimension')[law]), '')} that these points can bear",
                    ),
                    None,
                )
                for law in LAWS
            },
            untold,
        )
    )
    period = {law: np.array([_leading(own, "average period") for own, _ in series[law]]) for law in LAWS}
    rows.append(
        (
            "P = 0.2147, the average period by FFT (no unit)",
            {law: Finding((f"{said(estimate(period[law]), 's')}", f"{said(estimate(period[law] / PERIOD), 'revolutions')}"), None) for law in LAWS},
            Verdict("cannot be told: P has no unit; in seconds it is a tenth of a revolution, which is not the period of x(t)", UNTOLD.kind),
        )
    )
    return [claim("Eq. (19)", f"{words}.", findings, verdict) for words, findings, verdict in rows]


def _step(series: Series) -> float:
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


def _history(bench: Bench, law: str, ax: Axes) -> None:
    slideway.plot.exponent_history(bench.result("exponent", "0.1mm", "settled", law), ax=ax)
    # Linear within ±0.1 1/s: a few starts that still ring, at 1e3, would hide on which side of zero the others are.
    ax.autoscale(axis="y")
    ax.set_yscale("symlog", linthresh=0.1)


def _divergence(series: Series, ax: Axes) -> None:
    for number, (_, line) in enumerate(series):
        if line is None:
            continue
        ax.plot(line.time, line.mean_log_distance, color=colours[0], lw=0.8, alpha=0.7, label="neighbours, each start" if number == 0 else None)
        if line.exponent is not None and line.fit is not None:
            time, values = line.time[line.fit[0] : line.fit[1] + 1], line.mean_log_distance[line.fit[0] : line.fit[1] + 1]
            ax.plot(
                time,
                values.mean() + line.exponent * (time - time.mean()),
                color=colours[1],
                lw=1.6,
                alpha=0.7,
                label="line over 80 samples" if number == 0 else None,
            )
    ax.margins(x=0)
    finish(ax, "time [s]", "mean ln distance")
