"""Figures of studies of orbits: exponents and how they converged, Poincaré maps, bifurcations."""

from __future__ import annotations

import numpy as np
import xarray as xr

import slideway

from .numbers import amount, counted, number
from .sweep import FACTORS, Sweep, sweep_of
from .traces import Figure, Variant, band, bars_of, bins, line, points, rows, text

LINES = 20  # single members behind a band


def exponent_words(result: xr.Dataset) -> list[str]:
    """What the largest exponents say, in sentences; empty where there are none."""
    if "lyapunov_exponent" not in result:
        return []
    ended = slideway.finished(result).values
    largest = result["lyapunov_exponent"].values[ended, 0]
    if len(largest) == 0:
        return ["No member finished, so there are no exponents."]
    signs = slideway.exponent_signs(result).values[ended, 0]
    positive, negative, power = (int((signs == word).sum()) for word in ("above zero", "below zero", "no growth beyond a power of time"))
    sweep = sweep_of(result)
    sentences = [
        _of_columns(sweep, np.where(ended, result["lyapunov_exponent"].values[:, 0], np.nan))
        if sweep
        else f"Largest exponent: {number(float(largest.mean()))} s⁻¹ on average of {counted(len(largest), 'member')}, from "
        f"{number(float(largest.min()))} to {number(float(largest.max()))} s⁻¹.",
        f"With its 95 % interval and growth beyond t³ in the second half of the record it is positive in {positive}, negative in {negative} "
        f"and undecided in {len(largest) - positive - negative} of {counted(len(largest), 'member')}; positive means that neighbouring motions part "
        "exponentially.",
    ]
    if power > 0:
        sentences.append(f"Of {power} of the undecided the interval alone excludes 0, but there is no growth beyond a power of time.")
    for name, words in (
        (
            "grown_offsets",
            "offsets had grown to the size of the joint, so exponents are too small; rescale oftener "
            "(study.rescalings_per_revolution) or use a smaller study.d0",
        ),
        ("lost_offsets", "offsets had shrunk into rounding, so exponents are upper bounds"),
    ):
        share = float(result[name].values[ended].sum() / max(result["rescalings"].values[ended].sum(), 1)) if name in result else 0
        if share > 0.01:
            sentences.append(f"At {number(100 * share, 2)} % of the rescalings {words}.")
    return sentences


def _of_columns(sweep: Sweep, largest: np.ndarray) -> str:
    """The range of the columns' medians: a mean over columns would be of no mechanism at all."""
    medians = sweep.medians(largest)
    ends = (
        f"{number(float(medians[k]))} s⁻¹ at {amount(float(sweep.columns[k]), sweep.unit)}" for k in (int(np.nanargmin(medians)), int(np.nanargmax(medians)))
    )
    return f"Largest exponent: medians of the columns lie between {' and '.join(ends)} of {sweep.key}."


def exponents(result: xr.Dataset) -> list[Figure]:
    """Histogram of the exponents of all members, and the running exponents over time with a fit of what they tend to."""
    ended = slideway.finished(result).values
    if "lyapunov_exponent" not in result or not ended.any() or sweep_of(result):
        return []  # of sweeps see figures_sweep
    values = result["lyapunov_exponent"].values[ended]
    data = []
    for k in range(values.shape[1]):
        edges = bins(values[:, k], 40)
        counts = np.histogram(values[:, k], edges)[0]
        data.append(bars_of(edges, counts, f"λ{_lowered(k + 1)}", f"@c{k % 4 + 1}", opacity=0.8))
    layout = {**rows(["members"], "exponent [s<sup>−1</sup>]"), "barmode": "overlay", "bargap": 0}
    figures = []
    if len(values) > 1:
        span = float(result["lyapunov_time"].values[ended].mean())
        caption = f"Finite-time exponents of {counted(len(values), 'member')} over {number(span)} s each."
        figures.append(Figure("exponents", "Lyapunov exponents", caption, [Variant("all", data, layout)]))
    converged = _convergence(result, ended)
    return figures + ([converged] if converged else [])


