"""The energy audit of a result, or of the columns of a sweep."""

from __future__ import annotations

import math
from dataclasses import dataclass

import xarray as xr

from slideway.columns import Column, column, columns

from .energy import Balance, Verdict, balance, share, verdict
from .numbers import counted
from .sweep import by_column, sweep_of


@dataclass(frozen=True)
class Audit:
    """The audit of a result: what it says, and the balance to draw."""

    verdict: Verdict
    balance: Balance | None
    whose: str  # members whose means the balance has


def audit(result: xr.Dataset, every: list[Column]) -> Audit:
    """The audit of all members; of a sweep that of the column with the largest share, for columns are different mechanisms."""
    sweep = sweep_of(result)
    if sweep is None or column(every, "energy_residual") is None:
        return Audit(verdict(result, every), balance(result, every), "the members")
    audits = []
    for value, part in by_column(result, sweep).items():
        own = columns(part)
        terms = balance(part, own)
        size = share(terms) if terms else math.nan
        audits.append((-1.0 if math.isnan(size) else size, value, verdict(part, own), terms))
    _, value, worst, terms = max(audits, key=lambda audit: audit[0])
    whose = f"the members with {sweep.named(value)}"
    said = f"Column by column; this is the one with the largest share of {counted(len(audits), 'column')}, {sweep.named(value)}."
    return Audit(Verdict(worst.grade, worst.headline, [said, *worst.sentences]), terms, whose)
