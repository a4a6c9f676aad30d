"""What a study says in numbers and words: exponents, yields, sweeps column by column."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import xarray as xr

import slideway
from slideway.columns import group_of, stored
from slideway.figures.orbits import medians_of
from slideway.units import scaled

from .numbers import amount, counted, number


@dataclass(frozen=True)
class Sweep:
    """What a sweep changes; a mean over members of several columns would be of no mechanism at all.

    Attributes:
        key: dotted, of the scene.
        unit: of the file.
        values: of each member (member), in this unit.
    """

    key: str
    unit: str
    values: np.ndarray

    @property
    def columns(self) -> np.ndarray:
        """The values of the parameter, each once."""
        return np.unique(self.values)

    def named(self, value: float) -> str:
        """A column by its value: "joint.clearance = 0.1 mm"."""
        return f"{self.key} = {amount(value, self.unit)}"

    def medians(self, values: np.ndarray) -> np.ndarray:
        """Of each column the median of the members that have a number (member), NaN where none has."""
        return medians_of(self.values, values)[1]


def sweep_of(result: xr.Dataset) -> Sweep | None:
    """What a result sweeps; None where it is no sweep, or holds no members."""
    key = slideway.scene(result).get("study", {}).get("parameter")
    variable = str(key).replace(".", "_")
    if key is None or variable not in result or "member" not in result[variable].dims:
        return None
    return Sweep(str(key), str(result[variable].attrs.get("units", "1")), result[variable].values)


def by_column(result: xr.Dataset, sweep: Sweep) -> dict[float, xr.Dataset]:
    """The members of each column."""
    return {float(column): result.isel(member=np.flatnonzero(sweep.values == column)) for column in sweep.columns}


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


def yields(result: xr.Dataset) -> list[tuple[str, int, int, float, float, float]]:
    """Of each limit and of all: name, members that meet it, members that ran, share, ends of its interval (NaN for none)."""
    group = group_of(result, "yield")
    if group is None:
        return []
    trials = int(group["trials"])
    table = []
    for k, name in enumerate(group["limit"].values.tolist()):
        one = group.isel(limit=k)
        bounds = [f"{sign} {float(one[end]):g}" for sign, end in (("≥", "low"), ("≤", "high")) if np.isfinite(one[end])]
        unit = str(one["unit_name"].values)
        words = f"{name} {' and '.join(bounds)} {'' if unit == '1' else unit}".strip()
        low, high = one["share_interval"].values.tolist()
        table.append((words, int(one["met"]), trials, float(one["share"]), low, high))
    low, high = group["all_share_interval"].values.tolist()
    table.append(("all limits", int(group["all_met"]), trials, float(group["all_share"]), low, high))
    return table


def column_table(result: xr.Dataset, sweep: Sweep) -> list[tuple[str, ...]]:
    """Of each quantity: name, unit, least and largest median of a column and where these are."""
    table = []
    for name, unit, values in of_sweep(result):
        medians = sweep.medians(values)
        factor, named = scaled(unit, medians)
        ends = (int(np.nanargmin(medians)), int(np.nanargmax(medians)))
        cells = (f"{number(float(medians[k]) * factor)} at {amount(float(sweep.columns[k]), sweep.unit)}" for k in ends)
        table.append((name, named, *cells))
    return table


def of_sweep(result: xr.Dataset) -> Iterator[tuple[str, str, np.ndarray]]:
    """Name, unit and values (member) of each quantity that any member has; NaN of members that failed."""
    ended = slideway.finished(result).values
    for name, _, unit, values in stored(result):
        numbers = np.where(ended, values, np.nan)
        if np.isfinite(numbers).any():
            yield name, unit, numbers
