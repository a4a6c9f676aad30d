"""What a sweep changes, and its members column by column."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr

import slideway

from .numbers import amount
from .traces import text

FACTORS = {"m": (1e3, "mm"), "m s-1": (1e3, "mm/s"), "rad": (1e3, "mrad"), "rad s-1": (1.0, "rad/s")}


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

    @property
    def shown(self) -> tuple[np.ndarray, str]:
        """The values in a handy unit, and the title of their axis."""
        factor, unit = FACTORS.get(self.unit, (1.0, self.unit))
        return self.values * factor, text(self.key) + ("" if unit == "1" else f" [{text(unit)}]")

    def named(self, value: float) -> str:
        """A column by its value: "joint.clearance = 0.1 mm"."""
        return f"{self.key} = {amount(value, self.unit)}"

    def medians(self, values: np.ndarray) -> np.ndarray:
        """Of each column the median of the members that have a number (member), NaN where none has."""
        parts = (values[(self.values == column) & np.isfinite(values)] for column in self.columns)
        return np.array([np.median(part) if part.size else np.nan for part in parts])


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
