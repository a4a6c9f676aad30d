"""The resolved scene that every result carries."""

from __future__ import annotations

import re
import sys
from typing import Any

import xarray as xr

from .arguments import dataset, members, one_line
from .ensemble import Ensemble
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
        member: with this member's own values, where keys vary. Of ``Ensemble.run(inputs=...)``, whose rows no scene holds, it is a
            scene of this member alone.
        derived: also what is derived from other keys, such as masses from sizes, a member's from its own values; without it the
            scene can be run again.

    Raises:
        SlidewayError: the Dataset carries no scene, or has no such member, or what is derived of it cannot be told.

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
    resolved = tomllib.loads(text)
    values = {} if member is None else values_of(result, member)
    _put(resolved, values)
    study = resolved.get("study", {})
    if member is not None and has_rows_of_inputs(study):
        resolved["study"] = {key: value for key, value in study.items() if key not in ("design", "table")} | {"members": 1}
    if derived:
        if values:
            text = Ensemble({name: table for name, table in resolved.items() if name != "study"}).resolved
        resolved = tomllib.loads(_derived.sub(r"\1", text)) | ({"study": resolved["study"]} if study else {})
    return resolved


def resolved_of(text: str) -> dict[str, Any]:
    """A resolved scene as the program prints it, as nested dictionaries."""
    return tomllib.loads(text)


def has_rows_of_inputs(study: dict[str, Any]) -> bool:
    """Whether the members of a scene's [study] are rows of ``Ensemble.run(inputs=...)``: a table without a file."""
    return study.get("table") == ""


@one_line
def varied(result: xr.Dataset) -> dict[str, str]:
    """Dotted keys that differ between members, and the variable of a whole result that holds each of them.

    >>> slideway.scenes.varied(slideway.example())
    {'joint.clearance': 'joint_clearance'}
    """
    # Variables of the newest results name their keys; of a table, or of given inputs, no scene does.
    named = {str(data.attrs["key"]): str(name) for name, data in result.variables.items() if "key" in data.attrs}
    study = scene(result).get("study", {})
    keys = [*study.get("vary", {}), *([study["parameter"]] if "parameter" in study else [])]
    return {key: key.replace(".", "_") for key in keys} | named


def values_of(result: xr.Dataset, member: int) -> dict[str, float]:
    """What a member has of the dotted keys that differ between members.

    >>> slideway.scenes.values_of(slideway.example(), 3)
    {'joint.clearance': ...}
    """
    result = with_members(result)
    (member,) = members(member, numbers(result))[:1]
    return {key: float(result[variable].sel(member=member)) for key, variable in varied(result).items() if variable in result}


def _put(resolved: dict[str, Any], values: dict[str, float]) -> None:
    """Puts what a member has in the place of the common values."""
    both = {"joint.clearance": ("clearance_y", "clearance_z"),
            "contact.young_modulus": ("slider_young_modulus", "way_young_modulus")}
    for key, value in values.items():
        *groups, name = key.split(".")
        for each in both.get(key, (name,)):
            table = resolved
            for group in groups:
                table = table.setdefault(group, {})
            table[each] = value
