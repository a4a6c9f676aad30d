"""How members ended."""

from __future__ import annotations

import numpy as np
import xarray as xr

from .errors import SlidewayError


def statuses(result: xr.Dataset) -> xr.DataArray:
    """How each member ended, in words: "finished", "max_steps", "geometry" ...

    Returns:
        Words along ``member``.

    Raises:
        SlidewayError: the result holds no members (study.store = "statistics").

    >>> slideway.statuses(slideway.example()).values[:3]
    array(['finished', 'finished', 'finished'], dtype='<U15')
    """
    if "status" not in result:
        raise SlidewayError(
            "this result holds no members, for its scene says study.store = \"statistics\"; its group statistics counts how "
            "they ended"
        )
    status = result["status"]
    words = str(status.attrs["flag_meanings"]).split()
    by_value = dict(zip((int(value) for value in np.atleast_1d(status.attrs["flag_values"])), words, strict=True))
    return xr.DataArray(
        np.array([by_value.get(int(value), f"status {int(value)}") for value in status.values], dtype="<U15"),
        dims=status.dims,
        coords=status.coords,
        attrs={"long_name": status.attrs.get("long_name", "how the member ended")},
        name="status",
    )


def finished(result: xr.Dataset) -> xr.DataArray:
    """Which members finished: true or false along ``member``.

    >>> int(slideway.finished(slideway.example()).sum())
    11
    """
    return statuses(result) == "finished"
