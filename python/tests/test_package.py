"""The package as a whole: its version, its face, its documents."""

from __future__ import annotations

import inspect
import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import slideway
from conftest import root, slow


def python_blocks(document: str) -> list[str]:
    return re.findall(r"^```python\n(.*?)^```", (root / document).read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)


def test_version_is_that_of_the_program(program: str) -> None:
    stated = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
    assert stated.split()[1].rstrip(",") == slideway.__version__
    assert slideway.Ensemble({"schema": 1}).run().attrs["version"] == slideway.__version__


def test_package_is_marked_as_typed() -> None:
    assert (Path(slideway.__file__).parent / "py.typed").exists()


@pytest.mark.parametrize("module", [slideway, slideway.plot, slideway.report])
def test_every_public_function_has_an_example(module: object) -> None:
    functions = {name: getattr(module, name) for name in module.__all__ if inspect.isfunction(getattr(module, name))}  # type: ignore[attr-defined]
    assert functions
    for name, function in functions.items():
        assert ">>> " in (function.__doc__ or ""), name


def test_every_member_of_the_accessor_has_an_example() -> None:
    members = {name: member for name, member in vars(slideway.ResultAccessor).items() if not name.startswith("_")}
    assert {"group", "sections", "statistics", "yields", "sensitivity"} <= members.keys()
    for name, member in members.items():
        assert ">>> " in (member.__doc__ or ""), name


@pytest.mark.parametrize("function", [getattr(slideway.plot, name) for name in slideway.plot.__all__], ids=slideway.plot.__all__)
def test_every_plot_takes_an_axis(function: object) -> None:
    assert inspect.signature(function).parameters["ax"].default is None  # type: ignore[arg-type]


DOCUMENTS = ["README.md", "docs/reference/quantities.md", "docs/how_to/tolerance.md", "python/README.md", *slow("docs/how_to/python.md")]  # that one goes with other packages
# Runs each script that is given on stdin, in a folder and with names of its own, and tells what came of it: libraries are loaded once.
EACH = """
import json, os, sys, traceback
import matplotlib
matplotlib.use("Agg")
ends = {}
for name, (folder, script) in json.load(sys.stdin).items():
    os.chdir(folder)
    try:
        exec(compile(script, name, "exec"), {"__name__": "__main__"})
    except BaseException:
        ends[name] = traceback.format_exc()
    else:
        ends[name] = ""
    sys.modules["matplotlib"].pyplot.close("all")
json.dump(ends, open(sys.argv[1], "w"))
"""


