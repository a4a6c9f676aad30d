"""The map of regimes of a planar slider-crank with rigid contacts (docs/explanation/chaos.md): rest, periodic impacts and chaos over speed, restitution,
friction and clearance.

As a program it prints the shares of each regime and how many members change theirs at a tighter tolerance: python -m pictures.regimes.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import slideway
import xarray as xr
from slideway.figures.marks import Axis, Mark, Panel, Shape, named
from slideway.palette import colours
from slideway.plot.axes import picture

from .figures import stretches

speeds = np.linspace(20, 200, 19)  # [rad/s]
starts = 4
regimes_of = {"rests": "#c9d1d9", "every turn": colours[0], "every 2 to 8 turns": colours[2], "chaotic": colours[1], "undecided": "#ffffff"}
most_period, repeats, same = 8, 12, 1e-3  # turns; sections that have to repeat; clearances
restitution, friction, clearance = 0.8, 0.1, 0.1  # where they do not vary; clearance in mm
rows: dict[str, list[float]] = {
    "restitution": [0.5, 0.6, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95],
    "friction": [0.01, 0.05, 0.1, 0.2, 0.3, 0.5],
    "clearance [mm]": [0.02, 0.035, 0.06, 0.1, 0.2, 0.35, 0.5],
}


def period(sections: np.ndarray) -> int:
    """After how many sections they repeat; 0: not within `most_period`.

    >>> period(np.tile([[0.0], [1.0], [0.5]], (10, 1)))
    3
    >>> period(np.sin(np.arange(40.0) ** 2)[:, None])
    0
    """
    for turns in range(1, most_period + 1):
        if np.abs(sections[turns:] - sections[:-turns])[-repeats:].max() < same:
            return turns
    return 0


def _sections(result: xr.Dataset, member: int) -> np.ndarray:
    """States at crank angle 0 in clearances: (turns, states)."""
    scene = slideway.scene(result, member=member)
    found, joint = slideway.sections(result, member=member), scene["joint"]
    gap, arm, rod, speed = joint["clearance_y"], joint["slider_length"] / 2, scene["mechanism"]["rod_length"], scene["mechanism"]["crank_speed"]
    places = found.rod_angle * rod, found.pitch * arm, found.rod_angular_velocity * rod / speed, found.wz * arm / speed
    return np.stack([place.values / gap for place in places], axis=1)


def _regime(result: xr.Dataset, member: int) -> str:
    """Of one member.  One that lies still for a hundredth of a turn forgets every offset in it; one that always does rests."""
    if not bool(slideway.finished(result)[member]):
        return "undecided"
    if result.lost_offsets.values[member] >= result.rescalings.values[member]:
        return "rests"
    if turns := period(_sections(result, member)):
        return "every turn" if turns == 1 else "every 2 to 8 turns"
    return "chaotic" if slideway.exponent_signs(result).values[member, 0] == "above zero" else "undecided"


def row(root: Path, name: str, value: float, tolerance: float = 1e-6) -> list[list[str]]:
    """Regimes of all speeds and starts: [speed][start]."""
    gap = value if name == "clearance [mm]" else clearance
    sliding = value if name == "friction" else friction
    keys: dict[str, Any] = {
        "contact.restitution": value if name == "restitution" else restitution, "friction.static": sliding, "friction.kinetic": sliding,
        "joint.clearance": f"{gap} mm", 'study.vary."initial.y"': {"dist": "unif", "low": f"{-gap / 2} mm", "high": f"{gap / 2} mm"},
        "study.from": speeds[0], "study.to": speeds[-1], "study.points": speeds.size, "study.members": starts, "study.verify": 0,
        "study.transient_revolutions": 60, "study.revolutions": 40, "study.rescalings_per_revolution": 100,
        "integrator.rtol": tolerance, "integrator.atol": tolerance / 10, "integrator.max_steps": 300_000}  # fmt: skip
    result = slideway.run(root / "scenes/sweep_rigid.toml", progress=False, set=keys, max_failures="100%")
    found = [_regime(result, member) for member in range(result.sizes["member"])]
    return [found[i : i + starts] for i in range(0, len(found), starts)]


def regimes(root: Path) -> str:
    """Three maps over the speed of the crank; each row has a stripe for each start."""
    half, panels = (speeds[1] - speeds[0]) / 2, []
    edges = np.append(speeds - half, speeds[-1] + half)
    for name, values in rows.items():
        marks: list[Mark] = []
        for place, value in enumerate(values):
            found = np.array(row(root, name, value))
            for start in range(starts):
                low = place - 0.46 + 0.23 * start
                for regime, colour in regimes_of.items():
                    marks += stretches(edges, found[:, start] == regime, low, 0.23, colour)
        marks += [Shape(np.full((3, 2), np.nan), regime, colour, "#444444", 0.5) for regime, colour in regimes_of.items()]  # for the legend
        across = Axis("crank speed", "rad/s") if len(panels) == 2 else Axis("")
        across = replace(across, low=edges[0], high=edges[-1])
        panels.append(Panel(marks, across, Axis(name, ticks=named([f"{value:g}" for value in values]))))
    return picture(panels, height=7.6, below=3, sharex=True, height_ratios=[len(values) for values in rows.values()])


def main() -> None:
    """The shares, and what a tighter tolerance changes."""
    root = Path(__file__).resolve().parents[2]
    for name, values in rows.items():
        for value in values:
            found, tight = (np.array(row(root, name, value, tolerance)) for tolerance in (1e-6, 1e-9))
            shares = ", ".join(f"{regime} {np.mean(found == regime):.2f}" for regime in regimes_of)
            print(f"{name} {value:g}: {shares}; changed at rtol 1e-9: {np.sum(found != tight)} of {found.size}", flush=True)


if __name__ == "__main__":
    main()
