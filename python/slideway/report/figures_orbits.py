"""Figures of studies of orbits: exponents and how they converged, Poincaré maps, bifurcations."""

from __future__ import annotations

import numpy as np
import xarray as xr

import slideway

from .numbers import counted, number
from .traces import Figure, Variant, band, bars_of, bins, line, packed, points, rows, text

LINES = 20  # single members behind a band


def exponent_words(result: xr.Dataset) -> list[str]:
    """What the largest exponents say, in sentences; empty where there are none."""
    if "lyapunov_exponent" not in result:
        return []
    ended = slideway.finished(result).values
    largest = result["lyapunov_exponent"].values[ended, 0]
    wide = result["lyapunov_exponent_half_width"].values[ended, 0]
    if len(largest) == 0:
        return ["No member finished, so there are no exponents."]
    positive, negative = int((largest - wide > 0).sum()), int((largest + wide < 0).sum())
    sentences = [
        f"Largest exponent: {number(float(largest.mean()))} s⁻¹ on average of {counted(len(largest), 'member')}, from "
        f"{number(float(largest.min()))} to {number(float(largest.max()))} s⁻¹.",
        f"With its 95 % interval it is positive in {positive}, negative in {negative} and undecided in "
        f"{len(largest) - positive - negative} of them; positive means that neighbouring motions part exponentially.",
    ]
    for name, words in (
        (
            "grown_offsets",
            "offsets had grown to the size of the joint, so exponents are too small; rescale oftener "
            "(study.rescalings_per_revolution) or use a smaller study.d0",
        ),
        ("lost_offsets", "offsets had shrunk into rounding, so exponents are upper bounds"),
    ):
        share = (
            float(result[name].values[ended].sum() / max(result["rescalings"].values[ended].sum(), 1))
            if name in result
            else 0
        )
        if share > 0.01:
            sentences.append(f"At {number(100 * share, 2)} % of the rescalings {words}.")
    return sentences


def exponents(result: xr.Dataset) -> list[Figure]:
    """Histogram of the exponents of all members, and the running exponents over time with a fit of what they tend to."""
    ended = slideway.finished(result).values
    if "lyapunov_exponent" not in result or not ended.any():
        return []
    values = result["lyapunov_exponent"].values[ended]
    data = []
    for k in range(values.shape[1]):
        edges = bins(values[:, k], 40)
        counts = np.histogram(values[:, k], edges)[0]
        data.append(bars_of(edges, counts, f"λ{_lowered(k + 1)}", f"@c{k % 4 + 1}", opacity=0.8))
    layout = {**rows(["members"], "exponent [s<sup>−1</sup>]"), "barmode": "overlay", "bargap": 0}
    figures = []
    if len(values) > 1 and slideway.scene(result)["study"].get("kind") != "sweep":
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
        data.append(
            line(
                time[late], limit + memory / time[late], f"fit, tends to {number(limit)} s⁻¹", "@c2", width=2.2, dash="dash"
            )
        )
        layout = rows([f"{name} so far [s<sup>−1</sup>]"], "time after the transient [s]")
        layout["yaxis"] |= {"rangemode": "normal"}
        variants.append(Variant(name, data, layout))
    caption = (
        "Running exponents. The fit is λ + a/t over the second half of the mean: what the start leaves behind decays as 1/t."
    )
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
FACTORS = {"m": (1e3, "mm"), "m s-1": (1e3, "mm/s"), "rad": (1e3, "mrad"), "rad s-1": (1.0, "rad/s")}


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
        (x, x_title), (y, y_title) = (_scaled(sections, name) for name in (across, up))
        if len(shown) <= 4:
            data = [points(x[members == m], y[members == m], f"member {m}", f"@c{k % 4 + 1}") for k, m in enumerate(shown)]
        else:
            data = [points(x, y, "all members", "@c1/0.6", size=3)]
        layout = {**rows([y_title], x_title), "hovermode": "closest"}
        variants.append(Variant(f"{up} over {across}", data, layout))
    if not variants:
        return None
    where = (
        f"at the crank angle {number(study.get('phase', 0.0))} rad"
        if "section" not in study
        else "where the scene's study.section is crossed"
    )
    caption = (
        f"{counted(len(members), 'state')} of {counted(len(shown), 'member')} {where}. "
        "A few points are a periodic motion, a closed curve a quasi-periodic one, a cloud an irregular one."
    )
    if len(members) > 5000:
        caption += " An even choice of 5,000 is drawn."
    return Figure("poincare", "Poincaré map", caption, variants, height=480, choice="Plane")


def _scaled(sections: xr.Dataset, name: str) -> tuple[np.ndarray, str]:
    factor, unit = FACTORS.get(
        str(sections[name].attrs.get("units", "1")), (1.0, str(sections[name].attrs.get("units", "1")))
    )
    return sections[name].values * factor, f"{text(name)} [{text(unit)}]"


def bifurcation(result: xr.Dataset) -> Figure | None:
    """Sections and exponents over the parameter of a sweep."""
    key = slideway.scene(result)["study"].get("parameter")
    variable = str(key).replace(".", "_")
    if key is None or variable not in result:
        return None
    values = result[variable]
    factor, unit = FACTORS.get(str(values.attrs.get("units", "1")), (1.0, str(values.attrs.get("units", "1"))))
    of_member = dict(zip(result["member"].values.tolist(), (values.values * factor).tolist(), strict=True))
    x_title = f"{text(key)}" + ("" if unit == "1" else f" [{text(unit)}]")
    sections = slideway.sections(result) if "section_member" in result.coords else None
    lower = _exponent_row(result, values.values * factor)
    variants = []
    for name in ("y", "z", "roll", "yaw", "pitch", "vy", "vz"):
        if sections is None or name not in sections:
            continue
        y, title = _scaled(sections, name)
        at = np.array([of_member[m] for m in sections["member"].values.tolist()])
        data = [points(at, y, f"{name} at the sections", "@c1/0.7", size=3, showlegend=False), *lower]
        titles = [title, "largest exponent<br>[s<sup>−1</sup>]"] if lower else [title]
        variants.append(Variant(name, data, {**rows(titles, x_title), "hovermode": "closest"}))
    if not variants and lower:
        bare = [{key: part for key, part in trace.items() if key != "yaxis"} for trace in lower]
        variants.append(Variant("exponent", bare, rows(["largest exponent<br>[s<sup>−1</sup>]"], x_title)))
    if not variants:
        return None
    columns = len(np.unique(values.values))
    caption = f"{counted(columns, 'column')}, the states of all members at their sections."
    if lower:
        caption += " Below: each member's largest exponent with its 95 % interval, and the mean of each column."
    return Figure("bifurcation", "Bifurcation diagram", caption, variants, height=600 if lower else 420, choice="State")


def _exponent_row(result: xr.Dataset, parameter: np.ndarray) -> list[dict[str, object]]:
    if "lyapunov_exponent" not in result:
        return []
    ended = slideway.finished(result).values
    x, largest = parameter[ended], result["lyapunov_exponent"].values[ended, 0]
    wide = result["lyapunov_exponent_half_width"].values[ended, 0]
    bars = {"type": "data", "array": packed(wide), "color": "@c2/0.4", "thickness": 1, "width": 0}
    each = points(x, largest, "member", "@c2", axis=2, size=4, error_y=bars)
    columns = np.unique(x[np.isfinite(largest)])
    means = np.array([np.nanmean(largest[x == column]) for column in columns])
    return [each, line(columns, means, "mean of the column", "@c3", 2, width=2)]
