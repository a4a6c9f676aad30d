"""python -m reproduction: makes the results and the page; scripts/reproduce.sh calls it."""

from __future__ import annotations

import argparse
import math
import sys
import time
from collections.abc import Callable
from pathlib import Path

import slideway

from . import clearance, experiment, exponents, maps, modes, parameters, scatter
from .claims import Claim
from .page import page
from .plan import plan
from .runs import Laboratory, Missing
from .scale import SCALES
from .sections import Bench, Section

SECTIONS: tuple[Callable[[Bench], Section], ...] = (
    experiment.section,
    modes.section,
    clearance.section,
    scatter.positions,
    scatter.forces,
    maps.section,
    exponents.section,
    parameters.section,
)


def reproduce(
    scenes: Path, output: Path, scale: str = "full", threads: int | None = None, say: Callable[[str], None] = print
) -> tuple[list[Section], list[str]]:
    """Makes all results and the page OUTPUT/reproduction.html.

    Args:
        scenes: folder of the scenes.
        output: folder of the results, made if it is not there.
        scale: "full" or "tiny".
        threads: of the program; None: all that this process may use.
        say: takes lines of progress.

    Returns:
        The sections that could be made, and a line for each part that could not.
    """
    began = time.monotonic()
    laboratory = Laboratory(scenes, output, threads, say)
    runs = plan(SCALES[scale])
    laboratory.make(runs)
    made = time.monotonic() - began
    bench = Bench(laboratory, SCALES[scale])
    sections: list[Section] = []
    failures = [f"{name}: {why}" for name, why in laboratory.failures.items()]
    for build in SECTIONS:
        try:
            sections.append(build(bench))
            say(f"judged  {sections[-1].title}")
        except (Missing, slideway.SlidewayError) as error:
            failures.append(f"{build.__module__.rpartition('.')[2]}: the section cannot be made: {error}")
    facts = [
        f"{laboratory.version}; {len(runs)} runs in {made:.0f} s, page in {time.monotonic() - began - made:.0f} s (runs that were there already took no time). "
        "Each run's scene lies beside its result: slideway run NAME.toml makes it again."
    ]
    facts += energy_words(bench)
    if scale != "full":
        facts.append(f'Made at the scale "{scale}", which tests the machinery: none of these numbers means anything.')
    (output / "reproduction.html").write_text(page(sections, facts, failures), encoding="utf-8")
    return sections, failures


def energy_words(bench: Bench) -> list[str]:
    """How much of the drive's work each law made, over all cases; nothing where no audit could be made."""
    words = []
    if all(bench.shares.values()):
        made, kept = bench.shares["paper"], bench.shares["conservative"]
        words.append(
            f"Over all cases the law as published made {100 * min(made):.0f} to {100 * max(made):.0f} % of the drive's work out of nothing, "
            f"the conservative law less than {_rounded_up(100 * max(map(abs, kept))):.1g} %."
        )
    return words


def _rounded_up(value: float) -> float:
    """A positive number, rounded up to one digit."""
    size = 10.0 ** math.floor(math.log10(value)) if value > 0 else 1.0
    return math.ceil(value / size) * size


def main() -> int:
    """The command; exit code 1 where a part could not be made."""
    parser = argparse.ArgumentParser(
        prog="python -m reproduction", description="Figs. 3-5, 11-15, 17 and 19 of Qian et al. (2020) under both contact laws."
    )
    parser.add_argument("output", type=Path, help="folder of the results and of reproduction.html")
    parser.add_argument("--scenes", type=Path, default=Path(__file__).resolve().parents[2] / "scenes", help="folder of the scenes")
    parser.add_argument("--scale", choices=sorted(SCALES), default="full", help="tiny: the machinery alone, in seconds")
    parser.add_argument("--threads", type=int, help="threads of the program (default: all that this process may use)")
    options = parser.parse_args()
    try:
        sections, failures = reproduce(options.scenes, options.output, options.scale, options.threads, lambda line: print(line, flush=True))
    except (slideway.SlidewayError, OSError) as error:
        print(f"reproduce: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("reproduce: stopped; the same command goes on where it was", file=sys.stderr)
        return 130
    print()
    for section in sections:
        print(section.title)
        for claim in section.claims:
            print(_row(claim))
    print(f"\npage         {options.output / 'reproduction.html'}")
    if failures:
        more = f" (and {len(failures) - 1} more, named on the page)" if len(failures) > 1 else ""
        print(f"reproduce: a part could not be made: {failures[0]}{more}", file=sys.stderr)
        return 1
    return 0


def _row(claim: Claim) -> str:
    return f"  {claim.place:15} {claim.words}\n  {'':15} {claim.verdict.words}"


if __name__ == "__main__":
    sys.exit(main())
