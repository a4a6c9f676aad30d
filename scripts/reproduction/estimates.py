"""Means with their intervals, and what a difference of two ensembles says."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np
from slideway.intervals import student_t

MARGIN = 0.05
"""A change of less than this share of the first mean counts as none: an ensemble of quiet sliders tells differences of 1e-9."""


@dataclass(frozen=True)
class Estimate:
    """The mean of an ensemble.

    Attributes:
        mean: of the members with a number, in their unit; NaN where there is none.
        half_width: of its 95 % interval (Student); NaN for fewer than two members.
        median: of the members.
        count: of the members.
    """

    mean: float
    half_width: float
    median: float
    count: int

    @property
    def low(self) -> float:
        return self.mean - self.half_width

    @property
    def high(self) -> float:
        return self.mean + self.half_width


class Change(Enum):
    RISES = "rises"
    FALLS = "falls"
    SAME = "is the same"
    UNDECIDED = "undecided"


@dataclass(frozen=True)
class Difference:
    """From one ensemble to another.

    Attributes:
        mean, half_width: of the difference of the means, 95 % (Welch), in their unit.
        base: the first mean.
        change: what the interval says, with MARGIN of the base.
    """

    mean: float
    half_width: float
    base: float
    change: Change


def estimate(values: np.ndarray) -> Estimate:
    """Mean of independent members; what is not finite (a member that failed) is left out.

    >>> e = estimate(np.array([1.0, 2.0, 3.0]))
    >>> e.mean, round(e.half_width, 2)
    (2.0, 2.48)
    """
    there = _finite(values)
    if there.size == 0:
        return Estimate(np.nan, np.nan, np.nan, 0)
    half = student_t(there.size - 1) * float(there.std(ddof=1)) / np.sqrt(there.size) if there.size > 1 else np.nan
    return Estimate(float(there.mean()), float(half), float(np.median(there)), int(there.size))


def difference(first: np.ndarray, second: np.ndarray, margin: float = MARGIN) -> Difference:
    """Whether a positive quantity differs between two independent ensembles.

    Rises: the whole interval of the difference lies above `margin` of the first mean, and the medians say so too, for the mean
    of a few that still ring is no statement about all. Falls: likewise below. The same: within the margin. Else undecided.
    """
    a, b = _finite(first), _finite(second)
    if min(a.size, b.size) < 2:
        return Difference(np.nan, np.nan, np.nan, Change.UNDECIDED)
    variances = np.array([a.var(ddof=1) / a.size, b.var(ddof=1) / b.size])
    # Welch and Satterthwaite; rounded down, so that the interval is rather too wide.
    total = float(variances.sum())
    freedom = total**2 / float((variances**2 / [a.size - 1, b.size - 1]).sum()) if total > 0 else a.size + b.size - 2
    half = student_t(max(1, int(freedom))) * np.sqrt(total)
    mean, base = float(b.mean() - a.mean()), float(a.mean())
    least, middle = margin * abs(base), float(np.median(b) - np.median(a))
    change = Change.UNDECIDED
    if mean - half > least and middle > 0:
        change = Change.RISES
    elif mean + half < -least and middle < 0:
        change = Change.FALLS
    elif abs(mean) + half <= least:
        change = Change.SAME
    return Difference(mean, float(half), base, change)


def grows(columns: list[np.ndarray], margin: float = MARGIN) -> bool | None:
    """Whether a quantity grows from ensemble to ensemble: from the first to the last, and never falling between.

    Returns:
        True, False, or None where the members do not decide it.
    """
    whole = difference(columns[0], columns[-1], margin).change
    steps = [difference(a, b, margin).change for a, b in zip(columns, columns[1:])]
    if whole in (Change.SAME, Change.FALLS) or Change.FALLS in steps:
        return False
    return True if whole is Change.RISES else None


def _finite(values: np.ndarray) -> np.ndarray:
    flat = np.asarray(values, dtype=float).ravel()
    return np.asarray(flat[np.isfinite(flat)])


@dataclass(frozen=True)
class Share:
    """A share of members with Wilson's 95 % interval."""

    mean: float
    low: float
    high: float


def share(hits: np.ndarray, there: np.ndarray) -> Share:
    """The share of members that hit, of those that are there (Wilson 1927).

    >>> s = share(np.array([True] * 8 + [False] * 2), np.ones(10, bool))
    >>> s.mean, round(s.low, 3), round(s.high, 3)
    (0.8, 0.49, 0.943)
    """
    count, good = int(np.sum(there)), int(np.sum(hits & there))
    if count == 0:
        return Share(np.nan, 0.0, 1.0)
    z, p = 1.959963984540054, good / count
    middle, half = p + z**2 / (2 * count), z * np.sqrt(p * (1 - p) / count + z**2 / (4 * count**2))
    return Share(p, float((middle - half) / (1 + z**2 / count)), float((middle + half) / (1 + z**2 / count)))
