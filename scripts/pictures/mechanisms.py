"""The drawings of every mechanism with its keys (docs/reference/mechanisms.md): a key's colour says which table of the scene it is in."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Polygon, Rectangle
from slideway.palette import colours, grey, limit_colour
from slideway.report.contact import APEX_SIGNS

from .drawings import arrow, body, canvas, dark, way_tone
from .style import as_svg

Point = tuple[float, float]

TABLES = {"mechanism": dark, "joint": colours[0], "slider": colours[2], "way": colours[1], "initial": colours[3], "drive": colours[5],
           "way_ends": limit_colour}
_wide = 300.0  # units of a drawing across its 5.4 inches


def _sheet(height: float, tables: Sequence[str], corner: Point = (0.0, 0.0)) -> tuple[Figure, Axes]:
    """An empty drawing, with the tables' names in their colours below; its lower left corner may be elsewhere than at 0."""
    figure, ax = canvas(height / _wide * 5.4)
    ax.set_xlim(corner[0], corner[0] + _wide)
    ax.set_ylim(corner[1], corner[1] + height)
    for number, table in enumerate(tables):
        ax.text(corner[0] + _wide * (number + 0.5) / len(tables), corner[1] + 7, f"[{table}]", ha="center", va="center", color=TABLES[table],
                fontsize=9, weight="bold")
    return figure, ax


def _key(ax: Axes, table: str, names: str, at: Point, to: Point | None = None, ha: str = "center", on: str = "white") -> None:
    """Names of keys, with a thin line from their place to what they are of; `on` is the colour below them."""
    if to is not None:
        ax.plot(*zip(at, to, strict=True), color=grey, lw=0.7, zorder=8)
    ax.text(*at, names, ha=ha, va="center", color=TABLES[table], fontsize=9, linespacing=1.15, zorder=9,
            bbox={"fc": on, "ec": "none", "pad": 1.0})


def _words(ax: Axes, words: str, at: Point, **options: object) -> None:
    """What is no key."""
    ax.text(*at, words, **{"ha": "center", "va": "center", "color": grey, "fontsize": 8.5, "zorder": 9} | options)  # type: ignore[arg-type]


def _size(ax: Axes, start: Point, end: Point, off: float = 0.0) -> Point:
    """A size between two points, drawn so far to the left of the line between them; where its middle is."""
    start_at, end_at = np.array(start), np.array(end)
    along = (end_at - start_at) / np.hypot(*(end_at - start_at))
    shift = off * np.array([-along[1], along[0]])
    for point in (start_at, end_at):
        if off:
            ax.plot(*zip(point, point + shift * 1.12, strict=True), color=grey, lw=0.6, zorder=7)
    ax.annotate("", tuple(end_at + shift), tuple(start_at + shift), zorder=8,
                arrowprops={"arrowstyle": "<->", "color": dark, "lw": 0.9, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 7})
    middle = (start_at + end_at) / 2 + shift
    return float(middle[0]), float(middle[1])


def _tip(ax: Axes, at: Point, before: Point, colour: str) -> None:
    """The tip of a bent arrow."""
    ax.annotate("", at, before, zorder=8,
                arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 1, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 8})


def _turn(ax: Axes, centre: Point, radius: float, start: float, end: float, colour: str = dark) -> None:
    """An arc from one angle to another, in degrees, with an arrow at its end."""
    ax.add_patch(Arc(centre, 2 * radius, 2 * radius, theta1=min(start, end), theta2=max(start, end), color=colour, lw=1, zorder=7))
    tip = np.deg2rad(end)
    before = np.deg2rad(end - np.sign(end - start) * 6)
    points = [(centre[0] + radius * np.cos(angle), centre[1] + radius * np.sin(angle)) for angle in (before, tip)]
    _tip(ax, points[1], points[0], colour)


