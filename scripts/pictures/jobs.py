"""The pictures of the jobs (docs/how_to/jobs.md): each from the scene or script that the page shows."""

from __future__ import annotations

import csv
import importlib.util
import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import slideway
import xarray as xr
from scipy.io import loadmat
from slideway.palette import colours, grey, limit_colour
from slideway.plot.axes import frame

from .style import as_svg, panels

_g = 9.81


def _job(root: Path, scene: str, key: str, values: Sequence[float], duration: float, samples: int, series: list[str]) -> xr.Dataset:
    """A job's scene with a member for each of these values in place of its own members, and with time series."""
    vary = {key: {"dist": "values", "values": list(values)}}
    return slideway.run(root / "examples/jobs" / scene, progress=False, set={
        "study.design": "grid", "study.members": len(values), "study.vary": vary, "study.duration": duration, "study.samples": samples,
        "study.quantities": ["energy_residual", *series], "study.verify": 0})  # fmt: skip


def _table(root: Path, name: str) -> np.ndarray:
    """The rows of a table beside the scenes."""
    return np.loadtxt(root / "examples/jobs" / name, delimiter=",", skiprows=1)


def pump(root: Path) -> str:
    """Pressure of the plunger over a turn, and where the crosshead lies in its gap meanwhile."""
    gap, turn = 36.5, 0.1
    figure, (above, below) = panels(2, height=4.2, sharex=True)
    above.plot(*_table(root, "indicator.csv").T, "o-", color=grey, ms=3.5, lw=1)
    frame(above, "", "pressure [bar]")
    for scale, colour, words in ((4.909e-4, colours[0], "with the pressure"), (0.0, colours[1], "without")):
        result = _job(root, "pump.toml", "load.plunger.scale", [scale], 5 * turn, 5 * 600 + 1, ["y"])
        last = result.time.values >= 4 * turn - 1e-9
        below.plot(360 * (result.time.values[last] - 4 * turn) / turn, 1e6 * result.y.values[0, last], color=colour, lw=1.4, label=words)
    for side in (-gap, gap):
        below.axhline(side, color=grey, lw=0.8, ls=":")
    below.set_xlim(0, 360)
    below.set_xticks(range(0, 361, 60))
    below.set_ylim(-1.5 * gap, 1.5 * gap)
    below.legend(frameon=False, loc="upper center", ncols=2, bbox_to_anchor=(0.5, 1.08))
    frame(below, "crank angle in the fifth turn [°]", "height in the gap [µm]")
    return as_svg(figure)


def press(root: Path) -> str:
    """Speed of the press's crank over its strokes, with a light and a heavy flywheel."""
    figure, (ax,) = panels(height=3.0)
    result = _job(root, "press.toml", "drive.inertia", [0.3, 0.7], 5, 501, ["crank_angular_velocity"])
    for row, inertia, colour in zip(result.crank_angular_velocity.values, result.drive_inertia.values, colours, strict=False):
        ax.plot(result.time.values, row * 30 / np.pi, color=colour, lw=1.4, label=f"flywheel of {inertia:g} kg m²")
    ax.set_xlim(0, 5)
    figure.legend(loc="outside lower center", ncols=2, frameon=False)
    frame(ax, "time [s]", "crank speed [rpm]")
    return as_svg(figure)


def carriage(root: Path) -> str:
    """The measured speed and that of the carriage, and how it drops onto its way."""
    rest = 20 - 50  # offset less clearance [um]
    figure, (above, below) = panels(2, height=4.4)
    result = _job(root, "carriage.toml", "drive.scale", [1.0], 2.4, 1201, ["vx"])
    first = _job(root, "carriage.toml", "drive.scale", [1.0], 0.1, 2001, ["y"])
    above.plot(result.time.values, 1e3 * result.vx.values[0], color=colours[0], lw=1.4, label="carriage")
    above.plot(*_table(root, "carriage.csv").T, "o", color=colours[1], ms=4, label="measured")
    above.legend(frameon=False)
    above.set_xlim(0, 2.4)
    frame(above, "time [s]", "speed [mm/s]")
    below.plot(1e3 * first.time.values, 1e6 * first.y.values[0], color=colours[0], lw=1.2)
    below.axhline(rest, color=grey, lw=1, ls="--")
    below.text(100, rest + 4, "way's offset less clearance", color=grey, ha="right", va="bottom")
    below.set_xlim(0, 100)
    below.set_ylim(-32, 2)
    frame(below, "time [ms]", "height [µm]")
    return as_svg(figure)


def end_stops(root: Path) -> str:
    """Free carriages that run into a buffer, come back and slide to rest."""
    figure, (ax,) = panels(height=3.0)
    result = _job(root, "end_stops.toml", "initial.vx", [0.46, 0.5, 0.54], 0.6, 601, ["x"])
    for row, speed, colour in zip(result.x.values, result.initial_vx.values, colours, strict=False):
        ax.plot(result.time.values, 1e3 * row, color=colour, lw=1.4, label=f"{speed:g} m/s")
    ax.axhline(50, color=limit_colour, lw=1, ls="--")
    ax.text(0.6, 50.5, "buffer", color=limit_colour, ha="right", va="bottom")
    ax.set_xlim(0, 0.6)
    ax.set_ylim(0, 58)
    ax.legend(frameon=False, title="speed at the start", loc="lower right")
    frame(ax, "time [s]", "place on the way [mm]")
    return as_svg(figure)


