"""A study in parts, each run by a process of its own, and the one result that they make."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import xarray as xr

from . import arguments
from .errors import FileError, RunError, SlidewayError
from .program import call, error_of, find_program, shards_of
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
    any_start: bool = False,
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
        any_start: take starts that no mechanism has, such as inside the way.
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
    options += ["--any-start"] * bool(any_start)
    run_command(scene, arguments.path(output, "output"), None, options, False, set, overrides)


def merge(output: StrPath, *, force: bool = False) -> xr.Dataset:
    """Make one result of the parts that have run, and open it. Its numbers and its payload hash are those of an undivided run.

    Args:
        output: as of :func:`slideway.run_part`. The shards stay. What looks whether they are still needed is the program: the last line that
            ``slideway merge OUTPUT.shards -o COPY.nc`` prints says it.
        force: replace a result of slideway that is there already. It is replaced by one of all members, or left as it is.

    Raises:
        SlidewayError: there are no shards of that name.
        FileError: there is an `output`, and it may not be replaced, or the file cannot be written.
        StoppedEarly: some members have not run, or a signal came; `dataset` of the error holds those that have run, and `output` is as
            it was.

    >>> import tempfile
    >>> scene = {"schema": 1, "study": {"kind": "ensemble", "members": 4, "duration": "1 ms", "quantities": ["peak_tilt"]}}
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     for part in (1, 2):
    ...         slideway.run_part(scene, folder + "/out.nc", part, 2)
    ...     slideway.merge(folder + "/out.nc").sizes["member"]
    4
    """
    name = arguments.path(output, "output")
    shards = shards_of(name)
    if not os.path.isdir(shards):
        raise SlidewayError(f"{name}.shards: there is no such folder; run the parts of this output first")
    found = find_program()
    with _beside(name) as made:
        try:
            call(found, ["merge", shards, "-o", made, *(["--force"] if force else [])])
        except RunError as error:
            raise error_of(error.code, error.line.replace(made, name), name, found) from None
    return open_result(name, check=False)


@contextmanager
def _beside(output: str) -> Iterator[str]:
    """A name for a file that takes the place of `output` when the block ends without an error, in a folder of its own.

    The program finds there what it would find beside `output`, and says the same of it: the file, and the folder of shards, in which others may
    be at work.
    """
    place = os.path.realpath(output)
    if os.path.lexists(place) and not os.path.isfile(place):
        raise FileError(4, f"{output}: is no file; give another name")
    replaces = os.path.exists(place)
    try:
        with tempfile.TemporaryDirectory(prefix=".slideway_", dir=os.path.dirname(place), ignore_cleanup_errors=True) as folder:
            made = os.path.join(folder, os.path.basename(place))
            os.symlink(os.path.realpath(shards_of(output)), made + ".shards")
            if replaces:
                _link(place, made)
            yield made
            if not replaces and os.path.lexists(place):
                raise FileError(4, f"{output}: came there meanwhile; give force=True to replace it, or another name")
            _put(made, place)
    except OSError as error:
        raise FileError(4, f"{output}: cannot be written: {error.strerror}") from error


def _link(file: str, other: str) -> None:
    try:
        os.link(file, other)
    except OSError:  # not everywhere, nor of a file of somebody else
        shutil.copyfile(file, other)


def _put(made: str, place: str) -> None:
    """In its place on the disk, too, when this returns: the shards may be gone soon after."""
    os.replace(made, place)
    folder = os.open(os.path.dirname(place), os.O_RDONLY)
    try:
        os.fsync(folder)
    finally:
        os.close(folder)
