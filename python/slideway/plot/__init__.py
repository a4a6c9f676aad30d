"""Plots of results: each takes an axis or makes one, and returns it.

>>> ax = slideway.plot.time_series(slideway.example(), "y", member=0)
>>> ax.get_xlabel()
'time [s]'
"""

from .chaos import divergence, exponent_histogram, exponent_history
from .explanation import apex_forces
from .forces import force_histogram
from .orbits import orbit_yz, poincare
from .precision import work_precision
from .series import cumulative_area, time_series
from .spectra import spectrum
from .sweeps import bifurcation, exponent_sweep
from .tolerance import quantiles, sensitivity

__all__ = [
    "apex_forces",
    "bifurcation",
    "cumulative_area",
    "divergence",
    "exponent_histogram",
    "exponent_history",
    "exponent_sweep",
    "force_histogram",
    "orbit_yz",
    "poincare",
    "quantiles",
    "sensitivity",
    "spectrum",
    "time_series",
    "work_precision",
]
