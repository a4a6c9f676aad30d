"""The forces of one state, drawn where they act."""

from __future__ import annotations

import numpy as np

from ..arguments import shown
from ..errors import SlidewayError
from ..explanation import Explanation
from ..palette import class_colours, colours, grey
from ..units import scaled
from ..way import APEX_SIGNS
from .base import Axes, drawn
from .marks import Arrow, Axis, Curve, Mark, Panel, Shape, Text

_sides = {f"P{k}": dict(zip("xyz", signs, strict=True)) for k, signs in enumerate(APEX_SIGNS, start=1)}
_views = {"end": ("z", "y", "x"), "side": ("x", "y", "z"), "top": ("x", "z", "y")}  # to the right, up, and where the view comes from


@drawn
def apex_forces(explanation: Explanation, ax: Axes | None = None, *, view: str = "end") -> Panel:
    """The slider's hole on its way, with the normal forces at the apices.

    The way is to scale. The gaps to the hole are drawn larger, so that the largest is a quarter of the way's smaller side; where the hole
    lies inside the way's outline, an apex touches, and is filled. An arrow is the normal force of a face at an apex, on the slider; the one in
    the middle is the friction along the way. Arrows are long as the square root of their force, so that small ones are seen.

    Args:
        explanation: of :func:`slideway.explain`.
        view: "end" (along the way), "side" or "top".

    Raises:
        SlidewayError: `explanation` is something else, or there is no such view.

    >>> slideway.plot.apex_forces(slideway.explain(example_file, member=3, time=0.01), view="side").get_xlabel()
    'X [mm]'
    """
    if not isinstance(explanation, Explanation):
        raise SlidewayError("apex_forces draws what slideway.explain returns; give slideway.explain(result, member, time)")
    if view not in _views:
        raise SlidewayError(f"view is {shown(view)}; use one of {', '.join(_views)}")
    right, up, behind = _views[view]
    half = {name: 500 * explanation.sizes[size] for name, size in (("x", "slider_length"), ("y", "way_width"), ("z", "way_depth"))}  # [mm]
    depths = {(pair["apex"], pair["face"][0]): 1e3 * float(pair["depth"]) for pair in explanation.pairs}
    times = 0.5 * min(half["y"], half["z"]) / (max(map(abs, depths.values())) or 1e-3)

    def corner(apex: str) -> list[float]:
        """Of the hole."""
        return [_sides[apex][name] * (half[name] - times * depths.get((apex, name), 0.0)) for name in (right, up)]

    marks: list[Mark] = [Shape(np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * [half[right], half[up]], fill=grey, opacity=0.15)]
    for side, dash in ((1, "-"), (-1, "--")):
        seen = [apex for apex in _sides if _sides[apex][behind] == side]
        walls = [sorted((apex for apex in seen if _sides[apex][up] == s), key=lambda apex: s * _sides[apex][right]) for s in (1, -1)]
        rings = [[*walls[0], *walls[1], walls[0][0]]] if view == "end" else walls
        for k, ring in enumerate(rings):
            name = f"hole, {behind.upper()}{'+' if side > 0 else '−'} {'end' if view == 'end' else 'side'}"
            across, along = np.transpose([corner(apex) for apex in ring])
            marks.append(Curve(across, along, None if k else name, dash=dash))
    marks += _forces(explanation, half, view)
    title = f"member {explanation.member} at {explanation.time:.6g} s,\ngaps × {times:.3g}"
    return Panel(marks, Axis(right.upper(), "mm"), Axis(up.upper(), "mm"), title, equal=True, legend="upper right", margin=0.5)


def _forces(explanation: Explanation, half: dict[str, float], view: str) -> list[Mark]:
    """Apices, arrows, and the largest of them in words."""
    right, up, _ = _views[view]
    at = {apex: np.array([sides[right] * half[right], sides[up] * half[up]]) for apex, sides in _sides.items()}
    touching = {pair["apex"] for pair in explanation.pairs if pair["touches"]}
    marks: list[Mark] = []
    for touches, colour in ((False, grey), (True, class_colours["surface"])):  # those that touch above the others
        there = np.array([at[apex] for apex in at if (apex in touching) == touches]).reshape(-1, 2)
        marks.append(Curve(there[:, 0], there[:, 1], colour=colour, dash="", marker="o", hollow=not touches))
    rubs = float(np.nan_to_num(explanation.friction[0]))
    forces = [(pair["apex"], pair["face"], float(np.nan_to_num(pair["normal_force"]))) for pair in explanation.pairs]
    largest = max([abs(rubs), *(force for *_, force in forces)])
    for apex, face, force in forces:
        if force > 0 and face[0] in (right, up):
            length = half["y"] * (1 if face.endswith("plus") else -1) * float(np.sqrt(force / largest))
            by = (length, 0.0) if face[0] == right else (0.0, length)
            marks.append(Arrow(at[apex], at[apex] + by, class_colours["surface"], 1.6, "->"))
    if rubs != 0 and right == "x":
        marks.append(Arrow((0.0, 0.0), (half["x"] * float(np.copysign(np.sqrt(abs(rubs) / largest), rubs)), 0.0), colours[1], 1.6, "->"))
    factor, unit = scaled("N", np.array([largest]))
    words = "forces are not told" if np.isnan(explanation.force).any() else f"largest force {largest * factor:.3g} {unit}" if largest > 0 else "nothing touches"
    return [*marks, Text(0.02, 0.02, words, size=8, across="left", up="bottom", inside=True)]
