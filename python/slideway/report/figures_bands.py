"""Figures of all members over the time."""

from __future__ import annotations

import warnings

import numpy as np
import xarray as xr

from slideway.sampling import sample_axis
from slideway.way import may_be_misaligned

from .figures_series import BAND_MEMBERS, COUNTS, series_names
from .numbers import counted, scaled, unit_words
from .traces import Figure, Variant, band, line, rows, text

BAND_TIMES = 1000


def bands(result: xr.Dataset) -> Figure | None:
    """Quantiles over the members at each time; None where there are too few members."""
    if result.sizes["member"] < 10:
        return None
    samples, members = result.sizes["sample"], result.sizes["member"]
    step, stride = -(-samples // BAND_TIMES), -(-members // BAND_MEMBERS)
    thin = result.isel(sample=slice(None, None, step), member=slice(None, None, stride))
    variants = []
    for name in [name for name in series_names(result) if name not in COUNTS]:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)  # times that no member reached
            values = thin[name].transpose("member", "sample").values
            curves = np.nanquantile(values, (0.05, 0.25, 0.5, 0.75, 0.95), axis=0)
        factor, named = scaled(float(np.nanmax(np.abs(curves))), str(thin[name].attrs.get("units", "1")))
        low, quarter, middle, three, high = curves * factor
        title = name.replace("_", " ") + ("" if named == "1" else f" [{text(unit_words(named))}]")
        time, unit = sample_axis(thin)
        data = band(time, low, high, "5 to 95 %", "@c1/0.18") + band(time, quarter, three, "25 to 75 %", "@c1/0.35")
        data.append(line(time, middle, "median", "@c1", width=2))
        variants.append(Variant(name, data, rows([title], "time [s]" if unit == "s" else "turns of the crank")))
    caption = f"At each {'time' if 'turned' not in result.coords else 'angle'}, of the {counted(thin.sizes['member'], 'member')} that got there."
    if step > 1:
        caption += f" Every {step}th sample."
    if may_be_misaligned(result):
        caption += " As stored: y and z are not from the way's axis."
    return Figure("bands", "All members over time", caption, variants, choice="Series")
