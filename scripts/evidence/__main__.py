"""python -m evidence: makes the results and the page; scripts/evidence.sh calls it."""

from __future__ import annotations

import argparse
import sys
import time
from html import escape
from pathlib import Path

import slideway
from reproduction.page import html, table_html
from reproduction.runs import Laboratory, Missing

from .experiment import Experiment
from .experiments import EXPERIMENTS, SIZES


def page(experiments: list[Experiment], facts: list[str]) -> str:
    """The whole page as HTML."""
    parts = [f'<p class="soft">{escape(fact)}</p>' for fact in facts]
    for experiment in experiments:
        parts.append(f"<h2>{escape(experiment.title)}</h2>")
        parts += [f"<p>{escape(words)}</p>" for words in experiment.words]
        parts += [table_html(table) for table in experiment.tables]
    return html("Which law makes energy", "Which law makes energy, where and how much", parts)


def text(experiments: list[Experiment]) -> str:
    """The same as Markdown, to be copied from."""
    lines = []
    for experiment in experiments:
        lines += [f"## {experiment.title}", "", *experiment.words, ""]
        for table in experiment.tables:
            lines += [f"{table.caption}:", "", "| " + " | ".join(table.header) + " |", "|" + "---|" * len(table.header)]
            lines += ["| " + " | ".join(row) + " |" for row in table.rows] + [""]
    return "\n".join(lines)


def main() -> int:
    """The command; exit code 1 where a part could not be made."""
    parser = argparse.ArgumentParser(prog="python -m evidence", description="What docs/evidence/findings.md rests on.")
    parser.add_argument("output", type=Path, help="folder of the results and of evidence.html and evidence.md")
    parser.add_argument("--quick", action="store_true", help="the machinery alone; none of its numbers means anything")
    parser.add_argument("--threads", type=int, help="threads of the program (default: all that this process may use)")
    parser.add_argument("--only", help="one experiment: " + ", ".join(build.__name__ for build in EXPERIMENTS))
    options = parser.parse_args()
    began = time.monotonic()
    size = SIZES["quick" if options.quick else "full"]
    scenes = Path(__file__).resolve().parents[2] / "scenes"
    made, failures = [], []
    try:
        laboratory = Laboratory(scenes, options.output, options.threads, lambda line: print(line, flush=True))
        for build in EXPERIMENTS:
            if options.only not in (None, build.__name__):
                continue
            try:
                made.append(build(laboratory, size, options.output.resolve()))
            except (Missing, slideway.SlidewayError, OSError) as error:
                failures.append(f"{build.__name__}: {error}")
    except KeyboardInterrupt:
        print("evidence: stopped; the same command goes on where it was", file=sys.stderr)
        return 130
    facts = [f"{laboratory.version}; {time.monotonic() - began:.0f} s (runs that were there already took no time).", *failures]
    if options.quick:
        facts.append("Made with --quick, which tests the machinery: none of these numbers means anything.")
    (options.output / "evidence.html").write_text(page(made, facts), encoding="utf-8")
    (options.output / "evidence.md").write_text(text(made), encoding="utf-8")
    print(f"\npage         {options.output / 'evidence.html'}")
    for failure in failures:
        print(f"evidence: {failure}", file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
