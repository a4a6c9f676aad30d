"""The pictures of results."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import slideway
import xarray as xr
from slideway.figures.base import by_contact, panel_of
from slideway.figures.marks import Axis, Bars, Cloud, Curve, Level, Mark, Note, Panel, Shape, box, named
from slideway.palette import class_colours, colours, grey, limit_colour
from slideway.plot.axes import picture
from slideway.sections import sections

law_colours = {"paper": colours[1], "conservative": colours[0]}
law_names = {"paper": "law as published (paper)", "conservative": "conservative law"}

_short = {"paper": "as published", "conservative": "conservative"}
_standard = "scenes/slider_crank_0.1mm.toml"
_starts = {"initial.y": {"dist": "unif", "low": "-0.05 mm", "high": "0.05 mm"}}


def run(root: Path, scene: str, law: str, **overrides: Any) -> xr.Dataset:
    """A scene of the repository under a law, of which nothing runs again to be checked: the documentation's tables are."""
    varied = overrides.pop("vary", None)
    return slideway.run(root / scene, progress=False, contact__law=law, set={"study.vary": varied} if varied else None,
                        **{"study__verify": 0} | overrides)


def stretches(edges: np.ndarray, there: np.ndarray, low: float, height: float, colour: str) -> list[Shape]:
    """The stretches of columns in which a flag is set, in a row; the columns' edges are one more than the flags.

    >>> [one.points[[0, 2]].tolist() for one in stretches(np.arange(6.0), np.array([True, False, True, True, False]), 0, 1, "red")]
    [[[0.0, 0.0], [1.0, 1.0]], [[2.0, 0.0], [4.0, 1.0]]]
    """
    change = np.diff(np.concatenate([[0], there, [0]]).astype(int))
    begins, ends = np.flatnonzero(change > 0), np.flatnonzero(change < 0)
    return [Shape(box(edges[b], low, edges[e] - edges[b], height), fill=colour) for b, e in zip(begins, ends, strict=True)]


def modes(root: Path) -> str:
    """Which contacts a slider has over its first 0.6 s: the hardest of each sample."""
    panels = []
    for law, words in law_names.items():
        result = run(root, _standard, law, study__revolutions=0.3, study__samples_per_revolution=0, study__samples=6001,
                     study__quantities=["points", "lines", "surfaces", "x"])
        classes = by_contact(*(result[name].values[0] > 0 for name in ("surfaces", "lines", "points")))
        time = result["time"].values * 1e3
        # As fine as 400 columns of the picture; no contact gets lost.
        edges = np.linspace(time[0], time[-1], 401)
        column = np.minimum(np.searchsorted(edges, time, "right") - 1, 399)
        spans = [shape for level, (name, there) in enumerate(classes.items())
                 for shape in stretches(edges, np.bincount(column, there, 400) > 0, level - 0.4, 0.8, class_colours[name])]  # fmt: skip
        shares = {name: np.mean(there) for name, there in classes.items()}
        ticks = named([f"{name} {'<1%' if 0 < share < 0.01 else f'{share:.0%}'}" for name, share in shares.items()])
        across = Axis("time" if panels else "", "ms" if panels else "", low=time[0], high=time[-1])
        panels.append(Panel(spans, across, Axis("", low=-0.6, high=3.6, ticks=ticks), words))
    return picture(panels, height=4.2, sharex=True)


def energy_residual(root: Path) -> str:
    """Energy that each law makes over a turn of the crank, from eight starts; the share is that of the median start."""
    times = np.array([0.1, 0.3, 0.6, 1.2, 2.0])
    panels = []
    for law, words in _short.items():
        rows = []
        for time in times:
            result = run(root, _standard, law, vary=_starts, study__members=8, study__samples_per_revolution=0,
                         study__revolutions=float(time / 2), study__quantities=["energy_residual", "drive_work"])
            rows.append([1e3 * result[name].values for name in ("energy_residual", "drive_work")])
        residual, work = np.transpose(rows, (1, 2, 0))
        share = np.median(np.abs(residual[:, -1]) / work[:, -1])
        note = Note(f"{share:.0%} of the\ncrank's work" if share > 0.01 else f"{share:.0e} of the\ncrank's work")
        curves = [Curve(np.append(0, times), np.append(0, row), colour=law_colours[law], opacity=0.8) for row in residual]
        panels.append(Panel([*curves, note], Axis("time", "s"), Axis("" if panels else "energy made by the law", "" if panels else "mJ"), words))
    return picture(panels, 2, 3.2, sharey=True)


