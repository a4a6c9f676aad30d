"""Tables of a result for pandas: a row for each member, or for each of its samples."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from . import arguments
from .errors import SlidewayError
from .former_names import words_of_now
from .members import numbers, statuses, with_members

if TYPE_CHECKING:
    import pandas as pd


@arguments.one_line
def members_table(result: xr.Dataset) -> pd.DataFrame:
    """What a result says of each member, one row a member: the table of ``slideway export``.

    Returns:
        A pandas DataFrame with the index ``member``. Columns are ``status``, the label that a table gives the member, what varies under
        its key, then quantities, and all else that there is a number of. Several numbers of a variable are several columns:
        ``mode_time[free]``. ``frame.attrs["units"]`` has the units.

    Raises:
        SlidewayError: the result holds no members (study.store = "statistics").

    >>> frame = slideway.members_table(slideway.open(example_file))
    >>> float(frame["initial.y"].max()) < 1e-4, frame.attrs["units"]["mode_time[free]"]
    (True, 's')
    >>> frame.groupby("status").size().to_dict()
    {'finished': 64}
    """
    import pandas as pd

    words = np.atleast_1d(statuses(result).values)
    whole = with_members(result)
    columns: dict[str, Any] = {"status": words}
    units = {}
    if "member_label" in whole.coords:
        columns["member_label"] = np.atleast_1d(whole["member_label"].values).astype(str)
    for variable in _of_members(whole):
        data = whole[variable]
        for name, values in _spread(str(data.attrs.get("key", variable)), data):
            columns[name] = values
            if data.attrs.get("units", "1") != "1":
                units[name] = data.attrs["units"]
    frame = pd.DataFrame(columns, index=pd.Index(numbers(whole), name="member"))
    frame.attrs["units"] = units
    return frame


@arguments.one_line
def series(result: xr.Dataset, *names: str) -> pd.DataFrame:
    """Time series of all members, one row a sample: the table of ``slideway export --series``.

    Args:
        names: of series; left out: all.

    Returns:
        A pandas DataFrame with the index ``member``, ``time``. ``frame.attrs["units"]`` has the units. Of samples at equal angles of a crank
        that turns freely the index is ``member``, ``turned`` [rad], and ``time`` is the first column.

    Raises:
        SlidewayError: there are no time series in this result, or none of this name.

    >>> frame = slideway.series(slideway.open(example_file), "y", "vz")
    >>> len(frame), list(frame.columns), frame.attrs["units"]["vz"]
    (25664, ['y', 'vz'], 'm s-1')
    >>> float(frame.loc[3, "y"].iloc[0]) == float(slideway.open(example_file).initial_y.sel(member=3))
    True
    """
    import pandas as pd

    whole = with_members(result)
    there = [str(name) for name, data in whole.data_vars.items() if data.dims == ("member", "sample")]
    if not there:
        raise SlidewayError("this result has no time series; give the scene study.samples, or samples_per_revolution")
    for name in names:
        if arguments.text(name, "the name of a series") not in there:
            raise SlidewayError(f'there is no series "{name}" in this result; it has {", ".join(there)}')
    wanted = list(names) or there
    place = "turned" if "turned" in whole.coords else "time"
    wanted = ["time"] * (place == "turned") + wanted
    index = pd.MultiIndex.from_product([numbers(whole), whole[place].values], names=["member", place])
    frame = pd.DataFrame({name: whole[name].values.ravel() for name in wanted}, index=index)
    frame.attrs["units"] = {name: whole[name].attrs["units"] for name in wanted if whole[name].attrs.get("units", "1") != "1"}
    return frame


def _of_members(whole: xr.Dataset) -> list[str]:
    """Variables along ``member``, but for series, in the order of the table."""
    own = [str(name) for name, data in whole.data_vars.items() if data.dims[:1] == ("member",) and "sample" not in data.dims and name != "status"]
    quantities = words_of_now(str(whole.attrs.get("quantities", ""))).split()
    return sorted(own, key=lambda name: 0 if "key" in whole[name].attrs else 1 if name in quantities else 2)


def _spread(name: str, data: xr.DataArray) -> list[tuple[str, Any]]:
    """Columns of a variable, each with its name: one for each number that a member has."""
    columns = [(name, data)]
    for dimension in data.dims[1:]:
        labels = data[dimension].values if dimension in data.coords else np.arange(data.sizes[dimension])
        said = [label if isinstance(label, str) else f"{label:.0f}" if label == round(label) else repr(float(label)) for label in labels]
        columns = [(f"{stem}[{label}]", part.isel({dimension: i})) for stem, part in columns for i, label in enumerate(said)]
    return [(stem, part.values) for stem, part in columns]
