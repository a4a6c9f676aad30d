"""The pictures of the jobs (docs/how_to/jobs.md): each from the scene or script that the page shows."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import slideway
import xarray as xr
from scipy.io import loadmat
from slideway.figures.marks import Axis, Curve, Level, Mark, Panel, named
from slideway.palette import colours, grey, limit_colour
from slideway.plot.axes import picture

_g = 9.81


def _job(root: Path, scene: str, key: str, values: Sequence[float], duration: float, samples: int, series: list[str]) -> xr.Dataset:
    """A job's scene with a member for each of these values in place of its own members, and with time series."""
    vary = {key: {"dist": "values", "values": list(values)}}
    return slideway.run(root / "examples/jobs" / scene, progress=False, set={
        "study.design": "grid", "study.members": len(values), "study.vary": vary, "study.duration": duration, "study.samples": samples,
        "study.quantities": ["energy_residual", *series], "study.verify": 0})  # fmt: skip


def _table(root: Path, name: str) -> Curve:
    """A table beside the scenes."""
    return Curve(*np.loadtxt(root / "examples/jobs" / name, delimiter=",", skiprows=1).T, colour=grey, width=1, marker="o", size=3.5)


def _rows(x: np.ndarray, rows: np.ndarray, names: Sequence[str], factor: float = 1.0, width: float = 1.4) -> list[Mark]:
    """A series of each member."""
    return [Curve(x, factor * row, name, colour, width=width) for row, name, colour in zip(rows, names, colours, strict=False)]


def _closed(x: np.ndarray, rows: Sequence[np.ndarray]) -> list[Mark]:
    """What a closed form says of each member."""
    dots: list[Mark] = [Curve(x, row, colour=colour, dash="", marker="o", size=4) for row, colour in zip(rows, colours, strict=False)]
    return [*dots, Curve(x[:0], x[:0], "closed form", grey, dash="", marker="o", size=4)]


def pump(root: Path) -> str:
    """Pressure of the plunger over a turn, and where the crosshead lies in its gap meanwhile."""
    gap, turn = 36.5, 0.1
    result = _job(root, "pump.toml", "load.plunger.scale", [4.909e-4, 0.0], 5 * turn, 5 * 600 + 1, ["y"])
    last = result.time.values >= 4 * turn - 1e-9
    angle = Axis("crank angle in the fifth turn", "°", low=0, high=360, ticks={place: f"{place:g}" for place in range(0, 361, 60)})
    marks = _rows(360 * (result.time.values[last] - 4 * turn) / turn, result.y.values[:, last], ("with the pressure", "without"), 1e6)
    below = Panel([*marks, *(Level(side, dash=":", width=0.8) for side in (-gap, gap))], angle, Axis("height in the gap", "µm", low=-1.5 * gap, high=1.5 * gap))
    return picture([Panel([_table(root, "indicator.csv")], Axis(""), Axis("pressure", "bar")), below], height=4.4, below=2, sharex=True)


def press(root: Path) -> str:
    """Speed of the press's crank over its strokes, with a light and a heavy flywheel."""
    result = _job(root, "press.toml", "drive.inertia", [0.3, 0.7], 5, 501, ["crank_angular_velocity"])
    names = [f"flywheel of {inertia:g} kg m²" for inertia in result.drive_inertia.values]
    marks = _rows(result.time.values, result.crank_angular_velocity.values, names, 30 / np.pi)
    return picture([Panel(marks, Axis("time", "s", low=0, high=5), Axis("crank speed", "rpm"))], height=3.0, below=2)


def carriage(root: Path) -> str:
    """The measured speed and that of the carriage, and how it drops onto its way."""
    result = _job(root, "carriage.toml", "drive.scale", [1.0], 2.4, 1201, ["vx"])
    first = _job(root, "carriage.toml", "drive.scale", [1.0], 0.1, 2001, ["y"])
    measured = replace(_table(root, "carriage.csv"), label="measured", colour=colours[1], dash="", size=4)
    rest = Level(20 - 50, label="way's offset less clearance", dash="--")  # [um]
    above = Panel([*_rows(result.time.values, result.vx.values, ["carriage"], 1e3), measured], Axis("time", "s", low=0, high=2.4), Axis("speed", "mm/s"))
    below = Panel([Curve(1e3 * first.time.values, 1e6 * first.y.values[0]), rest], Axis("time", "ms", low=0, high=100), Axis("height", "µm", low=-32, high=2))
    return picture([above, below], height=4.4)