@pytest.fixture(scope="module")
def ends_of_documents(request: pytest.FixtureRequest, program: str, tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """What the examples of each document that is asked for were ended by: nothing where they came to their end."""
    scripts = {}
    for document in [item.callspec.params["document"] for item in request.session.items if "ends_of_documents" in getattr(item, "fixturenames", ())]:
        blocks = python_blocks(document)
        assert blocks
        # The blocks of a page follow each other, in the root of the repository.
        folder = tmp_path_factory.mktemp("document")
        for part in ("scenes", "examples"):  # of which scenes read tables
            (folder / part).symlink_to(root / part)
        scripts[document] = str(folder), "\n".join(blocks)
    said = folder / "ends.json"
    done = subprocess.run([sys.executable, "-c", EACH, str(said)], input=json.dumps(scripts), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    ends: dict[str, str] = json.loads(said.read_text())
    return ends


@pytest.mark.parametrize("document", DOCUMENTS)
def test_examples_of_documents_run(document: str, ends_of_documents: dict[str, str]) -> None:
    assert ends_of_documents[document] == ""


@pytest.mark.slow
def test_the_sampled_posterior_is_that_of_the_linearised_model(monkeypatch: pytest.MonkeyPatch) -> None:
    """Noise so small leaves a Gaussian: its covariance is that of least squares, noise² (JᵀJ)⁻¹, with J by central differences."""
    (block,) = [block for block in python_blocks("docs/how_to/python.md") if "import emcee" in block]
    monkeypatch.chdir(root)
    names: dict[str, Any] = {"np": np, "slideway": slideway}
    exec(compile(block, "docs/how_to/python.md", "exec"), names)
    truth, steps = np.array([0.4, 1e-3]), np.diag([1e-3, 1e-6])
    jacobian = np.stack([(names["heights"](truth[None] + step) - names["heights"](truth[None] - step))[0] / (2 * step.sum()) for step in steps], axis=1)
    expected = np.sqrt(np.diag(np.linalg.inv(jacobian.T @ jacobian))) * names["noise"]
    drawn = names["drawn"]
    assert np.allclose(drawn.std(axis=0), expected, rtol=0.2)
    assert np.all(np.abs(drawn.mean(axis=0) - truth) < 3 * expected)


@pytest.mark.slow
def test_commands_of_the_tutorial_run(program: str, tmp_path: Path) -> None:
    """With fewer members and shorter runs: each is accepted, and reads what those before it wrote."""
    text = (root / "docs/tutorial/tutorial.md").read_text(encoding="utf-8")
    commands = [shlex.split(line, comments=True) for line in re.findall(r"^\$ (slideway .*)$", text, re.MULTILINE)]
    assert {command[1] for command in commands} == {"check", "run", "info", "stats", "report"}
    (scene,) = re.findall(r"^```toml\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    (tmp_path / "mine.toml").write_text(scene, encoding="utf-8")
    (tmp_path / "scenes").symlink_to(root / "scenes")
    environment = {**os.environ, "SLIDEWAY_PYTHON": sys.executable}
    for command in commands:
        shorter = {"mine.toml": ["--set", "study.members=16", "--set", "study.duration=20 ms"]}.get(command[2], ["--set", "study.revolutions=0.2", "study.samples_per_revolution=1000"])
        line = [program, *command[1:], *(shorter if command[1] == "run" else [])]
        done = subprocess.run(line, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
        assert done.returncode == 0, (line, done.stderr)
    assert (tmp_path / "one.html").exists()


@pytest.mark.slow
def test_the_notebook_runs(program: str, tmp_path: Path) -> None:
    nbclient, nbformat = pytest.importorskip("nbclient"), pytest.importorskip("nbformat")
    notebook = nbformat.read(root / "python" / "examples" / "first_study.ipynb", as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells)
    nbclient.NotebookClient(notebook, timeout=60, kernel_name="python3", resources={"metadata": {"path": str(tmp_path)}}).execute()
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    (printed,) = [output.text for output in outputs if output.output_type == "stream" and output.name == "stdout"]
    shares = {law: float(share) for law, share in (line.split() for line in printed.splitlines())}
    assert abs(shares["conservative"]) < 1e-4 < 1e-2 < shares["paper"]
    assert any("image/png" in output.get("data", {}) for output in outputs)


def test_pages_and_plots_are_reached_from_the_package_alone_which_leaves_matplotlib_alone() -> None:
    code = """
import sys, slideway
print('matplotlib' in sys.modules, 'report' in dir(slideway), slideway.report.write.__name__, 'report' in slideway.__all__)
print(slideway.plot.__name__, 'matplotlib' in sys.modules)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.stdout.split() == ["False", "True", "write", "True", "slideway.plot", "False"], done.stderr


def test_the_page_of_quantities_is_that_of_the_program(program: str) -> None:
    listed = subprocess.run([program, "list"], capture_output=True, text=True, check=True).stdout
    page = (root / "docs/reference/quantities.md").read_text(encoding="utf-8")
    told = {match[1]: (match[2], match[3].replace("\\|", "|")) for match in re.finditer(r"^\| `(\w+)` \| (.*?) \| (.*) \| .* \|$", page, re.MULTILINE)}
    for part in ("quantities (study.quantities)", "series (study.quantities)"):
        rows = listed[listed.index(part) :].split("\n\n")[0].splitlines()[1:]
        for row in rows:
            name = row.split()[0]
            unit, meaning = told.pop(name)
            assert " ".join(row.split()).startswith(f"{name} {unit} {meaning}"), name
    assert not told