def oil_film(root: Path) -> str:
    """How a machine table sinks through its oil, beside the closed form."""
    length, width, depth, gap, weight = 0.2, 0.06, 0.08, 40e-6, 20 * _g + 1800  # of the scene
    figure, (ax,) = panels(height=3.0)
    result = _job(root, "oil_film.toml", "film.viscosity", [0.04, 0.06, 0.08], 3, 301, ["y"])
    films, dots = np.linspace(0.9999 * gap, 10e-6, 300), np.linspace(0, 3, 13)
    for row, viscosity, colour in zip(result.y.values, result.film_viscosity.values, colours, strict=False):
        ax.plot(result.time.values, 1e6 * (gap + row), color=colour, lw=1.4, label=f"{viscosity:g} Pa s")
        # Pushed by the film below, held by the one above, sheared at both sides.
        squeeze, sides = viscosity * depth**3 * (length - 0.63 * depth), 2 * viscosity * length * width / gap
        times = (0.5 * squeeze * (films**-2 - (2 * gap - films) ** -2) + sides * (gap - films)) / weight
        ax.plot(dots, 1e6 * np.interp(dots, times, films), "o", color=colour, ms=3.5)
    ax.plot([], [], "o", color=grey, ms=3.5, label="closed form")
    ax.set_xlim(0, 3)
    ax.set_ylim(0, 42)
    ax.legend(frameon=False, title="viscosity", loc="lower left", ncols=2)
    frame(ax, "time [s]", "film below the table [µm]")
    return as_svg(figure)


def shaken_spring(root: Path) -> str:
    """A slide on a spring on a shaking frame, and the amplitude of its resonance curve."""
    mass, stiffness, damping, turn = 0.8, 800.0, 2.5, 8 * np.pi  # of the scene
    amplitude = 1e3 * 1.5 / np.hypot(stiffness / mass - turn**2, turn * damping / mass)
    figure, (ax,) = panels(height=3.0)
    result = _job(root, "shaken_spring.toml", "spring.return.damping", [damping], 4, 801, ["x"])
    ax.plot(result.time.values, 1e3 * result.x.values[0], color=colours[0], lw=1.2, label="slide, relative to the frame")
    for side in (amplitude, -amplitude):
        ax.axhline(side, color=colours[1], lw=1.4, ls="--", label=f"resonance curve: ±{amplitude:.2f} mm" if side > 0 else None)
    ax.set_xlim(0, 4)
    ax.set_ylim(-8, 8)
    figure.legend(loc="outside lower center", ncols=2, frameon=False)
    frame(ax, "time [s]", "x [mm]")
    return as_svg(figure)


def leaning_way(root: Path) -> str:
    """A slider that glides down a way that rises and leans, beside the closed form."""
    figure, (ax,) = panels(height=3.0)
    leans = (0.0, 20.0, 45.0)
    result = _job(root, "leaning_way.toml", "mechanism.cross_inclination", np.deg2rad(leans), 0.5, 101, ["x"])
    dots = np.linspace(0, 0.5, 11)
    for row, lean, colour in zip(result.x.values, result.mechanism_cross_inclination.values, colours, strict=False):
        ax.plot(result.time.values, 1e3 * row, color=colour, lw=1.4, label=f"{np.rad2deg(lean):.0f}°")
        pull = _g * (np.sin(np.pi / 6) - 0.15 * np.cos(np.pi / 6) * (np.cos(lean) + np.sin(lean)))
        ax.plot(dots, -500 * pull * dots**2, "o", color=colour, ms=3.5)
    ax.plot([], [], "o", color=grey, ms=3.5, label="closed form")
    ax.set_xlim(0, 0.5)
    ax.legend(frameon=False, title="leans to its side by", loc="lower left")
    frame(ax, "time [s]", "x [mm]")
    return as_svg(figure)


def worn_way(root: Path) -> str:
    """A worn face, and how the carriage on it leans along its way."""
    figure, (above, below) = panels(2, height=4.2, sharex=True)
    above.plot(*_table(root, "wear.csv").T, "o-", color=grey, ms=3.5, lw=1)
    above.invert_yaxis()
    frame(above, "", "depth of the face [µm]")
    result = _job(root, "worn_way.toml", "way_profile.wear.scale", [0.5, 1.0, 1.5], 0.45, 901, ["pitch"])
    for row, scale, colour in zip(result.pitch.values, result.way_profile_wear_scale.values, colours, strict=False):
        below.plot(400 * result.time.values, 1e3 * row, color=colour, lw=1.4, label=f"{scale:g} of the depth")
    below.set_xlim(0, 180)
    below.legend(frameon=False)
    frame(below, "place of the carriage on its way [mm]", "pitch [mrad]")
    return as_svg(figure)


