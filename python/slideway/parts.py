"""A study in parts, each run by a process of its own, and the one result that they make."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import xarray as xr

from . import arguments
from .errors import SlidewayError, StoppedEarly
from .program import call, find_program
from .results import StrPath
from .results import open as open_result
from .runs import run_command


def run_part(
    scene: StrPath | Mapping[str, Any],
    output: StrPath,
    part: int,
    parts: int,
    *,
    threads: int = 1,
    set: Mapping[str, Any] | None = None,  # noqa: A002 (named as the program's --set)
    **overrides: Any,
) -> None:
    """Run one part of a study, for :func:`slideway.merge`. Parts may run at once, in any processes and on any machines that share the folder.

    Args:
        scene: path of a TOML file, or the scene as nested dictionaries; the same for all parts, as are `output`, `set` and overrides.
        output: the result file that the parts are for. They share the folder ``OUTPUT.shards``.
        part: the number of this part, from 1 on.
        parts: how many there are. Parts are consecutive members.
        threads: of this part; the cores over the number of parts that run at once.
        set: dotted keys and their values, in place of those of the scene.
        **overrides: the same as `set`, with two underscores for the dot: ``study__members=64``.

    Raises:
        RunError: as of :func:`slideway.run`.

    >>> slideway.run_part({"schema": 1}, "out.nc", 3, parts=2)
    Traceback (most recent call last):
    slideway.errors.SlidewayError: part is 3; give a whole number from 1 to 2
    """
    count = arguments.whole(parts, "parts", 1)
    options = ["--shard", f"{arguments.whole(part, 'part', 1, count)}/{count}", "--threads", str(arguments.whole(threads, "threads", 1))]
    run_command(scene, arguments.path(output, "output"), None, options, False, set, overrides)


def merge(output: StrPath, *, force: bool = False) -> xr.Dataset:
    """Make one result of the parts that have run, and open it. Its numbers and its payload hash are those of an undivided run.

    Args:
        output: as of :func:`slideway.run_part`. The shards stay; remove the folder when they are no longer needed.
        force: replace a result of slideway that is there already.

    Raises:
        SlidewayError: there are no shards of that name.
        StoppedEarly: some members have not run; `dataset` of the error holds those that have, and there is no `output`.

    >>> import tempfile
    >>> scene = {"schema": 1, "study": {"kind": "ensemble", "members": 4, "duration": "1 ms", "quantities": ["peak_tilt"]}}
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     for part in (1, 2):
    ...         slideway.run_part(scene, folder + "/out.nc", part, 2)
    ...     slideway.merge(folder + "/out.nc").sizes["member"]
    4
    """
    name = arguments.path(output, "output")
    if not os.path.isdir(name + ".shards"):
        raise SlidewayError(f"{name}.shards: there is no such folder; run the parts of this output first")
    found = find_program()
    try:
        call(found, ["merge", name + ".shards", "-o", name, *(["--force"] if force else [])])
    except StoppedEarly as error:
        os.remove(name)  # which would be in the way of the other parts
        raise StoppedEarly(error.code, f"{name}: some members have not run; run the other parts, and merge again", name, found) from error
    return open_result(name, check=False)
