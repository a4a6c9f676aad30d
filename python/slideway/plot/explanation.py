"""The forces of one state, drawn where they act."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from ..arguments import shown
from ..errors import SlidewayError
from ..explanation import Explanation
from ..palette import class_colours, colours, grey
from ..units import scaled
from .axes import axis

# Sides of the apices (model.md section 3).
_sides = {f"P{k}": {"x": 1 if k <= 4 else -1, "y": 1 if k in (1, 4, 5, 8) else -1, "z": 1 if k in (1, 2, 5, 6) else -1} for k in range(1, 9)}
_views = {"end": "zyx", "side": "xyz", "top": "xzy"}  # to the right, up, and where the view comes from


def apex_forces(explanation: Explanation, ax: Axes | None = None, *, view: str = "end") -> Axes:
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
    ax = axis(ax)
    half = {name: 500 * explanation.sizes[size] for name, size in (("x", "slider_length"), ("y", "way_width"), ("z", "way_depth"))}  # [mm]
    depths = {(pair["apex"], pair["face"][0]): 1e3 * float(pair["depth"]) for pair in explanation.pairs}
    times = 0.5 * min(half["y"], half["z"]) / (max(map(abs, depths.values())) or 1e-3)

    def corner(apex: str) -> tuple[float, float]:
        """Of the hole."""
        across, along = (_sides[apex][name] * (half[name] - times * depths.get((apex, name), 0.0)) for name in (right, up))
        return across, along

    ax.fill(half[right] * np.array([-1, 1, 1, -1]), half[up] * np.array([-1, -1, 1, 1]), color=grey, alpha=0.15, lw=0)
    for side, dashes in ((1, "-"), (-1, "--")):
        seen = [apex for apex in _sides if _sides[apex][behind] == side]
        walls = [sorted((apex for apex in seen if _sides[apex][up] == s), key=lambda apex: s * _sides[apex][right]) for s in (1, -1)]
        rings = [[*walls[0], *walls[1], walls[0][0]]] if view == "end" else walls
        for k, ring in enumerate(rings):
            name = f"hole, {behind.upper()}{'+' if side > 0 else '−'} {'end' if view == 'end' else 'side'}"
            ax.plot(*zip(*map(corner, ring), strict=True), dashes, color=colours[0], lw=1.2, label=None if k else name)
    _draw_forces(explanation, half, view, ax)
    ax.set_title(f"member {explanation.member} at {explanation.time:.6g} s,\ngaps × {times:.3g}", fontsize="small")
    ax.set_xlabel(f"{right.upper()} [mm]")
    ax.set_ylabel(f"{up.upper()} [mm]")
    ax.set_aspect("equal")
    ax.margins(0.35)
    ax.legend(loc="upper right", fontsize="x-small", frameon=False)
    return ax


def _draw_forces(explanation: Explanation, half: dict[str, float], view: str, ax: Axes) -> None:
    """Apices, arrows, and the largest of them in words."""
    right, up, _ = _views[view]
    at = {apex: (sides[right] * half[right], sides[up] * half[up]) for apex, sides in _sides.items()}
    touching = {pair["apex"] for pair in explanation.pairs if pair["touches"]}
    for apex in sorted(at, key=lambda apex: apex in touching):  # those that touch above the others
        colour, filled = (class_colours["surface"], class_colours["surface"]) if apex in touching else (grey, "none")
        ax.plot([at[apex][0]], [at[apex][1]], "o", ms=4, color=colour, mfc=filled)
    rubs = float(np.nan_to_num(explanation.friction[0]))
    forces = [(pair["apex"], pair["face"], float(np.nan_to_num(pair["normal_force"]))) for pair in explanation.pairs]
    largest = max([abs(rubs), *(force for *_, force in forces)])
    for apex, face, force in forces:
        if force > 0 and face[0] in (right, up):
            length = half["y"] * (1 if face.endswith("plus") else -1) * float(np.sqrt(force / largest))
            _arrow(ax, at[apex], (length, 0.0) if face[0] == right else (0.0, length), class_colours["surface"])
    if rubs != 0 and right == "x":
        _arrow(ax, (0.0, 0.0), (half["x"] * float(np.copysign(np.sqrt(abs(rubs) / largest), rubs)), 0.0), colours[1])
    factor, unit = scaled("N", np.array([largest]))
    words = "forces are not told" if np.isnan(explanation.force).any() else f"largest force {largest * factor:.3g} {unit}" if largest > 0 else "nothing touches"
    ax.text(0.02, 0.02, words, transform=ax.transAxes, fontsize="x-small", color=grey)


def _arrow(ax: Axes, start: tuple[float, float], by: tuple[float, float], colour: str) -> None:
    end = (start[0] + by[0], start[1] + by[1])
    ax.annotate("", end, start, arrowprops={"arrowstyle": "->", "color": colour, "lw": 1.6, "shrinkA": 0, "shrinkB": 0})
    ax.update_datalim([start, end])
