"""Growth of small differences."""

from __future__ import annotations

from typing import Union

import numpy as np
import xarray as xr

from ..errors import SlidewayError
from ..exponent_signs import half_width_of_mean
from ..members import with_members
from ..palette import colours
from ..series_statistics import SeriesStatistics, stats
from ..units import lowered, plus_minus, scaled
from .base import Axes, Members, chosen, drawn, exponent_of, failures, members_over, variable
from .marks import Array, Axis, Bars, Curve, Level, Mark, Note, Panel


@drawn
def divergence(
    curve: Union[SeriesStatistics, xr.Dataset], name: str = "y", member: int | None = None, ax: Axes | None = None, **options: object
) -> Panel:
    """How far neighbours of one series part, after Rosenstein, with the fitted line whose slope is the exponent.

    There is no line where `slideway stats` sees no exponential growth, though it gives the slope of a fit.

    Args:
        curve: what :func:`slideway.stats` returned, or a result, of which it is called (with `options`).
        name: of the series, where `curve` is a result.
        member: of the result; left out: its first.

    Raises:
        SlidewayError: the result has no such series, or too few samples.

    >>> import numpy as np
    >>> time = np.arange(20) * 1e-3
    >>> curve = slideway.SeriesStatistics({}, time, 600 * time - 12, 600.0, 5.0, (2, 12))
    >>> slideway.plot.divergence(curve).get_ylabel()
    'mean ln distance'
    """
    if isinstance(curve, xr.Dataset):
        variable(with_members(curve), name)
        curve = stats(curve, name, member, **options)  # type: ignore[arg-type]
    elif not isinstance(curve, SeriesStatistics) or options:
        raise SlidewayError("give what slideway.stats returned, or a result (Dataset) and the options of slideway.stats")
    factor, unit = scaled("s", curve.time)
    marks: list[Mark] = [Curve(factor * curve.time, curve.mean_log_distance, "neighbours of the series", width=0.8, marker=".")]
    if curve.growth_is_seen and curve.exponent is not None and curve.fit is not None:
        time, line = fitted(curve, *curve.fit)
        words = f"λ₁ = ({plus_minus(curve.exponent, curve.error or 0)}) 1/s, samples {curve.fit[0]} to {curve.fit[1]}"
        marks.append(Curve(factor * time, line, words, colours[1], width=2.2))
    else:
        marks.append(Note("no exponential growth is seen" if curve.exponent is not None else "no line to fit"))
    return Panel(marks, Axis("time", unit), Axis("mean ln distance"))


def fitted(curve: SeriesStatistics, first: int, last: int) -> tuple[Array, Array]:
    """Times of the first to the last sample of a fit, and the line through them."""
    time, values = curve.time[first : last + 1], curve.mean_log_distance[first : last + 1]
    return time, values.mean() + (curve.exponent or 0.0) * (time - time.mean())


