"""Sections of orbits, which are ragged: every member has its own number of them."""

from __future__ import annotations

import xarray as xr

from .errors import SlidewayError


def sections(result: xr.Dataset, member: int | None = None) -> xr.Dataset:
    """Sections of all members, or of one of them.

    Args:
        result: of a poincare or sweep study.
        member: number of the member in the scene's ensemble; left out: all of them.

    Returns:
        Variables along ``section`` without the prefix they have in the file (``time``, ``y``, ``vy`` ...), units in their
        attributes, and the coordinate ``member``, whose section it is.

    Raises:
        SlidewayError: there are no sections in this result, or no such member.

    >>> one = slideway.sections(slideway.example(), member=2)
    >>> one.y.sizes["section"], one.vy.units
    (40, 'm s-1')
    """
    if "section_member" not in result.coords:
        raise SlidewayError('this result has no sections; use study.kind = "poincare" or "sweep"')
    prefix = "section_"
    names = {
        str(name): str(name).removeprefix(prefix)
        for name in result.variables
        if result[name].dims == ("section",) and str(name).startswith(prefix)
    }
    rows = result[[name for name in names if name != "section_member"]].rename(names)
    if member is None:
        return rows
    if member not in result["member"].values:
        raise SlidewayError(f"there is no member {member} in this result; see its coordinate member")
    return rows.isel(section=(rows["member"] == member).values)
