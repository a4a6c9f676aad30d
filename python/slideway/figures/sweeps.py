"""What changes with a parameter."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from ..errors import SlidewayError
from ..palette import colours
from ..scenes import scene
from ..units import lowered, scaled
from .base import drawn, exponent_of, variable
from .marks import Axis, Cloud, Curve, Level, Panel
from .orbits import at_sections, rows_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@drawn
def bifurcation(result: xr.Dataset, name: str = "y", ax: Axes | None = None) -> Panel:
    """A state at the sections over the parameter of a sweep.

    Args:
        name: of the state.

    Raises:
        SlidewayError: the result is no sweep, or its sections have no such state.

    >>> slideway.plot.bifurcation(slideway.example(), "vy").get_xlabel()
    'joint.clearance [µm]'
    """
    key, parameter = _parameter(result)
    rows = rows_of(result, name)
    at = parameter.sel(member=rows["member"].values).values
    factor, unit = scaled(str(parameter.attrs["units"]), at)
    values, y = at_sections(rows, name, " at the sections")
    return Panel([Cloud(factor * at, values, opacity=0.7, size=float(np.clip(4000 / max(values.size, 1), 0.6, 12)))], Axis(key, unit), y)


@drawn
def exponent_sweep(result: xr.Dataset, ax: Axes | None = None, *, exponent: int = 1) -> Panel:
    """A Lyapunov exponent over the parameter of a sweep: each member, and the median of each column.

    Raises:
        SlidewayError: the result is no sweep, or has no exponents.

    >>> slideway.plot.exponent_sweep(slideway.example()).get_ylabel()
    'λ₁ [1/s]'
    """
    key, parameter = _parameter(result)
    values, at = exponent_of(variable(result, "lyapunov_exponent"), exponent).values, parameter.values
    half = exponent_of(result["lyapunov_exponent_half_width"], exponent).values if "lyapunov_exponent_half_width" in result else np.nan * values
    factor, unit = scaled(str(parameter.attrs["units"]), at)
    members = Curve(factor * at, values, "members", opacity=0.5, dash="", marker="o", size=3, low=values - half, high=values + half)
    return Panel([Level(0.0), members, medians(factor, at, values)], Axis(key, unit), Axis(f"λ{lowered(exponent)}", "1/s"))


def medians(factor: float, at: np.ndarray, values: np.ndarray) -> Curve:
    """The medians of the columns, joined; `factor` brings the parameter into the unit of its axis."""
    columns, middle = medians_of(at, values)
    there = np.isfinite(middle)
    return Curve(factor * columns[there], middle[there], "median of the column", colours[1], width=1.4)


def medians_of(at: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The columns of a sweep, and of each the median of the members that have a number, NaN where none has."""
    columns = np.unique(at)
    parts = (values[(at == column) & np.isfinite(values)] for column in columns)
    return columns, np.array([np.median(part) if part.size else np.nan for part in parts])


def _parameter(result: xr.Dataset) -> tuple[str, xr.DataArray]:
    """The key that a sweep changes, and its value of each member."""
    name = str(result.attrs.get("sweep_parameter", ""))
    if not name:
        raise SlidewayError('this result is no sweep; use study.kind = "sweep"')
    if name not in result:
        raise SlidewayError(f"this result has lost {name}, which its sweep changes; keep the variable")
    return str(scene(result)["study"]["parameter"]), result[name]
