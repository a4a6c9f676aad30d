"""A mechanism as its scene describes it: bodies, joints by their kinds, ground and drive, in one state or over many."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import cycle
from typing import Any, Union

import numpy as np
import xarray as xr

from .. import arguments
from ..errors import SlidewayError
from ..linkages import GROUND, SIDES, Array, Pose, point, poses, turned
from ..members import with_members
from ..palette import colours, grey, limit_colour
from ..program import call
from ..results import StrPath
from ..scene_files import scene_file
from ..scenes import resolved_of
from ..scenes import scene as scene_of
from ..toml_writer import to_value
from ..units import scaled
from .base import Axes, chosen, drawn
from .marks import Arrow, Axis, Curve, Mark, Moving, Panel, Shape, Text

dark = "#222222"
_widest = 0.4  # of a bearing's radius, or of a block's height: how wide a clearance is drawn
_circle = np.stack([np.cos(np.linspace(0, 2 * np.pi, 49)), np.sin(np.linspace(0, 2 * np.pi, 49))], -1)
_half_box = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])


@dataclass(frozen=True)
class Sketch:
    """What a mechanism is drawn from.

    Attributes:
        scene: resolved.
        state: its variables by name, numbers or arrays over time.
        title: which state it is.
        opened: `link.<name>` of a joint that does not close.
    """

    scene: dict[str, Any]
    state: dict[str, Any]
    title: str = ""
    opened: str = ""


@drawn
def mechanism(
    given: Union[StrPath, Mapping[str, Any], xr.Dataset, Sketch],
    member: int | None = None,
    time: float | None = None,
    ax: Axes | None = None,
    *,
    angle: float | str | None = None,
    program: StrPath | None = None,
) -> Panel:
    """The linkage of a scene at its start, or of a result at one of its samples: bodies with their mass centres, joints, ground and drive.

    A ring is a pin, a box on a line a slide. Of joints with clearance the gap is drawn larger, by the factor that the legend tells: the journal is a disc
    in the circle of its bearing, a block lies between its walls.

    Args:
        given: path of a scene, a scene as nested dictionaries, or a result.
        member: of a result; left out: its first.
        time: of a result [s]; the nearest sample is taken; left out: its first.
        angle: of a scene, in place of mechanism.start_angle: [rad], or a text such as "30 deg".
        program: path of the program; left out: SLIDEWAY_PROGRAM, else the PATH.

    Raises:
        SceneError: the scene is wrong, or does not go together.
        SlidewayError: the mechanism is no linkage, or the result has no time series.

    >>> pin = {"kind": "revolute", "first": "ground", "second": "pendulum"}
    >>> scene = {"schema": 1, "mechanism": {"kind": "linkage"}, "link": {"pin": pin}, "study": {"duration": 0.1},
    ...          "body": {"pendulum": {"mass": 1, "inertia": 0.01, "center_x": "0.1 m"}}}
    >>> slideway.plot.mechanism(scene).get_xlabel()
    'x [mm]'
    """
    if isinstance(given, Sketch):
        return panel(given)
    if isinstance(given, xr.Dataset):
        if angle is not None:
            raise SlidewayError("angle is for scenes; of a result give the time of a sample")
        run = stored(given, member)
        times = run.state["time"]
        wanted = times[0] if time is None else float(arguments.numbers(time, "time"))
        if not times[0] <= wanted <= np.nanmax(times):
            raise SlidewayError(f"time is {wanted:.6g}; the samples are from {times[0]:.6g} to {np.nanmax(times):.6g} s")
        at = int(np.nanargmin(np.abs(times - wanted)))
        return panel(replace(run, state={name: values[at] for name, values in run.state.items()}, title=f"{run.title} at {times[at]:.6g} s"))
    if member is not None or time is not None:
        raise SlidewayError("member and time are for results; of a scene give the angle at which it starts")
    settings = [] if angle is None else ["--set", f"mechanism.start_angle={to_value(angle, 'angle')}"]
    with scene_file(given) as file:
        said = json.loads(call(program, ["check", file.path, "--json", *settings], written=file.said))
    return panel(told(said))


@arguments.one_line
def animation(result: xr.Dataset, member: int | None = None, ax: Axes | None = None, *, frames: int = 100, seconds: float = 5.0) -> Any:
    """A linkage over the time series of a result: a FuncAnimation of matplotlib, for ``to_jshtml()`` in a notebook or ``save("run.gif")``.

    Args:
        member: its number; left out: the first.
        frames: so many samples are shown, an even choice.
        seconds: how long the film lasts.

    Raises:
        SlidewayError: the mechanism is no linkage, or the result has no time series.

    >>> pin = {"kind": "revolute", "first": "ground", "second": "pendulum"}
    >>> scene = {"schema": 1, "mechanism": {"kind": "linkage"}, "link": {"pin": pin}, "study": {"duration": 0.1, "samples": 11},
    ...          "body": {"pendulum": {"mass": 1, "inertia": 0.01, "center_x": "0.1 m"}}}
    >>> "<img" in slideway.plot.animation(slideway.run(scene), frames=3).to_jshtml()
    True
    """
    from ..plot.axes import animated

    run = stored(result, member)
    some = _some(run.state["time"].size, arguments.whole(frames, "frames", 2))
    whole = _drawing(replace(run, state={name: values[some] for name, values in run.state.items()}))
    return animated([whole.frame(number) for number in range(whole.count)], arguments.positive(seconds, "seconds"), ax)


def film(run: Sketch, frames: int, seconds: float) -> Panel:
    """The same of samples of :func:`stored` as a panel that moves."""
    some = _some(run.state["time"].size, frames)
    return _drawing(replace(run, state={name: values[some] for name, values in run.state.items()})).panel(seconds)


def _some(count: int, most: int) -> Array:
    """An even choice of so many places at most."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int)) if count else np.arange(0)