def end_stops(root: Path) -> str:
    """Free carriages that run into a buffer, come back and slide to rest."""
    result = _job(root, "end_stops.toml", "initial.vx", [0.46, 0.5, 0.54], 0.6, 601, ["x"])
    marks = _rows(result.time.values, result.x.values, [f"{speed:g} m/s at the start" for speed in result.initial_vx.values], 1e3)
    buffer = Level(50, label="buffer", colour=limit_colour, dash="--")
    return picture([Panel([*marks, buffer], Axis("time", "s", low=0, high=0.6), Axis("place on the way", "mm", low=0, high=58))], height=3.0)


def oil_film(root: Path) -> str:
    """How a machine table sinks through its oil, beside the closed form."""
    length, width, depth, gap, weight = 0.2, 0.06, 0.08, 40e-6, 20 * _g + 1800  # of the scene
    result = _job(root, "oil_film.toml", "film.viscosity", [0.04, 0.06, 0.08], 3, 301, ["y"])
    films, dots, closed = np.linspace(0.9999 * gap, 10e-6, 300), np.linspace(0, 3, 13), []
    for viscosity in result.film_viscosity.values:
        # Pushed by the film below, held by the one above, sheared at both sides.
        squeeze, sides = viscosity * depth**3 * (length - 0.63 * depth), 2 * viscosity * length * width / gap
        times = (0.5 * squeeze * (films**-2 - (2 * gap - films) ** -2) + sides * (gap - films)) / weight
        closed.append(1e6 * np.interp(dots, times, films))
    marks = _rows(result.time.values, gap + result.y.values, [f"{viscosity:g} Pa s" for viscosity in result.film_viscosity.values], 1e6)
    axes = Axis("time", "s", low=0, high=3), Axis("film below the table", "µm", low=0, high=42)
    return picture([Panel([*marks, *_closed(dots, closed)], *axes)], height=3.2, below=4)


def shaken_spring(root: Path) -> str:
    """A slide on a spring on a shaking frame, and the amplitude of its resonance curve."""
    mass, stiffness, damping, turn = 0.8, 800.0, 2.5, 8 * np.pi  # of the scene
    amplitude = 1e3 * 1.5 / np.hypot(stiffness / mass - turn**2, turn * damping / mass)
    result = _job(root, "shaken_spring.toml", "spring.return.damping", [damping], 4, 801, ["x"])
    marks = _rows(result.time.values, result.x.values, ["slide, relative to the frame"], 1e3, 1.2)
    marks += [Level(side, "y", f"resonance curve: ±{amplitude:.2f} mm", colours[1], 1.4, "--") for side in (amplitude, -amplitude)]
    return picture([Panel(marks, Axis("time", "s", low=0, high=4), Axis("x", "mm", low=-8, high=8))], height=3.0, below=2)


def leaning_way(root: Path) -> str:
    """A slider that glides down a way that rises and leans, beside the closed form."""
    leans, dots = np.deg2rad([0.0, 20.0, 45.0]), np.linspace(0, 0.5, 11)
    result = _job(root, "leaning_way.toml", "mechanism.cross_inclination", leans, 0.5, 101, ["x"])
    pulls = _g * (np.sin(np.pi / 6) - 0.15 * np.cos(np.pi / 6) * (np.cos(leans) + np.sin(leans)))
    marks = _rows(result.time.values, result.x.values, [f"leans by {np.rad2deg(lean):.0f}°" for lean in leans], 1e3)
    marks += _closed(dots, [-500 * pull * dots**2 for pull in pulls])
    return picture([Panel(marks, Axis("time", "s", low=0, high=0.5), Axis("x", "mm"))], height=3.0)


def worn_way(root: Path) -> str:
    """A worn face, and how the carriage on it leans along its way."""
    result = _job(root, "worn_way.toml", "way_profile.wear.scale", [0.5, 1.0, 1.5], 0.45, 901, ["pitch"])
    marks = _rows(400 * result.time.values, result.pitch.values, [f"{scale:g} of the depth" for scale in result.way_profile_wear_scale.values], 1e3)
    wear = _table(root, "wear.csv")
    above = Panel([wear], Axis(""), Axis("depth of the face", "µm", low=1.05 * wear.y.max(), high=-0.05 * wear.y.max()))
    below = Panel(marks, Axis("place of the carriage on its way", "mm", low=0, high=180), Axis("pitch", "mrad"))
    return picture([above, below], height=4.2, sharex=True)