def _axes(ax: Axes, at: Point, x: float, y: float) -> None:
    """The axes of the ground, Z towards the reader."""
    arrow(ax, at, (at[0] + x, at[1]))
    arrow(ax, at, (at[0], at[1] + y))
    for words, place in (("X", (at[0] + x + 6, at[1])), ("Y", (at[0], at[1] + y + 6)), ("Z", (at[0] - 7, at[1] - 6))):
        _words(ax, words, place, style="italic", color=dark, bbox={"fc": "white", "ec": "none", "pad": 0.5})
    ax.plot(*at, "o", ms=2.2, color=dark, zorder=10)


def _gravity(ax: Axes, at: Point, key: str = "inclination", beside: str = "perpendicular to the way") -> None:
    """Gravity, leaning to the left of what is perpendicular to the way."""
    angle, length = np.deg2rad(22), 44.0
    down = (at[0], at[1] - length)
    ax.plot(*zip(at, down, strict=True), color=grey, lw=0.8, ls=(0, (4, 3)))
    end = (at[0] - length * np.sin(angle), at[1] - length * np.cos(angle))
    arrow(ax, at, end)
    _turn(ax, at, 30, -90, -112)
    _key(ax, "mechanism", "gravity", (end[0] - 4, end[1] + 2), ha="right")
    _key(ax, "mechanism", key, (at[0] + 4, at[1] - 34), ha="left")
    _words(ax, beside, (at[0] + 4, at[1] - 44), ha="left", fontsize=8)


def _guide(ax: Axes, x: float, y: float, ends: Point, half: float = 28.0, width: float = 10.0, gap: float = 6.0, wall: float = 8.0, up: float = 0.0,
           ghost: bool = False) -> None:
    """Way and slider from the side, with a clearance that is seen."""
    ax.add_patch(Rectangle((ends[0], y - width), ends[1] - ends[0], 2 * width, fc=way_tone, ec=dark, lw=1, zorder=1))
    for side in (1, -1):
        lower = y + up + (gap + width if side > 0 else -gap - width - wall)
        ax.add_patch(Rectangle((x - half, lower), 2 * half, wall, fc="none" if ghost else body, ec=colours[0], lw=1.2, ls=":" if ghost else "-", zorder=2))
    for end in (x - half, x + half):
        ax.plot([end, end], [y + up - width - gap, y + up + width + gap], color=colours[0], lw=0.8, ls=":", zorder=3)


def _guide_keys(ax: Axes, x: float, y: float, end: float, up: float = 0.0) -> None:
    """Clearance and width of the way; the slider may be above its middle."""
    ax.plot([x + 22, x + 22], [y + 10, y + up + 16], color=limit_colour, lw=2.5, solid_capstyle="butt", zorder=4)
    _key(ax, "joint", "clearance_y", (x + 64, y + up + 30), (x + 22, y + up / 2 + 13))
    _key(ax, "joint", "way_width", (_size(ax, (end - 8, y - 10), (end - 8, y + 10))[0] - 6, y), ha="right", on=way_tone)


def _links(ax: Axes, centre: Point, pin: Point, far: Point | None) -> None:
    for start, end, colour, width in ((centre, pin, dark, 4.0), (pin, far, colours[1], 3.0)):
        if end is not None:
            ax.plot(*zip(start, end, strict=True), color=colour, lw=width, solid_capstyle="round", zorder=5)
    for point in (centre, pin, far):
        if point is not None:
            ax.add_patch(Circle(point, 2.6, fc="white", ec=dark, lw=1.2, zorder=6))


def _crank(ax: Axes, centre: Point, length: float, angle: float) -> Point:
    """Crank with its circle, speed and angle; where its pin is."""
    pin = (centre[0] + length * np.cos(np.deg2rad(angle)), centre[1] + length * np.sin(np.deg2rad(angle)))
    ax.add_patch(Circle(centre, length, fc="none", ec=grey, lw=0.7, ls=(0, (4, 4)), zorder=1))
    _turn(ax, centre, 20, 0, angle)
    _turn(ax, centre, length + 9, 100, 150)
    _size(ax, centre, pin, 9)
    return pin


def _drive(ax: Axes, at: Point, centre: Point) -> None:
    _key(ax, "drive", "torque, no_load_speed\nviscous, inertia", at, centre)


