"""Plots of results: each takes an axis or makes one, and returns it.

>>> ax = slideway.plot.time_series(slideway.example(), "y", member=0)
>>> ax.get_xlabel()
'time [s]'
"""

from ..figures.chaos import divergence, exponent_histogram, exponent_history
from ..figures.forces import force_histogram
from ..figures.orbits import orbit_yz, poincare
from ..figures.precision import work_precision
from ..figures.series import cumulative_area, time_series
from ..figures.spectra import spectrum
from ..figures.sweeps import bifurcation, exponent_sweep
from ..figures.tolerance import quantiles, sensitivity
from .explanation import apex_forces

__all__ = [
    "apex_forces", "bifurcation", "cumulative_area", "divergence", "exponent_histogram", "exponent_history", "exponent_sweep", "force_histogram",
    "orbit_yz", "poincare", "quantiles", "sensitivity", "spectrum", "time_series", "work_precision",
]  # fmt: skip
