"""Scenes given as dictionaries, written out as TOML."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from typing import Any

import numpy as np

from .errors import SlidewayError

_bare = re.compile(r"[A-Za-z0-9_-]+")
_escapes = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r", "\b": "\\b", "\f": "\\f"}


def to_toml(scene: Mapping[str, Any]) -> str:
    """A scene as TOML text.

    Dictionaries of the top level become tables, a dictionary that holds nothing but dictionaries (``study.vary``) becomes a
    table of its own, and whatever lies deeper an inline table.

    Raises:
        SlidewayError: a value that TOML has no place for; the message names its key.

    >>> print(to_toml({"schema": 1, "study": {"members": 8, "vary": {"initial.y": {"dist": "unif", "low": 0, "high": "1 um"}}}}))
    schema = 1
    <BLANKLINE>
    [study]
    members = 8
    <BLANKLINE>
    [study.vary]
    "initial.y" = { dist = "unif", low = 0, high = "1 um" }
    <BLANKLINE>
    """
    return "\n\n".join(_tables(scene, ())) + "\n"


def to_value(value: Any, where: str = "") -> str:
    """One value as TOML, dictionaries as inline tables.

    Args:
        where: the key that an error message names.

    >>> to_value(["0.1 mm", 2, True, 1e-6])
    '["0.1 mm", 2, true, 1e-06]'
    """
    if isinstance(value, (np.generic, np.ndarray)):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(value)  # nan and inf are spelt as in TOML
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, str):
        return '"' + "".join(_escaped(character) for character in value) + '"'
    if isinstance(value, Mapping):
        entries = ", ".join(f"{_key(key)} = {to_value(entry, f'{where}.{key}')}" for key, entry in value.items())
        return f"{{ {entries} }}" if entries else "{}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(to_value(entry, where) for entry in value) + "]"
    raise SlidewayError(
        f"{where or 'value'} is {value!r}, which no scene can hold; use a number, text, true or false, a list or a dictionary"
    )


def keys_of_lines(text: str) -> tuple[str, ...]:
    """The dotted key that stands in each line of what :func:`to_toml` wrote; a table's name in its own line, empty in an empty one.

    >>> keys_of_lines(to_toml({"schema": 1, "study": {"members": 8, "vary": {"initial.y": {"dist": "unif"}}}}))
    ('schema', '', 'study', 'study.members', '', 'study.vary', 'study.vary.initial.y')
    """
    keys, table = [], ""
    for line in text.splitlines():
        if line.startswith("["):
            table = line[1:-1].replace('"', "")
        own = line.partition(" = ")[0].strip('"') if " = " in line and not line.startswith("[") else ""
        keys.append(f"{table}.{own}".strip(".") if own else table if line else "")
    return tuple(keys)


def _escaped(character: str) -> str:
    if character in _escapes:
        return _escapes[character]
    return f"\\u{ord(character):04X}" if ord(character) < 0x20 or ord(character) == 0x7F else character


def _key(key: Any) -> str:
    return str(key) if _bare.fullmatch(str(key)) else to_value(str(key))


def _is_table(value: Any, depth: int) -> bool:
    if not isinstance(value, Mapping):
        return False
    return depth == 0 or (len(value) > 0 and all(isinstance(entry, Mapping) for entry in value.values()))


def _tables(table: Mapping[str, Any], path: tuple[str, ...]) -> list[str]:
    """Text blocks of a table and of those in it; a table's own values come first, or they would belong to another."""
    below = {key: value for key, value in table.items() if len(path) < 2 and _is_table(value, len(path))}
    lines = [f"[{'.'.join(_key(part) for part in path)}]"] if path else []
    for key, value in table.items():
        if key not in below:
            lines.append(f"{_key(key)} = {to_value(value, '.'.join((*path, str(key))))}")
    blocks = ["\n".join(lines)] if lines else []
    for key, value in below.items():
        blocks += _tables(value, (*path, str(key)))
    return blocks
