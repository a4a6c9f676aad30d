"""The drawings of every mechanism with its keys (docs/reference/mechanisms.md): a key's colour says which table of the scene it is in."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from slideway.figures.marks import Arrow, Place, box
from slideway.palette import colours, grey, limit_colour
from slideway.way import APEX_SIGNS, rotation

from .drawings import Sheet, arc, body, dark, faces, flat, way_tone

TABLES = {"mechanism": dark, "joint": colours[0], "slider": colours[2], "way": colours[1], "initial": colours[3], "drive": colours[5],
           "way_ends": limit_colour}


class Drawing(Sheet):
    """A sheet of 300 units across, with the tables' names in their colours below."""

    def __init__(self, height: float, tables: Sequence[str], corner: Place = (0.0, 0.0)) -> None:
        super().__init__(300, height, corner)
        for number, table in enumerate(tables):
            self.text(f"[{table}]", (corner[0] + 300 * (number + 0.5) / len(tables), corner[1] + 7), colour=TABLES[table], size=9, bold=True)

    def key(self, table: str, names: str, at: Place, to: Place | None = None, across: str = "center", paper: str = "white") -> None:
        """Names of keys, with a thin line from their place to what they are of; `paper` is the colour below them."""
        self.text(names, at, to, TABLES[table], 9, size=9, across=across, paper=paper)

    def words(self, words: str, at: Place, **options: Any) -> None:
        """What is no key."""
        self.text(words, at, **{"colour": grey, "size": 8.5, "order": 9} | options)

    def size(self, start: Place, end: Place, off: float = 0.0) -> Place:
        """A size between two points, drawn so far to the left of the line between them; where its middle is."""
        along = np.subtract(end, start) / np.hypot(*np.subtract(end, start))
        shift = off * np.array([-along[1], along[0]])
        for point in (start, end) if off else ():
            self.line([point, point + shift * 1.12], grey, 0.6, order=7)
        self.marks.append(Arrow(start + shift, end + shift, dark, 0.9, "<->", 7, 8))
        return (np.add(start, end)) / 2 + shift

    def tip(self, at: Place, before: Place, colour: str) -> None:
        """The tip of a bent arrow."""
        self.marks.append(Arrow(before, at, colour, 1, "-|>", 8, 8))

    def turn(self, centre: Place, radius: float, start: float, end: float, colour: str = dark) -> None:
        """An arc from one angle to another, in degrees, with an arrow at its end."""
        points = arc(centre, radius, start, end)
        self.line(points, colour, 1, order=7)
        self.tip(points[-1], arc(centre, radius, end - np.sign(end - start) * 6)[0], colour)

    def axes(self, at: Place, x: float, y: float) -> None:
        """The axes of the ground, Z towards the reader."""
        self.arrow(at, (at[0] + x, at[1]))
        self.arrow(at, (at[0], at[1] + y))
        for words, place in (("X", (at[0] + x + 6, at[1])), ("Y", (at[0], at[1] + y + 6)), ("Z", (at[0] - 7, at[1] - 6))):
            self.words(words, place, italic=True, colour=dark, paper="white")
        self.dots(at, dark, 2.2, 10)

    def gravity(self, at: Place, key: str = "inclination", beside: str = "perpendicular to the way") -> None:
        """Gravity, leaning to the left of what is perpendicular to the way."""
        angle, length = np.deg2rad(22), 44.0
        self.line([at, (at[0], at[1] - length)], grey, 0.8, "--")
        end = (at[0] - length * np.sin(angle), at[1] - length * np.cos(angle))
        self.arrow(at, end)
        self.turn(at, 30, -90, -112)
        self.key("mechanism", "gravity", (end[0] - 4, end[1] + 2), across="right")
        self.key("mechanism", key, (at[0] + 4, at[1] - 34), across="left")
        self.words(beside, (at[0] + 4, at[1] - 44), across="left", size=8)

    def guide(self, x: float, y: float, ends: Place, gap: float = 6.0, up: float = 0.0, ghost: bool = False) -> None:
        """Way and slider from the side, with a clearance that is seen."""
        self.shape(box(ends[0], y - 10, ends[1] - ends[0], 20), way_tone, dark, 1)
        for lower in (y + up + gap + 10, y + up - gap - 18):
            self.shape(box(x - 28, lower, 56, 8), "none" if ghost else body, colours[0], order=2, dash=":" if ghost else "-")
        for end in (x - 28, x + 28):
            self.line([(end, y + up - 10 - gap), (end, y + up + 10 + gap)], colours[0], 0.8, ":", 3)

    def guide_keys(self, x: float, y: float, end: float, up: float = 0.0) -> None:
        """Clearance and width of the way; the slider may be above its middle."""
        self.line([(x + 22, y + 10), (x + 22, y + up + 16)], limit_colour, 2.5, order=4)
        self.key("joint", "clearance_y", (x + 64, y + up + 30), (x + 22, y + up / 2 + 13))
        self.key("joint", "way_width", (self.size((end - 8, y - 10), (end - 8, y + 10))[0] - 6, y), across="right", paper=way_tone)

    def links(self, *joints: Place) -> None:
        """A crank, and a rod where there is one, between their joints."""
        for start, end, colour, width in zip(joints, joints[1:], (dark, colours[1]), (4.0, 3.0)):
            self.line([start, end], colour, width, order=5)
        for point in joints:
            self.shape(arc(point, 2.6), "white", dark, order=6)

    def crank(self, centre: Place, length: float, angle: float) -> Place:
        """Crank with its circle, speed and angle; where its pin is."""
        pin = arc(centre, length, angle)[0]
        self.shape(arc(centre, length), "none", grey, 0.7, dash="--")
        self.turn(centre, 20, 0, angle)
        self.turn(centre, length + 9, 100, 150)
        self.size(centre, pin, 9)
        return pin

    def drive(self, at: Place, centre: Place) -> None:
        self.key("drive", "torque, no_load_speed\nviscous, inertia", at, centre)

    def ring(self, centre: np.ndarray, axis: int, radius: float, colour: str) -> None:
        """A turn about an axis, in the sense of a right-handed screw."""
        points = np.insert(arc((0, 0), radius, -60, 200), 0, 0, axis=1)  # about X
        at = flat(np.roll(points, axis, axis=1) + centre)
        self.line(at, colour, 1.1, order=8)
        self.tip(at[-1], at[-3], colour)

    def corner_path(self, origin: np.ndarray, point: np.ndarray, colour: str) -> Place:
        """A point with the way to it along X, Y and Z."""
        at = flat([origin + point * mask for mask in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (1, 1, 1))])
        self.line(at, colour, 1, "--", 8)
        self.dots(at[-1], colour, 5.5, 9)
        return at[-1]


