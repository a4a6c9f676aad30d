"""Runs slideway, opens its results as xarray Datasets, and plots them.

>>> result = slideway.example()
>>> result.y.sizes["member"], result.y.units
(12, 'm')
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from ._version import __version__
from .accessor import ResultAccessor
from .errors import SlidewayError
from .members import finished, statuses
from .results import groups, open  # noqa: A004 (slideway.open is the name that users expect)
from .scenes import scene
from .sections import sections

if TYPE_CHECKING:
    from . import plot

__all__ = [
    "ResultAccessor",
    "SlidewayError",
    "__version__",
    "finished",
    "groups",
    "open",
    "plot",
    "scene",
    "sections",
    "statuses",
]


def __getattr__(name: str) -> Any:
    """slideway.plot is imported when it is first used: matplotlib takes its time."""
    if name == "plot":
        return importlib.import_module(".plot", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
