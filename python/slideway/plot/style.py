"""What all plots share: axes, units, colours, and the members that they show."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from typing import Any, Concatenate, ParamSpec, Union, cast

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from .. import arguments
from ..errors import SlidewayError
from ..members import finished, numbers, with_members
from ..palette import colours
from ..scenes import scene
from .legends import place_legend

Members = Union[int, Sequence[int], None]
P = ParamSpec("P")

most_lines = 8  # members that are drawn one by one

_spatial = ("z", "vz", "az", "roll", "yaw", "wx", "wy")  # series of spatial mechanisms
_prefixed = ("m", "s", "N", "J", "Pa", "Hz", "rad", "m s-1", "rad s-1", "N m")
_prefixes = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"))
_spellings = {"m s-1": "m/s", "m s-2": "m/s²", "rad s-1": "rad/s", "s-1": "1/s", "N m": "N m"}


def of_result(function: Callable[Concatenate[xr.Dataset, P], Axes]) -> Callable[Concatenate[xr.Dataset, P], Axes]:
    """A plot of a result, which may also be one member of it (``result.sel(member=0)``); all its errors have one line."""

    @functools.wraps(function)
    def drawn(result: xr.Dataset, *given: P.args, **named: P.kwargs) -> Axes:
        return function(with_members(result), *given, **named)

    return cast(Callable[Concatenate[xr.Dataset, P], Axes], arguments.one_line(drawn))


def axis(ax: Axes | None) -> Axes:
    """The axis given, or one of a new figure."""
    if ax is not None and not isinstance(ax, Axes):
        raise SlidewayError(f"ax is {arguments.shown(ax)}; give one axis of matplotlib, such as plt.subplots()[1]")
    return ax if ax is not None else plt.subplots(figsize=(7.2, 4.2), layout="constrained")[1]


def scaled(units: str, values: Any) -> tuple[float, str]:
    """The factor that brings values into a handy unit, and this unit.

    >>> scaled("m", [2e-5, -8e-5])
    (1000000.0, 'µm')
    >>> scaled("s-1", [640.0])
    (1.0, '1/s')
    """
    plain = _spellings.get(units, "" if units == "1" else units)
    numbers = np.abs(np.asarray(values, dtype=float))
    largest = np.max(numbers[np.isfinite(numbers)], initial=0.0)
    if units not in _prefixed or largest == 0:
        return 1.0, plain
    for size, prefix in _prefixes:
        # Large numbers keep their unit a little longer: 3,900 N reads better than 3.9 kN beside a limit of 1,000 N.
        if largest >= (10 * size if size > 1 else size * (1 - 1e-9)):
            break
    if units in ("s", "rad") and size > 1:
        size, prefix = 1.0, ""
    return 1.0 / size, prefix + plain


def label(words: str, unit: str) -> str:
    """ "y [µm]", or the words alone of a number without unit."""
    return f"{words} [{unit}]" if unit else words


def numbered(symbol: str, number: int) -> str:
    """A symbol with its number below.

    >>> numbered("λ", 12)
    'λ₁₂'
    """
    return symbol + "".join("₀₁₂₃₄₅₆₇₈₉"[int(digit)] for digit in str(number))


def plus_minus(value: float, error: float) -> str:
    """A value and its error, to two digits of the error.

    >>> plus_minus(684.52, 103.2), plus_minus(-0.04512, 0.0031)
    ('680 ± 100', '-0.0451 ± 0.0031')
    """
    if not (np.isfinite(error) and error > 0):
        return f"{value:.4g}"
    places = 1 - int(np.floor(np.log10(error)))
    return f"{round(value, places):.{max(places, 0)}f} ± {round(error, places):.{max(places, 0)}f}"


def words_of(name: str) -> str:
    """A variable's name as words."""
    return name.replace("_", " ")


