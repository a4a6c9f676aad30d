"""python -m study OUTDIR: the worked studies, as a page and its pictures; scripts/study.sh calls it."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
import slideway

from . import picture
from .machines import carriage, press
from .page import Found, page
from .runs import alone, by_fit, halved, loosest, middle, misaligned, pump, shares, verdicts, worn


def study(root: Path, fewer: int) -> Found:
    """All runs, with one in so many of the members."""
    losses = ["damping_loss", "friction_loss"]
    return Found(
        rigid=by_fit(root, pump, True, 4000 // fewer),
        compliant=by_fit(root, pump, False, 512 // fewer),
        tightened=[halved(root, pump, fit, 4000 // fewer) for fit in (loosest, middle)],
        parts=shares(root, pump, loosest, 1024 // fewer),
        before=by_fit(root, alone, True, 2000 // fewer),
        space=[misaligned(root, angle, 128 // fewer) for angle in (0.1, 0.2, 0.4)],
        worn=[worn(root, depth, 128 // fewer) for depth in (10, 40, 80)],
        presses=[press(root, inertia, 256 // fewer) for inertia in (0.3, 0.5, 0.8, 1.1)],
        carriages=[carriage(root, each, np.arange(150, 211, 5) * 1e-3) for each in ("linear", "monotone", "spline")],
        verdicts=[verdicts(root, "crosshead.toml", {"contact.law": "rigid"}, losses, 1024 // fewer, 64 // fewer),
                  verdicts(root, "crosshead.toml", {}, [*losses, "peak_normal_force"], 256 // fewer, 32 // fewer),
                  *(verdicts(root, "crosshead_space.toml", {"way_profile.wear.scale": depth}, [*losses, "peak_normal_force"], 256 // fewer, 32 // fewer)
                    for depth in (0, 40))],
    )  # fmt: skip


def main() -> int:
    """The command; exit code 1 where a run fails."""
    parser = argparse.ArgumentParser(prog="python -m study", description="The worked studies of a crosshead, a press and a carriage.")
    parser.add_argument("output", type=Path, help="folder of study.md and of its pictures")
    parser.add_argument("--quick", action="store_true", help="a sixteenth of the members, for a look")
    options = parser.parse_args()
    root = Path(__file__).resolve().parents[2]
    try:
        found = study(root, 16 if options.quick else 1)
        drawn = {"study": picture.losses(found.rigid, found.compliant), "study_worn": picture.worn(root),
                 "study_machines": picture.machines(root, found.presses, found.carriages)}  # fmt: skip
    except slideway.SlidewayError as error:
        print(f"study: {error}", file=sys.stderr)
        return 1
    (options.output / "pictures").mkdir(parents=True, exist_ok=True)
    (options.output / "study.md").write_text(page(root, found), encoding="utf-8")
    for name, svg in drawn.items():
        (options.output / "pictures" / f"{name}.svg").write_text(svg, encoding="utf-8")
    print(f"page         {options.output / 'study.md'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
