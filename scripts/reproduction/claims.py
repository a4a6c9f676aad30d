"""Claims of the paper, what each law gives for them, and the verdict."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from slideway.units import plus_minus

from .estimates import Estimate, difference, estimate, grows, share

LAWS = ("paper", "conservative")
LAW_WORDS = {"paper": "law as published", "conservative": "conservative law"}


@dataclass(frozen=True)
class Finding:
    """What one law gives for a claim.

    Attributes:
        lines: numbers with their intervals, in words.
        answer: does the claim hold? None: the data do not decide it.
    """

    lines: tuple[str, ...]
    answer: bool | None


@dataclass(frozen=True)
class Verdict:
    """A verdict in words, and how a page colours it: "yes", "part", "no" or "open"."""

    words: str
    kind: str


@dataclass(frozen=True)
class Claim:
    """One claim of the paper.

    Attributes:
        place: where it stands, "Fig. 12a".
        words: the claim in our own words.
        findings: by law.
        verdict: of both laws together.
    """

    place: str
    words: str
    findings: Mapping[str, Finding]
    verdict: Verdict


def judge(paper: bool | None, conservative: bool | None) -> Verdict:
    """The verdict of the two answers.

    >>> judge(True, False).words
    "holds only under the paper's law"
    """
    if paper is None and conservative is None:
        return Verdict("cannot be told from these runs", "open")
    if None in (paper, conservative):
        known, other = ("the paper's law", "the conservative one") if conservative is None else ("the conservative law", "the paper's")
        holds = "holds" if (paper if conservative is None else conservative) else "does not hold"
        return Verdict(f"{holds} under {known}, undecided under {other}", "open")
    if paper and conservative:
        return Verdict("holds", "yes")
    if paper:
        return Verdict("holds only under the paper's law", "part")
    if conservative:
        return Verdict("holds only under the conservative law", "part")
    return Verdict("does not hold", "no")


UNTOLD = Verdict("cannot be told from the scan", "open")


def claim(place: str, words: str, finding: Callable[[str], Finding], verdict: Verdict | None = None) -> Claim:
    """A claim with what each law gives for it and the verdict of both, or with one that is given where the print lacks what a judgement needs."""
    findings = {law: finding(law) for law in LAWS}
    return Claim(place, words, findings, verdict or judge(findings["paper"].answer, findings["conservative"].answer))


def growth(
    place: str, words: str, labels: Sequence[str], columns: Mapping[str, Sequence[np.ndarray]], unit: str, factor: float = 1.0, floor: float = 0.0
) -> Claim:
    """The claim that a quantity grows from case to case.

    Args:
        labels: of the cases.
        columns: by law, the members' values in each case.
        factor: brings the values into `unit`.
        floor: where most starts of every case stay below it, nothing moves, and nothing can grow.
    """

    def finding(law: str) -> Finding:
        values = columns[law]
        taken = [estimate(v) for v in values]
        lines = [f"{name}: {said(t, unit, factor)}" for name, t in zip(labels, taken, strict=True)]
        whole = difference(values[0], values[-1])
        answer = grows(list(values))
        moving = [share(v > floor, np.isfinite(v)) for v in values]
        if floor > 0 and all(m.high < 0.5 for m in moving):
            lines.append(f"nothing moves in {100 * min(1 - m.mean for m in moving):.0f} % of the starts at least: below {factor * floor:.2g} {unit}".rstrip())
            answer = False
        elif np.isfinite(whole.half_width) and whole.base != 0:
            lines.append(f"{labels[0]} → {labels[-1]}: {percent(whole.mean / whole.base, whole.half_width / abs(whole.base))}")
        return Finding(tuple(lines), answer)

    return claim(place, words, finding)


def said(value: Estimate, unit: str, factor: float = 1.0) -> str:
    """A mean with its interval, to two digits of the half width.

    >>> said(Estimate(12.345, 0.678, 12.0, 8), "N")
    '12.35 ± 0.68 N'
    """
    return " ".join(filter(None, (plus_minus(factor * value.mean, factor * value.half_width), unit)))


def percent(mean: float, half: float) -> str:
    """A relative change with its interval; beyond a factor of four as a factor.

    >>> percent(0.1234, 0.02), percent(9.0, 1.0)
    ('+12.3 ± 2.0 %', '× 10.0 ± 1.0')
    """
    if mean > 3:
        return f"× {plus_minus(1 + mean, half)}"
    text = plus_minus(100 * mean, 100 * half)
    return ("" if text.startswith(("−", "(−")) else "+") + text + " %"
