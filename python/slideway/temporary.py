"""Temporary files that are removed as soon as nothing uses them."""

from __future__ import annotations

import os
import shutil
import tempfile
import weakref
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

_prefix = "slideway_"


class TemporaryPath(str):
    """Path of a file in a folder of its own, which is removed when the last holder of the path lets it go.

    Datasets carry the path of their file in ``encoding["source"]``; what is selected from them carries the same object, so the file
    lives as long as any of them. ``remove`` is for those who know earlier.

    >>> path = temporary_path("a.nc")
    >>> folder = os.path.dirname(path)
    >>> os.path.isdir(folder)
    True
    >>> del path
    >>> os.path.isdir(folder)
    False
    """

    _finalizer: weakref.finalize[Any, Any]

    def remove(self) -> None:
        """Removes the folder now."""
        self._finalizer()

    # A copy that did not own the folder would outlive it; another process must not remove it.
    def __copy__(self) -> TemporaryPath:
        return self

    def __deepcopy__(self, memo: dict[int, object]) -> TemporaryPath:
        return self

    def __reduce__(self) -> tuple[type[str], tuple[str]]:
        return str, (str(self),)


def temporary_path(name: str) -> TemporaryPath:
    """A new path of that name, in a new folder."""
    folder = tempfile.mkdtemp(prefix=_prefix)
    path = TemporaryPath(os.path.join(folder, name))
    path._finalizer = weakref.finalize(path, _remove, folder, os.getpid())
    return path


@contextmanager
def temporary_folder() -> Iterator[str]:
    """A folder for the length of a block."""
    with tempfile.TemporaryDirectory(prefix=_prefix, ignore_cleanup_errors=True) as folder:
        yield folder


def _remove(folder: str, owner: int) -> None:
    # A forked process has the path too, but not the folder.
    if os.getpid() == owner:
        shutil.rmtree(folder, ignore_errors=True)
