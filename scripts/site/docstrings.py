"""Docstrings as the site's reference reads them: examples under a heading of their own, names without roles."""

from __future__ import annotations

import re
from typing import Any

import griffe


class Docstrings(griffe.Extension):
    """Rewrites every docstring once it is loaded."""

    def on_object(self, *, obj: griffe.Object, **_: Any) -> None:
        if obj.docstring is not None:
            obj.docstring.value = rewritten(obj.docstring.value)

    def on_package(self, *, pkg: griffe.Module, **_: Any) -> None:
        self.on_object(obj=pkg)


def rewritten(text: str) -> str:
    """A docstring with its roles as code and its doctests as a section.

    >>> rewritten("What :func:`slideway.open` gives.\\n\\n>>> 1 + 1\\n2")
    'What `slideway.open` gives.\\n\\nExamples:\\n    >>> 1 + 1\\n    2'
    """
    paragraphs = re.sub(r":(?:func|meth|class|attr|mod):`~?([^`]+)`", r"`\1`", text).split("\n\n")
    shown = []
    for paragraph in paragraphs:
        if paragraph.startswith(">>>"):
            paragraph = "Examples:\n" + "\n".join(f"    {line}" for line in paragraph.splitlines())
        shown.append(paragraph)
    return "\n\n".join(shown)