def _crank_and_rod(height: float, tables: Sequence[str], slider: float) -> tuple[Drawing, Place, Place]:
    """What both slider-cranks have: the drawing, with the crank's pin and the slider's place."""
    sheet = Drawing(height, tables)
    centre: Place = (58.0, height - 80)
    pin = sheet.crank(centre, 34, 55)
    place: Place = (slider, centre[1])
    sheet.links(centre, pin, place)
    sheet.axes(centre, 66, 45)
    sheet.key("mechanism", "crank_length", (25, centre[1] + 14), (centre[0] + 2, centre[1] + 19))
    sheet.key("mechanism", "crank_speed", (26, centre[1] + 54))
    sheet.key("mechanism", "start_angle", (centre[0] + 21, centre[1] + 5.5), across="left")
    sheet.key("mechanism", "crank_mass\ncrank_inertia\ncrank_section", (87, centre[1] + 60), (71, centre[1] + 18.5))
    sheet.drive((58, centre[1] - 58), centre)
    return sheet, pin, place


def slider_crank(_: Path) -> str:
    """The slider-crank from the side."""
    sheet, pin, place = _crank_and_rod(196, ("mechanism", "joint", "drive"), 205)
    x, y = place
    sheet.guide(x, y, (150, 294))
    sheet.guide_keys(x, y, 294)
    sheet.key("joint", "slider_length", sheet.size((x - 28, y + 24), (x + 28, y + 24), 12))
    sheet.key("mechanism", "slider_mass", (x + 8, y - 34), (x - 6, y - 20))
    middle = ((pin[0] + x) / 2, (pin[1] + y) / 2)
    sheet.dots(middle, colours[1], 5, 7, hollow=True)
    sheet.size(pin, place, 12)
    sheet.key("mechanism", "rod_length", (pin[0] + 36, pin[1] + 4))
    sheet.key("mechanism", "rod_mass, rod_inertia\nrod_section", (186, y + 62), middle)
    sheet.size(pin, middle, -7)
    sheet.key("mechanism", "rod_mass_center\nx rod_length", (124, y - 25), (126, y + 10))
    sheet.gravity((202, 70))
    return sheet.svg()


