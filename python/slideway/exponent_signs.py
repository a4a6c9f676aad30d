"""What records of growth allow to say of the sign of exponents, by the rule of the program (docs/explanation/chaos.md)."""

from __future__ import annotations

import numpy as np
import xarray as xr

from . import arguments
from .errors import SlidewayError
from .intervals import student_t
from .members import finished

most_growth_of_a_power = 3 * float(np.log(2))  # of t³ from T/2 to T, as a logarithm
_words = np.array(["undecided", "no growth beyond a power of time", "above zero", "below zero"])
_stored = ("lyapunov_exponent", "lyapunov_exponent_half_width", "lyapunov_exponent_late", "lyapunov_time")


@arguments.one_line
def exponent_signs(result: xr.Dataset) -> xr.DataArray:
    """What may be said of the sign of each member's exponents: above zero, below zero, undecided, no growth beyond a power of time.

    A sign needs an interval that excludes 0 and offsets that grew in the second half of the record, less its own interval, by more
    than t³ does; where the interval alone excludes 0 there is no growth (or shrinking) beyond a power of time, which is undecided too.

    Args:
        result: with exponents, or a selection of its members.

    Returns:
        Words along ``member`` and ``exponent``; "undecided" of members that failed.

    Raises:
        SlidewayError: there are no exponents with intervals in this result.

    >>> str(slideway.exponent_signs(slideway.example()).values[0, 0])
    'above zero'
    """
    if missing := [name for name in _stored if name not in arguments.dataset(result)]:
        raise SlidewayError(f'this result has no {missing[0]}; use study.kind = "lyapunov" or "sweep", with study.exponents = 1 or more')
    rate, half, late, time = (result[name] for name in _stored)
    signs = _signs(rate.values, half.values, *_late_growth(late.values, half.values, time.values[:, None]))
    return rate.copy(data=np.where(finished(result).values[:, None], _words[signs], _words[0])).assign_attrs(
        units="1", long_name="sign of the exponent"
    )


def half_width_of_mean(rate: np.ndarray, half: np.ndarray | None, late: np.ndarray | None, time: np.ndarray | None) -> float:
    """Half the width of the 95 % interval of the mean of two or more members [1/s]: Student's, or what the mean and that of the second
    halves differ by if that is more; it reaches to 0 where the second halves did not grow beyond a power of time.  Rounding is left out.

    Args:
        rate, half, late, time: of each member (member): exponent, half-width, that of the second half, length of the record; None of
            what the result does not have.
    """
    student = _student(rate)
    if half is None or late is None or time is None:
        return student
    width = max(student, abs(float(rate.mean() - late.mean())))
    growth, own = _late_growth(late, half, time)
    own = own[np.isfinite(own)]
    swing = float(own.mean()) / np.sqrt(own.size) if own.size else 0.0
    sign = _signs(np.array(rate.mean()), np.array(width), np.array(growth.mean()), np.array(max(_student(growth), swing)))
    return max(width, abs(float(rate.mean()))) if sign == 1 else width


def _student(values: np.ndarray) -> float:
    return student_t(values.size - 1) * float(values.std(ddof=1)) / float(np.sqrt(values.size))


def _late_growth(late: np.ndarray, half: np.ndarray, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """ln of the growth from T/2 to T, and half the width of its interval."""
    return late * time / 2, half * time / np.sqrt(2)


def _signs(rate: np.ndarray, half: np.ndarray, growth: np.ndarray, growth_half: np.ndarray) -> np.ndarray:
    """Places in the words."""
    beyond = np.where(rate > 0, growth, -growth) - growth_half
    certain = (np.abs(rate) > half) & ~np.isnan(beyond)
    return np.where(~certain, 0, np.where(beyond > most_growth_of_a_power, np.where(rate > 0, 2, 3), 1))
