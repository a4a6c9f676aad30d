"""What accuracy costs."""

from __future__ import annotations

import csv
import os
from collections.abc import Mapping, Sequence
from typing import Any, Union

import numpy as np

from ..arguments import path, shown, text
from ..errors import SlidewayError
from ..palette import colours
from .base import Axes, drawn, words_of
from .marks import Axis, Curve, Panel

Table = Union[str, "os.PathLike[str]", Mapping[str, Sequence[Any]]]
_markers = "os^Dv<>P"


@drawn
def work_precision(
    table: Table, problem: str | None = None, ax: Axes | None = None, *, error: str = "p95_error", cost: str = "seconds_per_member"
) -> Panel:
    """Error against run time, a curve for each method (`bench/results/work_precision.csv`).

    Args:
        table: path of the CSV, or its columns (a pandas DataFrame also does): problem, method, code, error, cost, error_unit.
        problem: left out: the only one in the table.
        error, cost: columns of the two axes.

    Raises:
        SlidewayError: a column is missing, or the problem is not in the table.

    >>> table = {"problem": ["decay"] * 2, "method": ["dopri5"] * 2, "code": ["avx2"] * 2, "error_unit": ["1"] * 2,
    ...          "p95_error": [1e-3, 1e-6], "seconds_per_member": [1e-5, 3e-5]}
    >>> slideway.plot.work_precision(table).get_title()
    'decay'
    """
    columns = _columns(table)
    for name in ("problem", "method", "code", text(error, "error"), text(cost, "cost")):
        if name not in columns:
            raise SlidewayError(f"the table has no column {name}, but {', '.join(columns)}")
    problems = list(dict.fromkeys(columns["problem"]))
    if problem is None and len(problems) > 1:
        raise SlidewayError(f"the table has several problems; give problem=, one of {', '.join(problems)}")
    problem = problems[0] if problem is None else problem
    if problem not in problems:
        raise SlidewayError(f"the table has no problem {problem}, but {', '.join(problems)}")
    rows = [i for i, name in enumerate(columns["problem"]) if name == problem]
    families = list(dict.fromkeys(columns["method"][i] for i in rows))
    curves = []
    for method, code in dict.fromkeys((columns["method"][i], columns["code"][i]) for i in rows):
        own = [i for i in rows if (columns["method"][i], columns["code"][i]) == (method, code)]
        errors = np.array([float(columns[error][i]) for i in own])
        costs = np.array([float(columns[cost][i]) for i in own])
        place = families.index(method)
        marker = _markers[(place + place // len(colours)) % len(_markers)]  # another one when the colours begin again
        # Vectorised code is a full line, the scalar peer of the same method a dashed one of its colour.
        curves.append(Curve(costs, np.where(errors > 0, errors, np.nan), f"{method}, {code}", colours[place % len(colours)],
                            dash="--" if code == "scalar" else "-", marker=marker, hollow=code == "scalar"))  # fmt: skip
    unit = columns["error_unit"][rows[0]] if "error_unit" in columns else "1"
    words = {"p95_error": "error, 95th percentile", "median_error": "error, median"}.get(error, words_of(error))
    x = Axis("time per member", "s", log=True) if cost == "seconds_per_member" else Axis(words_of(cost), log=True)
    return Panel(curves, x, Axis(words, "" if unit == "1" else unit, log=True), title=problem)


def _columns(table: Table) -> dict[str, list[str]]:
    if isinstance(table, (str, os.PathLike)):
        name = path(table, "table")
        try:
            with open(name, encoding="utf-8", newline="") as file:
                rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        except OSError as problem:
            raise SlidewayError(f"{name}: cannot be read ({problem.strerror}); check the path") from problem
        return {name: [row[name] for row in rows] for name in (rows[0] if rows else ())}
    if not hasattr(table, "keys"):
        raise SlidewayError(f"the table is {shown(table)}; give the path of a CSV, or its columns by their names")
    return {str(name): [str(value) for value in table[name]] for name in table}
