"""The resolved scene that every result carries."""

from __future__ import annotations

import re
import sys
from typing import Any

import xarray as xr

from .arguments import dataset, members, one_line
from .errors import SlidewayError
from .former_names import words_of_now
from .members import numbers, with_members

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

# A key whose value is derived from others stands in the resolved scene as a comment; in older results in other words.
_derived = re.compile(r"^# (\w+ = \S+  # (?:[^#\n]*, )?(?:derived: .*|follows from other keys))$", re.MULTILINE)


@one_line
def scene(result: xr.Dataset, member: int | None = None, derived: bool = False) -> dict[str, Any]:
    """The scene that was run, all defaults filled in, as nested dictionaries in SI units.

    Args:
        member: with the values that this member drew, where keys vary.
        derived: also what is derived from other keys, such as masses from sizes; without it the scene can be run again.

    Raises:
        SlidewayError: the Dataset carries no scene, or has no such member.

    >>> scene = slideway.scene(slideway.example())
    >>> scene["mechanism"]["crank_length"]
    0.05
    >>> slideway.scene(slideway.example(), derived=True)["mechanism"]["slider_mass"]
    0.1872
    """
    text = dataset(result).attrs.get("scene")
    if not text or not isinstance(text, str):
        raise SlidewayError("this Dataset carries no scene; use the one that slideway.open or slideway.run returned")
    text = words_of_now(text)
    resolved = tomllib.loads(_derived.sub(r"\1", text) if derived else text)
    if member is not None:
        _draw(resolved, result, member)
    return resolved


@one_line
def varied(result: xr.Dataset) -> dict[str, str]:
    """Dotted keys that differ between members, and the variable that holds each of them.

    >>> slideway.scenes.varied(slideway.example())
    {'joint.clearance': 'joint_clearance'}
    """
    study = scene(result).get("study", {})
    keys = [*study.get("vary", {}), *([study["parameter"]] if "parameter" in study else [])]
    return {key: key.replace(".", "_") for key in keys if key.replace(".", "_") in result}


def _draw(resolved: dict[str, Any], result: xr.Dataset, member: int) -> None:
    """Puts what a member drew in the place of the common values."""
    result = with_members(result)
    (member,) = members(member, numbers(result))[:1]
    both = {"joint.clearance": ("clearance_y", "clearance_z"),
            "contact.young_modulus": ("slider_young_modulus", "way_young_modulus")}
    for key, variable in varied(result).items():
        *groups, name = key.split(".")
        value = float(result[variable].sel(member=member))
        for each in both.get(key, (name,)):
            table = resolved
            for group in groups:
                table = table.setdefault(group, {})
            table[each] = value
