"""Text of others (titles, names of files) on a terminal or a page: what these would obey is shown as an escape, as the program has it."""

from __future__ import annotations

import re

# Control characters but for new lines and tabs, what turns the direction of text, separators of lines; halves of characters, which
# stand for bytes of a file's name that are no UTF-8.
_OBEYED = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u206f\ud800-\udfff]")


def escaped(text: str) -> str:
    r"""The text with such characters as ``\uNNNN``, and bytes that are no UTF-8 as ``\xNN``.

    >>> print(escaped("a \x9b2J \u202e b\udcff"))
    a \u009b2J \u202e b\xff
    """
    return _OBEYED.sub(_escape, text)


def _escape(found: re.Match[str]) -> str:
    code = ord(found[0])
    return f"\\x{code - 0xDC00:02x}" if 0xDC80 <= code <= 0xDCFF else f"\\u{code:04x}"