def planar_slider_crank(_: Path) -> str:
    """The planar slider-crank: a block between two walls."""
    sheet, pin, place = _crank_and_rod(208, ("mechanism", "joint", "initial", "drive"), 198)
    x, y = place
    for lower in (y + 26, y - 34):
        sheet.shape(box(143, lower, 151, 8), way_tone, dark, 1)
    sheet.shape(box(x - 32, y - 18, 64, 36), body, colours[0], order=2)
    for name, sides in (("C1", (1, 1)), ("C2", (1, -1)), ("C3", (-1, -1)), ("C4", (-1, 1))):
        sheet.dots((x + 32 * sides[0], y + 18 * sides[1]), limit_colour, 4, 6)
        sheet.words(name, (x + 23 * sides[0], y + 12 * sides[1]), colour=limit_colour)
    sheet.key("joint", "slider_length", sheet.size((x - 32, y + 18), (x + 32, y + 18), 24))
    sheet.key("joint", "slider_height", (sheet.size((x + 32, y - 18), (x + 32, y + 18), -10)[0] + 5, y), across="left")
    sheet.line([(x + 12, y + 18), (x + 12, y + 26)], limit_colour, 2.5, order=4)
    sheet.key("joint", "clearance, clearance_y", (x + 56, y + 60), (x + 12, y + 22))
    sheet.key("joint", "slider_depth", (x + 70, y - 46), (x + 14, y - 14))
    sheet.words("along Z", (x + 70, y - 55), size=8)
    sheet.key("mechanism", "slider_mass\nslider_inertia_z", (x + 8, y - 51), (x - 2, y - 12))
    sheet.key("mechanism", "rod_length\nrod_mass, rod_inertia\nrod_section", (156, y + 62), (pin[0] + 50, pin[1] - 11.6))
    sheet.key("initial", "y, vy", (x + 6, y + 3), across="left", paper=body)
    sheet.arrow((x, y), (x, y + 16), TABLES["initial"])
    sheet.turn(place, 40, 155, 205, TABLES["initial"])
    sheet.key("initial", "pitch, wz", (x - 62, y - 46), (x - 37, y - 15))
    sheet.gravity((202, 66))
    return sheet.svg()


