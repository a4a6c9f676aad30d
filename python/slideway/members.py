"""Members of a result: which they are, and how they ended."""

from __future__ import annotations

from collections import Counter

import numpy as np
import xarray as xr

from .arguments import dataset, one_line
from .errors import SlidewayError


@one_line
def statuses(result: xr.Dataset) -> xr.DataArray:
    """How each member ended, in words: "finished", "max_steps", "geometry" ...

    Returns:
        Words along ``member``; of ``result.sel(member=0)`` one word.

    Raises:
        SlidewayError: the result holds no members (study.store = "statistics").

    >>> slideway.statuses(slideway.example()).values[:3]
    array(['finished', 'finished', 'finished'], dtype='<U15')
    """
    if "status" not in dataset(result).data_vars:
        raise SlidewayError('this result holds no members, for its scene says study.store = "statistics"; its group statistics counts how they ended')
    status = result["status"]
    by_value = _meanings(status)
    said = [by_value.get(int(value), f"status {int(value)}") for value in np.ravel(status.values)]
    return xr.DataArray(
        np.array(said, dtype="<U15").reshape(status.shape),
        dims=status.dims,
        coords=status.coords,
        attrs={"long_name": status.attrs.get("long_name", "how the member ended")},
        name="status",
    )


def counts(result: xr.Dataset) -> Counter[str]:
    """How many members ended how, also of a result that holds statistics alone.

    >>> counts(slideway.example())
    Counter({'finished': 11, 'max_steps': 1})
    """
    if "status" in result.data_vars:
        return Counter(map(str, statuses(result).values))
    meanings = _meanings(result["status_value"])
    every = zip(result["status_value"].values.tolist(), result["status_count"].values.tolist(), strict=True)
    return Counter({meanings[value]: int(count) for value, count in every if count > 0})


def _meanings(status: xr.DataArray) -> dict[int, str]:
    """The words for each value of a status."""
    if not {"flag_meanings", "flag_values"} <= status.attrs.keys():
        raise SlidewayError("the statuses have lost their meanings; keep the attributes of what slideway.open returned")
    return dict(zip(map(int, np.atleast_1d(status.attrs["flag_values"])), str(status.attrs["flag_meanings"]).split(), strict=True))


@one_line
def finished(result: xr.Dataset) -> xr.DataArray:
    """Which members finished: true or false along ``member``.

    >>> int(slideway.finished(slideway.example()).sum())
    11
    """
    return statuses(result) == "finished"


def numbers(result: xr.Dataset) -> list[int]:
    """Numbers of the members in a result; none where it holds statistics alone.

    >>> numbers(slideway.example().sel(member=[4, 2])), numbers(slideway.example().sel(member=3))
    ([4, 2], [3])
    """
    return [int(number) for number in np.atleast_1d(result["member"].values)] if "member" in result.coords else []


def with_members(result: xr.Dataset) -> xr.Dataset:
    """A result whose members lie along a dimension: that which ``result.sel(member=0)`` has taken away is put back.

    Raises:
        SlidewayError: it does not say which member it is (``drop=True``).

    >>> one = slideway.example().sel(member=3)
    >>> "member" in one.y.dims, with_members(one).y.dims, with_members(one).section_y.dims
    (False, ('member', 'sample'), ('section',))
    """
    if "member" in dataset(result).dims:
        if "member" not in result.coords:
            raise SlidewayError("the members of this Dataset have lost their numbers; keep its coordinate member")
        return result
    if "status" not in result.data_vars and "member" not in result.coords:
        return result  # statistics alone, or a group
    if "member" not in result.coords:
        raise SlidewayError("this Dataset does not say which member it is; select with result.sel(member=...), without drop=True")
    # In a file that holds members, only their sections lie along no dimension member.
    own = {name: data.variable for name, data in result.data_vars.items() if "section" not in data.dims}
    wider = {name: (("member", *data.dims), data.values[np.newaxis], data.attrs, data.encoding) for name, data in own.items()}
    made = result.drop_vars("member").assign(wider)
    made.encoding = dict(result.encoding)
    return made.assign_coords(member=("member", numbers(result), result["member"].attrs))
