"""How large a result is, said before anything of it is read, and the part of it that somebody has chosen."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import warnings
from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import arguments, netcdf
from .errors import SlidewayError

if TYPE_CHECKING:
    import netCDF4

largest_unsaid = 1 << 32  # bytes of a file that is read as a whole without a word
largest_labels = 1 << 30  # bytes of labels, which are read when a result is opened
_block = 1 << 22  # entries that are read at a time


@dataclass(frozen=True)
class Size:
    """What a file holds."""

    members: int
    variables: int
    numbers: int  # bytes of them
    labels: int  # bytes of those that lie along members and sections


def size_of(file: netCDF4.Dataset) -> Size:
    """The size of an opened result; nothing of it is read."""
    columns = file.variables
    labels = sum(netcdf.bytes_of(columns[name]) for name in ("member", "section_count") if name in columns)
    if "section" in file.dimensions:
        labels += 4 * len(file.dimensions["section"])  # the member of each
    members = len(file.dimensions["member"]) if "member" in file.dimensions else 0
    return Size(members, len(columns), sum(map(netcdf.bytes_of, columns.values())), labels)


def in_words(count: float) -> str:
    """Bytes as people say them.

    >>> in_words(1e9 * 312), in_words(4100)
    ('312 GB', '4.1 kB')
    """
    for unit in ("B", "kB", "MB", "GB", "TB"):
        if count < 1000 or unit == "TB":
            break
        count /= 1000
    return f"{count:.3g} {unit}"


def require_choice(name: str, size: Size) -> None:
    """Refuses a result whose labels alone are too many to be read unasked."""
    if size.labels > largest_labels:
        raise SlidewayError(
            f"{name}: holds {size.members:,} members, {in_words(size.numbers)} of numbers in {size.variables} variables, and to open it reads "
            f'{in_words(size.labels)} of their labels; choose what you need: variables=["peak_normal_force"], members=(0, 999999), or a group'
        )


def require_choice_before_check(name: str) -> None:
    """The same before a large file is read for damage. Damaged files end processes, so that another one looks at it."""
    if os.path.getsize(name) <= largest_unsaid:
        return
    look = "import sys; from slideway.sizes import tell; tell(sys.argv[1])"
    done = subprocess.run([sys.executable, "-c", look, name], capture_output=True, text=True, check=False)
    if done.returncode == 0:  # else the search for damage says what is wrong
        require_choice(name, Size(**json.loads(done.stdout)))


def tell(name: str) -> None:
    """Prints the size of a file, for another process."""
    with netcdf.opened(name) as file:
        print(json.dumps(asdict(size_of(file))))


def say_before_check(name: str, stacklevel: int) -> None:
    """Says of a large file that all of it is going to be read."""
    size = os.path.getsize(name)
    if size > largest_unsaid:
        line = f"{name}: has {in_words(size)}, all of which is read now to look for damage; check=False leaves that out"
        warnings.warn(line, stacklevel=stacklevel + 1)


def with_labels(file: netCDF4.Dataset, names: Sequence[str]) -> frozenset[str]:
    """Variables of a result, and those that say which members, samples and entries their values are of."""
    if isinstance(names, str) or not isinstance(names, Sequence):
        raise SlidewayError(f'variables is {arguments.shown(names)}; give a list of names: ["peak_normal_force"]')
    variables = netcdf.variables_of(file)
    for name in names:
        if arguments.text(name, "a name in variables") not in variables:
            there = ", ".join(variables)
            raise SlidewayError(f'there is no variable "{name}" in this result; it has {arguments.shortened(there, 300)}')
    dimensions = {dimension for name in names for dimension in variables[name].dimensions}
    labels = {label for dimension in dimensions for label in (dimension, f"{dimension}_name")}
    labels |= {"time", "turned"} & set(variables) if "sample" in dimensions else set()
    labels |= {"section_count", "member"} if "section" in dimensions else set()
    return frozenset(names) | labels


def rows_of(file: netCDF4.Dataset, members: Any) -> dict[str, slice]:
    """Where members, from the first to the last that are asked for, and their sections lie in a file."""
    if not isinstance(members, (tuple, list)) or len(members) != 2:
        raise SlidewayError(f"members is {arguments.shown(members)}; give the first and the last: (0, 999)")
    first, last = (arguments.whole(number, "members", 0) for number in members)
    if "member" not in file.variables:
        raise SlidewayError('this result holds no members, for its scene says study.store = "statistics"; open its group statistics')
    stored = _Column(file.variables["member"])
    rows = slice(bisect_left(stored, first), bisect_left(stored, last + 1))
    if rows.start >= rows.stop:
        raise SlidewayError(f"there is no member from {first} to {last} in this result")
    found = {"member": rows}
    if "section_count" in file.variables:
        counts = file.variables["section_count"]
        start = _total(counts, 0, rows.start)
        found["section"] = slice(start, start + _total(counts, rows.start, rows.stop))
    return found


class _Column(Sequence[int]):
    """Numbers of members, which ascend, read one by one."""

    def __init__(self, variable: netCDF4.Variable) -> None:
        self._variable = variable

    def __len__(self) -> int:
        return len(self._variable)

    def __getitem__(self, place: Any) -> Any:
        return int(self._variable[place])


def _total(counts: netCDF4.Variable, start: int, stop: int) -> int:
    return sum(int(np.sum(counts[at : min(at + _block, stop)], dtype=np.int64)) for at in range(start, stop, _block))