def scotch_yoke(_: Path) -> str:
    """The scotch yoke: the crank's pin slides in a slot across the slider."""
    sheet = Drawing(202, ("mechanism", "joint", "drive"))
    centre: Place = (92, 116)
    y = centre[1]
    pin = sheet.crank(centre, 49, 45)
    x = pin[0]
    for half, tone in ((9.0, body), (4.0, "white")):
        sheet.shape(box(x - half, y - 50, 2 * half, 100 + 2 * (half - 4)), tone, colours[0], 0.9, 3)
    sheet.guide(x, y, (24, 294))
    sheet.links(centre, pin)
    sheet.axes(centre, 100, 66)
    sheet.guide_keys(x, y, 294)
    sheet.key("joint", "slider_length", sheet.size((x - 28, y - 24), (x + 28, y - 24), -40))
    sheet.key("mechanism", "slider_mass", (x + 58, y - 36), (x + 20, y - 20))
    sheet.key("mechanism", "crank_length", (60, y + 22), (centre[0] + 8, y + 21))
    sheet.key("mechanism", "crank_speed", (30, y + 62))
    sheet.key("mechanism", "start_angle", (40, y - 34), (centre[0] + 19.8, y + 2))
    sheet.words("slot across the slider", (x + 46, y + 54), across="left")
    sheet.line([(x + 44, y + 54), (x + 7, y + 46)], grey, 0.7)
    sheet.drive((50, y - 64), centre)
    sheet.gravity((206, 70))
    return sheet.svg()


def carriage(_: Path) -> str:
    """The carriage, and its speed over time."""
    sheet = Drawing(206, ("mechanism", "joint"))
    x, far, y = 60.0, 204.0, 150.0
    sheet.guide(x, y, (10, 294))
    sheet.guide(far, y, (10, 294), ghost=True)
    sheet.guide_keys(x, y, 294)
    sheet.axes((x, y), 90, 42)
    sheet.key("joint", "slider_length", sheet.size((far - 28, y + 24), (far + 28, y + 24), 12))
    sheet.key("mechanism", "slider_mass", (30, y - 36), (46, y - 20))
    sheet.arrow((x + 30, y - 20), (x + 52, y - 20), colours[1])
    sheet.key("mechanism", "carriage_speed", (x + 55, y - 20), across="left")
    sheet.key("mechanism", "stroke", sheet.size((x, y - 8), (far, y - 8), -36))
    base, left = 60.0, 22.0
    sheet.arrow((left, base), (158, base))
    sheet.arrow((left, base - 30), (left, base + 36))
    sheet.words("time", (150, base - 7))
    sheet.words("speed", (left + 5, base + 34), across="left")
    turning = np.linspace(0, np.pi, 30)
    reversal = np.stack([left + 48 + 18 * turning / np.pi, base + 20 * np.cos(turning)], 1)
    sheet.line([(left, base + 20), *reversal, (left + 114, base - 20)], colours[1], 1.6)
    sheet.key("mechanism", "reversal_time", (sheet.size((left + 48, base + 20), (left + 66, base + 20), 7)[0] + 14, base + 27), across="left")
    sheet.gravity((212, 80))
    return sheet.svg()


def free_slider(_: Path) -> str:
    """The slider that nothing drives."""
    sheet = Drawing(176, ("mechanism", "joint", "initial"))
    x, y, up = 120.0, 118.0, 4.0
    sheet.guide(x, y, (20, 294), gap=9, up=up)
    sheet.guide_keys(x, y, 294, up + 3)
    sheet.line([(94, y), (240, y)], grey, 0.7, "-.")
    sheet.axes((40, y), 40, 40)
    sheet.key("joint", "slider_length", sheet.size((x - 28, y + 31), (x + 28, y + 31), 11))
    centre = (x, y + up)
    sheet.arrow(centre, (x + 34, y + up), TABLES["initial"])
    sheet.arrow(centre, (x, y + 30), TABLES["initial"])
    sheet.dots(centre, TABLES["initial"], 4, 9)
    sheet.key("initial", "vx", (x + 41, y + up), paper=way_tone)
    sheet.key("initial", "y, vy", (x - 3, y + up + 10), across="right", paper="none")
    sheet.key("initial", "x", sheet.size((40, y - 6), (x, y - 6), -30))
    sheet.key("mechanism", "slider_mass", (x + 50, y - 32), (x + 18, y - 20))
    sheet.gravity((212, 74))
    return sheet.svg()