def poincare(root: Path) -> str:
    """Sections at crank angle 0 under both laws."""
    panels = []
    for law, words in _short.items():
        result = run(root, "scenes/poincare_0.1mm.toml", law, vary=_starts, study__members=16, study__transient_revolutions=2,
                     study__revolutions=20)
        rows, note = sections(result), [Note(f"all {result.sizes['section']} sections")] if panels else []
        cloud = Cloud(1e6 * rows["y"].values, 1e3 * rows["vy"].values, None, law_colours[law], size=7)
        panels.append(Panel([cloud, *note], Axis("y", "µm", low=-115, high=65), Axis("" if panels else "vy", "" if panels else "mm/s"), words))
    return picture(panels, 2, 3.6, sharey=True)


def bifurcation(root: Path) -> str:
    """Sections over the clearance, under the law as published and under the conservative one."""
    panels = []
    for law, words in law_names.items():
        result = run(root, "scenes/sweep_clearance.toml", law, study__points=16, study__revolutions=10, study__transient_revolutions=2,
                     study__exponents=0)
        (dots,) = panel_of(slideway.plot.bifurcation, result, "y").marks
        gap = np.array([50.0, 500.0])
        gaps: list[Mark] = [Curve(gap, side * gap, colour=grey, width=1, dash=":") for side in (1, -1)]
        across = Axis("clearance per side" if panels else "", "µm" if panels else "")
        panels.append(Panel([replace(dots, colour=law_colours[law]), *gaps], across, Axis("y at angle 0", "µm"), words))  # type: ignore[call-arg]
    return picture(panels, height=5.4, sharex=True)


def tolerance(root: Path) -> str:
    """Peak normal forces of the mechanisms of a tolerance study, with the limit and the yield."""
    edges, panels = np.geomspace(250, 6000, 61), []
    for law, words in law_names.items():
        force = run(root, "scenes/tolerance_0.1mm.toml", law, study__base=128)["peak_normal_force"].values
        shares = 100 * np.histogram(force, edges)[0] / force.size
        marks = [Bars(edges, shares, None, law_colours[law], 0.85), Level(1000, "x", "limit 1 kN", limit_colour, 1.8, "--")]
        ticks = {value: f"{value}" for value in (300, 500, 1000, 2000, 5000)}
        across = Axis("peak normal force" if panels else "", "N" if panels else "", log=True, ticks=ticks)
        met = np.mean(force <= 1000.0)
        panels.append(Panel(marks, across, Axis("members", "%", low=0, high=1.25 * shares.max()), f"{words}: {met:.0%} meet the limit"))
    return picture(panels, height=4.8, sharex=True)


def work_precision(root: Path) -> str:
    """Error against run time of one crank turn with its impacts (bench/results)."""
    panel = panel_of(slideway.plot.work_precision, root / "bench/results/work_precision.csv", "turn_energy")
    return picture([replace(panel, title="one crank turn with its impacts")], height=4.6, below=2)


def heyoka(root: Path) -> str:
    """slideway beside heyoka: error against run time on two smooth problems and two with contacts (bench/results)."""
    titles = {"lorenz": "Lorenz", "flight": "slider in flight", "springs": "slider rattling on springs", "bouncing": "mass between springs"}
    styles: dict[str, tuple[str, dict[str, Any]]] = {
        "slideway dop853": ("dop853", {"colour": colours[0], "marker": "o"}),
        "slideway dopri5": ("dopri5", {"colour": colours[1], "marker": "s"}),
        "slideway auto": ("auto", {"colour": colours[4], "marker": "D"}),
        "slideway verner65": ("verner65", {"colour": colours[2], "marker": "^"}),
        "heyoka": ("heyoka", {"colour": grey, "marker": "x", "dash": "--"}),
        "heyoka, which looks for touches": ("heyoka, looking for touches", {"colour": grey, "marker": "+", "dash": ":"}),
    }
    table, panels = pd.read_csv(root / "bench/results/heyoka_zen4.csv", comment="#"), []
    for place, (problem, title) in enumerate(titles.items()):
        curves = []
        for method, (words, style) in styles.items():
            rows = table[(table.problem == problem) & (table.method == method)]
            if len(rows):
                curves.append(Curve(1e6 * rows.seconds_per_member.to_numpy(), rows.median_error.to_numpy(), words, **style))
        times = np.concatenate([curve.x for curve in curves])
        ticks = {value: f"{value:g}" for value in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100) if times.min() <= value <= times.max()}
        across = Axis("time per member" if place > 1 else "", "µs" if place > 1 else "", log=True, ticks=ticks)
        panels.append(Panel(curves, across, Axis("" if place % 2 else "error, median", log=True, low=1e-14, high=0.1), title))
    return picture(panels, 2, 5.6, 3, sharey=True)
