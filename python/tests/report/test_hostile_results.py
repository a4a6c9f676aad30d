"""Results as no run makes them: whatever is in one, there is a page of it that holds together, or one line that says why not."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import slideway
import xarray as xr

from .conftest import Reader

Result = Callable[[str], xr.Dataset]
RECIPES = ["ensemble", "lyapunov", "poincare", "sweep", "correlations", "stored", "failing"]
PAGES = int(os.environ.get("SLIDEWAY_HOSTILE_PAGES", "3"))  # of each recipe
VALUES: list[Any] = [np.nan, np.inf, -np.inf, 1e308, -1e308, 5e-324, 0.0, -1.0, 1e19]
TEXTS: list[Any] = ["", "</script><blink>", "\u2028", "a" * 5000, 3, np.nan, "schema = 1", "[study]\nkind = 3", np.array([1.0, 2.0]), "nan", "µ\n"]


def altered(result: xr.Dataset, random: np.random.Generator) -> xr.Dataset:
    """A result with one to four things in it that are not as they were."""
    made = result.copy(deep=True)
    for _ in range(random.integers(1, 5)):
        if not made.data_vars:
            break
        name = str(random.choice([str(name) for name in made.data_vars]))
        values = made[name].values
        match random.integers(7):
            case 0:
                made = made.drop_vars(name)
            case 1 if values.dtype.kind in "fi":
                some = random.random(values.shape) < random.choice([0.1, 1.0])
                made[name] = made[name].dims, np.where(some, random.choice(VALUES), values), made[name].attrs
            case 2:
                made[name].attrs[str(random.choice(["units", "long_name", "flag_meanings", "flag_values", "of_quantity"]))] = TEXTS[random.integers(len(TEXTS))]
            case 3:
                attribute = str(random.choice(list(made.attrs)))
                made.attrs[attribute] = TEXTS[random.integers(len(TEXTS))]
            case 4:
                made.attrs.pop(str(random.choice(list(made.attrs))))
            case 5:
                dimension = str(random.choice([str(d) for d in made.dims]))
                made = made.isel({dimension: slice(int(random.integers(3)))})
            case _:
                made[name] = made[name].astype(random.choice(["f4", "i8", "U5", "bool"]))
    made.encoding = dict(result.encoding)
    return made


def pages_hold_together(result: xr.Dataset, path: Path, seeds: range) -> int:
    """How many of the altered results have a page."""
    pages = 0
    for seed in seeds:
        try:
            slideway.report.write(altered(result, np.random.default_rng(seed)), path)
        except slideway.SlidewayError as error:
            said = str(error)
            assert said and said.isprintable(), seed
        else:
            pages += 1
            reader = Reader(path.read_text(encoding="utf-8"))
            assert "blink" not in [tag for tag, _ in reader.tags], seed  # what a text says is no element
            json.dumps(reader.data, allow_nan=False)
            path.unlink()
    return pages


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")  # of numbers that overflow
@pytest.mark.parametrize("recipe", RECIPES)
def test_results_that_no_run_makes_have_a_page_or_one_line(recipe: str, result_of: Result, tmp_path: Path) -> None:
    assert pages_hold_together(result_of(recipe), tmp_path / "p.html", range(PAGES)) >= 0


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("recipe", RECIPES)
def test_hundreds_of_results_that_no_run_makes(recipe: str, result_of: Result, tmp_path: Path) -> None:
    assert pages_hold_together(result_of(recipe), tmp_path / "p.html", range(1000, 1300)) > 10
