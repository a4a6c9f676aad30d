"""Chaos statistics of one stored series, as the program computes them."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass

import numpy as np
import xarray as xr

from .arguments import members, one_line, text, whole
from .errors import SlidewayError
from .members import numbers, with_members
from .program import call
from .results import StrPath, file_of
from .temporary import temporary_folder

_no_growth = ("no exponential growth", "the exponent means little")  # what verdicts say of it
_options = ("skip", "skip_samples", "max_points", "delay", "dimension", "theiler", "fit", "column", "dt")


@dataclass(frozen=True)
class SeriesStatistics:
    """What `slideway stats` says of a series.

    Attributes:
        text: its rows by their labels: "average period", "delay", "0-1 test", "verdict" ...
        time: of the divergence curve [s].
        mean_log_distance: ⟨ln d⟩ of neighbours after that time, natural logarithm of the distance in the series' unit.
        exponent, error: slope of the fit and its standard error [1/s]; None where there is none.
        fit: first and last sample of the fit.
        growth_is_seen: whether the verdict lets the exponent stand; where it says that no growth is seen, the slope means nothing.
    """

    text: dict[str, str]
    time: np.ndarray
    mean_log_distance: np.ndarray
    exponent: float | None
    error: float | None
    fit: tuple[int, int] | None

    @property
    def growth_is_seen(self) -> bool:
        """See above.

        >>> slideway.stats(example_file, "y").growth_is_seen
        False
        """
        verdict = self.text.get("verdict", "")
        return self.exponent is not None and not any(words in verdict for words in _no_growth)


@one_line
def stats(
    result: StrPath | xr.Dataset, variable: str = "y", member: int | None = None, *, program: StrPath | None = None, **options: object
) -> SeriesStatistics:
    """Delay, dimension, exponent after Rosenstein and 0-1 test of a stored series (`slideway stats`).

    Args:
        result: a result with a time series, or its path; a CSV table also does.
        variable: of the result.
        member: of the result; left out: its first.
        program: path of the program; left out: SLIDEWAY_PROGRAM, else the PATH.
        **options: those of the program, underscores for hyphens: skip, skip_samples, max_points, delay, dimension, theiler, fit ("31..94"),
            and of a table column, dt.

    Raises:
        SceneError: no such variable, or too few samples.
        SlidewayError: an option that is none, or a member that is not in the result.

    >>> slideway.stats(example_file, "y").text["0-1 test"]
    'none from ... samples, one of every ...'
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
    if "column" not in options and not path.endswith(".csv"):
        arguments += ["--variable", text(variable, "variable")]
    if member is not None:
        arguments += ["--member", str(whole(member, "member", 0))]
    for option, value in options.items():
        arguments += [f"--{option.replace('_', '-')}", str(value)]
    with temporary_folder() as folder:
        curves = os.path.join(folder, "curves.csv")
        rows = _rows(call(program, [*arguments, "-o", curves]))
        table = np.atleast_1d(np.genfromtxt(curves, delimiter=",", names=True))
    known = np.isfinite(table["mean_log_distance"])
    growth = re.match(r"(\S+) ± (\S+) 1/s", rows.get("exponent", ""))
    window = re.match(r"samples (\d+) to (\d+)", rows.get("fit window", ""))
    return SeriesStatistics(
        text=rows,
        time=table["time"][known],
        mean_log_distance=table["mean_log_distance"][known],
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