def _crank_and_rod(height: float, tables: Sequence[str], slider: float) -> tuple[Figure, Axes, Point, Point]:
    """What both slider-cranks have: the drawing, with the crank's pin and the slider's place."""
    figure, ax = _sheet(height, tables)
    centre: Point = (58.0, height - 80)
    pin = _crank(ax, centre, 34, 55)
    place: Point = (slider, centre[1])
    _links(ax, centre, pin, place)
    _axes(ax, centre, 66, 45)
    _key(ax, "mechanism", "crank_length", (25, centre[1] + 14), (centre[0] + 2, centre[1] + 19))
    _key(ax, "mechanism", "crank_speed", (26, centre[1] + 54))
    _key(ax, "mechanism", "start_angle", (centre[0] + 21, centre[1] + 5.5), ha="left")
    _key(ax, "mechanism", "crank_mass\ncrank_inertia\ncrank_section", (87, centre[1] + 60), (71, centre[1] + 18.5))
    _drive(ax, (58, centre[1] - 58), centre)
    return figure, ax, pin, place


def slider_crank(_root: Path) -> str:
    """The slider-crank from the side."""
    figure, ax, pin, place = _crank_and_rod(196, ("mechanism", "joint", "drive"), 205)
    x, y = place
    _guide(ax, x, y, (150, 294))
    _guide_keys(ax, x, y, 294)
    _key(ax, "joint", "slider_length", _size(ax, (x - 28, y + 24), (x + 28, y + 24), 12))
    _key(ax, "mechanism", "slider_mass", (x + 8, y - 34), (x - 6, y - 20))
    middle = ((pin[0] + x) / 2, (pin[1] + y) / 2)
    ax.plot(*middle, "o", ms=5, color="white", mec=colours[1], zorder=7)
    _size(ax, pin, place, 12)
    _key(ax, "mechanism", "rod_length", (pin[0] + 36, pin[1] + 4))
    _key(ax, "mechanism", "rod_mass, rod_inertia\nrod_section", (186, y + 62), middle)
    _size(ax, pin, middle, -7)
    _key(ax, "mechanism", "rod_mass_center\nx rod_length", (124, y - 25), (126, y + 10))
    _gravity(ax, (202, 70))
    return as_svg(figure)


def planar_slider_crank(_root: Path) -> str:
    """The planar slider-crank: a block between two walls."""
    figure, ax, pin, place = _crank_and_rod(208, ("mechanism", "joint", "initial", "drive"), 198)
    x, y = place
    for lower in (y + 26, y - 34):
        ax.add_patch(Rectangle((143, lower), 151, 8, fc=way_tone, ec=dark, lw=1, zorder=1))
    ax.add_patch(Rectangle((x - 32, y - 18), 64, 36, fc=body, ec=colours[0], lw=1.2, zorder=2))
    for name, sides in (("C1", (1, 1)), ("C2", (1, -1)), ("C3", (-1, -1)), ("C4", (-1, 1))):
        ax.plot(x + 32 * sides[0], y + 18 * sides[1], "o", ms=4, color=limit_colour, zorder=6)
        _words(ax, name, (x + 23 * sides[0], y + 12 * sides[1]), color=limit_colour)
    _key(ax, "joint", "slider_length", _size(ax, (x - 32, y + 18), (x + 32, y + 18), 24))
    _key(ax, "joint", "slider_height", (_size(ax, (x + 32, y - 18), (x + 32, y + 18), -10)[0] + 5, y), ha="left")
    ax.plot([x + 12, x + 12], [y + 18, y + 26], color=limit_colour, lw=2.5, solid_capstyle="butt", zorder=4)
    _key(ax, "joint", "clearance, clearance_y", (x + 56, y + 60), (x + 12, y + 22))
    _key(ax, "joint", "slider_depth", (x + 70, y - 46), (x + 14, y - 14))
    _words(ax, "along Z", (x + 70, y - 55), fontsize=8)
    _key(ax, "mechanism", "slider_mass\nslider_inertia_z", (x + 8, y - 51), (x - 2, y - 12))
    _key(ax, "mechanism", "rod_length\nrod_mass, rod_inertia\nrod_section", (156, y + 62), (pin[0] + 50, pin[1] - 11.6))
    _key(ax, "initial", "y, vy", (x + 6, y + 3), ha="left", on=body)
    arrow(ax, (x, y), (x, y + 16), TABLES["initial"])
    _turn(ax, place, 40, 155, 205, TABLES["initial"])
    _key(ax, "initial", "pitch, wz", (x - 62, y - 46), (x - 37, y - 15))
    _gravity(ax, (202, 66))
    return as_svg(figure)


