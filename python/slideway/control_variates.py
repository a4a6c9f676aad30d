"""A mean of few costly members, made sharper by what is known of many cheap ones."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias, cast

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from .arguments import numbers, one_line, shown
from .errors import SlidewayError
from .intervals import student_t

_Values: TypeAlias = ArrayLike | xr.DataArray
_Column: TypeAlias = tuple[NDArray[np.int64], NDArray[np.float64]]  # members, ascending, and their values


@dataclass(frozen=True)
class ControlVariate:
    """What few costly and many cheap members say of the mean of the costly ones.

    Attributes:
        mean: the estimate.
        low, high: its 95 % interval (Student).
        correlation: multiple correlation of the costly values with the cheap ones.
        gain: what as short an interval from costly members alone would cost, over what these members cost.
        cheap_per_costly: cheap members for each costly one that make the gain largest; infinite where they cost nothing.
        pairs: members that both have.
        cheap: members of which the cheap values are known, the pairs included.
    """

    mean: float
    low: float
    high: float
    correlation: float
    gain: float
    cheap_per_costly: float
    pairs: int
    cheap: int


def _column(values: _Values, name: str) -> _Column:
    """Members and their values without those that are NaN."""
    found = numbers(values, name)
    if found.ndim != 1:
        raise SlidewayError(f"{name} is {shown(values)}, of {found.ndim} dimensions; give one value of each member")
    labels = values["member"].values if isinstance(values, xr.DataArray) and "member" in values.coords else np.arange(found.size)
    there = np.isfinite(found)
    order = np.argsort(labels[there], kind="stable")
    return labels[there][order].astype(np.int64), found[there][order]


def _common(columns: Sequence[_Column]) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """The members that all columns have, and their values, (members, columns)."""
    members = columns[0][0]
    for labels, _ in columns[1:]:
        members = np.intersect1d(members, labels)
    return members, np.stack([values[np.searchsorted(labels, members)] for labels, values in columns], axis=1)


@one_line
def control_variate(costly: _Values, cheap: _Values | Sequence[_Values], *, cost_ratio: float = 0.0) -> ControlVariate:
    """The mean of a costly quantity from few members, by its regression on cheap quantities of many.

    The regression estimator of double sampling (Cochran, Sampling Techniques, 3rd ed. 1977, section 12.6). Cheap values are those of
    the same members, for example with rigid instead of compliant contacts, or the inputs that they drew, and of more members besides. Draws
    are independent (study.design = "mc"): with one seed, the first members of a long study are those of a short one.

    Args:
        costly: a value of each member; 0 and 1 for a yield. Members are told by their number in a result, else by their place.
        cheap: values of more members, or several such.
        cost_ratio: cost of a cheap member over that of a costly one, for the gain.

    Raises:
        SlidewayError: too few members have both.

    >>> import numpy as np
    >>> random = np.random.default_rng(3)
    >>> cheap = random.normal(5, 1, 1000)
    >>> costly = cheap[:20] + random.normal(0, 0.1, 20)
    >>> found = slideway.control_variate(costly, cheap, cost_ratio=0.01)
    >>> round(found.mean, 2), bool(found.low < 5 < found.high), found.pairs, round(found.gain)
    (5.01, True, 20, 24)
    """
    if not cost_ratio >= 0:
        raise SlidewayError(f"cost_ratio is {shown(cost_ratio)}; give the cost of a cheap member over that of a costly one, 0 or more")
    several = isinstance(cheap, Sequence) and len(cheap) > 0 and not np.isscalar(cheap[0])
    known = _common([_column(values, "cheap") for values in (cast("Sequence[_Values]", cheap) if several else [cast("_Values", cheap)])])
    members, paired = _common([_column(costly, "costly"), *((known[0], column) for column in known[1].T)])
    n, of, controls = members.size, known[0].size, known[1].shape[1]
    freedom = n - 1 - controls
    if freedom < 2:
        raise SlidewayError(f"{n} members have costly and cheap values; give {controls + 3} or more, with the same numbers in both")

    values, others = paired[:, 0], paired[:, 1:]
    centred = others - others.mean(axis=0)
    slopes = np.linalg.lstsq(centred, values - values.mean(), rcond=None)[0]
    shift = known[1].mean(axis=0) - others.mean(axis=0)
    # What the regression leaves is known of the pairs, what it explains of all.
    left = float(np.sum((values - values.mean() - centred @ slopes) ** 2)) / freedom
    explained = float(np.var(known[1] @ slopes, ddof=1))
    spread = left * (1 / n + float(shift @ np.linalg.pinv(centred.T @ centred) @ shift)) + explained / of
    mean = float(values.mean() + shift @ slopes)
    half = student_t(freedom) * math.sqrt(spread)
    best = math.sqrt(explained / (left * cost_ratio)) if left * cost_ratio > 0 else math.inf
    gain = (left + explained) / (spread * (n + cost_ratio * of)) if spread > 0 else math.inf
    correlation = math.sqrt(explained / (left + explained)) if explained > 0 else 0.0
    return ControlVariate(mean, mean - half, mean + half, correlation, gain, best, n, of)
