"""The examples in the docstrings."""

from __future__ import annotations

import doctest
import importlib
import pkgutil
from collections.abc import Callable

import pytest
import slideway
import xarray as xr

# A command line is no module to import.
names = [m.name for m in pkgutil.walk_packages(slideway.__path__, "slideway.") if not m.name.endswith("__main__")]


@pytest.mark.parametrize("name", ["slideway", *names])
def test_examples_in_docstrings_hold(name: str, result_of: Callable[[str], xr.Dataset]) -> None:
    module = importlib.import_module(name)
    example_file = result_of("ensemble").encoding["source"]
    tolerance_file = result_of("tolerance").encoding["source"]
    outcome = doctest.testmod(
        module,
        extraglobs={"slideway": slideway, "example_file": example_file, "tolerance_file": tolerance_file},
        optionflags=doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS | doctest.IGNORE_EXCEPTION_DETAIL,
    )
    assert outcome.failed == 0