def scotch_yoke(_root: Path) -> str:
    """The scotch yoke: the crank's pin slides in a slot across the slider."""
    figure, ax = _sheet(202, ("mechanism", "joint", "drive"))
    centre: Point = (92, 116)
    y = centre[1]
    pin = _crank(ax, centre, 49, 45)
    x = pin[0]
    for half, tone in ((9.0, body), (4.0, "white")):
        ax.add_patch(Rectangle((x - half, y - 50), 2 * half, 100 + 2 * (half - 4), fc=tone, ec=colours[0], lw=0.9, zorder=3))
    _guide(ax, x, y, (24, 294))
    _links(ax, centre, pin, None)
    _axes(ax, centre, 100, 66)
    _guide_keys(ax, x, y, 294)
    _key(ax, "joint", "slider_length", _size(ax, (x - 28, y - 24), (x + 28, y - 24), -40))
    _key(ax, "mechanism", "slider_mass", (x + 58, y - 36), (x + 20, y - 20))
    _key(ax, "mechanism", "crank_length", (60, y + 22), (centre[0] + 8, y + 21))
    _key(ax, "mechanism", "crank_speed", (30, y + 62))
    _key(ax, "mechanism", "start_angle", (40, y - 34), (centre[0] + 19.8, y + 2))
    _words(ax, "slot across the slider", (x + 46, y + 54), ha="left")
    ax.plot([x + 44, x + 7], [y + 54, y + 46], color=grey, lw=0.7)
    _drive(ax, (50, y - 64), centre)
    _gravity(ax, (206, 70))
    return as_svg(figure)


def carriage(_root: Path) -> str:
    """The carriage, and its speed over time."""
    figure, ax = _sheet(206, ("mechanism", "joint"))
    x, far, y = 60.0, 204.0, 150.0
    _guide(ax, x, y, (10, 294))
    _guide(ax, far, y, (10, 294), ghost=True)
    _guide_keys(ax, x, y, 294)
    _axes(ax, (x, y), 90, 42)
    _key(ax, "joint", "slider_length", _size(ax, (far - 28, y + 24), (far + 28, y + 24), 12))
    _key(ax, "mechanism", "slider_mass", (30, y - 36), (46, y - 20))
    arrow(ax, (x + 30, y - 20), (x + 52, y - 20), colours[1])
    _key(ax, "mechanism", "carriage_speed", (x + 55, y - 20), ha="left")
    _key(ax, "mechanism", "stroke", _size(ax, (x, y - 8), (far, y - 8), -36))
    base, left = 60.0, 22.0
    arrow(ax, (left, base), (158, base))
    arrow(ax, (left, base - 30), (left, base + 36))
    _words(ax, "time", (150, base - 7))
    _words(ax, "speed", (left + 5, base + 34), ha="left")
    turning = np.linspace(0, np.pi, 30)
    ax.plot([left, left + 48], [base + 20, base + 20], color=colours[1], lw=1.6)
    ax.plot(left + 48 + 18 * turning / np.pi, base + 20 * np.cos(turning), color=colours[1], lw=1.6)
    ax.plot([left + 66, left + 114], [base - 20, base - 20], color=colours[1], lw=1.6)
    _key(ax, "mechanism", "reversal_time", (_size(ax, (left + 48, base + 20), (left + 66, base + 20), 7)[0] + 14, base + 27), ha="left")
    _gravity(ax, (212, 80))
    return as_svg(figure)


