"""Colours of plots and pages: the same thing has the same colour in both."""

from __future__ import annotations

# Dark enough for lines on white, and told apart by readers who see few colours; the page's four, then more for single members.
colours = ("#0b6bb8", "#c4510c", "#18804f", "#8a4aa8", "#b08800", "#1794a8", "#666666", "#c2418c")
class_colours = {"free": "#8b96a2", "point": "#e0a100", "line": "#d55e00", "surface": "#a3155f"}
limit_colour = "#b3261e"
grey = "#616a75"  # what is there for comparison: the ideal, the clearance

# What pages call them, where they have others for readers who like the dark.
names_of_colours = {colour: f"c{number}" for number, colour in enumerate(colours[:4], start=1)} | {colour: name for name, colour in class_colours.items()}
names_of_colours |= {limit_colour: "bad", grey: "muted"}


def style_sheet() -> str:
    """The colours as variables of a page's style; its dark ones come after them.

    >>> style_sheet()[:24]
    ':root { --c1: #0b6bb8; -'
    """
    return ":root { " + " ".join(f"--{name}: {colour};" for colour, name in names_of_colours.items()) + " }\n"
