"""The pictures of the worked studies."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import slideway
from slideway.figures.marks import Axis, Curve, Level, Mark, Panel
from slideway.palette import colours, grey, limit_colour
from slideway.plot.axes import picture

from . import ideal
from .machines import Carriage, Press, ideal_press, lifting
from .runs import Outcome, fits, pump


def losses(rigid: list[Outcome], compliant: list[Outcome]) -> str:
    """How the energy of impacts is distributed for each fit, and the limit; as SVG."""
    curves = []
    for colour, fit, *both in zip(colours, fits, rigid, compliant, strict=False):
        for of, dash, label in zip(both, ("-", ":"), (fit.name, None), strict=True):
            ordered = 1e3 * np.sort(of.impacts)
            chosen = np.unique(np.linspace(0, ordered.size - 1, 160).astype(int))
            curves.append(Curve(ordered[chosen], (chosen + 0.5) / ordered.size, label, colour, width=2, dash=dash))
    of_others = Curve(np.empty(0), np.empty(0), "compliant contacts", "#555555", width=2, dash=":")
    limit = Level(1e3 * pump.impact_limit, "x", "limit", limit_colour, 1.2)
    lost = Axis("energy lost in impacts, a turn", "mJ", log=True, ticks={value: f"{value:g}" for value in (0.2, 0.5, 1, 2, 5, 10)})
    return picture([Panel([*curves, of_others, limit], lost, Axis("share of crossheads below", low=0, high=1.01))], height=3.6, below=3)


def worn(root: Path) -> str:
    """Side force and wear over the way; how the crosshead leans meanwhile, in its second turn."""
    one = ideal.turn(root, 0.08)
    rows = np.loadtxt(root / "scenes/crosshead_wear.csv", delimiter=",", skiprows=1)
    wear = Panel([Curve(*rows.T, colour=grey, width=1, marker="o", size=3.5)], Axis(""), Axis("wear, share of its depth", low=-0.05, high=1.1))
    place, force = Axis("place of the slider's centre, and along the way", "mm"), Axis("side force down", "N", low=-20, high=400)
    above = Panel([Curve(1e3 * one.x, -one.side, width=1.4)], place, force, right=wear)
    depths = [0.0, 40.0, 80.0]
    result = slideway.run(root / "scenes/crosshead_space.toml", progress=False, set={
        "study.design": "grid", "study.members": len(depths), "study.vary": {"way_profile.wear.scale": {"dist": "values", "values": depths}},
        "study.verify": 0, "mechanism.start_angle": "90 deg", "study.samples": 2401, "study.quantities": ["energy_residual", "pitch"]})  # fmt: skip
    angle = 90 + np.degrees(ideal.speed) * result.time.values - 360
    last = (angle >= 0) & (angle <= 360)
    leans = [Curve(angle[last], 1e3 * pitch[last], f"worn by {depth:g} µm", colour)
             for pitch, depth, colour in zip(result.pitch.values, depths, colours, strict=False)]  # fmt: skip
    ticks = {place: f"{place}" for place in range(0, 361, 60)}
    below = Panel(leans, Axis("crank angle", "°", low=0, high=360, ticks=ticks), Axis("pitch", "mrad"))
    return picture([above, below], height=4.8, below=3)


def machines(root: Path, presses: list[Press], carriages: list[Carriage]) -> str:
    """The press's drop over its flywheel, the carriage's lean over the height of its mass."""
    inertia, wheels = np.geomspace(presses[0].inertia, presses[-1].inertia, 40), np.array([one.inertia for one in presses])
    low, high = (100 * np.array([np.quantile(one.drop, part) for one in presses]) for part in (0.01, 0.99))
    means = 100 * np.array([np.mean(one.drop) for one in presses])
    left = [
        Curve(inertia, 100 * ideal_press(root, inertia), "closed form", grey), Level(10, colour=limit_colour, width=1.2, dash="--"),
        Curve(wheels, means, "presses, 98 %", dash="", marker="o", low=low, high=high),
    ]  # fmt: skip
    right: list[Mark] = []
    for one, colour in zip(carriages, colours, strict=False):
        right.append(Curve(1e3 * one.heights, 1e3 * one.leaning, one.interpolation, colour, marker="o", size=3))
        right.append(Level(1e3 * lifting(root, one.interpolation), "x", colour=colour, dash="--"))
    flywheel = Axis("flywheel", "kg m²", log=True, ticks={wheel: f"{wheel:g}" for wheel in wheels})
    return picture([
        Panel(left, flywheel, Axis("speed lost in a stroke", "%", low=0)), Panel(right, Axis("height of the mass", "mm"), Axis("largest pitch", "mrad")),
    ], 2, 3.6, 5)  # fmt: skip
