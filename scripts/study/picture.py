"""The pictures of the worked studies."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import slideway
from pictures.style import as_svg, axes_of
from slideway.palette import colours, grey, limit_colour
from slideway.plot.axes import frame

from . import ideal
from .machines import Carriage, Press, ideal_press, lifting
from .runs import Outcome, fits, pump


def losses(rigid: list[Outcome], compliant: list[Outcome]) -> str:
    """How the energy of impacts is distributed for each fit, and the limit; as SVG."""
    figure, (ax,) = axes_of(height=3.6)
    frame(ax, "energy lost in impacts, a turn [mJ]", "share of crossheads below")
    for colour, fit, stiff, soft in zip(colours, fits, rigid, compliant, strict=False):
        for of, style, label in ((stiff, "-", fit.name), (soft, ":", None)):
            ordered = 1e3 * np.sort(of.impacts)
            chosen = np.unique(np.linspace(0, ordered.size - 1, 160).astype(int))
            ax.plot(ordered[chosen], (chosen + 0.5) / ordered.size, style, color=colour, lw=2, label=label)
    ax.plot([], [], ":", color="#555555", lw=2, label="compliant contacts")
    ax.axvline(1e3 * pump.impact_limit, color=limit_colour, lw=1.2, label="limit")
    ax.set_xscale("log")
    ax.set_xticks([0.2, 0.5, 1, 2, 5, 10], ["0.2", "0.5", "1", "2", "5", "10"])
    ax.minorticks_off()
    ax.set_ylim(0, 1.01)
    figure.legend(loc="outside lower center", ncols=3, frameon=False)
    return as_svg(figure)


def worn(root: Path) -> str:
    """Side force and wear over the way; how the crosshead leans meanwhile, in its second turn."""
    figure, (above, below) = axes_of(2, height=4.6)
    one = ideal.turn(root, 0.08)
    above.plot(1e3 * one.x, -one.side, color=colours[0], lw=1.4)
    frame(above, "place of the slider's centre, and along the way [mm]", "side force down [N]")
    rows = np.loadtxt(root / "scenes/crosshead_wear.csv", delimiter=",", skiprows=1)
    other = above.twinx()
    other.plot(*rows.T, "o-", color=grey, ms=3.5, lw=1)
    other.set_ylabel("wear, share of its depth", color=grey)
    other.set_ylim(-0.05, 1.1)
    above.set_ylim(-20, 400)
    depths = [0.0, 40.0, 80.0]
    result = slideway.run(root / "scenes/crosshead_space.toml", progress=False, set={
        "study.design": "grid", "study.members": len(depths), "study.vary": {"way_profile.wear.scale": {"dist": "values", "values": depths}},
        "study.verify": 0, "mechanism.start_angle": "90 deg", "study.samples": 2401, "study.quantities": ["energy_residual", "pitch"]})  # fmt: skip
    angle = 90 + np.degrees(ideal.speed) * result.time.values - 360
    last = (angle >= 0) & (angle <= 360)
    for pitch, depth, colour in zip(result.pitch.values, depths, colours, strict=False):
        below.plot(angle[last], 1e3 * pitch[last], color=colour, lw=1.2, label=f"{depth:g} µm")
    below.set_xlim(0, 360)
    below.set_xticks(range(0, 361, 60))
    below.legend(frameon=False, loc="upper left", bbox_to_anchor=(0.28, 1.05), title="worn by")
    frame(below, "crank angle [°]", "pitch [mrad]")
    return as_svg(figure)


def machines(root: Path, presses: list[Press], carriages: list[Carriage]) -> str:
    """The press's drop over its flywheel, the carriage's lean over the height of its mass."""
    figure, (left, right) = axes_of(1, 2, height=3.4)
    inertia = np.geomspace(presses[0].inertia, presses[-1].inertia, 40)
    left.plot(inertia, 100 * ideal_press(root, inertia), color=grey, lw=1.2, label="closed form")
    for one in presses:
        left.plot([one.inertia] * 2, 100 * np.quantile(one.drop, [0.01, 0.99]), color=colours[0], lw=2.4, solid_capstyle="butt")
    left.plot([one.inertia for one in presses], [100 * np.mean(one.drop) for one in presses], "o", color=colours[0], ms=4, label="presses, 98 %")
    left.axhline(10, color=limit_colour, lw=1.2, ls="--")
    left.set_xscale("log")
    left.set_xticks([one.inertia for one in presses], [f"{one.inertia:g}" for one in presses])
    left.minorticks_off()
    left.set_ylim(0, None)
    left.legend(frameon=False)
    frame(left, "flywheel [kg m²]", "speed lost in a stroke [%]")
    for one, colour in zip(carriages, colours, strict=False):
        right.plot(1e3 * one.heights, 1e3 * one.leaning, "o-", color=colour, ms=3, lw=1.2, label=one.interpolation)
        right.axvline(1e3 * lifting(root, one.interpolation), color=colour, lw=1, ls="--")
    right.legend(frameon=False, loc="center left")
    frame(right, "height of the mass [mm]", "largest pitch [mrad]")
    return as_svg(figure)
