"""Spectra of accelerations, as sensors on the slider would show them."""

from __future__ import annotations

import numpy as np
import xarray as xr

from slideway.errors import SlidewayError
from slideway.signals import amplitude_spectrum, even_step

from .members import chosen
from .poses import Poses
from .traces import Figure, Variant, line, rows

G = 9.80665  # the reference [m/s²]
FLOOR = -140.0  # [dB]
SERIES = {"acceleration_top": "top sensor", "acceleration_front": "front sensor", "ax": "centre, along X", "ay": "centre, along Y", "az": "centre, along Z"}


def spectra(result: xr.Dataset, seen: dict[int, Poses]) -> Figure | None:
    """One-sided amplitude spectra with a Hann window, dB re g (model.md section 7); None without series of accelerations."""
    names = [name for name in SERIES if name in result and "sample" in result[name].dims]
    variants = []
    for member, label in chosen(result).items():
        row = result.sel(member=member).isel(sample=seen[member].samples)
        data = []
        for k, name in enumerate(names):
            try:
                frequency, amplitude = amplitude_spectrum(row[name].values, even_step(row["time"].values))
            except SlidewayError:
                continue  # too short a record, or one with gaps
            level = 20 * np.log10(np.maximum(amplitude[1:] / G, 10 ** (FLOOR / 20)))
            data.append(line(frequency[1:], level, SERIES[name], f"@c{k % 4 + 1}", width=0.9))
        if data:
            variants.append(Variant(label, data, rows(["amplitude [dB re g]"], "frequency [Hz]")))
    if not variants:
        return None
    caption = (
        "One-sided amplitude spectra with a Hann window. The samples are points of the motion, not means over their spacing: "
        "what is faster than half the sampling rate is folded back."
    )
    return Figure("spectra", "Spectra of accelerations", caption, variants, choice="Member")
