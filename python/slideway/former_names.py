"""What earlier versions called quantities: their results have these names, and this package the names of now."""

from __future__ import annotations

import re

try:
    from . import _native
except ImportError:  # without the library results keep the names that they have
    _native = None  # type: ignore[assignment]

first_format = 3  # format_version of results whose names are those of now
_names: dict[str, str] = {} if _native is None else _native.former_names()
_words = re.compile(rf"(?<![a-z0-9_])({'|'.join(map(re.escape, _names)) or '(?!)'})(?![a-z0-9_])")


def name_of_now(name: str) -> str:
    """The name of a variable, also of one of a group, whose name begins with its quantity's.

    >>> name_of_now("crank_work"), name_of_now("crank_work_mean"), name_of_now("peak_tilt")
    ('drive_work', 'drive_work_mean', 'peak_tilt')
    """
    for then, now in _names.items():
        if name == then or name.startswith(then + "_"):
            return now + name.removeprefix(then)
    return name


def words_of_now(text: str) -> str:
    """A label with the names of now.

    >>> words_of_now("yield of crank_work [1]")
    'yield of drive_work [1]'
    """
    return _words.sub(lambda found: _names[found[1]], text)
