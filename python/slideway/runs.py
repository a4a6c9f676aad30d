"""Running scenes."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Mapping, Sequence
from typing import Any

import xarray as xr

from . import arguments
from .ensemble import Ensemble, is_available
from .errors import SlidewayError, TooManyFailures
from .keys import nearest_key
from .members import counts
from .program import Interrupted, call, error_of, find_program, follow
from .results import StrPath, file_of, open_temporary
from .results import open as open_result
from .scene_files import scene_file
from .temporary import TemporaryPath, temporary_path
from .toml_writer import to_value


_largest_in_memory = 1 << 28  # bytes


def run(
    scene: StrPath | Mapping[str, Any],
    output: StrPath | None = None,
    *,
    program: StrPath | None = None,
    threads: int | None = None,
    backend: str | None = None,
    isa: str | None = None,
    progress: bool = True,
    set: Mapping[str, Any] | None = None,  # noqa: A002 (named as the program's --set)
    resume: bool = False,
    force: bool = False,
    max_hours: float | None = None,
    max_failures: int | str | None = None,
    members: int | tuple[int, int] | None = None,
    any_start: bool = False,
    **overrides: Any,
) -> xr.Dataset:
    """Run a scene and open its result.

    Without `output` a run of moderate size takes place in this process (:class:`Ensemble`), unless an argument or SLIDEWAY_PROGRAM
    asks for the program. The numbers and errors are the same.

    Args:
        scene: path of a TOML file, or the scene as nested dictionaries.
        output: the result file; left out: the result is in memory, or in a temporary file, which is gone once the Dataset is
            closed, or neither it nor anything selected from it is used any more.
        program: path of the program; left out: SLIDEWAY_PROGRAM, else the PATH.
        threads: left out: all that this process may use.
        backend: "auto", "cpu" or "cuda".
        isa: "auto", or one of the instruction sets that ``slideway list`` names.
        progress: pass on what the program says of its progress, to stderr; warnings are passed on in any case.
        set: dotted keys and their values, in place of those of the scene: ``{"joint.clearance": "0.2 mm"}``;
            :func:`slideway.keys` has all of them, with unit, domain and default.
        resume: go on with what an earlier run has left beside `output`.
        force: replace a result of slideway that is there already; any other file is left, and a FileError says so.
        max_hours: stop after this time and keep what is finished.
        max_failures: members that may fail, a number or a share such as "5%" (the program's default: "1%").
        members: run this member alone, or these: (first, last).
        any_start: take starts that no mechanism has, such as inside the way.
        **overrides: the same as `set`, with two underscores for the dot: ``study__members=64``.

    Returns:
        The result, as :func:`slideway.open` gives it.

    Raises:
        SceneError: the scene or an option is wrong (exit code 2).
        TooManyFailures: more members failed than may (3); its attribute `dataset` is the result, with all members.
        FileError: a file could not be read or written (4).
        StoppedEarly: stopped by `max_hours` or a signal (5); its attribute `dataset` holds the members that ended before.
        RunError: any other end; all of these have `code` and `line`.
        KeyboardInterrupt: Ctrl-C; the program was stopped cleanly, and `__cause__` is the StoppedEarly.
        SlidewayError: the program was not found, or an override is no key.

    >>> result = slideway.run({"schema": 1, "study": {"kind": "ensemble", "quantities": ["peak_tilt"]}},
    ...                       study__members=4, study__duration="1 ms", progress=False)
    >>> result.peak_tilt.dims
    ('member', 'axis')
    """
    if output is None and not (program or os.environ.get("SLIDEWAY_PROGRAM") or backend or resume or max_hours or members is not None):
        computed = _in_memory(scene, threads, isa, progress, any_start, _all_overrides(set, overrides, None), max_failures)
        if computed is not None:
            return computed
    options = _options(threads, backend, isa, max_hours, max_failures, members)
    options += ["--resume"] * bool(resume) + ["--force"] * bool(force) + ["--any-start"] * bool(any_start)
    result = run_command(scene, None if output is None else arguments.path(output, "output"), program, options, bool(progress), set, overrides)
    return open_temporary(result) if isinstance(result, TemporaryPath) else open_result(result, check=False)


def run_command(
    scene: StrPath | Mapping[str, Any],
    output: str | None,
    program: StrPath | None,
    options: Sequence[str],
    progress: bool,
    given: Mapping[str, Any] | None,
    words: Mapping[str, Any],
) -> str:
    """Calls ``slideway run``, and returns the name of its result; without `output` it is a temporary one.

    Raises:
        RunError: it failed.
    """
    found = find_program(program)
    settings = [word for key, value in _all_overrides(given, words, found).items() for word in ("--set", f"{key}={to_value(value, key)}")]
    with scene_file(scene) as file:
        result = temporary_path(_stem(file.path) + ".nc") if output is None else output
        line_of_command = [found, "run", file.path, "-o", result, *options, *settings, *["--quiet"] * (not progress)]
        try:
            code, line = follow(line_of_command, progress, file.said)
        except Interrupted as stopped:
            # Code 0: the run was at its end already.
            raise KeyboardInterrupt from error_of(stopped.code, stopped.line, result, found) if stopped.code != 0 else None
    if code != 0:
        raise error_of(code, line, result, found)
    return result


def info(result: StrPath | xr.Dataset, program: StrPath | None = None) -> str:
    """What `slideway info` says of a result: provenance, statuses, statistics.

    Args:
        result: a Dataset of slideway.open or slideway.run, of whose whole file it speaks, or the path of the file.
        program: path of the program; left out: SLIDEWAY_PROGRAM, else the PATH.

    Raises:
        FileError: the file cannot be read.

    >>> print(slideway.info(example_file).splitlines()[0])
    file ...ensemble.nc
    """
    return call(program, ["info", file_of(result)])


def _in_memory(
    scene: StrPath | Mapping[str, Any],
    threads: int | None,
    isa: str | None,
    progress: bool,
    any_start: bool,
    overrides: Mapping[str, Any],
    max_failures: int | str | None,
) -> xr.Dataset | None:
    """The result of a run in this process; None where the package has no module for it, or the result is too large."""
    limit = str("1%" if max_failures is None else max_failures)
    if not is_available() or not re.fullmatch(r"\d+(\.\d+%|%)?", limit):
        return None  # the program says what is wrong
    ensemble = Ensemble(scene, threads=threads, isa=isa or "auto", verify=True, set=overrides)
    if ensemble.result_bytes > _largest_in_memory:
        return None
    for warning in ensemble.warnings_before_run(of_starts=any_start):
        print(f"warning: {warning}", file=sys.stderr, flush=True)
    computed = ensemble.run(progress=bool(progress), any_start=any_start)
    ended = counts(computed)
    all_members = ended.total()
    failed = all_members - ended["finished"]
    share = limit.endswith("%")
    if failed > float(limit.rstrip("%")) * (all_members / 100 if share else 1):
        raise TooManyFailures(3, f"slideway: {failed} of {all_members} members failed, more than --max-failures {limit}", "", computed)
    return computed


def _options(
    threads: int | None, backend: str | None, isa: str | None, max_hours: float | None, max_failures: int | str | None, members: int | tuple[int, int] | None
) -> list[str]:
    """The options of the command line for arguments that Python can tell to be wrong, as their types."""
    given: dict[str, str] = {}
    if threads is not None:
        given["--threads"] = str(arguments.whole(threads, "threads", 1))
    if backend is not None:
        given["--backend"] = arguments.text(backend, "backend")
    if isa is not None:
        given["--isa"] = arguments.text(isa, "isa")
    if max_hours is not None:
        given["--max-hours"] = str(arguments.positive(max_hours, "max_hours"))
    if max_failures is not None:
        share = isinstance(max_failures, str)
        given["--max-failures"] = str(max_failures if share else arguments.whole(max_failures, "max_failures", 0))
    if isinstance(members, (tuple, list)):
        if len(members) != 2:
            raise SlidewayError(f"members is {arguments.shown(members)}; give one number, or the first and the last: (0, 15)")
        first, last = (arguments.whole(number, "members", 0) for number in members)
        given["--members"] = f"{first}..{last}"
    elif members is not None:
        given["--member"] = str(arguments.whole(members, "members", 0))
    return [word for option in given.items() for word in option]


def _stem(path: str) -> str:
    return os.path.splitext(os.path.basename(path))[0]


def _all_overrides(given: Mapping[str, Any] | None, words: Mapping[str, Any], program: str | None) -> dict[str, Any]:
    def unknown(word: str) -> str:
        hint = nearest_key(word, program) or "; keys of the scene have two underscores, as in study__members=64 (slideway.keys() has all)"
        return f"run() has no argument {word}{hint}"

    return arguments.overrides(given, words, unknown)
