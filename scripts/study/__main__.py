"""python -m study OUTDIR: the worked study of a crosshead, as a page and a picture; scripts/study.sh calls it."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import slideway

from .page import page
from .picture import picture
from .runs import by_fit, halved, misaligned, shares


def main() -> int:
    """The command; exit code 1 where a run fails."""
    parser = argparse.ArgumentParser(prog="python -m study", description="The worked study of a crosshead.")
    parser.add_argument("output", type=Path, help="folder of study.md and pictures/study.svg")
    parser.add_argument("--quick", action="store_true", help="a sixteenth of the members, for a look")
    options = parser.parse_args()
    root = Path(__file__).resolve().parents[2]
    fewer = 16 if options.quick else 1
    try:
        rigid, compliant = by_fit(root, True, 4000 // fewer), by_fit(root, False, 512 // fewer)
        bought, parts = halved(root, 16_000 // fewer), shares(root, 2048 // fewer)
        space = [misaligned(root, angle, 128 // fewer) for angle in (0.1, 0.2, 0.4)]
    except slideway.SlidewayError as error:
        print(f"study: {error}", file=sys.stderr)
        return 1
    (options.output / "pictures").mkdir(parents=True, exist_ok=True)
    (options.output / "study.md").write_text(page(rigid, compliant, bought, parts, space), encoding="utf-8")
    (options.output / "pictures" / "study.svg").write_text(picture(rigid, compliant), encoding="utf-8")
    print(f"page         {options.output / 'study.md'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