def free_slider(_root: Path) -> str:
    """The slider that nothing drives."""
    figure, ax = _sheet(176, ("mechanism", "joint", "initial"))
    x, y, up = 120.0, 118.0, 4.0
    _guide(ax, x, y, (20, 294), gap=9, up=up)
    _guide_keys(ax, x, y, 294, up + 3)
    ax.plot([94, 240], [y, y], color=grey, lw=0.7, ls=(0, (6, 3, 1, 3)), zorder=2)
    _axes(ax, (40, y), 40, 40)
    _key(ax, "joint", "slider_length", _size(ax, (x - 28, y + 31), (x + 28, y + 31), 11))
    centre = (x, y + up)
    arrow(ax, centre, (x + 34, y + up), TABLES["initial"])
    arrow(ax, centre, (x, y + 30), TABLES["initial"])
    ax.plot(*centre, "o", ms=4, color=TABLES["initial"], zorder=9)
    _key(ax, "initial", "vx", (x + 41, y + up), on=way_tone)
    _key(ax, "initial", "y, vy", (x - 3, y + up + 10), ha="right", on="none")
    _key(ax, "initial", "x", _size(ax, (40, y - 6), (x, y - 6), -30))
    _key(ax, "mechanism", "slider_mass", (x + 50, y - 32), (x + 18, y - 20))
    _gravity(ax, (212, 74))
    return as_svg(figure)


def joint(_root: Path) -> str:
    """The section of way and slider, seen along X: faces, clearances, thicknesses."""
    figure, ax = _sheet(246, ("mechanism", "joint"))
    x, y, width, depth, gap, wall = 150.0, 148.0, 40.0, 66.0, 9.0, 15.0
    for size, tone, edge in ((gap + wall, body, colours[0]), (gap, "white", colours[0]), (0.0, way_tone, dark)):
        ax.add_patch(Rectangle((x - depth - size, y - width - size), 2 * (depth + size), 2 * (width + size), fc=tone, ec=edge, lw=1.2, zorder=1))
    arrow(ax, (x, y), (x, y + 24))
    arrow(ax, (x, y), (x + 24, y))
    _words(ax, "Y", (x - 6, y + 24), style="italic", color=dark)
    _words(ax, "Z", (x + 25, y - 6), style="italic", color=dark)
    for face, at, turned in (("y_plus", (x + 34, y + width - 5), 0), ("y_minus", (x + 24, y - width + 5), 0),
                             ("z_plus", (x + depth - 5, y - 9), 90), ("z_minus", (x - depth + 5, y + 22), 90)):
        _words(ax, face, at, rotation=turned, style="italic", color=dark)
    _key(ax, "joint", "way_width", (x - 34, _size(ax, (x - 34, y - width), (x - 34, y + width))[1] + 4), on=way_tone)
    _key(ax, "joint", "way_depth", (x - 4, _size(ax, (x - depth, y - 26), (x + depth, y - 26))[1]), on=way_tone)
    _size(ax, (x + 10, y + width), (x + 10, y + 8))
    _key(ax, "joint", "thickness_y", (x + 13, y + 26), ha="left", on="none")
    _size(ax, (x + depth, y + 17), (x + 22, y + 17))
    _key(ax, "joint", "thickness_z", (x + 21, y + 10), ha="left", on="none")
    _key(ax, "joint", "wall", (x - 102, y - 70), _size(ax, (x - depth - gap - wall, y - 30), (x - depth - gap, y - 30)))
    for name, start, end, at in (("y_plus", (x + 54, y + width), (x + 54, y + width + gap), (x + 60, y + 82)),
                                 ("y_minus", (x + 54, y - width), (x + 54, y - width - gap), (x + 92, y - 74)),
                                 ("z_plus", (x + depth, y + 30), (x + depth + gap, y + 30), (x + 113, y + 70)),
                                 ("z_minus", (x - depth - gap, y + 30), (x - depth, y + 30), (x - 92, y + 82))):
        ax.plot(*zip(start, end, strict=True), color=limit_colour, lw=2.5, solid_capstyle="butt", zorder=4)
        _key(ax, "joint", f"clearance_{name}", at, ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2))
    _key(ax, "joint", "clearance_y", (8, 46), ha="left")
    _words(ax, "both faces across Y", (56, 46), ha="left")
    _key(ax, "joint", "clearance_z", (8, 35), ha="left")
    _words(ax, "both faces across Z", (56, 35), ha="left")
    _key(ax, "joint", "clearance", (8, 24), ha="left")
    _words(ax, "all four faces", (56, 24), ha="left")
    _gravity(ax, (202, 66), "cross_inclination", "in this section")
    return as_svg(figure)