def told(said: Mapping[str, Any]) -> Sketch:
    """The start of a scene, as ``slideway check`` tells it."""
    state = {name: np.nan if value is None else float(value) for name, value in said["start"].items()}
    return Sketch(resolved_of(said["resolved"]), state, opened=str(said.get("open", "")))


def stored(result: xr.Dataset, member: int | None = None) -> Sketch:
    """A member over its time series."""
    result = with_members(result)
    number = chosen(result, member)[0]
    row = result.sel(member=number)
    series = {str(name): row[name].values for name in row.variables if row[name].dims == ("sample",)}
    if "sample" not in result.sizes:
        raise SlidewayError("this result has no time series of which a state could be drawn; run it with study.samples = 200, or give the scene")
    series["time"] = np.asarray(row["time"].values, dtype=float)
    there = np.all([np.isfinite(values) for values in series.values()], axis=0)
    return Sketch(scene_of(result, number), {name: values[there] for name, values in series.items()}, f"member {number}")


def panel(sketch: Sketch) -> Panel:
    """The drawing of a state."""
    return _drawing(sketch).panel()


def _drawing(sketch: Sketch) -> _Drawing:
    if sketch.scene["mechanism"]["kind"] != "linkage":
        raise SlidewayError(f"mechanism draws linkages, and this is a {sketch.scene['mechanism']['kind']} (docs/reference/mechanisms.md has pictures of these)")
    return _Drawing(sketch)


