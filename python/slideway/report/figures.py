"""Which figures a page shows, their variants and what to know of them; what is in them is that of :mod:`slideway.plot`."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr

import slideway
from slideway.columns import Column, group_of
from slideway.distribution import ran, whose
from slideway.errors import SlidewayError
from slideway.figures import base, chaos, orbits, series, tolerance
from slideway.figures.base import words_of
from slideway.figures.marks import Axis, Bars, Cloud, Curve, Level, Mark, Panel, Rows, named
from slideway.palette import class_colours, colours, limit_colour
from slideway.sampling import sample_axis, too_coarse
from slideway.units import lowered, scaled
from slideway.way import may_be_misaligned

from .energy import Audit, Balance, joules
from .findings import Sweep, of_sweep, sweep_of
from .members import chosen
from .numbers import counted, number, percent
from .poses import Poses
from .traces import MOST_POINTS, Figure, Variant

STATES = (("y", "z"), ("roll", "yaw", "pitch"))
RATES = (("vy", "vz"), ("wx", "wy", "wz"))
COUNTS = ("surfaces", "lines", "points")
MAPS = (("y", "vy"), ("z", "vz"), ("z", "y"), ("roll", "wx"), ("yaw", "wy"), ("pitch", "wz"))
SENSORS = {"acceleration_top": "top sensor", "acceleration_front": "front sensor", "ax": "centre, along X", "ay": "centre, along Y", "az": "centre, along Z"}
BAND_MEMBERS, BAND_TIMES = 2000, 1000


def figures(result: xr.Dataset, every: Sequence[Column], seen: dict[int, Poses], audit: Audit) -> dict[str, Figure]:
    """All figures that suit the result, by their names, in their order on the page.

    Args:
        seen: poses of the members that are looked at one by one; empty where the result has no time series of them.
    """
    sweep = sweep_of(result)
    made: list[Figure | None] = []
    if seen:
        made += [_series(result, seen, "series", "Time series", STATES), _series(result, seen, "rates", "Velocities", RATES)]
        made += [None if sweep else bands(result), _orbit(result), _forces(result, seen), _spectra(result)]
    if "status" in result:
        made.append((_bifurcation(result, sweep) if sweep else None) or _poincare(result))
        made += [] if sweep else _exponents(result)
    made += [_quantities(result, sweep)] if sweep else [_modes(every), _sensitivity(result), _quantiles(result, every), _histograms(every)]
    made.append(_balance(audit.balance, audit.whose) if audit.balance else None)
    return {figure.name: figure for figure in made if figure}


Variants = Iterable[tuple[str, Panel | Sequence[Panel] | None]]


def of(name: str, title: str, caption: str, variants: Variants, height: int = 380, choice: str = "Show") -> Figure | None:
    """A figure of the variants that there are."""
    kept = [Variant(label, [panels] if isinstance(panels, Panel) else panels) for label, panels in variants if panels]
    return Figure(name, title, caption, kept, height, choice) if kept else None


def panel_of(plot: Callable[..., base.Axes], *given: Any, **named: Any) -> Panel | None:
    """The figure that a plot draws; None where there is nothing to draw."""
    try:
        return base.panel_of(plot, *given, **named)
    except SlidewayError:
        return None


def _names(result: xr.Dataset) -> list[str]:
    """Variables along member and sample."""
    return [str(name) for name in result.data_vars if set(result[name].dims) == {"member", "sample"}]


def _series(result: xr.Dataset, seen: dict[int, Poses], name: str, title: str, groups: Sequence[Sequence[str]]) -> Figure | None:
    """What the chosen members did over time: place and tilt with what the scene asked for, or the velocities."""
    names = _names(result)
    rows = [there for group in groups if (there := [state for state in group if state in names])]
    extra = [one for one in names if one not in {*COUNTS, *sum((*STATES, *RATES), ())}] if name == "series" else []

    def panels(member: int) -> list[Panel]:
        found = [_states(result, member, seen[member], row) for row in rows]
        return found + [panel for one in extra if (panel := panel_of(series.time_series, result, one, member))]

    samples = result.sizes["sample"]
    caption = f"{counted(samples, 'sample')}, every {spacing(result)}."
    if too_coarse(result, list(seen)):
        caption += " That is far coarser than the contacts: samples are points, for a line between them would show what never was."
    if name == "series":
        caption += " Dotted: the clearance, where the slider without tilt would touch."
        if may_be_misaligned(result):
            caption += " y and z are from the way's axis, all else is not."
    if samples > MOST_POINTS:
        caption += f" Of so many, the least and the largest of each short stretch are drawn (at most {MOST_POINTS:,} points a curve)."
    variants = ((label, panels(member)) for member, label in chosen(result).items())
    return of(name, title, caption, variants, 110 + 150 * (len(rows) + len(extra)), "Member")


def _states(result: xr.Dataset, member: int, pose: Poses, names: Sequence[str]) -> Panel:
    """States of one unit; y and z from the way's axis, as its walls."""
    row = result.sel(member=member).isel(sample=pose.samples)
    values = {"y": pose.y, "z": pose.z} | {name: row[name].values for name in names if name not in ("y", "z")}
    factor, unit = scaled(str(row[names[0]].attrs.get("units", "1")), np.concatenate([values[name] for name in names]))
    second, x = series.time_axis(*sample_axis(result))
    time = second * sample_axis(result)[0][pose.samples]
    marks: list[Mark] = []
    for name, tint in zip(names, colours, strict=False):
        coarse = too_coarse(result, [member], name)
        marks.append(Curve(time, factor * values[name], name, tint, dash="" if coarse else "-", marker="." if coarse else "", size=2.5))
    gaps = {pose.joint.gap_y, pose.joint.gap_z} - {0.0} if "y" in names else set()
    marks += [Level(side * factor * gap, dash=":") for gap in sorted(gaps) for side in (-1, 1)]
    return Panel(marks, x, Axis(", ".join(names) + (" from the way's axis" if "y" in names and may_be_misaligned(result) else ""), unit))


