"""The slider in its way: frames for the drawings of assets/animation.js, and the part of the page around them."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from slideway.way import play

from .markup import Section, tag, words
from .members import chosen
from .numbers import number
from .poses import Joint, Poses
from .traces import packed

SPEEDS = (0.1, 0.25, 0.5, 1, 2, 4)
COLOURS = (("var(--point)", "point"), ("var(--line)", "line"), ("var(--surface)", "surface"), ("var(--free)", "free (below the pictures)"))
VIEWS = {
    "end": "Along the way: Z to the right, Y up. Solid and dots: the slider and its apices at the nearer end; dashed and rings: at the farther one.",
    "side": "From the side: X to the right, Y up.",
    "top": "From above: X to the right, Z down.",
}
MOST_FRAMES = 2000
VISIBLE = 0.09  # of the way's smaller side: how large the magnified clearance is drawn


def magnification(joint: Joint) -> float:
    """By which factor gaps and tilts are drawn larger than bodies: one or two significant digits, at least 1.

    >>> magnification(Joint(False, 0.04, 0.02, 0.03, 1e-4, 1e-4))
    18.0
    """
    size = joint.width if joint.planar else min(joint.width, joint.depth)
    wanted = VISIBLE * size / max(play(joint.gap_y), play(joint.gap_z))
    return max(1.0, float(f"{wanted:.2g}"))


def frames(result: xr.Dataset, seen: dict[int, Poses]) -> dict[str, Any]:
    """All that the drawings need, as data for the page; lengths in mm, angles in rad.

    Each member has a frame per stored sample, of more than 2000 an even choice. touching holds a bit per apex-face pair, in
    the order of :func:`contact.spatial_depths` (or of the four corners).
    """
    joint = next(iter(seen.values())).joint
    return {
        "planar": joint.planar,
        "magnification": magnification(joint),
        "members": [_member(pose, label) for pose, label in zip(seen.values(), chosen(result).values(), strict=True)],
    }


def _member(pose: Poses, label: str) -> dict[str, Any]:
    count = len(pose.time)
    kept = np.unique(np.linspace(0, count - 1, min(count, MOST_FRAMES)).round().astype(int)) if count else np.arange(0)
    bits = (pose.touching[kept].astype(np.uint32) << np.arange(pose.touching.shape[1], dtype=np.uint32)).sum(1)
    joint = pose.joint
    states = {name: getattr(pose, name)[kept] for name in ("roll", "yaw", "pitch")}
    lengths = {name: getattr(pose, name)[kept] * 1e3 for name in ("y", "z")}
    extra: dict[str, Any] = {}
    if pose.x is not None:
        extra["x"] = packed(pose.x[kept] * 1e3)
    if pose.crank is not None and pose.links is not None:
        extra["crank"] = packed(np.mod(pose.crank[kept], 2 * np.pi))
        extra["links"] = [length * 1e3 for length in pose.links]
    return {
        "label": label, "count": len(kept), "of": count, "length": joint.length * 1e3, "width": joint.width * 1e3, "depth": joint.depth * 1e3,
        "gaps": [joint.gap_y * 1e3, joint.gap_z * 1e3], "time": packed(pose.time[kept], "f8"),
        **{name: packed(values) for name, values in {**lengths, **states}.items()}, "touching": packed(bits, "u2"),
        "modes": packed(pose.modes[kept].ravel(), "u1"), **extra,
    }  # fmt: skip


def animation_section(film: dict[str, Any] | str) -> Section:
    """The animation of :func:`frames`, or in one line why there is none."""
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