def overhang(root: Path) -> str:
    """Where both ends of a guide with an overhanging tool lie in its gap, there and back."""
    half, upper, lower = 30.0, 20.0, 30.0  # of the guide's length [mm], clearances [um]
    result = _job(root, "overhang.toml", "slider.mass_center_x", [0.045], 0.54, 2701, ["y", "pitch"])
    middle, turned = 1e6 * result.y.values[0], 1e3 * half * result.pitch.values[0]
    marks = _rows(1e3 * result.time.values, np.array([middle + turned, middle - turned]), ("front, under the tool", "rear"), width=1.2)
    marks += [Level(limit, dash="--") for limit in (-upper, lower)]
    marks += [Level(reversal + 10, "x", "turns round" if reversal < 300 else None, width=0, half=10) for reversal in (250, 520)]
    return picture([Panel(marks, Axis("time", "ms", low=0, high=540), Axis("height in the gap", "µm", low=-38, high=48))], height=3.2, below=3)


def export(root: Path) -> str:
    """What other programs read: members from the CSV file, a time series from the MAT file."""
    program = Path(os.environ["SLIDEWAY_PROGRAM"]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["sh", str(root / "examples/jobs/export.sh"), "--quiet", "--set", "study.members=64", "--set", "study.verify=0"], cwd=folder,
                       env={**os.environ, "PATH": f"{program.parent}{os.pathsep}{os.environ['PATH']}"}, check=True, capture_output=True)  # fmt: skip
        members = pd.read_csv(Path(folder) / "pump_members.csv")
        series = loadmat(Path(folder) / "pump.mat", squeeze_me=True, struct_as_record=False)["series"]
    clearance, loss = (members[name].to_numpy() for name in ("joint.clearance_y [m]", "damping_loss [J]"))
    left = Curve(1e6 * clearance, 1e3 * loss, dash="", marker="o", size=4)
    lines = _rows(1e3 * series.time, series.y[:2], ["member 0", "member 1"], 1e6, 1.2)
    return picture([
        Panel([left], Axis("clearance", "µm"), Axis("impact loss", "mJ"), "pump_members.csv"),
        Panel(lines, Axis("time", "ms", low=0, high=200), Axis("y", "µm", low=-95, high=55), "pump.mat"),
    ], columns=2, height=3.0)  # fmt: skip


def fit(root: Path) -> str:
    """Shares of the pumps that exceed the limit, by fit, with their intervals, from few and from enough members."""
    found = importlib.util.spec_from_file_location("fit", root / "examples/jobs/fit.py")
    assert found and found.loader
    job = importlib.util.module_from_spec(found)
    sys.modules["fit"] = job  # where its data class looks itself up
    found.loader.exec_module(job)
    lowest = 0.02  # [%], where the axis ends
    marks: list[Mark] = []
    for shift, members, colour in ((-0.13, 256, colours[1]), (0.13, 4000, colours[0])):
        rows = [job.study(name, members, None) for name in job.COSTS]
        low, high, share = 100 * (1 - np.array([(row.interval[1], row.interval[0], row.met / row.members) for row in rows]).T)
        place = np.arange(len(rows)) + shift
        for some, marker, words in ((share > 0, "o", f"{members:,} pumps of each fit"), (share <= 0, "v", None)):
            ends = {"low": np.maximum(low, lowest)[some], "high": high[some]}
            marks.append(Curve(place[some], np.maximum(share, lowest)[some], words, colour, dash="", marker=marker, size=6, **ends))
    marks.append(Level(100 * (1 - job.WANTED), "y", "0.1 %", limit_colour, 1.4, "--"))
    across = Axis("fit, and what it costs", ticks=named([f"{name}\n{cost:g}" for name, cost in job.COSTS.items()]))
    up = Axis("above the limit", "%", log=True, low=lowest, high=100, ticks={value: f"{value:g}" for value in (0.1, 1, 10, 100)})
    return picture([Panel(marks, across, up)], height=3.4)


JOBS = {f"job_{make.__name__}": make for make in (pump, press, carriage, end_stops, oil_film, shaken_spring, leaning_way, overhang, worn_way, export, fit)}