@drawn
def exponent_history(result: xr.Dataset, member: Members = None, ax: Axes | None = None, *, exponent: int = 1) -> Panel:
    """How a Lyapunov exponent settles with the time over which it is taken, or where members have different ones with their rescalings.

    Args:
        member: number of a member, or several; left out: all.
        exponent: its number, 1 the largest.

    Raises:
        SlidewayError: the result has no history (study.kind = "lyapunov", study.history > 0).

    >>> slideway.plot.exponent_history(slideway.example()).get_ylabel()
    'running λ₁ [1/s]'
    """
    data = exponent_of(variable(result, "lyapunov_history"), exponent)
    members = chosen(result, member)
    rows = data.sel(member=members).values
    every = (result["lyapunov_time"] / result["rescalings"]).sel(member=members).values
    if not np.isfinite(every).any():
        raise SlidewayError("none of these members finished; see slideway.statuses(result)")
    across, x = result["history"].values, Axis("rescalings", tight=True)
    if np.nanmax(every) - np.nanmin(every) <= 1e-6 * np.nanmin(every):  # the drives of all are as fast
        factor, unit = scaled("s", across * np.nanmin(every))
        across, x = factor * across * np.nanmin(every), Axis("time", unit, tight=True)
    if not np.isfinite(rows).any():
        raise SlidewayError("none of these members has a running exponent; see slideway.statuses(result)")
    # The first values are those of single stretches, and would flatten all others.
    later = rows[:, rows.shape[1] // 10 :]
    low, high = np.nanmin(later), np.nanmax(later)
    y = Axis(f"running λ{lowered(exponent)}", "1/s", low=min(low, 0) - 0.05 * (high - low), high=max(high, 0) + 0.1 * (high - low))
    return Panel([Level(0.0), *members_over(across, rows, members, failures(result, members))], x, y)


@drawn
def exponent_histogram(result: xr.Dataset, ax: Axes | None = None, *, exponent: int = 1, bins: int | str = "auto") -> Panel:
    """Lyapunov exponents of all members that finished, with their mean and its 95 % interval.

    Of a single member the interval of its own estimate is drawn; of a sweep each column by itself, for columns are different mechanisms.

    Args:
        exponent: its number, 1 the largest.
        bins: of numpy.histogram.

    Raises:
        SlidewayError: the result has no exponents, no member finished, or a sweep has more columns than colours.

    >>> slideway.plot.exponent_histogram(slideway.example()).get_xlabel()
    'λ₁ [1/s]'
    """
    data = exponent_of(variable(result, "lyapunov_exponent"), exponent).values
    there = np.isfinite(data)
    if not there.any():
        raise SlidewayError("no member has an exponent, for none finished; see slideway.statuses(result)")
    columns = _columns(result)
    marks: list[Mark] = []
    for number, (name, of_column) in enumerate(columns):
        values = data[of_column & there]
        if values.size == 0:
            continue
        half = _half_width(values, result, exponent, of_column & there)
        mean, tint = float(values.mean()), colours[1] if len(columns) == 1 else colours[number]
        if values.size > 1:
            # Equal exponents would make bins of no width.
            span = np.ptp(values) or max(abs(mean), 1.0) * 1e-3
            within = None if np.ptp(values) else (mean - span, mean + span)
            heights, edges = np.histogram(values, bins if within is None else 1, within)
            marks.append(Bars(edges, heights, None, colours[number], 0.7 if len(columns) == 1 else 0.45))
        missing = int(of_column.sum()) - values.size
        count = f"{values.size} members" + (f", {missing} failed" if missing else "") if of_column.sum() > 1 else "one member"
        marks.append(Level(mean, "x", f"{name}({plus_minus(mean, half)}) 1/s, {count}", tint, 2, half=half))
    alone = there.sum() == 1
    return Panel([*marks, Level(0.0, "x")], Axis(f"λ{lowered(exponent)}", "1/s"), Axis("" if alone else "members", ticks={} if alone else None))


def _columns(result: xr.Dataset) -> list[tuple[str, np.ndarray]]:
    """The members that a mean may be taken of, with what to call them: all, or those of each column of a sweep."""
    name = str(result.attrs.get("sweep_parameter", ""))
    if name not in result:
        return [("", np.ones(result.sizes["member"], dtype=bool))]
    at = result[name].values
    values = np.unique(at)
    if len(values) > len(colours):
        raise SlidewayError(f"this sweep has {len(values)} columns, too many to tell apart; use exponent_sweep, or select members")
    factor, unit = scaled(str(result[name].attrs["units"]), at)
    return [("" if len(values) == 1 else f"{factor * value:.4g} {unit}: ", at == value) for value in values]


def _half_width(values: np.ndarray, result: xr.Dataset, exponent: int, of: np.ndarray) -> float:
    """Of the 95 % interval: of the members' mean, or of the one member's own estimate."""
    if values.size > 1:
        half, late = (
            exponent_of(result[name], exponent).values[of] if name in result else None
            for name in ("lyapunov_exponent_half_width", "lyapunov_exponent_late")
        )
        return half_width_of_mean(values, half, late, result["lyapunov_time"].values[of] if "lyapunov_time" in result else None)
    if "lyapunov_exponent_half_width" in result:
        return float(exponent_of(result["lyapunov_exponent_half_width"], exponent).values[of][0])
    return float("nan")
