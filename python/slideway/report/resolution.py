"""Whether a study's numbers are the equations' or the integration's, in the words and the colour of the page."""

from __future__ import annotations

from dataclasses import dataclass

import xarray as xr

import slideway

GRADES = {"resolved": "good", "error_bounded": "none", "undecided": "none", "not_resolved": "bad", "not_checked": "none"}
HEADLINES = {
    "resolved": "Resolved: the integration error is below the study's own intervals",
    "error_bounded": "Integration error bounded: larger than the study's own intervals may be",
    "undecided": "Resolution undecided: too few members ran again, some did not come to their end, or all numbers are 0",
    "not_resolved": "Not resolved: tighter tolerances say something else",
    "not_checked": "Not checked against tighter tolerances",
}


@dataclass(frozen=True)
class Resolution:
    """What the check of a result says, for the page.

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
    found = slideway.resolution(result)
    if found is None:
        return None
    lines = tuple(line.strip() for line in found.summary.splitlines())
    return Resolution(GRADES.get(found.verdict, "none"), HEADLINES.get(found.verdict, found.verdict), lines)
