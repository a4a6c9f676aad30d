"""What a section of the page is made of, and where its numbers come from."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np
import slideway
import xarray as xr
from slideway.figures.marks import Panel
from slideway.plot.axes import png

from .claims import LAW_WORDS, LAWS, Claim, growth, said
from .estimates import estimate
from .plan import name
from .runs import Laboratory, Missing
from .scale import Scale

WINDOWS = {"start": "from scattered starts", "settled": "when settled"}
"""The first revolutions from starts within the clearance, and as many after them."""


@dataclass(frozen=True)
class Figure:
    """One figure under both laws: PNG images by law, or a line that says why there is none."""

    caption: str
    images: dict[str, bytes | str]


@dataclass(frozen=True)
class Table:
    caption: str
    header: Sequence[str]
    rows: Sequence[Sequence[str]]


def by_law(caption: str, head: str, columns: Sequence[str], rows: Mapping[str, Callable[[str], Sequence[str]]]) -> Table:
    """A table with the same columns under each law.

    Args:
        head: of the first column, the rows' names.
        rows: by their names, what gives the cells under a law.
    """
    header = [head, *(f"{LAW_WORDS[law]}: {column}" for law in LAWS for column in columns)]
    return Table(caption, header, [[name, *(cell for law in LAWS for cell in cells(law))] for name, cells in rows.items()])


@dataclass
class Section:
    """A section of the page.

    Attributes:
        title: what of the paper is shown.
        words: paragraphs before the claims.
    """

    title: str
    words: list[str] = field(default_factory=list)
    claims: list[Claim] = field(default_factory=list)
    figures: list[Figure] = field(default_factory=list)
    tables: list[Table] = field(default_factory=list)


@dataclass(frozen=True)
class Bench:
    """The results, by what they are of.

    Attributes:
        shares: by law, of the drive's work that the law made, each time an audit was asked for.
    """

    laboratory: Laboratory
    scale: Scale
    shares: dict[str, list[float]] = field(default_factory=lambda: {law: [] for law in LAWS})

    def result(self, family: str, case: str, stage: str, law: str) -> xr.Dataset:
        """A result.

        Raises:
            Missing: it could not be made.
        """
        return self.laboratory.result(name(family, case, stage, law))

    def values(self, family: str, case: str, stage: str, law: str, quantity: str, entry: str | None = None) -> np.ndarray:
        """A quantity of each member, in SI units; NaN of one that failed.

        Args:
            entry: label of the entry of a quantity with several: "top", "z" ...; left out: the first.
        """
        result = self.result(family, case, stage, law)
        data = result[quantity]
        if entry is not None:
            (dimension,) = (d for d in data.dims if d != "member")
            data = data.sel({dimension: entry})
        elif data.ndim > 1:
            data = data.isel({d: 0 for d in data.dims if d != "member"})
        return np.where(slideway.finished(result).values, np.asarray(data.values, dtype=float), np.nan)

    def series(self, family: str, case: str, stage: str, law: str, variable: str) -> np.ndarray:
        """A series, member × sample, of the members that finished."""
        result = self.result(family, case, stage, law)
        return np.asarray(result[variable].values[slideway.finished(result).values], dtype=float)

    def audit(self, family: str, cases: Sequence[tuple[str, str]], stage: str, revolutions: float) -> Table:
        """The energy that the law made beside the work of the drive.

        Args:
            cases: their words and names.
            revolutions: of the runs.
        """
        turn = 1e3 / revolutions

        def cells(case: str, law: str) -> list[str]:
            made, work, seconds = (self.values(family, case, stage, law, name) for name in ("energy_residual", "drive_work", "end_time"))
            share = estimate(made).mean / estimate(work).mean
            self.shares[law].append(share)
            return [said(estimate(turn * made), ""), said(estimate(1e3 * made / seconds), ""), said(estimate(turn * work), ""),
                    f"{100 * share:.2g} %" if abs(share) > 1e-4 else "below 0.01 %"]  # fmt: skip

        caption = "Energy that the contact law made out of nothing (the residual ε of the audit), beside the work of the drive."
        columns = ("made [mJ a turn]", "made [mJ/s]", "drive's work [mJ a turn]", "share")
        return by_law(caption, "energy audit", columns, {words: partial(cells, case) for words, case in cases})

    def growth(
        self, place: str, words: str, quantity: Quantity, cases: Mapping[str, str], window: str, unit: str, factor: float = 1.0, floor: float = 0.0
    ) -> Claim:
        """The claim that a quantity grows from case to case (:func:`claims.growth`)."""
        columns = {law: [quantity(self, case, window, law) for case in cases.values()] for law in LAWS}
        return growth(place, words, list(cases), columns, unit, factor, floor)


Quantity = Callable[[Bench, str, str, str], np.ndarray]
"""Of bench, case, window and law: a value of each member."""


def values(quantity: str, *entries: str, family: str = "crank", factor: float = 1.0) -> Quantity:
    """A stored quantity; of several entries the root of the sum of their squares."""

    def of(bench: Bench, case: str, window: str, law: str) -> np.ndarray:
        parts = [bench.values(family, case, window, law, quantity, entry) for entry in entries or (None,)]
        return np.asarray(factor * (np.sqrt(np.sum(np.square(parts), axis=0)) if len(parts) > 1 else parts[0]))

    return of


def measured(name: str, measure: Callable[[np.ndarray], np.ndarray]) -> Quantity:
    """A measure of a series, member × sample."""
    return lambda bench, case, window, law: np.asarray(measure(bench.series("crank", case, window, law, name)))


def draw(caption: str, panel: Callable[[str], Panel], height: float = 3.9) -> Figure:
    """Draws a figure once for each law."""
    images: dict[str, bytes | str] = {}
    for law in LAWS:
        try:
            images[law] = png(panel(law), height)
        except (slideway.SlidewayError, Missing) as error:
            images[law] = str(error)
    return Figure(caption, images)


def wide_range(values: np.ndarray) -> bool:
    """Whether there are more than two decades to show, for which an axis should be logarithmic."""
    return bool(values.size and values.max() > 100 * values.min())
