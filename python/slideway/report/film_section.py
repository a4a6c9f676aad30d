"""The part of the page around the animation; its drawings are those of assets/animation.js."""

from __future__ import annotations

from typing import Any

from .markup import Section, tag, words
from .numbers import number

SPEEDS = (0.1, 0.25, 0.5, 1, 2, 4)
COLOURS = (("var(--point)", "point"), ("var(--line)", "line"), ("var(--surface)", "surface"), ("var(--free)", "free (below the pictures)"))
VIEWS = {
    "end": "Along the way: Z to the right, Y up. Solid and dots: the slider and its apices at the nearer end; dashed and rings: at the farther one.",
    "side": "From the side: X to the right, Y up.",
    "top": "From above: X to the right, Z down.",
}


def animation_section(film: dict[str, Any] | str) -> Section:
    """The animation of :func:`animation.frames`, or in one line why there is none."""
    name, title = "animation", "The slider in its way"
    if isinstance(film, str):
        return Section(name, title, tag("p", words(film), class_="absent"))
    members = film["members"]
    body = tag("p", words(_reading(film)))
    colours = (tag("li", tag("i", style=f"background:{colour}"), words(kind)) for colour, kind in COLOURS)
    body += tag("ul", *colours, class_="key", aria_label="Colours of contacts")
    views = ["side"] if film["planar"] else list(VIEWS)
    body += tag("div", *(_view(view) for view in views), class_="views single" if film["planar"] else "views", id="stage")
    body += _now() + _time_line() + _controls([str(member["label"]) for member in members])
    if "x" in members[0]:
        drawing = tag("svg", id="view-strip", role="img", aria_label="The mechanism to scale")
        body += tag("figure", drawing, tag("figcaption", "The mechanism, to scale."), class_="strip")
    return Section(name, title, body)


def _reading(film: dict[str, Any]) -> str:
    shown, stored = film["members"][0]["count"], film["members"][0]["of"]
    frame = "a stored sample" if shown == stored else f"one of {stored:,} stored samples, an even choice of {shown:,}"
    return (
        f"Bodies are to scale; gaps and tilts are drawn {number(film['magnification'])} times as large, so that what touches in "
        f"the drawing touches in the joint. A frame is {frame}; what is shorter than their spacing, as most impacts are, falls "
        "between the frames."
    )


def _view(name: str) -> str:
    drawing = tag("svg", id=f"view-{name}", role="img", aria_label=f"Slider and way. {VIEWS[name]}")
    return tag("figure", drawing, tag("figcaption", words(VIEWS[name])))


def _now() -> str:
    time = tag("span", "t = ", tag("b", id="now-time"))
    mode = tag("span", "mode (surfaces, lines, points) ", tag("b", id="now-mode"))
    return tag("p", time, mode, tag("span", id="now-place"), class_="now")


def _time_line() -> str:
    slider = '<input type="range" id="frame" min="0" max="0" value="0" aria-label="Time">'
    return tag("div", tag("canvas", id="timeline", aria_hidden="true"), slider, class_="frames")


def _controls(labels: list[str]) -> str:
    buttons = (("play", "Play"), ("back", "◂ Frame"), ("forward", "Frame ▸"), ("contact", "Next contact"))
    parts = [tag("button", words(text), type="button", id=name) for name, text in buttons]
    speeds = (tag("option", words(f"{speed:g}×"), value=speed, selected=speed == 1) for speed in SPEEDS)
    parts.append(tag("label", "Speed", tag("select", *speeds, id="speed")))
    if len(labels) > 1:
        members = (tag("option", words(label)) for label in labels)
        parts.append(tag("label", "Member", tag("select", *members, id="film-choice")))
    return tag("div", *parts, tag("span", id="pace"), class_="controls")
