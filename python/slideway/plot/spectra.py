"""Spectra."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from ..arguments import positive
from ..errors import SlidewayError
from ..palette import colours
from ..signals import amplitude_spectrum, even_step
from .style import Members, axis, chosen, finish, label, most_lines, of_result, scaled, series_of, words_of

standard_gravity = 9.80665  # m/s²


@of_result
def spectrum(
    result: xr.Dataset, name: str = "acceleration_top", member: Members = None, ax: Axes | None = None, *, reference: float | None = None, span: float = 100.0
) -> Axes:
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
    unit = scaled(units, [1.0])[1]
    level = standard_gravity if of_gravity else 1.0 if reference is None else reference
    against = "g" if of_gravity else f"{level:g} {unit}".strip()

    def decibels(amplitudes: np.ndarray) -> np.ndarray:
        return np.asarray(20 * np.log10(np.maximum(amplitudes, np.finfo(float).tiny) / level))

    factor, hertz = scaled("Hz", frequency)
    ax = axis(ax)
    if len(members) <= most_lines:
        lines = decibels(amplitude)
        shown = lines
        for number, line, colour in zip(members, lines, colours, strict=False):
            ax.plot(factor * frequency, line, color=colour, lw=0.8, label=f"member {number}" if len(members) > 1 else None)
    else:
        lines = decibels(np.sqrt(np.mean(amplitude**2, axis=0)))
        low, high = decibels(np.quantile(amplitude, (0.05, 0.95), axis=0))
        shown = np.array([low, high])
        ax.fill_between(factor * frequency, low, high, color=colours[0], alpha=0.25, lw=0, label="90 % of the members")
        ax.plot(factor * frequency, lines, color=colours[0], lw=1, label=f"root mean square of {len(members)} members")
    # Single zeros of a spectrum would stretch the axis.
    peak, floor = float(shown.max()), float(np.quantile(shown, 0.01))
    ax.set_ylim(max(peak - span, floor - 5), peak + 5)
    ax.margins(x=0)
    return finish(ax, label("frequency", hertz), label(words_of(name), f"dB re {against}"))