def _flat(points: object) -> np.ndarray:
    """X to the right and towards the reader, Y up, Z to the left and towards the reader."""
    points = np.asarray(points, dtype=float)
    return np.stack([(points[..., 0] - points[..., 2]) * np.cos(np.pi / 6), points[..., 1] - (points[..., 0] + points[..., 2]) * 0.5], -1)


def _ring(ax: Axes, centre: np.ndarray, axis: int, radius: float, colour: str) -> None:
    """A turn about an axis, in the sense of a right-handed screw."""
    angle = np.deg2rad(np.linspace(-60, 200, 50))
    first, second = ((1, 2), (2, 0), (0, 1))[axis]
    points = np.zeros((50, 3))
    points[:, first], points[:, second] = radius * np.cos(angle), radius * np.sin(angle)
    at = _flat(points + centre)
    ax.plot(*at.T, color=colour, lw=1.1, zorder=8)
    _tip(ax, tuple(at[-1]), tuple(at[-3]), colour)


def _corner_path(ax: Axes, origin: np.ndarray, point: np.ndarray, colour: str) -> Point:
    """A point with the way to it along X, Y and Z."""
    stations = [origin + point * mask for mask in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (1, 1, 1))]
    at = _flat(stations)
    ax.plot(*at.T, color=colour, lw=1, ls=(0, (3, 2)), zorder=8)
    ax.plot(*at[-1], "o", ms=5.5, color=colour, zorder=9)
    return float(at[-1][0]), float(at[-1][1])


def slider(_root: Path) -> str:
    """The slider's frame from its hole's centre: apices, centre of mass, pin, motion at the start."""
    figure, ax = _sheet(240, ("mechanism", "slider", "initial"), (-150, -130))
    half = np.array([56.0, 26.0, 38.0])
    at = _flat(APEX_SIGNS * half)
    for ring, tone in (([0, 1, 2, 3], "#b9cfe4"), ([0, 3, 7, 4], "#e3eef8"), ([0, 1, 5, 4], body)):
        ax.add_patch(Polygon(at[ring], fc=tone, ec=colours[0], lw=1.2, alpha=0.55, zorder=2))
    ax.plot(*at.T, "o", color=limit_colour, ms=4, zorder=5)
    for number, point in enumerate(at, start=1):
        shift = 8 * point / max(float(np.hypot(*point)), 1.0) if np.hypot(*point) > 20 else np.array([7.0, 4.0])
        _words(ax, f"P{number}", tuple(point + shift), color=limit_colour)
    zero = np.zeros(3)
    for axis, reach, name in ((0, 122, "X"), (1, 84, "Y"), (2, 96, "Z")):
        end = np.zeros(3)
        end[axis] = reach
        arrow(ax, tuple(_flat(zero)), tuple(_flat(end)), dark)
        _ring(ax, end * 0.88, axis, 9, TABLES["initial"])
        _words(ax, name, tuple(_flat(end * 1.07)), style="italic", color=dark)
    for place, state, inertia in (((118, -84), "x, vx\nroll, wx", "slider_inertia_x"), ((52, 86), "y, vy\nyaw, wy", "slider_inertia_y"),
                                  ((-121, -24), "z, vz\npitch, wz", "slider_inertia_z")):
        _key(ax, "initial", state, place)
        _key(ax, "mechanism", inertia, (place[0], place[1] - 16))
    mass = _corner_path(ax, zero, np.array([30.0, -12.0, -46.0]), TABLES["slider"])
    _key(ax, "slider", "mass_center_x\nmass_center_y\nmass_center_z", (116, 56), mass)
    _key(ax, "mechanism", "slider_mass", (116, 76))
    pin = _corner_path(ax, zero, np.array([-44.0, 14.0, 22.0]), TABLES["slider"])
    _key(ax, "slider", "pin_x\npin_y\npin_z", (-112, 78), pin)
    _words(ax, "x, vx: only free_slider,\nwhich has no pin", (-100, -92), fontsize=8)
    return as_svg(figure)


