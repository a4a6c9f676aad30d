"""Distribution functions of members, and the one denominator of their shares: the members drawn from it that ran."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from .members import counts, numbers, statuses
from .scenes import scene

Array = NDArray[np.float64]


def drawn(result: xr.Dataset) -> NDArray[np.bool_]:
    """Which stored members are draws of the distribution: all, but of a saltelli design those of A and B, the first two of each row.

    The others repeat their inputs but for one, so that distributions and yields of the file leave them out. A selection that has no
    draws is taken as it is.
    """
    draws = _draws(result)
    return draws if draws.any() else ~draws


def whose(result: xr.Dataset) -> str:
    """What those members are called."""
    return "draws" if _is_radial(result) and _draws(result).any() else "members"


def _is_radial(result: xr.Dataset) -> bool:
    return "scene" in result.attrs and scene(result).get("study", {}).get("design") == "saltelli"


def _draws(result: xr.Dataset) -> NDArray[np.bool_]:
    there = np.asarray(numbers(result), dtype=int)
    return there % (len(scene(result)["study"]["vary"]) + 2) < 2 if _is_radial(result) else there >= 0


def ran(result: xr.Dataset) -> int:
    """How many drawn members ran: finished or failed. Shares of members that meet a limit are of these, and so are all others.

    >>> ran(slideway.example())
    12
    """
    if "status" in result.data_vars:
        return int(((statuses(result) != "not_run").values & drawn(result)).sum())
    return sum(count for status, count in counts(result).items() if status != "not_run")


def steps(values: ArrayLike, trials: int) -> tuple[Array, Array]:
    """The empirical distribution function: values in rising order, and the percentage of the trials that are no larger.

    F(v) jumps by 100/trials at each value and is flat between; where some trials failed it ends below 100.

    Args:
        values: of the members that finished, any unit; those that are no numbers are left out.
        trials: members that ran.

    >>> steps([3.0, 1.0, 2.0], 4)[1].tolist()
    [25.0, 50.0, 75.0]
    """
    there = np.asarray(values, dtype=float)
    there = np.sort(there[np.isfinite(there)])
    return there, 100 * np.arange(1, there.size + 1) / max(trials, 1)


def bounds(edges: Array, counts: Array, trials: int) -> tuple[Array, Array, Array]:
    """Where a distribution function lies of which only a histogram is known: it is exact at the edges of the bins.

    Args:
        edges: of the bins (n + 1), any unit; counts (n); trials: members that ran.

    Returns:
        Ends of each bin (2n), and there the least and the largest percentage that the function can have.

    >>> [part.tolist() for part in bounds(np.array([0.0, 1.0, 2.0]), np.array([1.0, 3.0]), 4)]
    [[0.0, 1.0, 1.0, 2.0], [0.0, 0.0, 25.0, 25.0], [25.0, 25.0, 100.0, 100.0]]
    """
    below = 100 * np.concatenate([[0.0], np.cumsum(counts)]) / max(trials, 1)
    return np.repeat(edges, 2)[1:-1], np.repeat(below[:-1], 2), np.repeat(below[1:], 2)