def joint(_: Path) -> str:
    """The section of way and slider, seen along X: faces, clearances, thicknesses."""
    sheet = Drawing(246, ("mechanism", "joint"))
    x, y, width, depth, gap, wall = 150.0, 148.0, 40.0, 66.0, 9.0, 15.0
    for size, tone, edge in ((gap + wall, body, colours[0]), (gap, "white", colours[0]), (0.0, way_tone, dark)):
        sheet.shape(box(x - depth - size, y - width - size, 2 * (depth + size), 2 * (width + size)), tone, edge)
    sheet.arrow((x, y), (x, y + 24))
    sheet.arrow((x, y), (x + 24, y))
    sheet.words("Y", (x - 6, y + 24), italic=True, colour=dark)
    sheet.words("Z", (x + 25, y - 6), italic=True, colour=dark)
    for face, at, turned in (("y_plus", (x + 34, y + width - 5), 0), ("y_minus", (x + 24, y - width + 5), 0),
                             ("z_plus", (x + depth - 5, y - 9), 90), ("z_minus", (x - depth + 5, y + 22), 90)):
        sheet.words(face, at, turn=turned, italic=True, colour=dark)
    sheet.key("joint", "way_width", (x - 34, sheet.size((x - 34, y - width), (x - 34, y + width))[1] + 4), paper=way_tone)
    sheet.key("joint", "way_depth", (x - 4, sheet.size((x - depth, y - 26), (x + depth, y - 26))[1]), paper=way_tone)
    sheet.size((x + 10, y + width), (x + 10, y + 8))
    sheet.key("joint", "thickness_y", (x + 13, y + 26), across="left", paper="none")
    sheet.size((x + depth, y + 17), (x + 22, y + 17))
    sheet.key("joint", "thickness_z", (x + 21, y + 10), across="left", paper="none")
    sheet.key("joint", "wall", (x - 102, y - 70), sheet.size((x - depth - gap - wall, y - 30), (x - depth - gap, y - 30)))
    for name, start, end, at in (("y_plus", (x + 54, y + width), (x + 54, y + width + gap), (x + 60, y + 82)),
                                 ("y_minus", (x + 54, y - width), (x + 54, y - width - gap), (x + 92, y - 74)),
                                 ("z_plus", (x + depth, y + 30), (x + depth + gap, y + 30), (x + 113, y + 70)),
                                 ("z_minus", (x - depth - gap, y + 30), (x - depth, y + 30), (x - 92, y + 82))):
        sheet.line([start, end], limit_colour, 2.5, order=4)
        sheet.key("joint", f"clearance_{name}", at, ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2))
    sheet.key("joint", "clearance_y", (8, 46), across="left")
    sheet.words("both faces across Y", (56, 46), across="left")
    sheet.key("joint", "clearance_z", (8, 35), across="left")
    sheet.words("both faces across Z", (56, 35), across="left")
    sheet.key("joint", "clearance", (8, 24), across="left")
    sheet.words("all four faces", (56, 24), across="left")
    sheet.gravity((202, 66), "cross_inclination", "in this section")
    return sheet.svg()


def slider(_: Path) -> str:
    """The slider's frame from its hole's centre: apices, centre of mass, pin, motion at the start."""
    sheet = Drawing(240, ("mechanism", "slider", "initial"), (-150, -130))
    half = np.array([56.0, 26.0, 38.0])
    at = flat(APEX_SIGNS * half)
    for ring, tone in faces:
        sheet.shape(at[ring], tone, colours[0], order=2, opacity=0.55)
    sheet.dots(at, limit_colour, 4)
    for number, point in enumerate(at, start=1):
        shift = 8 * point / max(float(np.hypot(*point)), 1.0) if np.hypot(*point) > 20 else np.array([7.0, 4.0])
        sheet.words(f"P{number}", point + shift, colour=limit_colour)
    zero = np.zeros(3)
    for axis, reach, name in ((0, 122, "X"), (1, 84, "Y"), (2, 96, "Z")):
        end = np.zeros(3)
        end[axis] = reach
        sheet.arrow(flat(zero), flat(end), dark)
        sheet.ring(end * 0.88, axis, 9, TABLES["initial"])
        sheet.words(name, flat(end * 1.07), italic=True, colour=dark)
    for place, state, inertia in (((118, -84), "x, vx\nroll, wx", "slider_inertia_x"), ((52, 86), "y, vy\nyaw, wy", "slider_inertia_y"),
                                  ((-121, -24), "z, vz\npitch, wz", "slider_inertia_z")):
        sheet.key("initial", state, place)
        sheet.key("mechanism", inertia, (place[0], place[1] - 16))
    mass = sheet.corner_path(zero, np.array([30.0, -12.0, -46.0]), TABLES["slider"])
    sheet.key("slider", "mass_center_x\nmass_center_y\nmass_center_z", (116, 56), mass)
    sheet.key("mechanism", "slider_mass", (116, 76))
    pin = sheet.corner_path(zero, np.array([-44.0, 14.0, 22.0]), TABLES["slider"])
    sheet.key("slider", "pin_x\npin_y\npin_z", (-112, 78), pin)
    sheet.words("x, vx: only free_slider,\nwhich has no pin", (-100, -92), size=8)
    return sheet.svg()


