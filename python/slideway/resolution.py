"""What a run says of its own numbers: how large their integration error may be."""

from __future__ import annotations

from dataclasses import dataclass, field

import xarray as xr

from .arguments import one_line
from .results import StrPath, file_of, groups
from .results import open as open_result

VERDICTS = ("resolved", "error_bounded", "undecided", "not_resolved")
"""Of a number, the best first; of a result also ``not_checked``."""


@dataclass(frozen=True)
class Resolution:
    """What the check of a result's resolution says.

    Attributes:
        verdict: over all numbers: one of :data:`VERDICTS`, or "not_checked".
        summary: the program's own words, in lines.
        numbers: a Dataset along ``members_of`` (all members, those of a column of a sweep, those that share a value of a list) and
            ``checked`` (the number, with its unit): ``number``, ``number_half_width``, ``number_sd``, ``difference`` (check less study),
            ``error_bound``, ``margin``, ``pairs``, ``cut``, ``verdict`` (a word of :data:`VERDICTS`). Empty where nothing was checked.
    """

    verdict: str
    summary: str
    numbers: xr.Dataset = field(default_factory=xr.Dataset, repr=False)

    def __bool__(self) -> bool:
        """Whether every number is resolved, but those that are 0 in all members."""
        return self.verdict == "resolved"


@one_line
def resolution(result: StrPath | xr.Dataset) -> Resolution | None:
    """Whether a result's numbers are the equations' or the integration's, as the run has found out.

    Returns:
        None where it was not asked: of shards that were merged before all members had run.

    >>> found = slideway.resolution(example_file)
    >>> found.verdict, bool(found)
    ('not_checked', False)
    """
    if "verification" not in groups(result):
        return None
    with open_result(file_of(result), group="verification", check=False) as group:
        numbers = xr.Dataset()
        if "verdict" in group:
            names = ["number", "number_half_width", "number_sd", "difference", "error_bound", "margin", "pairs", "cut", "verdict"]
            numbers = group[[name for name in names if name in group]].load()
            words = numbers["verdict"].astype(int).values
            numbers["verdict"] = numbers["verdict"].dims, [[VERDICTS[word] for word in row] for row in words]
        return Resolution(str(group.attrs["resolution"]), str(group.attrs["summary"]), numbers)
