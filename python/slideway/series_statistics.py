"""Chaos statistics of one stored series, as the program computes them."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass

import numpy as np
import xarray as xr

from .program import call, temporary_file
from .results import StrPath, path_of


@dataclass(frozen=True)
class SeriesStatistics:
    """What `slideway stats` says of a series.

    Attributes:
        text: its rows by their labels: "average period", "delay", "0-1 test", "verdict" ...
        time: of the divergence curve [s].
        mean_log_distance: ⟨ln d⟩ of neighbours after that time, natural logarithm of the distance in the series' unit.
        exponent, error: slope of the fit and its standard error [1/s]; None where there is none.
        fit: first and last sample of the fit.
    """

    text: dict[str, str]
    time: np.ndarray
    mean_log_distance: np.ndarray
    exponent: float | None
    error: float | None
    fit: tuple[int, int] | None


def stats(
    result: StrPath | xr.Dataset, variable: str = "y", member: int | None = None, *, program: StrPath | None = None, **options: object
) -> SeriesStatistics:
    """Delay, dimension, exponent after Rosenstein and 0-1 test of a stored series (`slideway stats`).

    Args:
        result: a result with a time series, or its path; a CSV table also does.
        variable: of the result.
        member: of the result; left out: its first.
        **options: those of the program, underscores for hyphens: skip, max_points, delay, dimension, theiler, fit ("31..94"),
            and of a table column, dt.

    Raises:
        SceneError: no such variable, or too few samples.

    >>> slideway.stats(example_file, "y").text["0-1 test"]
    'none from ... samples, one of every ...'
    """
    path = path_of(result) if isinstance(result, xr.Dataset) else os.fspath(result)
    curves = temporary_file("curves.csv")
    arguments = ["stats", path, "-o", curves]
    if "column" not in options and not path.endswith(".csv"):
        arguments += ["--variable", variable]
    if member is not None:
        arguments += ["--member", str(member)]
    for option, value in options.items():
        arguments += [f"--{option.replace('_', '-')}", str(value)]
    text = _rows(call(program, arguments))
    table = np.genfromtxt(curves, delimiter=",", names=True)
    there = np.isfinite(table["mean_log_distance"])
    growth = re.match(r"(\S+) ± (\S+) 1/s", text.get("exponent", ""))
    window = re.match(r"samples (\d+) to (\d+)", text.get("fit window", ""))
    return SeriesStatistics(
        text=text,
        time=table["time"][there],
        mean_log_distance=table["mean_log_distance"][there],
        exponent=float(growth[1]) if growth else None,
        error=float(growth[2]) if growth else None,
        fit=(int(window[1]), int(window[2])) if window else None,
    )


def _rows(output: str) -> dict[str, str]:
    """The program's rows: a label in 16 columns and its text; rows without label go on with the one before."""
    rows: dict[str, str] = {}
    label = ""
    for line in output.splitlines():
        label = line[:16].strip() or label
        rows[label] = f"{rows[label]}\n{line[17:].strip()}" if label in rows else line[17:].strip()
    return rows
