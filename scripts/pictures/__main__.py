"""python -m pictures OUTDIR [NAME...]: makes the pictures; scripts/pictures.sh calls it."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from pathlib import Path

import slideway

from .drawings import apices, mechanism
from .figures import bifurcation, energy_residual, heyoka, modes, poincare, tolerance, work_precision
from .film import film
from .impacts import rigid
from .jobs import JOBS
from .mechanisms import KEYS
from .overviews import explain, layers, linkage, plots, report, stability
from .regimes import regimes
largest = 200_000  # bytes of a picture
# What makes the text of an SVG file, or a PNG file; its argument is the root of the repository.
PICTURES: dict[str, Callable[[Path], str | bytes]] = {
    "mechanism": mechanism,
    "apices": apices,
    "rattling": film,
    "modes": modes,
    "energy_residual": energy_residual,
    "poincare": poincare,
    "bifurcation": bifurcation,
    "tolerance": tolerance,
    "work_precision": work_precision,
    "rigid": rigid,
    "regimes": regimes,
    "heyoka": heyoka,
    "stability": stability,
    "layers": layers,
    "plots": plots,
    "linkage": linkage,
    "explain": explain,
    "report": report,
} | KEYS | JOBS


def main() -> int:
    """The command; exit code 1 where a picture could not be made."""
    parser = argparse.ArgumentParser(prog="python -m pictures", description="The pictures of the documentation.")
    parser.add_argument("output", type=Path, help="folder of the pictures")
    parser.add_argument("names", nargs="*", help="which: " + ", ".join(PICTURES) + " (default: all)")
    options = parser.parse_args()
    unknown = [name for name in options.names if name not in PICTURES]
    if unknown:
        parser.error(f"there is no picture {unknown[0]}; give some of {', '.join(PICTURES)}")
    root = Path(__file__).resolve().parents[2]
    options.output.mkdir(parents=True, exist_ok=True)
    for name in options.names or PICTURES:
        began = time.monotonic()
        try:
            drawn = PICTURES[name](root)
        except slideway.SlidewayError as error:
            print(f"pictures: {name}: {error}", file=sys.stderr)
            return 1
        content = drawn if isinstance(drawn, bytes) else drawn.encode()
        size = len(content)
        if size >= largest:
            print(f"pictures: {name}: {size} bytes, above {largest}; draw fewer points", file=sys.stderr)
            return 1
        (options.output / f"{name}.{'png' if isinstance(drawn, bytes) else 'svg'}").write_bytes(content)
        print(f"{name:<16} {size / 1000:6.0f} kB {time.monotonic() - began:6.1f} s", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
