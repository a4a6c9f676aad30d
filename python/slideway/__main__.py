"""python -m slideway report FILE.nc [-o OUT.html], and draw -o OUT.svg: what the program's own commands hand over to."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable
from pathlib import Path

from .errors import SlidewayError
from .escapes import escaped

FILE_TROUBLE = 4  # the exit code that the program itself has for it


def main(arguments: list[str] | None = None) -> int:
    """Run a command of the companion; returns the exit code (2 for bad usage comes from argparse)."""
    parser = argparse.ArgumentParser(prog="python -m slideway", description="The Python companion of slideway.")
    commands = parser.add_subparsers(dest="command", required=True)
    page = commands.add_parser("report", help="write a page about a result that opens without a network")
    page.add_argument("FILE", help="result file of slideway run")
    page.add_argument("-o", "--output", metavar="OUT.html", help="the page (default: FILE with .html)")
    page.add_argument("--force", action="store_true", help="replace a page of slideway that is there already")
    drawing = commands.add_parser("draw", help="draw the mechanism that slideway check tells on stdin")
    drawing.add_argument("-o", "--output", metavar="OUT.svg|OUT.png", required=True, help="the picture, which is replaced where there is one")
    given = parser.parse_args(arguments)
    if given.command == "draw":
        return _told(lambda: f"drawing      {_draw(given.output)}")
    out = given.output or str(Path(given.FILE).with_suffix(".html"))
    if Path(out).exists() and not given.force:
        print(escaped(f"{out}: is there already; add --force to replace it, or give another name with -o"), file=sys.stderr)
        return FILE_TROUBLE
    return _told(lambda: f"report       {_write(given.FILE, out)}")


def _write(file: str, out: str) -> str:
    from .report import write

    return str(write(file, out))


def _draw(out: str) -> str:
    from .figures.mechanism import panel, told
    from .plot.axes import picture, png
    from .report.page import replace

    drawing = panel(told(json.load(sys.stdin)))
    replace(Path(out), png(drawing, 4.2) if out.endswith(".png") else picture([drawing], height=4.2, width=6.2).replace("?>", "?>\n<!-- slideway -->", 1))
    return out


def _told(made: Callable[[], str]) -> int:
    """Says what was made, or why it was not; returns the exit code."""
    try:
        print(escaped(made()))
    except SlidewayError as error:
        print(escaped(str(error)), file=sys.stderr)
        return FILE_TROUBLE
    except ModuleNotFoundError as error:
        print(f"slideway: the Python package {error.name} is missing; install it with {sys.executable} -m pip install {error.name}", file=sys.stderr)
        return FILE_TROUBLE
    return 0


if __name__ == "__main__":
    sys.exit(main())
