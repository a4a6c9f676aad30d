"""The commands of the repository's pages are run as they stand there; slow: what they print is what the pages show."""

from __future__ import annotations

import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import root, slow


# Stands in for the program on the path of the shell: runs are shortened, everything else is as it is.
SHORT = """#!{python}
import os, sys
shorter = {{
    "slider_crank": ["study.revolutions=0.1", "study.samples_per_revolution=10000"],
    "tolerance": ["study.base=4", "study.duration=5 ms"],
    "ensemble": ["study.members=16", "study.duration=2 ms", "study.samples=5"],
    "lyapunov": ["study.members=4", "study.transient_revolutions=0", "study.revolutions=0.02", "study.rescalings_per_revolution=2000", "study.history=10"],
    "poincare": ["study.members=2", "study.transient_revolutions=0", "study.revolutions=1", "mechanism.crank_speed=600 rpm"],
    "sweep": ["study.members=2", "study.points=2", "study.transient_revolutions=0", "study.revolutions=2", "mechanism.crank_speed=600 rpm"],
    "carriage": ["study.revolutions=0.01"],
    "planar": ["study.duration=10 ms"],
    "crosshead": ["study.members=16", "study.duration=20 ms"],
    "free": ["study.duration=10 ms"],
    "pump": ["study.members=16"],
    "press": ["study.members=4", "study.duration=0.2 s"],
    "end": ["study.members=16"],
    "shaken": ["study.members=16", "study.duration=0.2 s"],
    "leaning": ["study.members=16"],
    "overhang": ["study.members=16"],
    "oil": ["study.members=16"],
    "worn": ["study.members=16"],
}}
line = sys.argv[1:]
if line[0] == "run":
    kind = os.path.basename(line[1]).partition(".")[0].partition("_")[0]
    kind = "slider_crank" if kind == "slider" else kind
    for setting in shorter[kind]:
        line += ["--set", "study.members=8" if setting == "study.base=4" and "study.design=lhs" in line else setting]
os.execv({program!r}, [{program!r}, *line])
"""


def blocks(document: str) -> list[list[str]]:
    """The lines of each fenced block without a language."""
    text = (root / document).read_text(encoding="utf-8")
    return [body.splitlines() for language, body in re.findall(r"^```(.*?)\n(.*?)^```", text, re.MULTILINE | re.DOTALL) if not language]


def commands(document: str) -> list[str]:
    """Lines that call the program, as a shell takes them."""
    lines = [line.removeprefix("$ ") for block in blocks(document) for line in block]
    return [line for line in lines if re.match(r"(mpirun -n \d+ |source <\()?slideway [a-z]", line)]


def runnable(command: str) -> list[str]:
    """What of a line this machine can do: one process in place of ranks, its own shell, and a scene in place of SCENE."""
    command = re.sub(r"^mpirun -n \d+ ", "", command)
    command = re.sub(r"^source <\((.*?)\).*", r"\1", command).replace("| source", "")
    command = re.sub(r"\| jq .*", f"| {shlex.quote(sys.executable)} -m json.tool", command)
    command = command.replace("SCENE", "scenes/ensemble_starts.toml")
    if "--shard 3/8" in command:
        return [command.replace("3/8", f"{part}/8") for part in range(1, 9)]
    return [command]


PAGES = ["docs/explanation/chaos.md", "docs/how_to/command_line.md", "docs/how_to/gpu.md", "docs/how_to/jobs.md", "docs/reference/json.md", "docs/how_to/parameters.md", "docs/how_to/report.md", "docs/reference/results.md", "docs/how_to/rigid.md",
         "docs/how_to/tolerance.md"]  # fmt: skip


@pytest.fixture
def shell(program: str, tmp_path: Path) -> Path:
    """A folder that looks like the root of the repository after a run, with the short program in bin."""
    (tmp_path / "bin").mkdir()
    short = tmp_path / "bin" / "slideway"
    short.write_text(SHORT.format(python=sys.executable, program=str(Path(program).resolve())), encoding="utf-8")
    short.chmod(0o755)
    for folder in ("scenes", "examples"):
        (tmp_path / folder).symlink_to(root / folder)
    (tmp_path / "hunt_crossley.hpp").symlink_to(root / "tests/extending/hunt_crossley.hpp")
    return tmp_path


