"""python -m slideway report FILE.nc [-o OUT.html]: what the program's own command hands over to."""

from __future__ import annotations

import argparse
import sys
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
    given = parser.parse_args(arguments)
    out = given.output or str(Path(given.FILE).with_suffix(".html"))
    if Path(out).exists() and not given.force:
        print(escaped(f"{out}: is there already; add --force to replace it, or give another name with -o"), file=sys.stderr)
        return FILE_TROUBLE
    try:
        from .report import write

        print(escaped(f"report       {write(given.FILE, out)}"))
    except SlidewayError as error:
        print(escaped(str(error)), file=sys.stderr)
        return FILE_TROUBLE
    except ModuleNotFoundError as error:
        print(f"slideway: the Python package {error.name} is missing; install it with {sys.executable} -m pip install {error.name}", file=sys.stderr)
        return FILE_TROUBLE
    return 0


if __name__ == "__main__":
    sys.exit(main())
