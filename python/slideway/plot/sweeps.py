"""What changes with a parameter."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from ..arguments import text, whole
from ..errors import SlidewayError
from ..palette import colours, grey
from ..scenes import scene
from ..sections import sections
from .style import axis, finish, label, numbered, of_result, scaled, variable, words_of


@of_result
def bifurcation(result: xr.Dataset, name: str = "y", ax: Axes | None = None) -> Axes:
    """A state at the sections over the parameter of a sweep.

    Args:
        name: of the state.

    Raises:
        SlidewayError: the result is no sweep, or its sections have no such state.

    >>> slideway.plot.bifurcation(slideway.example(), "vy").get_xlabel()
    'joint.clearance [µm]'
    """
    key, parameter = _parameter(result)
    rows = sections(result)
    if text(name, "name") not in rows:
        raise SlidewayError(f"the sections have no {name}, but {', '.join(str(v) for v in rows.data_vars)}")
    at = parameter.sel(member=rows["member"].values).values
    values = rows[name].values
    (fx, unit_x), (fy, unit_y) = scaled(str(parameter.attrs["units"]), at), scaled(str(rows[name].attrs["units"]), values)
    ax = axis(ax)
    size = float(np.clip(4000 / max(values.size, 1), 0.6, 12))
    ax.scatter(fx * at, fy * values, s=size, color=colours[0], alpha=0.7, lw=0, rasterized=values.size > 20000)
    return finish(ax, label(key, unit_x), label(f"{words_of(name)} at the sections", unit_y))


@of_result
def exponent_sweep(result: xr.Dataset, ax: Axes | None = None, *, exponent: int = 1) -> Axes:
    """A Lyapunov exponent over the parameter of a sweep: each member, and the median of each column.

    Raises:
        SlidewayError: the result is no sweep, or has no exponents.

    >>> slideway.plot.exponent_sweep(slideway.example()).get_ylabel()
    'λ₁ [1/s]'
    """
    key, parameter = _parameter(result)
    data = variable(result, "lyapunov_exponent")
    if whole(exponent, "exponent", 1) > data.sizes["exponent"]:
        raise SlidewayError(f"there is no exponent {exponent} in this result; use study.exponents = {exponent}")
    values, at = data.isel(exponent=exponent - 1).values, parameter.values
    factor, unit = scaled(str(parameter.attrs["units"]), at)
    columns = np.unique(at)
    middle = [np.median(own) if (own := values[(at == c) & np.isfinite(values)]).size else np.nan for c in columns]
    ax = axis(ax)
    ax.axhline(0, color=grey, lw=1)
    ax.plot(factor * at, values, "o", ms=3, color=colours[0], alpha=0.5, mew=0, label="members")
    ax.plot(factor * columns, middle, color=colours[1], lw=1.4, label="median")
    return finish(ax, label(key, unit), f"{numbered('λ', exponent)} [1/s]")


def _parameter(result: xr.Dataset) -> tuple[str, xr.DataArray]:
    """The key that a sweep changes, and its value of each member."""
    name = str(result.attrs.get("sweep_parameter", ""))
    if not name:
        raise SlidewayError('this result is no sweep; use study.kind = "sweep"')
    if name not in result:
        raise SlidewayError(f"this result has lost {name}, which its sweep changes; keep the variable")
    return str(scene(result)["study"]["parameter"]), result[name]
