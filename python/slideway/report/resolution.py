"""Whether a study's numbers are the equations' or the integration's, as the run has found out."""

from __future__ import annotations

from dataclasses import dataclass

import xarray as xr

import slideway

GRADES = {"resolved": "good", "not_resolved": "bad", "not_checked": "none"}
HEADLINES = {
    "resolved": "Resolved: tighter tolerances say the same",
    "not_resolved": "Not resolved: tighter tolerances say something else",
    "not_checked": "Not checked against tighter tolerances",
}


@dataclass(frozen=True)
class Resolution:
    """What the group `verification` of a result says.

    Attributes:
        grade: of the page's style: good, bad or none.
        headline: in a few words.
        lines: the program's own words.
    """

    grade: str
    headline: str
    lines: tuple[str, ...]


def resolution(result: xr.Dataset) -> Resolution | None:
    """Of a result of slideway run; None where it was not asked (merged shards, results of earlier versions)."""
    if "verification" not in slideway.groups(result):
        return None
    with slideway.open(slideway.results.path_of(result), group="verification") as group:
        kind, summary = str(group.attrs["resolution"]), str(group.attrs["summary"])
    return Resolution(GRADES.get(kind, "none"), HEADLINES.get(kind, kind), tuple(line.strip() for line in summary.splitlines()))
