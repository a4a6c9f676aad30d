"""Colours of plots and pages: the same thing has the same colour in both."""

from __future__ import annotations

# Dark enough for lines on white, and told apart by readers who see few colours; the page's four, then more for single members.
colours = ("#0b6bb8", "#c4510c", "#18804f", "#8a4aa8", "#b08800", "#1794a8", "#666666", "#c2418c")
class_colours = {"free": "#8b96a2", "point": "#e0a100", "line": "#d55e00", "surface": "#a3155f"}
limit_colour = "#b3261e"
grey = "#616a75"  # what is there for comparison: the ideal, the clearance


def style_sheet() -> str:
    """The colours as variables of a page's style; its dark ones come after them.

    >>> style_sheet()[:24]
    ':root { --c1: #0b6bb8; -'
    """
    named = {f"c{number}": colour for number, colour in enumerate(colours[:4], start=1)} | class_colours
    named |= {"bad": limit_colour, "muted": grey}
    return ":root { " + " ".join(f"--{name}: {colour};" for name, colour in named.items()) + " }\n"