def _convergence(result: xr.Dataset, ended: np.ndarray) -> Figure | None:
    if "lyapunov_history" not in result or result.sizes.get("history", 0) < 4:
        return None
    history = result["lyapunov_history"].transpose("member", "history", "exponent").values[ended]
    spacing = (result["lyapunov_time"].values[ended] / result["rescalings"].values[ended]).mean()
    time = result["history"].values * spacing
    variants = []
    for k in range(history.shape[2]):
        curves = history[:, :, k]
        mean = np.nanmean(curves, axis=0)
        limit, memory, from_ = fit_limit(time, mean)
        name = f"λ{_lowered(k + 1)}"
        data = []
        if len(curves) >= 10:
            low, high = np.nanquantile(curves, (0.05, 0.95), axis=0)
            data += band(time, low, high, "5 to 95 % of the members", "@c1/0.18")
        for curve in curves[:LINES]:
            data.append(line(time, curve, "member", "@c1/0.35", width=0.8, showlegend=False, hoverinfo="skip"))
        data.append(line(time, mean, "mean", "@c1", width=2.2))
        late = time >= from_
        data.append(line(time[late], limit + memory / time[late], f"fit, tends to {number(limit)} s⁻¹", "@c2", width=2.2, dash="dash"))
        layout = rows([f"{name} so far [s<sup>−1</sup>]"], "time after the transient [s]")
        layout["yaxis"] |= {"rangemode": "normal"}
        variants.append(Variant(name, data, layout))
    caption = "Running exponents. The fit is λ + a/t over the second half of the mean: what the start leaves behind decays as 1/t."
    return Figure("convergence", "Convergence of the exponents", caption, variants, choice="Exponent")


def fit_limit(time: np.ndarray, running: np.ndarray) -> tuple[float, float, float]:
    """Least squares of λ + a/t over the second half of a running exponent: λ, a, and the time from which it holds.

    >>> from slideway.report.figures_orbits import fit_limit
    >>> t = np.linspace(1, 10, 50)
    >>> [round(part, 6) for part in fit_limit(t, 3 + 2 / t)[:2]]
    [3.0, 2.0]
    """
    late = time >= time[-1] / 2
    terms = np.stack([np.ones(late.sum()), 1 / time[late]], 1)
    (limit, memory), *_ = np.linalg.lstsq(terms, running[late], rcond=None)
    return float(limit), float(memory), float(time[late][0])


def _lowered(k: int) -> str:
    return str(k).translate(str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉"))


MAPS = (("y", "vy"), ("z", "vz"), ("z", "y"), ("roll", "wx"), ("yaw", "wy"), ("pitch", "wz"))


def poincare(result: xr.Dataset) -> Figure | None:
    """The map of all members' sections, in several planes."""
    if "section_member" not in result.coords or result.sizes["section"] == 0:
        return None
    sections = slideway.sections(result)
    if sections.sizes["section"] == 0:
        return None
    members = sections["member"].values
    shown = np.unique(members)
    study = slideway.scene(result)["study"]
    variants = []
    for across, up in MAPS:
        if across not in sections or up not in sections:
            continue
        (x, x_title), (y, y_title) = (scaled_sections(sections, name) for name in (across, up))
        if len(shown) <= 4:
            data = [points(x[members == m], y[members == m], f"member {m}", f"@c{k % 4 + 1}") for k, m in enumerate(shown)]
        else:
            data = [points(x, y, "all members", "@c1/0.6", size=3)]
        layout = {**rows([y_title], x_title), "hovermode": "closest"}
        variants.append(Variant(f"{up} over {across}", data, layout))
    if not variants:
        return None
    where = f"at the crank angle {number(study.get('phase', 0.0))} rad" if "section" not in study else "where the scene's study.section is crossed"
    caption = (
        f"{counted(len(members), 'state')} of {counted(len(shown), 'member')} {where}. "
        "A few points are a periodic motion, a closed curve a quasi-periodic one, a cloud an irregular one."
    )
    if len(members) > 5000:
        caption += " An even choice of 5,000 is drawn."
    return Figure("poincare", "Poincaré map", caption, variants, height=480, choice="Plane")


def scaled_sections(sections: xr.Dataset, name: str) -> tuple[np.ndarray, str]:
    """A state at the sections in a handy unit, and the title of its axis."""
    factor, unit = FACTORS.get(str(sections[name].attrs.get("units", "1")), (1.0, str(sections[name].attrs.get("units", "1"))))
    return sections[name].values * factor, f"{text(name)} [{text(unit)}]"