class _Drawing:
    """Marks of a linkage, in a handy unit; with more than one state they move."""

    def __init__(self, sketch: Sketch, like: _Drawing | None = None) -> None:
        self.sketch, self.scene, self.title = sketch, sketch.scene, sketch.title
        where = poses(self.scene, sketch.state)
        self.count = max(np.size(pose.angle) for pose in where.values())
        self.links: dict[str, dict[str, Any]] = self.scene["link"]
        ends = [where[link[side]].place(point(link, side)) for link in self.links.values() for side in SIDES]
        ends += [where[name].place(point(body, "center")) for name, body in self.scene["body"].items()]
        points = np.concatenate([np.reshape(end, (-1, 2)) for end in ends])
        self.factor: float
        self.unit: str
        self.factor, self.unit = (like.factor, like.unit) if like else scaled("m", points)
        self.low: Array = like.low if like else self.factor * np.nanmin(points, 0)
        self.high: Array = like.high if like else self.factor * np.nanmax(points, 0)
        self.size = float(max(*(self.high - self.low), 1e-9))
        self.middle = (self.low + self.high) / 2
        self.where = {name: Pose(self.factor * np.broadcast_to(pose.at, (self.count, 2)), np.broadcast_to(pose.angle, (self.count,)))
                      for name, pose in where.items()}  # fmt: skip
        self.tints = {GROUND: grey} | dict(zip(self.scene["body"], cycle(colours)))
        gaps = [self._room(link) / (self.factor * link["clearance"]) for link in self.links.values() if "clearance" in link]
        self.times = max(1.0, float(f"{min(gaps):.1g}")) if gaps else 1.0
        self.marks: list[Mark] = []
        # Middles and half sizes of words, and of what they are not to cover.
        self.taken: list[tuple[Array, Array]] = [(self.factor * end.reshape(-1, 2)[0], np.full(2, 0.01 * self.size)) for end in ends]

    def frame(self, number: int) -> Panel:
        """One of the states, over the axes of all, without names."""
        state = {name: values[number] for name, values in self.sketch.state.items()}
        one = _Drawing(replace(self.sketch, state=state, title=f"{self.sketch.title} at {state['time']:.6g} s"), self)
        shown = one.panel()
        return replace(shown, marks=[mark for mark in shown.marks if not isinstance(mark, Text) or mark.inside])

    def panel(self, seconds: float = 0.0) -> Panel:
        for name, body in self.scene["body"].items():
            self._body(name, body)
        for name, link in self.links.items():
            {"revolute": self._pin, "prismatic": self._slide, "journal": self._journal, "block": self._block}[link["kind"]](link)
            if GROUND in (link["first"], link["second"]):
                self._ground(link)
            self._name(name, link)
        self._drive()
        words = "crosses: mass centres" + f"; clearances × {self.times:g}" * (self.times > 1)
        self.marks.append(Text(0.01, 0.99, words, size=7.5, across="left", up="top", inside=True))
        room = 0.16 * self.size
        across, up = (Axis(name, self.unit, low=low - room, high=high + room) for name, low, high in zip("xy", self.low, self.high, strict=True))
        marks = self.marks if seconds else [mark.mark if isinstance(mark, Moving) else mark for mark in self.marks]
        marks = [mark for mark in marks if not seconds or not isinstance(mark, Text) or mark.inside]
        return Panel(marks, across, up, self.title, equal=True, legend="none", seconds=seconds)

    def _room(self, link: Mapping[str, Any]) -> float:
        """How wide the clearance of a joint may be drawn."""
        return _widest * (self._radius(link) if link["kind"] == "journal" else self.factor * float(link["height"]))

    def _radius(self, link: Mapping[str, Any]) -> float:
        return max(self.factor * float(link["radius"]), 0.02 * self.size)

    def _magnified(self, places: Array, link: Mapping[str, Any]) -> Array:
        """Places in a clearance (states, n) as it is drawn; what is far beyond it, of a joint that is open, is there to scale."""
        far = np.linalg.norm(places, axis=-1, keepdims=True) / (1.5 * self.factor * float(link["clearance"]))
        return places + (self.times - 1) * places / np.maximum(far, 1.0)

    def _end(self, link: Mapping[str, Any], side: str) -> Array:
        """Of a joint on one of its bodies, in all states."""
        return self.where[link[side]].place(self.factor * point(link, side))

    def _add(self, mark: Union[Curve, Shape], track: Array, turn: Array | None = None) -> None:
        """A mark where it is in the first state; track (states, 2) and turn (states) say where it goes."""
        if self.count > 1:
            degrees = None if turn is None else np.rad2deg(np.unwrap(turn - turn[0]))
            self.marks.append(Moving(mark, track - track[0], track[0], degrees))
        else:
            self.marks.append(mark)

    def _add_to(self, body: str, mark: Union[Curve, Shape]) -> None:
        self._add(mark, self.where[body].at, self.where[body].angle)

    def _text(self, words: str, at: Array, off: float, colour: str, along: Array | None = None, **options: Any) -> None:
        """Words beside a place where no others are: across a line if they are of one, else away from the middle of the drawing."""
        away = at - self.middle if along is None else np.array([-along[1], along[0]])
        first = np.arctan2(away[1], away[0]) if np.hypot(*away) > 1e-6 * self.size else np.pi / 2
        half = np.array([0.008 * self.size * len(words), 0.02 * self.size])  # about
        turns = first + np.pi * np.array([0, 1, 0.25, -0.25, 0.5, -0.5, 0.75, -0.75])
        tries = [at + ring * (off + abs(np.cos(turn)) * half[0] * (off > 0)) * np.array([np.cos(turn), np.sin(turn)]) for ring in (1, 1.7) for turn in turns]
        place = next((one for one in tries if all((np.abs(one - other) > half + wide).any() for other, wide in self.taken)), tries[0])
        self.taken.append((place, half))
        self.marks.append(Text(float(place[0]), float(place[1]), words, colour, order=9, paper="#ffffffb0", **options))

    def _body(self, name: str, body: Mapping[str, Any]) -> None:
        """A bar between its joints, or what they span, and the mass centre."""
        pose, tint = self.where[name], self.tints[name]
        centre = self.factor * point(body, "center")
        own = [self.factor * point(link, side) for link in self.links.values() for side in SIDES if link[side] == name]
        corners = np.unique(np.array([*own, centre] if len(np.unique(own, axis=0)) < 2 else own), axis=0)
        about = corners - corners.mean(0)
        ring = corners[np.argsort(np.arctan2(about[:, 1], about[:, 0]))]
        outline = pose.place(ring[:, None, :])[:, 0]
        self._add_to(name, Shape(outline, None, _light(tint), tint, 3.0, order=2))
        at = pose.place(centre)
        self._add(Curve(at[:1, 0], at[:1, 1], None, tint, dash="", marker="X", size=6, order=6), at)
        is_bar = len(ring) == 2
        self._text(name, pose.place(corners.mean(0))[0], 0.05 * self.size * is_bar, tint, outline[1] - outline[0] if is_bar else None, size=9, bold=True)

    def _pin(self, link: Mapping[str, Any]) -> None:
        at = self._end(link, "first")
        self._add(Curve(at[:1, 0], at[:1, 1], None, dark, dash="", marker="o", size=7, hollow=True, order=5), at)

    def _slide(self, link: Mapping[str, Any]) -> None:
        """A line of the first body, and a box of the second."""
        line, box = self._end(link, "first"), self._end(link, "second")
        angle = self.where[link["first"]].angle + link.get("direction", 0.0)
        along = np.einsum("ij,ij->i", box - line, turned([1.0, 0.0], angle))
        ends = np.array([min(along.min(), 0.0) - 0.12 * self.size, max(along.max(), 0.0) + 0.12 * self.size])
        rail = line[0] + turned(np.stack([ends, [0.0, 0.0]], -1), angle[0])
        self._add(Curve(rail[:, 0], rail[:, 1], None, self.tints[link["first"]], dash="-.", order=1), line, angle)
        self._add(Shape(box[0] + turned(_half_box * [0.09, 0.05] * self.size, angle[0]), None, "white", self.tints[link["second"]], 1.6, order=4), box, angle)

    def _journal(self, link: Mapping[str, Any]) -> None:
        """The bearing's circle, and in it the journal, both with the gap that is drawn."""
        pin, hole = self._end(link, "first"), self._end(link, "second")
        radius, gap = self._radius(link), self.times * self.factor * float(link["clearance"])
        self._add_to(link["second"], Shape(hole[0] + radius * _circle, None, "white", self.tints[link["second"]], 1.6, order=4))
        at = hole + self._magnified(pin - hole, link)
        tint = self.tints[link["first"]]
        self._add(Shape(at[0] + (radius - gap) * _circle, None, _light(tint), tint, 1.2, order=5), at)

    def _block(self, link: Mapping[str, Any]) -> None:
        """Two walls, and between them the block, across them and in its tilt with the gap that is drawn."""
        block, walls = self.where[link["first"]].angle, self.where[link["second"]].angle + link.get("direction", 0.0)
        middle = self._end(link, "second")
        apart = turned((self._end(link, "first") - middle)[:, None, :], -walls[:, None])[:, 0]
        length, height, gap = (self.factor * float(link[key]) for key in ("length", "height", "clearance"))
        tilt = np.remainder(block - walls + np.pi, 2 * np.pi) - np.pi
        tilt = self._magnified(tilt[:, None] * length / 2, link)[:, 0] * 2 / length
        ends = np.array([apart[:, 0].min() - 0.8 * length, apart[:, 0].max() + 0.8 * length])
        for side in (1, -1):
            wall = middle[0] + turned(np.stack([ends, np.full(2, side * (height / 2 + self.times * gap))], -1), walls[0])
            self._add(Curve(wall[:, 0], wall[:, 1], None, self.tints[link["second"]], width=2.0, order=3), middle, walls)
        at = middle + turned(np.stack([apart[:, 0], self._magnified(apart[:, 1:], link)[:, 0]], -1), walls)
        tint = self.tints[link["first"]]
        self._add(Shape(at[0] + turned(_half_box * [length, height], walls[0] + tilt[0]), None, _light(tint), tint, 1.6, order=4), at, walls + tilt)

    def _ground(self, link: Mapping[str, Any]) -> None:
        """What stands: below a pin a foot, behind a line or walls strokes."""
        at = self._end(link, "first" if link["first"] == GROUND else "second")[0]
        foot, turn, off = 0.05 * self.size, 0.0, 0.05 * self.size
        if link["kind"] in ("revolute", "journal"):
            self.marks.append(Shape(at + foot * np.array([[0, 0], [-0.7, -1], [0.7, -1]]), None, "white", grey, 1.2, order=1))
        else:
            turn = float(link.get("direction", 0.0))
            off = 0.0 if link["kind"] == "prismatic" else self.factor * (link["height"] / 2 + self.times * link["clearance"])
            if link["kind"] == "block":
                along = turned([1.0, 0.0], turn)
                at = at + along * float(along @ (self._end(link, "first")[0] - at))
        starts = np.linspace(-1.0, 1.0, 6)
        strokes = np.array([[[x * foot, -off], [(x - 0.3) * foot, -off - 0.35 * foot], [np.nan, np.nan]] for x in starts]).reshape(-1, 2)
        strokes = np.concatenate([strokes, [[-foot, -off], [foot, -off]]])
        across, up = (at + turned(strokes, turn)).T
        self.marks.append(Curve(across, up, None, grey, width=1.0, order=1))

    def _name(self, name: str, link: Mapping[str, Any]) -> None:
        """Of a joint, and where it is open, how far."""
        ends = [self._end(link, side)[0] for side in SIDES]
        off = 0.04 * self.size + (self._radius(link) if link["kind"] == "journal" else 0.0)
        self._text(name, ends[0], off, limit_colour if self.sketch.opened == f"link.{name}" else grey, size=7.5, italic=True)
        if self.sketch.opened == f"link.{name}":
            across, up = np.transpose(ends)
            apart = float(np.hypot(*(ends[1] - ends[0])))
            self.title = f"{name}: its ends are {apart:.4g} {self.unit} apart"
            self.marks.append(Curve(across, up, self.title, limit_colour, width=2.0, dash=":", marker="o", order=8))

    def _drive(self) -> None:
        """An arrow about the pin of what the drive turns."""
        body = self.scene.get("drive", {}).get("body")
        pin = next((link for link in self.links.values() if {link["first"], link["second"]} == {GROUND, body} and link["kind"] == "revolute"), None)
        if pin is None:
            return
        at, sense = self._end(pin, "first")[0], -1.0 if self.scene["mechanism"].get("crank_speed", 0.0) < 0 else 1.0
        turn = self.where[str(body)].angle[0] + sense * np.deg2rad(np.linspace(30, 150, 25))
        arc = at + 0.09 * self.size * np.stack([np.cos(turn), np.sin(turn)], -1)
        self.marks += [Curve(arc[:-1, 0], arc[:-1, 1], None, limit_colour, width=1.6, order=7), Arrow(arc[-3], arc[-1], limit_colour, 1.6, order=7)]


def _light(colour: str) -> str:
    """A tint for what a line of this colour is about."""
    return "#" + "".join(f"{round(255 - 0.25 * (255 - int(colour[i : i + 2], 16))):02x}" for i in (1, 3, 5))
