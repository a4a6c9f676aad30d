"""What all figures share: members, units, words, and how a figure becomes a plot."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, ParamSpec, Union

import numpy as np
import xarray as xr

from .. import arguments
from ..errors import SlidewayError
from ..members import finished, numbers, with_members
from ..palette import colours
from ..scenes import scene
from .marks import Array, Band, Curve, Mark, Note, Panel

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Axes
else:
    Axes = object  # matplotlib takes its time, which pages need not

Members = Union[int, Sequence[int], None]
P = ParamSpec("P")

most_lines = 8  # members that are drawn one by one

_spatial = ("z", "vz", "az", "roll", "yaw", "wx", "wy")  # series of spatial mechanisms


def drawn(function: Callable[P, Panel]) -> Callable[P, Axes]:
    """A figure as a plot: on the axis `ax` or one of its own; all its errors have one line. A result may also be one member (``result.sel(member=0)``)."""
    signature = inspect.signature(function)

    @functools.wraps(function)
    def plot(*given: P.args, **named: P.kwargs) -> Axes:
        bound = signature.bind(*given, **named)
        ax = bound.arguments.pop("ax", None)
        if "result" in bound.arguments:
            bound.arguments["result"] = with_members(bound.arguments["result"])
        panel = function(*bound.args, **bound.kwargs)
        from ..plot.axes import draw

        return draw(panel, ax)

    return arguments.one_line(plot)


def panel_of(plot: Callable[..., Axes], *given: Any, **named: Any) -> Panel:
    """The figure that a plot draws, as data."""
    panel: Panel = inspect.unwrap(plot)(*given, **named)
    return panel


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


def by_contact(surface: Array, line: Array, point: Array) -> dict[str, Array]:
    """Which samples are of which class, by their hardest contact.

    >>> {name: there.tolist() for name, there in by_contact(*np.array([[False, True], [False, True], [True, False]])).items()}
    {'free': [False, False], 'point': [True, False], 'line': [False, False], 'surface': [False, True]}
    """
    return {"free": ~(surface | line | point), "point": point & ~line & ~surface, "line": line & ~surface, "surface": surface}


def failures(result: xr.Dataset, members: Sequence[int]) -> int:
    """How many of the members did not finish."""
    return int((~finished(result).sel(member=list(members))).sum()) if "status" in result else 0


def members_over(x: Array, rows: Array, members: Sequence[int], failed: int, coarse: str | None = None) -> list[Mark]:
    """Series of members: lines of few, the bands in which many of them lie.

    Args:
        rows: member × place, in the units of the axis; NaN where a member has nothing.
        coarse: why the samples of a member are not joined, if so.
    """
    if len(members) <= most_lines:
        style: dict[str, Any] = {"width": 1.0} if coarse is None else {"dash": "", "marker": ".", "size": 3.0}
        names = [f"member {number}" if len(members) > 1 else None for number in members]
        lines: list[Mark] = [Curve(x, row, name, colour, **style) for name, row, colour in zip(names, rows, colours, strict=False)]
        return lines if coarse is None else [*lines, Note(coarse)]
    levels = np.full((5, x.size), np.nan)
    some = np.isfinite(rows).any(axis=0)
    levels[:, some] = np.nanquantile(rows[:, some], (0.0, 0.05, 0.5, 0.95, 1.0), axis=0)
    note = f" ({failed} failed)" if failed else ""
    return [
        Band(x, levels[0], levels[4], f"all {len(members)} members{note}", opacity=0.15),
        Band(x, levels[1], levels[3], "90 % of them", opacity=0.35),
        Curve(x, levels[2], "median", width=1.4),
    ]


def exponent_of(data: xr.DataArray, number: int) -> xr.DataArray:
    """One of the exponents of each member, 1 the largest."""
    count = data.sizes["exponent"]
    if arguments.whole(number, "exponent", 1) > count:
        raise SlidewayError(f"there is no exponent {number} in this result, which has {count}; use study.exponents = {number}")
    return data.isel(exponent=number - 1)
