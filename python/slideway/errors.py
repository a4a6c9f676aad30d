"""What goes wrong: one family of exceptions, each with one line that says what is wrong and what to do."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import xarray as xr


class SlidewayError(Exception):
    """Whatever slideway cannot do: its text is one line that says what is wrong and what to do.

    >>> try:
    ...     slideway.open("nowhere.nc")
    ... except slideway.SlidewayError as error:
    ...     print(error)
    nowhere.nc: there is no such file; check the path
    """

    def __init__(self, line: str = "") -> None:
        super().__init__(" ".join(line.splitlines()))  # names of files and keys may hold line breaks

    def __reduce__(self) -> tuple[Any, ...]:
        # Exceptions go to other processes by the arguments that they were made of, which differ in number here.
        return _restored, (type(self), self.args, self.__dict__)


def _restored(kind: type[SlidewayError], arguments: tuple[Any, ...], attributes: dict[str, Any]) -> SlidewayError:
    error = kind.__new__(kind, *arguments)
    error.__dict__.update(attributes)
    return error


class RunError(SlidewayError):
    """The program ended with an error.

    Attributes:
        code: its exit code; negative: the signal that ended it.
        line: the last line that it wrote to stderr, which says why.
        stderr: all that a command wrote there which is soon done: of :func:`slideway.compile` the compiler's words.
    """

    stderr: str = ""

    def __init__(self, code: int, line: str) -> None:
        super().__init__(line)
        self.code = code
        self.line = line


class SceneError(RunError):
    """The scene or an option is wrong (exit code 2); the text says where and what to do."""


class FileError(RunError):
    """A file could not be read or written (exit code 4)."""


class KeptResults(RunError):
    """An end that leaves results: `dataset` is what was computed.

    Attributes:
        output: the result file that the run was to make, or made; empty of a run in memory.
    """

    def __init__(self, code: int, line: str, output: str, computed: xr.Dataset | None = None) -> None:
        super().__init__(code, line)
        self.output = output
        self._computed = computed

    @property
    def dataset(self) -> xr.Dataset:
        """What was computed before the end."""
        if self._computed is not None:
            return self._computed
        from .results import open as open_result

        return open_result(self.output)


class TooManyFailures(KeptResults):
    """More members failed than max_failures allows (exit code 3). All members are in `dataset`, with the status of each."""


class StoppedEarly(KeptResults):
    """Stopped by a signal or by max_hours (exit code 5). `dataset` holds the members that ended before; with the same output and
    ``resume=True`` the run goes on."""

    def __init__(self, code: int, line: str, output: str, program: str, computed: xr.Dataset | None = None) -> None:
        super().__init__(code, line, output, computed)
        self.program = program
        self._merged: str | None = None

    @property
    def dataset(self) -> xr.Dataset:
        """One file of the members that ended before the stop; the others have the status not_run. The shards stay as they are."""
        if self._computed is not None:
            return self._computed
        from .program import call, shards_of
        from .results import open as open_result
        from .temporary import temporary_path

        if self._merged is None:
            merged = temporary_path("merged.nc")
            # Code 5 says that members are missing, which is known.
            call(self.program, ["merge", shards_of(self.output), "-o", merged], good=(0, 5))
            self._merged = merged
        return open_result(self._merged, check=False)
