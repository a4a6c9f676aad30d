"""Running scenes."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import xarray as xr

from .errors import SlidewayError
from .program import Interrupted, call, error_of, find_program, follow, temporary_file
from .results import StrPath, path_of
from .results import open as open_result
from .toml_writer import to_toml, to_value


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
    max_hours: float | None = None,
    max_failures: int | str | None = None,
    members: int | tuple[int, int] | None = None,
    **overrides: Any,
) -> xr.Dataset:
    """Run a scene and open its result.

    Args:
        scene: path of a TOML file, or the scene as nested dictionaries.
        output: the result file; left out: a temporary one, which is gone when Python ends.
        program: path of the program; left out: SLIDEWAY_PROGRAM, else the PATH.
        threads: left out: all that this process may use.
        backend: "auto", "cpu" or "cuda".
        isa: "auto", or one of the instruction sets that ``slideway list`` names.
        progress: pass on what the program says of its progress, to stderr; warnings are passed on in any case.
        set: dotted keys and their values, in place of those of the scene: ``{"joint.clearance": "0.2 mm"}``.
        resume: go on with what an earlier run has left beside `output`.
        max_hours: stop after this time and keep what is finished.
        max_failures: members that may fail, a number or a share such as "5%" (the program's default: "1%").
        members: run this member alone, or these: (first, last).
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
    found = find_program(program)
    path = _scene_file(scene)
    result = temporary_file(_stem(path) + ".nc") if output is None else os.fspath(output)
    command = [found, "run", path, "-o", result]
    for key, value in _all_overrides(set, overrides).items():
        command += ["--set", f"{key}={to_value(value, key)}"]
    for option, given in (("--threads", threads), ("--backend", backend), ("--isa", isa), ("--max-hours", max_hours),
                          ("--max-failures", max_failures)):
        if given is not None:
            command += [option, str(given)]
    if members is not None:
        command += ["--member", str(members)] if isinstance(members, int) else ["--members", f"{members[0]}..{members[1]}"]
    command += ["--resume"] * resume + ["--quiet"] * (not progress)
    try:
        code, line = follow(command, show=progress)
    except Interrupted as stopped:
        # Code 0: the run was at its end already.
        raise KeyboardInterrupt from error_of(stopped.code, stopped.line, result, found) if stopped.code != 0 else None
    if code != 0:
        raise error_of(code, line, result, found)
    return open_result(result)


def info(result: StrPath | xr.Dataset, program: StrPath | None = None) -> str:
    """What `slideway info` says of a result: provenance, statuses, statistics.

    >>> print(slideway.info(example_file).splitlines()[0])
    file ...ensemble.nc
    """
    return call(program, ["info", path_of(result) if isinstance(result, xr.Dataset) else os.fspath(result)])


def _scene_file(scene: StrPath | Mapping[str, Any]) -> str:
    if not isinstance(scene, Mapping):
        return os.fspath(scene)
    study = scene.get("study")
    if isinstance(study, Mapping) and "table" in study:
        # The program looks for a table beside the scene, and this one lies in a temporary folder.
        scene = {**scene, "study": {**study, "table": os.path.abspath(study["table"])}}
    path = temporary_file("scene.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(to_toml(scene))
    return path


def _stem(path: str) -> str:
    return os.path.splitext(os.path.basename(path))[0]


def _all_overrides(given: Mapping[str, Any] | None, words: Mapping[str, Any]) -> dict[str, Any]:
    named = dict(given or {})
    for word, value in words.items():
        if "__" not in word:
            raise SlidewayError(f"run() has no argument {word}; keys of the scene have two underscores, as in study__members=64")
        named[word.replace("__", ".")] = value
    return named