def way(_: Path) -> str:
    """The way's place, attitude and ends."""
    sheet = Drawing(206, ("mechanism", "way", "way_ends"), (-60, -130))
    for axis, reach, name in ((0, 196, "X"), (1, 44, "Y"), (2, 44, "Z")):
        end = np.zeros(3)
        end[axis] = reach
        sheet.arrow(flat(np.zeros(3)), flat(end))
        end[axis] += 8
        sheet.words(name, flat(end), italic=True, colour=dark)
    attitude = rotation(0.0, np.deg2rad(10), np.deg2rad(14))
    place = np.array([100.0, 40.0, -44.0])
    corners = flat(APEX_SIGNS * [62, 9, 13] @ attitude.T + place)
    for ring, _ in faces:
        sheet.shape(corners[ring], way_tone, dark, 1, 2, opacity=0.85)
    stations = np.array([[place[0], 0, 0], [place[0], 0, place[2]], place])
    sheet.line(flat(stations), TABLES["way"], 1.2, "--", 8)
    sheet.dots(flat(place), TABLES["way"], 5, 9)
    middles = flat((stations[:-1] + stations[1:]) / 2)
    sheet.key("way", "offset_z", middles[0] + [4, -5], across="left")
    sheet.key("way", "offset_y", middles[1] + [5, -10], across="left")
    for axis, reach, name, shift in ((0, 88, "roll", (2, 14)), (1, 50, "yaw", (20, 0)), (2, 62, "pitch", (-14, -5))):
        end = attitude[:, axis] * reach + place
        sheet.arrow(flat(place), flat(end), TABLES["way"])
        sheet.ring(attitude[:, axis] * reach * 0.88 + place, axis, 8, TABLES["way"])
        sheet.key("way", name, flat(end) + shift)
    for name, side in (("from", -1), ("to", 1)):
        end = attitude[:, 0] * 62 * side + place
        foot = np.array([end[0], 0, 0])
        sheet.line(flat([end, [end[0], 0, end[2]], foot]), TABLES["way_ends"], 0.8, "--", 1)
        sheet.dots(flat(foot), TABLES["way_ends"], 9, 9, "|")
        sheet.key("way_ends", name, flat(foot) - [4, 11])
    sheet.dots(flat(stations[0]), dark, 9, 9, "|")
    sheet.key("mechanism", "rod_length", flat(stations[0]) - [6, 12], across="right")
    sheet.words("0 without a rod", flat(stations[0]) - [6, 22], across="right", size=8)
    return sheet.svg()


KEYS: dict[str, Callable[[Path], str]] = {
    "keys_slider_crank": slider_crank,
    "keys_scotch_yoke": scotch_yoke,
    "keys_carriage": carriage,
    "keys_free_slider": free_slider,
    "keys_planar_slider_crank": planar_slider_crank,
    "keys_joint": joint,
    "keys_slider": slider,
    "keys_way": way,
}
