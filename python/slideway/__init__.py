"""Runs slideway, opens its results as xarray Datasets, and plots them.

>>> result = slideway.example()
>>> result.y.sizes["member"], result.y.units
(12, 'm')
"""

from __future__ import annotations

from . import plot, report  # matplotlib and plotly, which take their time, come when something is drawn
from ._version import __version__
from .accessor import ResultAccessor
from .control_variates import ControlVariate, control_variate
from .ensemble import Ensemble
from .errors import FileError, RunError, SceneError, SlidewayError, StoppedEarly, TooManyFailures
from .example import example
from .explanation import Explanation, explain
from .exponent_signs import exponent_signs
from .keys import Key, Keys, keys
from .members import finished, statuses
from .modules import Module, compile  # noqa: A004 (as the program's command)
from .parts import merge, run_part
from .resolution import Resolution, resolution
from .results import groups, open, tree  # noqa: A004 (slideway.open is the name that users expect)
from .runs import info, run
from .scenes import scene
from .sections import sections
from .series_statistics import SeriesStatistics, stats
from .tables import members_table, series

__all__ = [
    "ControlVariate", "Ensemble", "Explanation", "FileError", "Key", "Keys", "Module", "Resolution", "ResultAccessor", "RunError", "SceneError",
    "SeriesStatistics", "SlidewayError", "StoppedEarly", "TooManyFailures", "__version__", "compile", "control_variate", "example", "explain",
    "exponent_signs", "finished", "groups", "info", "keys", "members_table", "merge", "open", "plot", "report", "resolution", "run", "run_part", "scene",
    "sections", "series", "stats", "statuses", "tree",
]  # fmt: skip