def variable(result: xr.Dataset, name: str) -> xr.DataArray:
    """A variable of a result.

    Raises:
        SlidewayError: it is not there; the text says which key of the scene stores it.
    """
    if arguments.text(name, "name") in result:
        return result[name]
    if name in _spatial and kind_of(result) == "planar_slider_crank":
        raise SlidewayError(f"a planar_slider_crank moves in one plane and has no {name}; take x, y or pitch")
    if result.attrs.get("store") == "statistics":
        raise SlidewayError(f'this result holds statistics alone, and no {name}; run it with study.store = "members"')
    if "section" in name:
        raise SlidewayError(f'this result has no {name}; use study.kind = "poincare" or "sweep"')
    if name.startswith("lyapunov"):
        raise SlidewayError(f'this result has no {name}; use study.kind = "lyapunov", or "sweep" with study.exponents = 1')
    if "sample" not in result.dims and not name.startswith(("peak_", "max_", "min_", "mean_", "rms_", "final_")):
        raise SlidewayError(
            f'this result has no {name}; add study.samples_per_revolution = 200 for a time series, and "{name}" to study.quantities if it is no state'
        )
    raise SlidewayError(f'this result has no {name}; add "{name}" to study.quantities')


def series_of(result: xr.Dataset, name: str) -> xr.DataArray:
    """A variable along member and sample.

    Raises:
        SlidewayError: it is not there, or no series.
    """
    data = variable(result, name)
    if set(data.dims) != {"member", "sample"}:
        raise SlidewayError(f"{name} is no series over the time; see slideway.plot.quantiles")
    return data.transpose("member", "sample")


def kind_of(result: xr.Dataset) -> str:
    """mechanism.kind of the result's scene, empty where it carries none."""
    return str(scene(result)["mechanism"]["kind"]) if "scene" in result.attrs else ""


def chosen(result: xr.Dataset, member: Members) -> list[int]:
    """Numbers of the members to show: those given, or all of which there are any numbers.

    Raises:
        SlidewayError: one of them is not in the result.
    """
    there = numbers(result)
    if not there:
        raise SlidewayError('this result holds no members; run it with study.store = "members"')
    return there if member is None else arguments.members(member, there)


def failures(result: xr.Dataset, members: Sequence[int]) -> int:
    """How many of the members did not finish."""
    return int((~finished(result).sel(member=list(members))).sum()) if "status" in result else 0


def draw_members(ax: Axes, time: np.ndarray, rows: np.ndarray, members: Sequence[int], failed: int, coarse: str | None = None) -> None:
    """Series of members over the time: lines of few, the bands in which many of them lie.

    Args:
        rows: member × time, in the units of the axis; NaN where a member has nothing.
        coarse: why the samples of a member are not joined, if so.
    """
    if len(members) <= most_lines:
        style = {"ls": "-", "lw": 1.0} if coarse is None else {"ls": "none", "marker": ".", "ms": 3.0, "mew": 0}
        for number, row, colour in zip(members, rows, colours, strict=False):
            ax.plot(time, row, color=colour, label=f"member {number}" if len(members) > 1 else None, **style)  # type: ignore[arg-type]
        if coarse is not None:
            ax.plot([], [], " ", label=coarse)
    else:
        levels = np.full((5, time.size), np.nan)
        some = np.isfinite(rows).any(axis=0)
        levels[:, some] = np.nanquantile(rows[:, some], (0.0, 0.05, 0.5, 0.95, 1.0), axis=0)
        note = f" ({failed} failed)" if failed else ""
        ax.fill_between(time, levels[0], levels[4], color=colours[0], alpha=0.15, lw=0, label=f"all {len(members)} members{note}")
        ax.fill_between(time, levels[1], levels[3], color=colours[0], alpha=0.35, lw=0, label="90 % of them")
        ax.plot(time, levels[2], color=colours[0], lw=1.4, label="median")
    ax.margins(x=0)


def finish(ax: Axes, x: str, y: str) -> Axes:
    """Labels, a light grid and, where there is something to tell, a legend that covers no data."""
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    ax.grid(True, color="#DDDDDD", lw=0.6)
    ax.set_axisbelow(True)
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)
    if ax.get_legend_handles_labels()[1]:
        place_legend(ax)
    return ax
