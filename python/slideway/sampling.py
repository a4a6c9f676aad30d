"""Whether samples follow the motion, or are so far apart that a line between them shows what never was."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray

_rates = {"x": "vx", "y": "vy", "z": "vz", "roll": "wx", "yaw": "wy", "pitch": "wz"}
_smooth = ("x", "vx", "crank_angle", "crank_speed")  # which contacts hardly change
_most = 0.25  # of a step that the rates at its ends may leave unexplained, in the middle one of the steps


def unexplained(time: NDArray[np.float64], values: NDArray[np.float64], rates: NDArray[np.float64]) -> float:
    """Which part of the step from sample to sample the rates at its two ends do not explain; the median over all steps.

    |Δv − Δt (r₀ + r₁)/2| / (|Δv| + Δt (|r₀| + |r₁|)/2), the trapezoid rule; next to 0 of samples that follow the motion, and of
    the size of 1 where contacts come and go between them. A slider at rest counts as 0.

    Args:
        time: of the samples [s], (n); values and their rates per second, (n).

    Returns:
        NaN of fewer than three samples.

    >>> t = np.linspace(0, 2, 201)
    >>> unexplained(t, np.sin(5 * t), 5 * np.cos(5 * t)) < 0.01, unexplained(t, np.sin(500 * t), 500 * np.cos(500 * t)) > 0.5
    (True, True)
    """
    there = np.isfinite(values) & np.isfinite(rates)
    time, values, rates = time[there], values[there], rates[there]
    if time.size < 3:
        return float("nan")
    step, span = np.diff(values), np.diff(time)
    miss = np.abs(step - span * (rates[1:] + rates[:-1]) / 2)
    size = np.abs(step) + span * (np.abs(rates[1:]) + np.abs(rates[:-1])) / 2
    return float(np.median(miss / (size + 1e-3 * np.ptp(values) + np.finfo(float).tiny)))


def sample_axis(result: xr.Dataset) -> tuple[NDArray[np.float64], str]:
    """Where the samples of all members lie, and the unit: times in s, or of a crank that turns freely and is sampled by angle its turns."""
    if "turned" in result.coords:
        return np.asarray(result["turned"].values) / (2 * np.pi), "turns"
    return np.asarray(result["time"].values), "s"


def too_coarse(result: xr.Dataset, members: Sequence[int], name: str = "y") -> bool:
    """Whether the samples of a series are far coarser than the contacts that shape it, for any of these members.

    Decided by :func:`unexplained` of y, which gravity keeps in contact, and of the series itself where its rate is stored. False where
    neither is, and of series that contacts hardly change.
    """
    if name in _smooth:
        return False
    time = result["time"] if "time" in result else xr.DataArray(np.array([]), dims="sample")
    for state in {"y", name} & _rates.keys():
        if {state, _rates[state]} <= set(result.data_vars) and "sample" in result[state].dims:
            rows = (result[which].sel(member=list(members)).values for which in (state, _rates[state]))
            times = time.sel(member=list(members)).values if "member" in time.dims else [time.values] * len(members)
            if any(unexplained(*row) > _most for row in zip(times, *rows, strict=True)):
                return True
    return False


def coarse_words(result: xr.Dataset) -> str:
    """What a reader has to know of samples that are too coarse, in two short lines of a legend.

    >>> coarse_words(xr.Dataset(coords={"time": ("sample", [0.0, 0.01, 0.02])}))
    'samples every 10 ms,\\nfar coarser than contacts'
    """
    places, unit = sample_axis(result)
    step = float(np.median(np.diff(places)))
    return f"samples every {f'{1e3 * step:.3g} ms' if unit == 's' else f'{360 * step:.3g}°'},\nfar coarser than contacts"
