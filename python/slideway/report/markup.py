"""HTML by hand: every text passes through :func:`html.escape`, every data block through :func:`data_block`."""

from __future__ import annotations

import html
import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from slideway.escapes import escaped


@dataclass(frozen=True)
class Section:
    """A part of the page with a place in its table of contents."""

    name: str  # of its element
    title: str
    body: str  # HTML


def tag(name: str, *children: str, **attributes: object) -> str:
    """An element around children that are HTML already; class_ and for_ lose their underscore, others get hyphens.

    >>> tag("p", words("<b>"), class_="a", data_x=1)
    '<p class="a" data-x="1">&lt;b&gt;</p>'
    """
    written = "".join(
        f' {key.rstrip("_").replace("_", "-")}="{html.escape(escaped(str(value)))}"' if value is not True else f" {key}"
        for key, value in attributes.items()
        if value is not False and value is not None
    )
    return f"<{name}{written}>{''.join(children)}</{name}>"


def words(text: object) -> str:
    """Text as HTML, whatever a title or a name holds."""
    return html.escape(escaped(str(text)))


def table(head_words: Sequence[str], body: Iterable[Sequence[object]], caption: str, numeric: int = 1) -> str:
    """A table; columns from `numeric` on hold numbers. On a narrow page a row of more than three cells becomes a block of lines."""

    def cells(row: Sequence[object], head: bool) -> str:
        parts = []
        for k, cell in enumerate(row):
            scope = "col" if head else "row" if k == 0 else None
            column = None if scope else head_words[k]
            parts.append(tag("th" if scope else "td", words(cell), class_="n" if k >= numeric else None, scope=scope, data_column=column))
        return tag("tr", *parts)

    layout = "scroll" + " stacked" * (len(head_words) > 3) + " pairs" * (len(head_words) > 5)
    lines = [cells(row, False) for row in body]
    inner = tag("caption", words(caption)) + tag("thead", cells(head_words, True)) + tag("tbody", *lines)
    return tag("div", tag("table", inner), class_=layout, tabindex="0", role="region", aria_label=caption)


def facts(pairs: Iterable[tuple[str, str]]) -> str:
    """Names and values as a list of definitions."""
    return tag("dl", *(tag("div", tag("dt", words(name)), tag("dd", words(value))) for name, value in pairs))


def data_block(name: str, data: Any) -> str:
    """Data for the page's own scripts; nothing in it can end the element or start another.

    >>> data_block("d", ["</script>"])
    '<script type="application/json" id="d">["\\\\u003c/script>"]</script>'
    """
    written = json.dumps(data, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    for sign in "<&\u2028\u2029":
        written = written.replace(sign, f"\\u{ord(sign):04x}")
    return f'<script type="application/json" id="{html.escape(name)}">{written}</script>'
