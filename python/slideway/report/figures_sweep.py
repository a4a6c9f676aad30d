"""Figures of sweeps: sections, exponents and quantities over the parameter, column by column."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import xarray as xr

import slideway

from .columns import stored
from .figures_orbits import scaled_sections
from .numbers import amount, counted, number, scaled, unit_words
from .sweep import Sweep
from .traces import Figure, Variant, line, packed, points, rows, text


def bifurcation(result: xr.Dataset, sweep: Sweep) -> Figure | None:
    """Sections and exponents over the parameter of a sweep."""
    place, x_title = sweep.shown
    of_member = dict(zip(result["member"].values.tolist(), place.tolist(), strict=True))
    sections = slideway.sections(result) if "section_member" in result.coords else None
    lower = _exponent_row(result, sweep)
    variants = []
    for name in ("y", "z", "roll", "yaw", "pitch", "vy", "vz"):
        if sections is None or name not in sections:
            continue
        y, title = scaled_sections(sections, name)
        at = np.array([of_member[m] for m in sections["member"].values.tolist()])
        data = [points(at, y, f"{name} at the sections", "@c1/0.7", size=3, showlegend=False), *lower]
        titles = [title, "largest exponent<br>[s<sup>−1</sup>]"] if lower else [title]
        variants.append(Variant(name, data, {**rows(titles, x_title), "hovermode": "closest"}))
    if not variants and lower:
        bare = [{key: part for key, part in trace.items() if key != "yaxis"} for trace in lower]
        variants.append(Variant("exponent", bare, rows(["largest exponent<br>[s<sup>−1</sup>]"], x_title)))
    if not variants:
        return None
    caption = f"{counted(len(sweep.columns), 'column')}, the states of all members at their sections."
    if lower:
        caption += " Below: each member's largest exponent with its 95 % interval, and the median of each column."
    return Figure("bifurcation", "Bifurcation diagram", caption, variants, height=600 if lower else 420, choice="State")


def _exponent_row(result: xr.Dataset, sweep: Sweep) -> list[dict[str, object]]:
    if "lyapunov_exponent" not in result:
        return []
    ended = slideway.finished(result).values
    largest = np.where(ended, result["lyapunov_exponent"].values[:, 0], np.nan)
    wide = result["lyapunov_exponent_half_width"].values[ended, 0]
    bars = {"type": "data", "array": packed(wide), "color": "@c1/0.4", "thickness": 1, "width": 0}
    each = points(sweep.shown[0][ended], largest[ended], "member", "@c1", axis=2, size=4, error_y=bars)
    return [each, _middle(sweep, largest, 2)]


def _middle(sweep: Sweep, values: np.ndarray, axis: int = 1) -> dict[str, object]:
    """The medians of the columns, joined."""
    medians = sweep.medians(values)
    there = np.isfinite(medians)
    return line(np.unique(sweep.shown[0])[there], medians[there], "median of the column", "@c2", axis, width=2)


def quantities(result: xr.Dataset, sweep: Sweep) -> Figure | None:
    """Each quantity of each member over the parameter, and the median of each column; None without quantities."""
    variants = []
    place, x_title = sweep.shown
    for name, unit, values in _of_members(result):
        factor, named = scaled(float(np.nanmax(np.abs(values))), unit)
        there = np.isfinite(values)
        data = [points(place[there], values[there] * factor, "member", "@c1/0.6"), _middle(sweep, values * factor)]
        title = text(name) + ("" if named == "1" else f" [{text(unit_words(named))}]")
        variants.append(Variant(name, data, {**rows([title], x_title), "hovermode": "closest"}))
    if not variants:
        return None
    caption = f"Of the members that finished, and the median of each of {counted(len(sweep.columns), 'column')}."
    return Figure("columns", f"Quantities over {sweep.key}", caption, variants, choice="Quantity")


def column_table(result: xr.Dataset, sweep: Sweep) -> list[tuple[str, ...]]:
    """Of each quantity: name, unit, least and largest median of a column and where these are."""
    table = []
    for name, unit, values in _of_members(result):
        medians = sweep.medians(values)
        factor, named = scaled(float(np.nanmax(np.abs(medians))), unit)
        ends = (int(np.nanargmin(medians)), int(np.nanargmax(medians)))
        cells = (f"{number(float(medians[k]) * factor)} at {amount(float(sweep.columns[k]), sweep.unit)}" for k in ends)
        table.append((name, unit_words(named), *cells))
    return table


def _of_members(result: xr.Dataset) -> Iterator[tuple[str, str, np.ndarray]]:
    """Name, unit and values (member) of each quantity that any member has; NaN of members that failed."""
    ended = slideway.finished(result).values
    for name, _, unit, values in stored(result):
        numbers = np.where(ended, values, np.nan)
        if np.isfinite(numbers).any():
            yield name, unit, numbers