def way(_root: Path) -> str:
    """The way's place, attitude and ends."""
    figure, ax = _sheet(206, ("mechanism", "way", "way_ends"), (-60, -130))
    for axis, reach, name in ((0, 196, "X"), (1, 44, "Y"), (2, 44, "Z")):
        end = np.zeros(3)
        end[axis] = reach
        arrow(ax, tuple(_flat(np.zeros(3))), tuple(_flat(end)))
        end[axis] += 8
        _words(ax, name, tuple(_flat(end)), style="italic", color=dark)
    yaw, pitch = np.deg2rad(10), np.deg2rad(14)
    attitude = np.array([[np.cos(pitch), -np.sin(pitch), 0], [np.sin(pitch), np.cos(pitch), 0], [0, 0, 1]]) @ np.array(
        [[np.cos(yaw), 0, np.sin(yaw)], [0, 1, 0], [-np.sin(yaw), 0, np.cos(yaw)]])
    place = np.array([100.0, 40.0, -44.0])
    corners = _flat(APEX_SIGNS * [62, 9, 13] @ attitude.T + place)
    for ring in ([0, 1, 2, 3], [0, 3, 7, 4], [0, 1, 5, 4]):
        ax.add_patch(Polygon(corners[ring], fc=way_tone, ec=dark, lw=1, alpha=0.85, zorder=2))
    stations = np.array([[place[0], 0, 0], [place[0], 0, place[2]], place])
    ax.plot(*_flat(stations).T, color=TABLES["way"], lw=1.2, ls=(0, (3, 2)), zorder=8)
    ax.plot(*_flat(place), "o", ms=5, color=TABLES["way"], zorder=9)
    middles = _flat((stations[:-1] + stations[1:]) / 2)
    _key(ax, "way", "offset_z", (middles[0][0] + 4, middles[0][1] - 5), ha="left")
    _key(ax, "way", "offset_y", (middles[1][0] + 5, middles[1][1] - 10), ha="left")
    for axis, reach, name, shift in ((0, 88, "roll", (2, 14)), (1, 50, "yaw", (20, 0)), (2, 62, "pitch", (-14, -5))):
        end = attitude[:, axis] * reach + place
        arrow(ax, tuple(_flat(place)), tuple(_flat(end)), TABLES["way"])
        _ring(ax, attitude[:, axis] * reach * 0.88 + place, axis, 8, TABLES["way"])
        _key(ax, "way", name, (float(_flat(end)[0] + shift[0]), float(_flat(end)[1] + shift[1])))
    for name, side in (("from", -1), ("to", 1)):
        end = attitude[:, 0] * 62 * side + place
        foot = np.array([end[0], 0, 0])
        ax.plot(*_flat([end, [end[0], 0, end[2]], foot]).T, color=TABLES["way_ends"], lw=0.8, ls=(0, (2, 2)), zorder=1)
        ax.plot(*_flat(foot), "|", ms=9, color=TABLES["way_ends"], zorder=9)
        _key(ax, "way_ends", name, (float(_flat(foot)[0] - 4), float(_flat(foot)[1] - 11)))
    ax.plot(*_flat(stations[0]), "|", ms=9, color=dark, zorder=9)
    _key(ax, "mechanism", "rod_length", (float(_flat(stations[0])[0] - 6), float(_flat(stations[0])[1] - 12)), ha="right")
    _words(ax, "0 without a rod", (float(_flat(stations[0])[0] - 6), float(_flat(stations[0])[1] - 22)), ha="right", fontsize=8)
    return as_svg(figure)


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
