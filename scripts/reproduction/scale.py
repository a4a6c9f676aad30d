"""How large the reproduction is."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Scale:
    """Members and lengths of the runs.

    Attributes:
        members: starts of each case of the slider-crank.
        carriages: starts of each case of the experiment.
        dense_members: members of the runs that are sampled densely (spectra, forces by mode).
        dense_samples, dense_revolutions: samples of a revolution (of the carriage: of 0.1 s), and how many there are.
        crank_samples, carriage_samples: samples of a revolution and of a way there and back.
        revolutions, carriage_revolutions: of each mechanism, from its start and again when it has settled.
        maps, map_transient, map_revolutions: members and revolutions of the maps; the paper records 150.
        exponents, exponent_transient, exponent_revolutions, exponent_history: members, revolutions and points of the history of
            the exponents by neighbours.
        series, series_revolutions, series_samples: members and revolutions of the series that the small-data-sets method takes,
            and their samples a revolution.
        verified: members of the slider-cranks' and carriages' runs that run again, to check the others; None: what the program does unasked.
    """

    members: int
    carriages: int
    dense_members: int
    dense_samples: int
    dense_revolutions: float
    crank_samples: int
    carriage_samples: int
    carriage_revolutions: float
    revolutions: float
    maps: int
    map_transient: float
    map_revolutions: float
    exponents: int
    exponent_transient: float
    exponent_revolutions: float
    exponent_history: int
    series: int
    series_revolutions: float
    series_samples: int
    verified: int | None = None


FULL = Scale(members=64, carriages=48, dense_members=8, dense_samples=20000, dense_revolutions=1, crank_samples=1000, carriage_samples=4000,
             carriage_revolutions=1, revolutions=2, maps=8, map_transient=20, map_revolutions=150, exponents=32, exponent_transient=2,
             exponent_revolutions=8, exponent_history=100, series=8, series_revolutions=30, series_samples=200, verified=64)  # fmt: skip
# Seconds in all: every run and every judgement is there, and no number means anything.
TINY = Scale(members=3, carriages=2, dense_members=2, dense_samples=20000, dense_revolutions=0.02, crank_samples=4000, carriage_samples=10000,
             carriage_revolutions=0.01, revolutions=0.02, maps=2, map_transient=0, map_revolutions=10, exponents=2, exponent_transient=0,
             exponent_revolutions=0.02, exponent_history=10, series=2, series_revolutions=2, series_samples=100)  # fmt: skip
SCALES = {"full": FULL, "tiny": TINY}
