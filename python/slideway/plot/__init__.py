"""Plots of results: each takes an axis or makes one, and returns it.

>>> ax = slideway.plot.time_series(slideway.example(), "y", member=0)
>>> ax.get_xlabel()
'time [s]'
"""

from ..figures.chaos import divergence, exponent_histogram, exponent_history
from ..figures.forces import apex_forces
from ..figures.mechanism import animation, mechanism
from ..figures.orbits import bifurcation, exponent_sweep, journal, orbit_yz, poincare
from ..figures.precision import work_precision
from ..figures.series import cumulative_area, force_histogram, spectrum, time_series
from ..figures.tolerance import quantiles, sensitivity

__all__ = [
    "animation", "apex_forces", "bifurcation", "cumulative_area", "divergence", "exponent_histogram", "exponent_history", "exponent_sweep", "force_histogram",
    "journal", "mechanism", "orbit_yz", "poincare", "quantiles", "sensitivity", "spectrum", "time_series", "work_precision",
]  # fmt: skip
