"""The pictures of results."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import slideway
import xarray as xr
from slideway.figures.marks import Axis, Bars, Cloud, Curve, Level, Note, Panel
from slideway.palette import class_colours, colours, grey, limit_colour
from slideway.plot.axes import frame
from slideway.sections import sections

from .style import as_svg, axes_of, law_colours, law_names, picture

_short = {"paper": "as published", "conservative": "conservative"}
_standard = "scenes/slider_crank_0.1mm.toml"
_starts = {"initial.y": {"dist": "unif", "low": "-0.05 mm", "high": "0.05 mm"}}


def run(root: Path, scene: str, law: str, **overrides: Any) -> xr.Dataset:
    """A scene of the repository under a law, of which nothing runs again to be checked: the documentation's tables are."""
    varied = overrides.pop("vary", None)
    return slideway.run(root / scene, progress=False, contact__law=law, set={"study.vary": varied} if varied else None,
                        **{"study__verify": 0} | overrides)


def stretches(time: np.ndarray, there: np.ndarray, columns: int = 400) -> list[tuple[float, float]]:
    """Starts and lengths of the stretches in which a flag is set, as fine as so many columns of the picture; none gets lost.

    >>> import numpy as np
import pandas as pd
    >>> stretches(np.arange(8.0), np.array([0, 1, 0, 0, 0, 0, 1, 1]) > 0, 4)
    [(0.0, 1.75), (5.25, 1.75)]
    """
    edges = np.linspace(time[0], time[-1], columns + 1)
    column = np.minimum(np.searchsorted(edges, time, "right") - 1, columns - 1)
    marked = np.concatenate([[0], np.bincount(column, there, columns) > 0, [0]]).astype(int)
    begins, ends = np.flatnonzero(np.diff(marked) > 0), np.flatnonzero(np.diff(marked) < 0)
    return [(float(edges[b]), float(edges[e] - edges[b])) for b, e in zip(begins, ends, strict=True)]


def modes(root: Path) -> str:
    """Which contacts a slider has over its first 0.6 s: the hardest of each sample."""
    classes = ("free", "point", "line", "surface")
    figure, axes = axes_of(2, height=4.2, sharex=True)
    for ax, law in zip(axes, law_names, strict=True):
        result = run(root, _standard, law, study__revolutions=0.3, study__samples_per_revolution=0, study__samples=6001,
                     study__quantities=["points", "lines", "surfaces", "x"])
        points, lines, surfaces = (result[name].values[0] > 0 for name in ("points", "lines", "surfaces"))
        hardest = np.select([surfaces, lines, points], [3, 2, 1], 0)
        time = result["time"].values * 1e3
        for level, name in enumerate(classes):
            ax.broken_barh(stretches(time, hardest == level), (level - 0.4, 0.8), color=class_colours[name], lw=0)
        shares = [np.mean(hardest == level) for level in range(4)]
        ax.set_yticks(range(4), [f"{name} {'<1%' if 0 < share < 0.01 else f'{share:.0%}'}" for name, share in zip(classes, shares, strict=True)])
        ax.set_title(law_names[law], loc="left")
        ax.set_xlim(time[0], time[-1])
        ax.set_ylim(-0.6, 3.6)
        frame(ax, "time [ms]" if ax is axes[-1] else "", "")
    return as_svg(figure)


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
    figure, axes = axes_of(2, height=5.4, sharex=True)
    for ax, law in zip(axes, law_names, strict=True):
        result = run(root, "scenes/sweep_clearance.toml", law, study__points=16, study__revolutions=10, study__transient_revolutions=2,
                     study__exponents=0)
        slideway.plot.bifurcation(result, "y", ax=ax)
        for dots in ax.collections:
            dots.set_color(law_colours[law])
        gap = np.array([50.0, 500.0])
        ax.plot(gap, gap, color=grey, lw=1, ls=":")
        ax.plot(gap, -gap, color=grey, lw=1, ls=":")
        ax.set_title(law_names[law], loc="left")
        frame(ax, "clearance per side [µm]" if ax is axes[-1] else "", "y at angle 0 [µm]")
    return as_svg(figure)


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
    figure, (ax,) = axes_of(height=4.6)
    slideway.plot.work_precision(root / "bench/results/work_precision.csv", "turn_energy", ax)
    ax.set_title("")
    ax.set_title("one crank turn with its impacts", loc="left")
    handles, words = ax.get_legend_handles_labels()
    ax.get_legend().remove()
    figure.legend(handles, words, loc="outside lower center", ncols=2, frameon=False)
    return as_svg(figure)


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
