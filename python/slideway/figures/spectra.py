"""Spectra."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from ..arguments import positive
from ..errors import SlidewayError
from ..palette import colours
from ..signals import amplitude_spectrum, even_step
from ..units import scaled, spelled
from .base import Members, chosen, drawn, most_lines, series_of, words_of
from .marks import Axis, Band, Curve, Mark, Panel

if TYPE_CHECKING:
    from matplotlib.axes import Axes

standard_gravity = 9.80665  # m/s²


@drawn
def spectrum(
    result: xr.Dataset, name: str = "acceleration_top", member: Members = None, ax: Axes | None = None, *, reference: float | None = None, span: float = 100.0
) -> Panel:
    """One-sided amplitude spectrum with a Hann window, in decibels (Fig. 5 of Qian et al. 2020).

    20 log10(amplitude / reference). Up to eight members are lines; of more the root mean square of their amplitudes is drawn,
    within the band of 90 % of them. Members that did not finish are left out.

    Args:
        name: of the series.
        member: number of a member, or several; left out: all.
        reference: in the unit of the series; left out: 1 g of an acceleration, else 1 of the unit.
        span: what lies so many decibels below the peak is cut off.

    Raises:
        SlidewayError: there is no such series, or no member has all samples.

    >>> slideway.plot.spectrum(slideway.example(), "y", member=0).get_xlabel()
    'frequency [Hz]'
    """
    data = series_of(result, name)
    if reference is not None:
        positive(reference, "reference")
    positive(span, "span")
    units = str(data.attrs.get("units", "1"))
    members = chosen(result, member)
    rows = data.sel(member=members).values
    whole = np.isfinite(rows).all(axis=1)
    if not whole.any():
        raise SlidewayError("none of these members has all samples, for they failed; see slideway.statuses(result)")
    members = [number for number, complete in zip(members, whole, strict=True) if complete]
    frequency, amplitude = amplitude_spectrum(rows[whole], even_step(result["time"].values))
    of_gravity = reference is None and units == "m s-2"
    level = standard_gravity if of_gravity else 1.0 if reference is None else reference
    against = "g" if of_gravity else f"{level:g} {spelled(units)}".strip()

    def decibels(amplitudes: np.ndarray) -> np.ndarray:
        return np.asarray(20 * np.log10(np.maximum(amplitudes, np.finfo(float).tiny) / level))

    factor, hertz = scaled("Hz", frequency)
    x = factor * frequency
    if len(members) <= most_lines:
        shown = decibels(amplitude)
        names = [f"member {number}" if len(members) > 1 else None for number in members]
        marks: list[Mark] = [Curve(x, line, name, colour, width=0.8) for name, line, colour in zip(names, shown, colours, strict=False)]
    else:
        middle = decibels(np.sqrt(np.mean(amplitude**2, axis=0)))
        low, high = shown = decibels(np.quantile(amplitude, (0.05, 0.95), axis=0))
        marks = [Band(x, low, high, "90 % of the members"), Curve(x, middle, f"root mean square of {len(members)} members", width=1)]
    # Single zeros of a spectrum would stretch the axis.
    peak, floor = float(shown.max()), float(np.quantile(shown, 0.01))
    return Panel(marks, Axis("frequency", hertz, tight=True), Axis(words_of(name), f"dB re {against}", low=max(peak - span, floor - 5), high=peak + 5))
