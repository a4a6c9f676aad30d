"""Files that are replaced whole."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path


def replace(path: Path, text: str) -> None:
    """Puts a text in a file that others see old or new, never in part; its unfinished name is this call's own."""
    descriptor, part = tempfile.mkstemp(prefix=f".{path.name}.", suffix=".part", dir=path.parent)
    try:
        with open(descriptor, "w", encoding="utf-8") as file:
            file.write(text)
        os.chmod(part, _usual_mode(path))
        os.replace(part, path)
    except BaseException:
        os.unlink(part)
        raise


def _usual_mode(path: Path) -> int:
    """Permissions of the file as it is, or of any new one: those of a temporary file are for its owner alone."""
    if path.exists():
        return path.stat().st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
