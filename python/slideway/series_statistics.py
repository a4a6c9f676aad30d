"""Chaos statistics of one stored series, as the program computes them."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass

import numpy as np
import xarray as xr

from .arguments import members, one_line, text, whole
from .errors import SlidewayError
from .members import numbers, with_members
from .program import call
from .results import StrPath, file_of
from .temporary import temporary_folder

_options = ("skip", "skip_samples", "max_points", "delay", "dimension", "theiler", "fit", "column", "dt")


@dataclass(frozen=True)
class SeriesStatistics:
    """What `slideway stats` says of a series.

    Attributes:
        text: its rows by their labels: "average period", "delay", "0-1 test", "verdict" ...
        time: of the divergence curve [s].
        mean_log_distance: ⟨ln d⟩ of neighbours after that time, natural logarithm of the distance in the series' unit.
        exponent, error: slope of the fit and half its 95 % interval [1/s]; None where there is none.
        fit: first and last sample of the fit.
        growth_is_seen: whether the verdict lets the exponent stand; where it says that no growth is seen, the slope means nothing.
    """

    text: dict[str, str]
    time: np.ndarray
    mean_log_distance: np.ndarray
    exponent: float | None
    error: float | None
    fit: tuple[int, int] | None
    growth_is_seen: bool = True


@one_line
def stats(
    result: StrPath | xr.Dataset, variable: str | None = None, member: int | None = None, *, program: StrPath | None = None, **options: object
) -> SeriesStatistics:
    """Delay, dimension, exponent after Rosenstein and 0-1 test of a stored series (`slideway stats`).

    Args:
        result: a result with a time series, or its path; a CSV table also does.
        variable: of the result, or the column of a table; left out: y, or the table's last column.
        member: of the result; left out: its first.
        program: path of the program; left out: SLIDEWAY_PROGRAM, else the PATH.
        **options: those of the program, underscores for hyphens: skip, skip_samples, max_points, delay, dimension, theiler, fit ("31..94"),
            and of a table dt.

    Raises:
        SceneError: no such variable, or too few samples.
        SlidewayError: an option that is none, or a member that is not in the result.

    >>> slideway.stats(example_file, "y").text["0-1 test"]
    'none from ... samples, one of every ...'
    >>> slideway.stats(example_file, "y").growth_is_seen
    False
    """
    path = file_of(result)
    if isinstance(result, xr.Dataset):
        there = numbers(with_members(result))
        if not there:
            raise SlidewayError('this result holds no members, and so no series; run it with study.store = "members"')
        # A selection's first member need not be the file's.
        member = members(there[0] if member is None else member, there)[0]
    for option in options:
        if option not in _options:
            raise SlidewayError(f"stats() has no argument {option}, but {', '.join(_options)}")
    arguments = ["stats", path]
    if variable is not None:
        arguments += ["--column" if path.endswith(".csv") else "--variable", text(variable, "variable")]
    if member is not None:
        arguments += ["--member", str(whole(member, "member", 0))]
    for option, value in options.items():
        arguments += [f"--{option.replace('_', '-')}", str(value)]
    with temporary_folder() as folder:
        curves = os.path.join(folder, "curves.csv")
        said = json.loads(call(program, [*arguments, "-o", curves, "--json"]))
        table = np.atleast_1d(np.genfromtxt(curves, delimiter=",", names=True))
    known = np.isfinite(table["mean_log_distance"])
    growth = said["exponent"]
    return SeriesStatistics(
        text=_rows(said["text"]),
        time=table["time"][known],
        mean_log_distance=table["mean_log_distance"][known],
        exponent=growth["value"] if growth else None,
        error=growth["half_width"] if growth else None,
        fit=(growth["first_sample"], growth["last_sample"]) if growth else None,
        growth_is_seen=bool(growth and growth["is_exponential"]),
    )


def _rows(pairs: list[list[str]]) -> dict[str, str]:
    """The program's rows by their labels; rows without a label go on with the one before."""
    rows: dict[str, str] = {}
    label = ""
    for own, text in pairs:
        label = own or label
        rows[label] = f"{rows[label]}\n{text}" if label in rows else text
    return rows