def run(line: str, folder: Path) -> subprocess.CompletedProcess[str]:
    path = f"{folder / 'bin'}{os.pathsep}{os.environ['PATH']}"
    return subprocess.run(["bash", "-c", f"set -o pipefail; {line}"], cwd=folder, env={**os.environ, "PATH": path, "SLIDEWAY_PYTHON": sys.executable, "XDG_CACHE_HOME": str(folder / "cache")},
                          capture_output=True, text=True, check=False)  # fmt: skip


@pytest.mark.parametrize("document", ["README.md", *slow(*PAGES)])
def test_commands_of_a_page_run(document: str, shell: Path, program: str) -> None:
    if document in ("docs/explanation/chaos.md", "docs/how_to/report.md", "docs/reference/results.md"):  # which begin with a result that is there
        subprocess.run([program, "run", "scenes/planar_rigid.toml", "--set", "study.members=4", "--set", "study.duration=1 s", "--set", "study.samples=4001",
                        "--quiet", "-o", "out.nc"], cwd=shell, check=True)  # fmt: skip
        (shell / "measured.csv").write_text("".join(f"{k},{(k * 7919) % 1000}\n" for k in range(4000)), encoding="utf-8")
    if document == "docs/reference/results.md":
        assert run("slideway run scenes/poincare_0.1mm.toml -o orbits.nc", shell).returncode == 0
    lines = commands(document)
    assert lines
    for line in lines:
        if not line.startswith("slideway merge"):
            (shell / "OUT.nc").unlink(missing_ok=True)
        for part in runnable(line):
            done = run(part, shell)
            no_gpu = "--backend cuda" in part and done.returncode == 4
            assert done.returncode == 0 or no_gpu, (document, part, done.stderr)


def test_every_page_with_commands_is_among_them() -> None:
    names = [str(page.relative_to(root)) for page in (root / "docs").rglob("*.md")]
    found = {name for name in names if commands(name)} | {"README.md"}
    assert found == {"README.md", *PAGES, "docs/tutorial/tutorial.md"}  # whose commands test_package.py runs


# What depends on the machine or its clock.
OF_THE_MACHINE = re.compile(r"(throughput|cost|metadata) ")


def transcripts(document: str) -> list[tuple[str, list[str]]]:
    """Commands behind "$ ", each with the lines that the page shows of what it prints; `...` stands for others."""
    found: list[tuple[str, list[str]]] = []
    for block in blocks(document):
        for line in block:
            if line.startswith("$ "):
                found.append((line.removeprefix("$ "), []))
            elif found and line.strip() and line != "...":
                found[-1][1].append(" ".join(line.split()))
    return [(command, shown) for command, shown in found if command.startswith("slideway")]


def missing(shown: list[str], printed: str) -> list[str]:
    """The lines shown that are not printed, in this order."""
    left = iter([" ".join(line.split()) for line in printed.splitlines()])
    return [line for line in shown if not OF_THE_MACHINE.match(line) and line not in left]


def test_lines_that_a_program_does_not_print_are_found() -> None:
    assert missing(["a b", "c"], "a  b\nd\nc\n") == []
    assert missing(["a b", "cost 3 s", "e"], "a  b\nd\nc\n") == ["e"]
    assert missing(["c", "a b"], "a  b\nd\nc\n") == ["a b"]
    assert [command.split()[1] for command, shown in transcripts("docs/tutorial/tutorial.md")] == ["check", "run", "info", "stats", "report", "run", "run", "run"]
    assert all(shown for command, shown in transcripts("README.md"))


@pytest.mark.slow
@pytest.mark.parametrize("document", ["README.md", "docs/tutorial/tutorial.md"])
def test_pages_show_what_the_program_prints(document: str, program: str, tmp_path: Path) -> None:
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "slideway").symlink_to(Path(program).resolve())
    (tmp_path / "scenes").symlink_to(root / "scenes")
    for scene in re.findall(r"^```toml\n(.*?)^```", (root / document).read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL):
        (tmp_path / "mine.toml").write_text(scene, encoding="utf-8")
    wrong = {}
    for command, shown in transcripts(document):
        done = run(command, tmp_path)
        assert done.returncode == 0, (command, done.stderr)
        if lines := missing(shown, done.stdout):
            wrong[command] = lines
    assert not wrong, json.dumps(wrong, indent=1, ensure_ascii=False)
