"""The keys of a scene: what there is to set, as the program's own tables say."""

from __future__ import annotations

import difflib
import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from .program import call
from .results import StrPath


@dataclass(frozen=True)
class Key:
    """A key of a scene.

    Attributes:
        name: dotted, as in ``set={"joint.clearance": "0.2 mm"}``; with two underscores for the dot a keyword of :func:`slideway.run`.
        type: "number", "integer", "boolean", "choice", "text", "list" or "table".
        unit: SI unit of its numbers; "1" for plain ones, "" for what is no number.
        domain: what it may be: "> 0", "≥ 1, ≤ 3", "one of paper, conservative, kelvin_voigt, foundation"; "" for anything of its type.
        default: what it is where nobody gives it; "" for nothing.
        meaning: one sentence.
        counts_for: mechanisms, laws, studies and methods that know it, where not all do: ``{"laws": ["paper"]}``.
    """

    name: str
    type: str
    unit: str
    domain: str
    default: str
    meaning: str
    counts_for: Mapping[str, list[str]] = field(default_factory=dict)

    def __str__(self) -> str:
        unit = f" [{self.unit}]" if self.unit not in ("", "1") else ""
        parts = [self.meaning, self.domain, f"default {self.default}" if self.default else ""]
        return f"{self.name}{unit}: " + "; ".join(part for part in parts if part)


class Keys(dict[str, Key]):
    """Keys of scenes by their dotted names, in the order of a scene; printed, a line for each."""

    def __str__(self) -> str:
        return "\n".join(map(str, self.values()))


def keys(part: str = "", program: StrPath | None = None) -> Keys:
    """All keys of a scene, or those with `part` in their name: unit, domain, default and a sentence for each.

    They are what ``slideway list --json`` says, so those of the program that runs the scenes. Each is an argument of
    :func:`slideway.run`: ``set={"study.members": 64}`` or ``study__members=64``.

    Args:
        part: of the dotted name, such as "study." or "clearance".
        program: path of the program; left out: SLIDEWAY_PROGRAM, else the PATH.

    >>> print(slideway.keys()["joint.clearance"])
    joint.clearance [m]: clearance per side; ≥ -0.0001; default 0.0001
    >>> print(slideway.keys("young"))
    contact.slider_young_modulus [Pa]: modulus of the slider; > 0; default 2.07e+11
    contact.way_young_modulus [Pa]: modulus of the way; > 0; default 2.07e+11
    contact.young_modulus [Pa]: modulus of both bodies; > 0; default 2.07e+11
    """
    rows: list[dict[str, Any]] = json.loads(call(program, ["list", "--json"]))["keys"]
    return Keys((row["name"], _key_of(row)) for row in rows if part in row["name"])


def nearest_key(name: str, program: StrPath | None = None) -> str:
    """A hint for a name that is no key: "; did you mean study.members?", or "" where nothing is near.

    >>> nearest_key("study__membrs")
    '; did you mean study__members?'
    """
    known = [key.replace(".", "__") for key in keys(program=program)]
    near = difflib.get_close_matches(name.replace(".", "__"), known, 1) or _with_end(name, known)
    return f"; did you mean {near[0]}?" if near else ""


def _with_end(name: str, known: Iterable[str]) -> list[str]:
    """The first of the names that have this one behind their table."""
    return [key for key in known if key.rpartition("__")[2] == name][:1]


def _key_of(row: Mapping[str, Any]) -> Key:
    counts_for = {what: row[what] for what in ("mechanisms", "laws", "studies", "methods") if what in row}
    return Key(row["name"], row["type"], row.get("unit", ""), _domain_of(row), row.get("default", ""), row["meaning"], counts_for)


def _domain_of(row: Mapping[str, Any]) -> str:
    if "choices" in row:
        return "one of " + ", ".join(row["choices"])
    limits = [("minimum", "≥"), ("exclusive_minimum", ">"), ("maximum", "≤")]
    return ", ".join(f"{sign} {row[limit]:.10g}" for limit, sign in limits if limit in row and abs(row[limit]) < 1e18)
