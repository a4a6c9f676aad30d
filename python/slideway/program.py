"""The program slideway: where it is, and how it is called."""

from __future__ import annotations

import contextlib
import ctypes
import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from .arguments import path
from .errors import FileError, RunError, SceneError, SlidewayError, StoppedEarly, TooManyFailures

if TYPE_CHECKING:
    from .results import StrPath

_set_parent_death_signal = 1  # PR_SET_PDEATHSIG of prctl(2)
_patience = 30.0  # until a program that was asked to end is made to [s]


def find_program(program: StrPath | None = None) -> str:
    """Where the program is: the argument, else the environment variable SLIDEWAY_PROGRAM, else in the package, else on the PATH.

    Raises:
        SlidewayError: it is in none of these places.

    >>> find_program("/nowhere/slideway")
    Traceback (most recent call last):
    slideway.errors.SlidewayError: /nowhere/slideway: is no program that can be run; give the path of the program slideway
    """
    for given in (program, os.environ.get("SLIDEWAY_PROGRAM")):
        if given:
            name = path(given, "program")
            found = shutil.which(name)
            if not found:
                raise SlidewayError(f"{name}: is no program that can be run; give the path of the program slideway")
            return found
    found = _packaged() or shutil.which("slideway")
    if not found:
        raise SlidewayError(
            "the program slideway was not found; install the package with pip install ., or build it (scripts/demo.sh does) and set SLIDEWAY_PROGRAM to its path, give "
            "program=..., or put its folder on the PATH"
        )
    return found


def _packaged() -> str | None:
    """The program that a wheel brings."""
    return shutil.which(os.path.join(os.path.dirname(__file__), "bin", "slideway"))


def shards_of(output: str) -> str:
    """The folder of a result's shards: beside what a link to the result leads to, unless they were made before there was a link."""
    return output + ".shards" if os.path.isdir(output + ".shards") else os.path.realpath(output) + ".shards"


def call(program: StrPath | None, arguments: Sequence[str], good: Sequence[int] = (0,), written: Callable[[str], str] = str) -> str:
    """Calls a command that is soon done.

    Args:
        good: exit codes that are no error.
        written: makes of a line that it says what the user reads.

    Returns:
        What it wrote to stdout.

    Raises:
        RunError: it failed; the text is its own last line.
    """
    found = find_program(program)
    done = _started(subprocess.run, [found, *arguments], capture_output=True, text=True, encoding="utf-8", check=False)
    if done.returncode not in good:
        error = error_of(done.returncode, written(_last_line(done.stderr.splitlines())), "", found)
        error.stderr = done.stderr
        raise error
    return str(done.stdout)


def follow(command: Sequence[str], show: bool, written: Callable[[str], str] = str) -> tuple[int, str]:
    """Runs a command to its end and shows what it says on stderr, line by line; without `show` its warnings alone.

    Each line is put as `written` has it.

    Ctrl-C asks the command to stop, waits until it has written what it has, and is then raised again; a second Ctrl-C does
    not wait. Any other exception, such as one that a handler of SIGTERM raises, ends it in the same way, and so does the end of
    Python itself (on Linux), whatever ended it.

    Returns:
        The exit code, and the last line on stderr.
    """
    # In a process group of its own: a terminal's Ctrl-C reaches Python alone, which passes it on once.
    # SIGPIPE stays ignored: once Python is gone nobody reads stderr, and what is finished has to be written all the same.
    process = _started(
        subprocess.Popen, command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, encoding="utf-8",
        errors="replace", start_new_session=True, restore_signals=False, preexec_fn=_end_with_python(),
    )
    lines: list[str] = []
    interrupt: KeyboardInterrupt | None = None
    try:
        while True:
            try:
                _pass_on(process, lines, show, written)
                code = process.wait()
                break
            except KeyboardInterrupt as error:
                if interrupt is not None:
                    process.kill()
                    raise
                interrupt = error
                process.send_signal(signal.SIGINT)
    finally:
        _end(process)
        if process.stderr is not None:
            process.stderr.close()
    if interrupt is not None:
        raise Interrupted(code, _last_line(lines)) from interrupt
    return code, _last_line(lines)


def _started(start: Callable[..., Any], command: Sequence[str], **options: Any) -> Any:
    """Starts a process, or says why its program does not run."""
    try:
        return start(command, **options)
    except OSError as error:
        why = error.strerror or error
        raise SlidewayError(f"{command[0]}: cannot be run ({why}); give the path of the program slideway") from error


class Interrupted(Exception):
    """A run that Ctrl-C ended, with its exit code and last line."""

    def __init__(self, code: int, line: str) -> None:
        super().__init__(line)
        self.code = code
        self.line = line


def error_of(code: int, line: str, output: str, program: str) -> RunError:
    """The exception for an exit code other than 0."""
    if code == 2:
        return SceneError(code, line)
    if code == 3:
        return TooManyFailures(code, line, output)
    if code == 4:
        return FileError(code, line)
    if code == 5:
        return StoppedEarly(code, line, output, program)
    if code < 0:
        return RunError(code, f"slideway was ended by {signal.Signals(-code).name}; what it had finished can be resumed")
    return RunError(code, line or f"slideway ended with exit code {code} and said nothing")


def _end_with_python() -> Callable[[], None] | None:
    """What the new process calls before it becomes the program, so that it gets SIGTERM when Python ends; None where Linux is not there.

    All that it needs is loaded here: between fork and exec another thread's locks may be held for ever.
    """
    if not sys.platform.startswith("linux"):
        return None
    try:
        prctl = ctypes.CDLL(None).prctl
    except (OSError, AttributeError):
        return None
    python, get_parent, leave, request, end = os.getpid(), os.getppid, os._exit, _set_parent_death_signal, int(signal.SIGTERM)

    def ask() -> None:
        prctl(request, end, 0, 0, 0)
        if get_parent() != python:  # Python ended before it could be asked for
            leave(128 + end)

    return ask


def _end(process: subprocess.Popen[str]) -> None:
    """Asks a process that still runs to end, and makes it when it does not."""
    if process.poll() is None:
        process.terminate()
        try:
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(_patience)
        finally:
            process.kill()
            process.wait()


def _pass_on(process: subprocess.Popen[str], lines: list[str], show: bool, written: Callable[[str], str]) -> None:
    assert process.stderr is not None
    for line in process.stderr:
        lines.append(written(line.rstrip("\n")))
        del lines[:-20]
        if show or lines[-1].startswith("warning: "):
            print(lines[-1], file=sys.stderr, flush=True)


def _last_line(lines: Sequence[str]) -> str:
    return next((line.strip() for line in reversed(lines) if line.strip()), "")