def spacing(result: xr.Dataset) -> str:
    places, unit = sample_axis(result)
    step = float((places[-1] - places[0]) / max(len(places) - 1, 1))
    return f"{number(step)} s" if unit == "s" else f"{number(360 * step)} degrees that the crank turns"


def bands(result: xr.Dataset) -> Figure | None:
    """Where the members are at each time; None where there are too few members."""
    if result.sizes["member"] < 10:
        return None
    step, stride = -(-result.sizes["sample"] // BAND_TIMES), -(-result.sizes["member"] // BAND_MEMBERS)
    thin = result.isel(sample=slice(None, None, step), member=slice(None, None, stride))
    caption = f"At each {'time' if 'turned' not in result.coords else 'angle'}, of the {counted(thin.sizes['member'], 'member')} that got there."
    caption += f" Every {step}th sample." if step > 1 else ""
    names = [name for name in _names(result) if name not in COUNTS]
    return of("bands", "All members over time", caption, ((name, panel_of(series.time_series, thin, name)) for name in names), choice="Series")


def _orbit(result: xr.Dataset) -> Figure | None:
    """Path of the slider's centre in the gap, seen along the way."""
    caption = "The slider's centre, seen along the way, from a dot, where it starts. Dotted: how far it can go without tilt."
    variants = ((label, panel_of(orbits.orbit_yz, result, member)) for member, label in chosen(result).items())
    return of("orbit", "Orbit in the gap", caption, variants, 460, "Member")


def _forces(result: xr.Dataset, seen: dict[int, Poses]) -> Figure | None:
    """How often which contact force was seen; where the file has no modes, by those of the poses of the members that are looked at."""
    if set(COUNTS) <= set(map(str, result)):
        some = result.isel(member=slice(None, None, -(-result.sizes["member"] // BAND_MEMBERS)))
    else:
        some = result.sel(member=list(seen))
        for k, name in enumerate(COUNTS):
            touching = np.zeros((len(seen), result.sizes["sample"]))
            for row, pose in zip(touching, seen.values(), strict=True):
                row[pose.samples] = pose.modes[:, k]
            some = some.assign({name: (("member", "sample"), touching)})
    caption = f"Of all samples of {counted(some.sizes['member'], 'member')}, by the hardest contact of each."
    return of("forces", "Contact forces by mode", caption, [("all", panel_of(series.force_histogram, some))])


def _spectra(result: xr.Dataset) -> Figure | None:
    """Spectra of accelerations, as sensors on the slider would show them."""
    names = [name for name in SENSORS if name in result and "sample" in result[name].dims]

    def panel(member: int) -> Panel | None:
        found = {name: one for name in names if (one := panel_of(series.spectrum, result, name, member, reference=series.standard_gravity))}
        if not found:
            return None
        curves = [(name, mark) for name, one in found.items() for mark in one.marks if isinstance(mark, Curve)]
        marks = [replace(curve, label=SENSORS[name], colour=tint) for (name, curve), tint in zip(curves, colours, strict=False)]
        lows, highs = zip(*((one.y.low or 0.0, one.y.high or 0.0) for one in found.values()), strict=True)
        return Panel(marks, next(iter(found.values())).x, Axis("amplitude", "dB re g", low=min(lows), high=max(highs)))

    caption = ("One-sided amplitude spectra with a Hann window. The samples are points of the motion, not means over their spacing: "
               "what is faster than half the sampling rate is folded back.")  # fmt: skip
    return of("spectra", "Spectra of accelerations", caption, ((label, panel(member)) for member, label in chosen(result).items()), choice="Member")


def _bifurcation(result: xr.Dataset, sweep: Sweep) -> Figure | None:
    """Sections and exponents over the parameter of a sweep."""
    below = panel_of(orbits.exponent_sweep, result)
    lower = [below] if below else []
    above = {name: panel_of(orbits.bifurcation, result, name) for name in ("y", "z", "roll", "yaw", "pitch", "vy", "vz")}
    variants: list[tuple[str, Sequence[Panel]]] = [(name, [panel, *lower]) for name, panel in above.items() if panel]
    caption = f"{counted(len(sweep.columns), 'column')}, the states of all members at their sections."
    if below:
        caption += " Below: each member's largest exponent with its 95 % interval, and the median of each column."
    return of("bifurcation", "Bifurcation diagram", caption, variants or [("exponent", lower)], 600 if below else 420, "State")


def _poincare(result: xr.Dataset) -> Figure | None:
    """The map of all members' sections, in several planes."""
    if "section_member" not in result.coords or (sections := slideway.sections(result)).sizes["section"] == 0:
        return None
    scene = slideway.scene(result)
    study, by_period = scene["study"], base.kind_of(result) == "carriage" or scene.get("drive", {}).get("kind") == "profile"
    phase = f"{number(study.get('phase', 0.0))} rad" + (" of the drive's period" if by_period else "")
    where = f"at the {'phase' if by_period else 'crank angle'} {phase}" if "section" not in study else "where the scene's study.section is crossed"
    count = sections.sizes["section"]
    caption = (f"{counted(count, 'state')} of {counted(len(np.unique(sections['member'])), 'member')} {where}. "
               "A few points are a periodic motion, a closed curve a quasi-periodic one, a cloud an irregular one.")  # fmt: skip
    if count > MOST_POINTS:
        caption += f" An even choice of {MOST_POINTS:,} is drawn."
    variants = ((f"{up} over {across}", panel_of(orbits.poincare, result, across, up)) for across, up in MAPS)
    return of("poincare", "Poincaré map", caption, variants, 480, "Plane")


def _exponents(result: xr.Dataset) -> list[Figure | None]:
    """Histogram of the exponents of all members, and the running exponents over time with a fit of what they tend to."""
    if "lyapunov_exponent" not in result or not (ended := slideway.finished(result).values).any():
        return []
    numbers = range(1, result.sizes["exponent"] + 1)
    found: list[Figure | None] = []
    if ended.sum() > 1:
        times = result["lyapunov_time"].values[ended]
        span = " to ".join(dict.fromkeys((number(times.min()), number(times.max()))))
        caption = f"Finite-time exponents of {counted(int(ended.sum()), 'member')} over {span} s each, and their mean with its 95 % interval."
        variants = ((f"λ{lowered(k)}", panel_of(chaos.exponent_histogram, result, exponent=k)) for k in numbers)
        found.append(of("exponents", "Lyapunov exponents", caption, variants, choice="Exponent"))
    if "lyapunov_history" in result and result.sizes["history"] >= 4:
        caption = "Running exponents. The fit is λ + a/t over the second half of the mean: what the start leaves behind decays as 1/t."
        variants = ((f"λ{lowered(k)}", _convergence(result.isel(member=ended), k)) for k in numbers)
        found.append(of("convergence", "Convergence of the exponents", caption, variants, choice="Exponent"))
    return found


def _convergence(result: xr.Dataset, exponent: int) -> Panel | None:
    panel = panel_of(chaos.exponent_history, result, exponent=exponent)
    if panel is None:
        return None
    time = next(mark.x for mark in panel.marks if isinstance(mark, Curve))
    mean = result["lyapunov_history"].isel(exponent=exponent - 1).transpose("member", "history").mean("member").values
    limit, memory, start = fit_limit(time, mean)
    late = time[time >= start]
    fit = Curve(late, limit + memory / late, f"fit of the mean, tends to {number(limit)} s⁻¹", colours[1], width=2.2, dash="--")
    return replace(panel, marks=[*panel.marks, fit])


def fit_limit(time: np.ndarray, running: np.ndarray) -> tuple[float, float, float]:
    """Least squares of λ + a/t over the second half of a running exponent: λ, a, and the time from which it holds.

    >>> t = np.linspace(1, 10, 50)
    >>> [round(part, 6) for part in fit_limit(t, 3 + 2 / t)[:2]]
    [3.0, 2.0]
    """
    late = time >= time[-1] / 2
    terms = np.stack([np.ones(late.sum()), 1 / time[late]], 1)
    (limit, memory), *_ = np.linalg.lstsq(terms, running[late], rcond=None)
    return float(limit), float(memory), float(time[late][0])


def _quantities(result: xr.Dataset, sweep: Sweep) -> Figure | None:
    """Each quantity of each member over the parameter, and the median of each column; None without quantities."""
    across, x_unit = scaled(sweep.unit, sweep.values)

    def panel(name: str, unit: str, values: np.ndarray) -> Panel:
        factor, named = scaled(unit, values)
        there = np.isfinite(values)
        members = Cloud(across * sweep.values[there], factor * values[there], "member", opacity=0.6, size=8)
        return Panel([members, orbits.medians(across, sweep.values, factor * values)], Axis(sweep.key, x_unit), Axis(words_of(name), named))

    caption = f"Of the members that finished, and the median of each of {counted(len(sweep.columns), 'column')}."
    variants = ((name, panel(name, unit, values)) for name, unit, values in of_sweep(result))
    return of("columns", f"Quantities over {sweep.key}", caption, variants, choice="Quantity")


def _quantiles(result: xr.Dataset, every: Sequence[Column]) -> Figure | None:
    """Distribution function of each quantity, with quantiles, their intervals and the scene's limits; shares of the members that ran."""
    trials, limits = ran(result), tolerance.limits_of(result)
    drawn = [one for one in every if one.of_file and one.high > one.low]
    caption = "Distribution functions; all shares are of the members that ran, and those that failed lie beyond the end of the curve. "
    if all(one.values is not None for one in drawn):
        caption += f"Each step is a member{f'; of so many, {MOST_POINTS:,} are drawn' if trials > MOST_POINTS else ''}."
    else:
        caption += "The members are not stored: the function lies in the band, and is known at its corners."
    caption += " Dots: quantiles of the members that finished; bars: their 95 % intervals, as far as the design allows some."
    variants = ((one.name, tolerance.distribution([one], *limits, trials, whose(result))) for one in drawn)
    return of("quantiles", "Distribution functions", caption, variants, choice="Quantity")


def _sensitivity(result: xr.Dataset) -> Figure | None:
    """Which inputs drive each quantity: Sobol indices, or rank correlations where the design has none."""
    group = group_of(result, "sensitivity")
    if group is None:
        return None
    sobol = any(str(name).endswith("_total") for name in group)
    end = "_total" if sobol else "_rank_correlation"
    if sobol:
        caption = (f"Sobol indices of {counted(int(group['rows_used']), 'row')} of the design, bars: 95 % intervals. First order: what an input does alone. "
                   "Total: with all that it interacts with.")  # fmt: skip
    else:
        caption = "Spearman's rank correlation of input and quantity, from −1 to 1, bars: 95 % intervals where the design allows some."
    if without := str(group.attrs.get("without_index", "")):
        caption += f" Without an index: {without}."
    named: list[tuple[str, str, str | None]] = []
    for name in [str(variable).removesuffix(end) for variable in group if str(variable).endswith(end)]:
        other = next((str(d) for d in group[name + end].dims if d != "input"), None)
        named += [(f"{name}[{label}]", name, str(label)) for label in group[other].values] if other else [(name, name, None)]
    variants = ((full, panel_of(tolerance.sensitivity, group, name, label)) for full, name, label in named)
    return of("sensitivity", "What drives the scatter", caption, variants, 140 + 42 * group.sizes["input"], "Quantity")


def _histograms(every: Sequence[Column]) -> Figure | None:
    """How each quantity scatters over the members; None where there are hardly any."""

    def panel(one: Column) -> Panel:
        factor, unit = scaled(one.unit, (one.low, one.high))
        values = np.empty(0) if one.values is None else one.values
        edges, counts = (one.histogram.edges, one.histogram.counts) if one.histogram else np.histogram(values, _bins(values))[::-1]
        tint = class_colours.get(one.component, colours[0])
        mean = Level(factor * one.mean, "x", f"mean {number(factor * one.mean)}", colours[1], 2)
        return Panel([Bars(factor * edges, counts, None, tint, 1.0), mean], Axis(words_of(one.name), unit), Axis("members"))

    shown = [one for one in every if one.count >= 5 and one.high > one.low and (one.histogram or one.values is not None)]
    return of("histograms", "How quantities scatter", "Counts of the members that finished.", ((one.name, panel(one)) for one in shown), choice="Quantity")


def _bins(values: np.ndarray, most: int = 60) -> np.ndarray:
    """Edges of bins for a histogram: Freedman-Diaconis, at least 8 and no more than the picture bears."""
    there = values[np.isfinite(values)]
    width = 2 * float(np.subtract(*np.percentile(there, [75, 25]))) / len(there) ** (1 / 3)
    count = np.ptp(there) / width if width > 0 else most
    return np.histogram_bin_edges(there, int(np.clip(count, min(8, len(there)), most)))


def _modes(every: Sequence[Column]) -> Figure | None:
    """Which share of the time was spent in which contact, on average over the members."""
    times = {one.component: one for one in every if one.name.startswith("mode_time[")}
    total = sum(one.mean for one in times.values())
    if not total > 0:
        return None
    shares = {name: times[name].mean / total for name in class_colours if name in times}
    bars = [Rows(np.array([100 * share]), f"{name}: {percent(share)}", class_colours[name]) for name, share in shares.items()]
    caption = f"By the stiffest contact at each time; free is flight without any. Mean of {counted(next(iter(times.values())).count, 'member')}."
    panel = Panel(bars, Axis("share of the time", "%", low=0, high=100), Axis("", ticks=named([""])), stacked=True)
    return of("modes", "Time by contact mode", caption, [("all", panel)], 210)


def _balance(terms: Balance, whose: str) -> Figure | None:
    """Where energy came from and where it went; None where the file lacks a term."""
    kept = terms.gained - terms.lost
    if not math.isfinite(kept):
        return None
    parts = [("drive", terms.work, colours[0]), ("loads", terms.loads, colours[5]), ("ground's motion", terms.ground, colours[7]),
             ("made by law and method", terms.residual, limit_colour), ("friction", -terms.friction, colours[1]),
             ("contact damping", -terms.damping, colours[2]), ("dampers of springs and stops", -terms.dampers, colours[6]),
             ("oil film", -terms.film, colours[4]), ("motion, height, springs", -kept, colours[3])]  # fmt: skip
    factor, unit = scaled("J", [amount for _, amount, _ in parts])
    bars = [Rows(factor * np.array([max(-amount, 0.0), max(amount, 0.0)]), f"{name}: {joules(abs(amount))}", tint)
            for name, amount, tint in parts if amount != 0]  # fmt: skip
    caption = f"Means over {whose}. Both bars are as long as each other, for the residual is what closes the balance."
    panel = Panel(bars, Axis("per member", unit), Axis("", ticks=named(["went to", "came from"])), stacked=True)
    return of("balance", "Balance of energy", caption, [("all", panel)], 250)
