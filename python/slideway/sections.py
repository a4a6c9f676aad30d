"""Sections of orbits, which are ragged: every member has its own number of them."""

from __future__ import annotations

import numpy as np
import xarray as xr

from . import arguments
from .errors import SlidewayError
from .members import numbers, with_members


@arguments.one_line
def sections(result: xr.Dataset, member: int | None = None) -> xr.Dataset:
    """Sections of all members, or of one of them.

    Args:
        result: of a poincare or sweep study, or a selection of its members.
        member: number of the member in the scene's ensemble; left out: all in the result.

    Returns:
        Variables along ``section`` without the prefix they have in the file (``time``, ``y``, ``vy`` ...), units in their
        attributes, and the coordinate ``member``, whose section it is.

    Raises:
        SlidewayError: there are no sections in this result, or no such member.

    >>> one = slideway.sections(slideway.example(), member=2)
    >>> one.y.sizes["section"], one.vy.units
    (40, 'm s-1')
    >>> slideway.sections(slideway.example().sel(member=[0, 5])).sizes["section"]
    80
    """
    if "section_member" not in arguments.dataset(result).coords:
        raise SlidewayError('this result has no sections; use study.kind = "poincare" or "sweep"')
    there = numbers(with_members(result))
    wanted = there if member is None else arguments.members(member, there)
    prefix = "section_"
    names = {str(name): str(name).removeprefix(prefix) for name in result.variables if result[name].dims == ("section",) and str(name).startswith(prefix)}
    # A member selected by a scalar would stand in the way of whose section each is.
    rows = result[[name for name in names if name != "section_member"]].drop_vars("member", errors="ignore").rename(names)
    return rows.isel(section=np.isin(rows["member"].values, wanted))
