"""Quantities of a result as columns of members, or as the statistics that a file holds in their place."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from .distribution import drawn
from .members import finished
from .results import groups, holds_all, path_of
from .results import open as open_result
from .scenes import scene

Array = NDArray[np.float64]

SHOWN = (0.05, 0.25, 0.5, 0.75, 0.95)  # probabilities of the quantiles in the table


@dataclass(frozen=True)
class Histogram:
    """edges (k + 1) in the column's unit and counts (k)."""

    edges: Array
    counts: Array


@dataclass(frozen=True)
class Column:
    """One number per member that finished, summarised; in the column's unit."""

    name: str  # with its component, as in "mode_time[free]"
    meaning: str
    unit: str
    count: int
    mean: float
    sd: float  # NaN of a single member
    low: float
    high: float
    quantiles: dict[float, float]
    quantile_intervals: dict[float, tuple[float, float]]  # NaN where there are too few members for one; empty without any
    values: Array | None  # of the members that finished; None where the file has only statistics
    histogram: Histogram | None  # where the file has one

    @property
    def component(self) -> str:
        """Which of the values of a quantity that has several; empty where it has one."""
        return self.name.partition("[")[2].removesuffix("]")

    @property
    def of_file(self) -> bool:
        """Whether the quantiles are the file's statistics."""
        return len(self.quantiles) > len(SHOWN)


def columns(result: xr.Dataset, names: Sequence[str] | None = None) -> list[Column]:
    """Quantities of the members that finished, from the group statistics where it has them; left out: all that the scene asked for."""
    statistics = group_of(result, "statistics")
    ended = (finished(result).values if "status" in result else True) & drawn(result)
    every: list[Column] = []
    for name in _asked(result) if names is None else names:
        if statistics is not None and f"{name}_mean" in statistics:
            every += _from_statistics(result, statistics, name, ended)
        else:
            every += [_of_members(component, meaning, unit, values[ended]) for component, meaning, unit, values in stored(result, [name])]
    return every


def group_of(result: xr.Dataset, name: str) -> xr.Dataset | None:
    """A group of the result's file, if it has one and the result is all of the file."""
    if not result.encoding.get("source") or name not in groups(result) or not holds_all(result):
        return None
    with open_result(path_of(result), group=name) as group:
        return group.load()


def column(every: list[Column], name: str) -> Column | None:
    """The column of that name."""
    return next((one for one in every if one.name == name), None)


def _asked(result: xr.Dataset) -> list[str]:
    return [str(name) for name in scene(result).get("study", {}).get("quantities", [])]


def stored(result: xr.Dataset, names: Sequence[str] | None = None) -> Iterator[tuple[str, str, str, Array]]:
    """Name, meaning, unit and values (member) of each component of each of these quantities; left out: of all that the scene asked for."""
    for name in _asked(result) if names is None else names:
        if name not in result.data_vars or "member" not in result[name].dims or "sample" in result[name].dims:
            continue
        variable = result[name].transpose("member", ...)
        meaning, unit = str(variable.attrs.get("long_name", "")), str(variable.attrs.get("units", "1"))
        if variable.ndim == 1:
            yield name, meaning, unit, variable.values
            continue
        for k, label in enumerate(_labels(result, str(variable.dims[1]), variable.shape[1])):
            yield f"{name}[{label}]", meaning, unit, variable.values[:, k]


def _labels(result: xr.Dataset, dimension: str, size: int) -> list[str]:
    if dimension in result.coords:
        return [str(label) for label in result[dimension].values]
    return [str(k) for k in range(size)]


def _of_members(name: str, meaning: str, unit: str, values: Array) -> Column:
    there = values[np.isfinite(values)]
    none = len(there) == 0
    return Column(
        name=name, meaning=meaning, unit=unit, count=len(there), mean=np.nan if none else float(there.mean()),
        sd=float(there.std(ddof=1)) if len(there) > 1 else np.nan, low=np.nan if none else float(there.min()), high=np.nan if none else float(there.max()),
        quantiles={} if none else dict(zip(SHOWN, np.quantile(there, SHOWN).tolist(), strict=True)), quantile_intervals={}, values=there, histogram=None,
    )  # fmt: skip


def _from_statistics(result: xr.Dataset, statistics: xr.Dataset, name: str, ended: NDArray[np.bool_]) -> Iterator[Column]:
    mean = statistics[f"{name}_mean"]
    probabilities = statistics["probability"].values.tolist()
    members = {component: values for component, _, _, values in stored(result, [name])}
    labels = _labels(result, str(mean.dims[0]), mean.shape[0]) if mean.ndim else [None]
    for k, label in enumerate(labels):
        component = statistics if label is None else statistics.isel({str(mean.dims[0]): k})
        full = name if label is None else f"{name}[{label}]"
        edges = component[f"{name}_bin_edge"].values
        edges = edges[np.isfinite(edges)]
        counts = component[f"{name}_bin_count"].values[: max(len(edges) - 1, 0)]
        bounds = component[f"{name}_quantile_interval"].values
        has_bounds = np.isfinite(bounds).any()
        yield Column(
            name=full, meaning=str(mean.attrs.get("long_name", "")).removeprefix("mean: "), unit=str(mean.attrs.get("units", "1")),
            count=int(component[f"{name}_count"]), mean=float(component[f"{name}_mean"]), sd=float(component[f"{name}_sd"]),
            low=float(component[f"{name}_min"]), high=float(component[f"{name}_max"]),
            quantiles=dict(zip(probabilities, component[f"{name}_quantile"].values.tolist(), strict=True)),
            quantile_intervals=dict(zip(probabilities, map(tuple, bounds.tolist()), strict=True)) if has_bounds else {},
            values=members[full][ended] if full in members else None, histogram=Histogram(edges, counts) if len(edges) > 1 else None,
        )  # fmt: skip
