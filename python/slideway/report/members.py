"""Which members a report looks at one by one, and how it calls them."""

from __future__ import annotations

import numpy as np
import xarray as xr

import slideway

from .numbers import number

MOST = 3


def chosen(result: xr.Dataset) -> dict[int, str]:
    """Numbers and labels of the members to look at: the first, the one in the middle and the most loaded of those that finished.

    Where none finished, the first that have any samples, for these may show why. The result has time series.
    """
    numbers = result["member"].values
    ended = np.flatnonzero(slideway.finished(result).values)
    if len(ended) == 0:
        series = next(data for data in result.data_vars.values() if set(data.dims) == {"member", "sample"})
        began = np.isfinite(series.transpose("member", "sample").values[:, 0])
        ran = np.flatnonzero(began & (slideway.statuses(result).values != "not_run"))
        return {int(numbers[k]): label(result, int(numbers[k])) for k in ran[:MOST]}
    picks = {int(numbers[ended[0]]): ""}
    if "peak_normal_force" in result and len(ended) > 2:
        order = ended[np.argsort(result["peak_normal_force"].values[ended], kind="stable")]
        picks.setdefault(int(numbers[order[len(order) // 2]]), "median peak force")
        picks.setdefault(int(numbers[order[-1]]), "largest peak force")
    else:
        for k in ended[1:MOST]:
            picks.setdefault(int(numbers[k]), "")
    return {member: f"member {member}" + (f" ({why})" if why else "") for member, why in picks.items()}


def label(result: xr.Dataset, member: int) -> str:
    """The member with how it ended."""
    row = result.sel(member=member)
    status = str(slideway.statuses(result).sel(member=member).values)
    if status == "finished":
        return f"member {member}"
    return f"member {member} ({status} at t = {number(float(row['end_time']))} s)"