def overhang(root: Path) -> str:
    """Where both ends of a guide with an overhanging tool lie in its gap, there and back."""
    half, upper, lower = 30.0, 20.0, 30.0  # of the guide's length [mm], clearances [um]
    figure, (ax,) = panels(height=3.2)
    result = _job(root, "overhang.toml", "slider.mass_center_x", [0.045], 0.54, 2701, ["y", "pitch"])
    middle, turned = 1e6 * result.y.values[0], 1e3 * half * result.pitch.values[0]
    for side, colour, words in ((1, colours[0], "front, under the tool"), (-1, colours[1], "rear")):
        ax.plot(1e3 * result.time.values, middle + side * turned, color=colour, lw=1.2, label=words)
    for limit in (-upper, lower):
        ax.axhline(limit, color=grey, lw=1, ls="--")
    for reversal in (250, 520):
        ax.axvspan(reversal, reversal + 20, color=grey, alpha=0.2, lw=0)
    ax.text(260, 0, "turns round", color=grey, ha="center", va="center", rotation=90)
    ax.set_xlim(0, 540)
    ax.set_ylim(-38, 48)
    ax.legend(frameon=False, loc="upper left", ncols=2)
    frame(ax, "time [ms]", "height in the gap [µm]")
    return as_svg(figure)


def export(root: Path) -> str:
    """What other programs read: members from the CSV file, a time series from the MAT file."""
    program = Path(os.environ["SLIDEWAY_PROGRAM"]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["sh", str(root / "examples/jobs/export.sh"), "--quiet", "--set", "study.members=64", "--set", "study.verify=0"], cwd=folder,
                       env={**os.environ, "PATH": f"{program.parent}{os.pathsep}{os.environ['PATH']}"}, check=True, capture_output=True)  # fmt: skip
        with (Path(folder) / "pump_members.csv").open(encoding="utf-8") as lines:
            members = list(csv.DictReader(lines))
        series = loadmat(Path(folder) / "pump.mat", squeeze_me=True, struct_as_record=False)["series"]
    figure, (left, right) = panels(1, 2, height=3.0)
    left.plot([1e6 * float(row["joint.clearance_y [m]"]) for row in members], [1e3 * float(row["damping_loss [J]"]) for row in members], "o",
              color=colours[0], ms=3.5)
    left.set_title("pump_members.csv", loc="left")
    frame(left, "clearance [µm]", "impact loss [mJ]")
    for number, colour in zip((0, 1), colours, strict=False):
        right.plot(1e3 * series.time, 1e6 * series.y[number], color=colour, lw=1.2, label=f"member {number}")
    right.set_xlim(0, 200)
    right.set_ylim(-95, 55)
    right.set_title("pump.mat", loc="left")
    right.legend(frameon=False, loc="lower right")
    frame(right, "time [ms]", "y [µm]")
    return as_svg(figure)


def fit(root: Path) -> str:
    """Shares of the pumps that exceed the limit, by fit, with their intervals, from few and from enough members."""
    found = importlib.util.spec_from_file_location("fit", root / "examples/jobs/fit.py")
    assert found and found.loader
    job = importlib.util.module_from_spec(found)
    sys.modules["fit"] = job  # where its data class looks itself up
    found.loader.exec_module(job)
    lowest = 0.02  # [%], where the axis ends
    figure, (ax,) = panels(height=3.4)
    for shift, members, colour in ((-0.13, 256, colours[1]), (0.13, 4000, colours[0])):
        for place, name in enumerate(job.COSTS):
            row = job.study(name, members, None)
            low, high, share = (100 * (1 - value) for value in (*reversed(row.interval), row.met / row.members))
            ax.plot([place + shift] * 2, [max(low, lowest), high], color=colour, lw=2.4, solid_capstyle="butt",
                    label=f"{members:,} pumps of each fit" if place == 0 else None)
            ax.plot(place + shift, max(share, lowest), "o" if share > 0 else "v", color=colour, ms=6, clip_on=False)
    ax.axhline(100 * (1 - job.WANTED), color=limit_colour, lw=1.4, ls="--")
    ax.text(4.45, 0.108, "0.1 %", color=limit_colour, ha="right", va="bottom")
    ax.set_yscale("log")
    ax.set_ylim(lowest, 100)
    ax.set_yticks([0.1, 1, 10, 100], ["0.1", "1", "10", "100"])
    ax.set_xticks(range(len(job.COSTS)), [f"{name}\n{cost:g}" for name, cost in job.COSTS.items()])
    ax.legend(frameon=False, loc="upper left")
    frame(ax, "fit, and what it costs", "above the limit [%]")
    return as_svg(figure)


JOBS = {f"job_{make.__name__}": make for make in (pump, press, carriage, end_stops, oil_film, shaken_spring, leaning_way, overhang, worn_way, export, fit)}
