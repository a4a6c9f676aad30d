"""What a sweep changes, and its members column by column."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr

import slideway
from slideway.figures.sweeps import medians_of

from .numbers import amount


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
