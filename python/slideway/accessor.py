"""ds.slideway: what a result knows beyond its variables."""

from __future__ import annotations

import weakref
from typing import TYPE_CHECKING, Any

import xarray as xr

from . import members, results, tables
from . import scenes as scenes_
from . import sections as sections_

if TYPE_CHECKING:
    import pandas as pd


@xr.register_dataset_accessor("slideway")  # type: ignore[no-untyped-call, unused-ignore]
class ResultAccessor:
    """Everything about a result that is no variable of it, as ``result.slideway``.

    >>> result = slideway.example()
    >>> result.slideway.scene["joint"]["clearance_y"]
    0.0001
    >>> result.slideway.sections(member=2).sizes["section"]
    40
    """

    def __init__(self, result: xr.Dataset) -> None:
        # xarray keeps the accessor in its Dataset: a reference back would keep both, and a temporary file, until the next collection.
        self._living = weakref.ref(result)
        self._otherwise = result.copy()

    @property
    def _result(self) -> xr.Dataset:
        living = self._living()
        return self._otherwise if living is None else living

    @property
    def path(self) -> str:
        """The file that the result comes from.

        >>> slideway.open(example_file).slideway.path.endswith("ensemble.nc")
        True
        """
        return results.path_of(self._result)

    @property
    def scene(self) -> dict[str, Any]:
        """See :func:`slideway.scene`.

        >>> slideway.example().slideway.scene["study"]["kind"]
        'sweep'
        """
        return scenes_.scene(self._result)

    @property
    def groups(self) -> list[str]:
        """See :func:`slideway.groups`.

        >>> "sensitivity" in slideway.open(tolerance_file).slideway.groups
        True
        """
        return results.groups(self._result)

    @property
    def statistics(self) -> xr.Dataset:
        """Counts, moments, quantiles and histograms of each quantity, of a tolerance study.

        >>> with slideway.open(tolerance_file).slideway.statistics as statistics:
        ...     statistics.members.to_series().to_dict()  # 16 rows of a Saltelli design in 8 inputs: 16 · (8 + 2)
        {'finished': 160}
        """
        return self.group("statistics")

    @property
    def yields(self) -> xr.Dataset:
        """Shares of the members that meet the scene's limits (the group "yield").

        >>> with slideway.open(tolerance_file).slideway.yields as yields:
        ...     yields.limit.values.tolist(), 0 <= float(yields.all_share) <= 1
        (['peak_normal_force'], True)
        """
        return self.group("yield")

    @property
    def sensitivity(self) -> xr.Dataset:
        """Sobol indices, or rank correlations, of each quantity and input.

        >>> with slideway.open(tolerance_file).slideway.sensitivity as sensitivity:
        ...     int(sensitivity.rows_used), sensitivity.peak_normal_force_first.sizes["input"]
        (16, 8)
        """
        return self.group("sensitivity")

    @property
    def statuses(self) -> xr.DataArray:
        """See :func:`slideway.statuses`.

        >>> slideway.example().slideway.statuses.values[-1].item()
        'max_steps'
        """
        return members.statuses(self._result)

    @property
    def finished(self) -> xr.DataArray:
        """See :func:`slideway.finished`.

        >>> int(slideway.example().slideway.finished.sum())
        11
        """
        return members.finished(self._result)

    def group(self, name: str) -> xr.Dataset:
        """A group of the file, as slideway.open(path, group=name).

        >>> with slideway.open(tolerance_file).slideway.group("statistics") as statistics:
        ...     statistics.sizes["probability"] > 0
        True
        """
        return results.open(self.path, group=name)

    def sections(self, member: int | None = None) -> xr.Dataset:
        """See :func:`slideway.sections`.

        >>> slideway.example().slideway.sections(member=2).sizes["section"]
        40
        """
        return sections_.sections(self._result, member)

    def members_table(self) -> pd.DataFrame:
        """See :func:`slideway.members_table`.

        >>> slideway.example().slideway.members_table().index.name
        'member'
        """
        return tables.members_table(self._result)

    def series(self, *names: str) -> pd.DataFrame:
        """See :func:`slideway.series`.

        >>> slideway.open(example_file).slideway.series("y").index.names
        FrozenList(['member', 'time'])
        """
        return tables.series(self._result, *names)
