"""Calls that cannot work: each ends with a SlidewayError of one line, and none with what xarray, numpy or matplotlib say."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import netCDF4
import numpy as np
import pytest
import slideway
import xarray as xr
from conftest import Result

plot = slideway.plot
short = {"schema": 1, "study": {"kind": "ensemble", "members": 2, "duration": "1 ms", "quantities": ["peak_tilt"]}}


def one_line(call: Callable[[], object]) -> str:
    """What the call says; it has to fail in one line."""
    with pytest.raises(slideway.SlidewayError) as caught:
        call()
    said = str(caught.value)
    assert said and "\n" not in said
    return said


def made(folder: Path, name: str, source: Path) -> Any:
    """A path that is no result, of the kind that its name says."""
    path = folder / "a.nc"
    whole = source.read_bytes()
    match name.split():
        case ["missing"]:
            return path
        case ["folder"]:
            path.mkdir()
        case ["empty"]:
            path.touch()
        case ["text"]:
            path.write_text("no NetCDF")
        case ["pipe"]:
            os.mkfifo(path)
        case ["line", "break"]:
            return folder / "a\nb.nc"
        case ["zeros"]:
            path.write_bytes(bytes(len(whole)))
        case ["foreign"]:
            xr.Dataset({"a": 1}).to_netcdf(path, engine="netcdf4")
        case ["first", part]:
            path.write_bytes(whole[: int(part) * len(whole) // 100])
        case ["hollow", part]:
            end = int(part) * len(whole) // 100
            path.write_bytes(whole[:end] + bytes(len(whole) - end))
        case ["labels"]:
            shutil.copy(source, path)
            with netCDF4.Dataset(path, "a") as file:
                file["section_count"][:] = 1_000_000
    return path


FILES = ["missing", "folder", "empty", "text", "pipe", "line break", "zeros", "foreign", "first 1", "first 10", "first 50", "first 90",
         "first 99", "hollow 1", "hollow 5", "labels"]  # fmt: skip


@pytest.mark.parametrize("name", FILES)
def test_damaged_files_are_refused(name: str, result_of: Result, tmp_path: Path) -> None:
    path = made(tmp_path, name, Path(result_of("poincare").slideway.path))
    said = one_line(lambda: slideway.open(path))
    assert " ".join(str(path).split()) in said
    assert one_line(lambda: slideway.report.write(path, tmp_path / "p.html"))
    assert not (tmp_path / "p.html").exists()


@pytest.mark.parametrize("path", [None, 3, 2.5, "", "a\0b.nc", b"a.nc", [], {}, object(), True, xr.Dataset()])
def test_what_is_no_path_is_refused(path: Any, program: str) -> None:
    for call in (slideway.open, slideway.groups, slideway.info, slideway.stats):
        one_line(lambda: call(path))
    one_line(lambda: slideway.report.write(path, "p.html"))


# Arguments of functions that take a result; the recipe of the result, and what fails.
CALLS: dict[str, tuple[str, Callable[[xr.Dataset], object]]] = {
    f"{name} {words}": (recipe, (lambda function, given: lambda result: function(result, **given))(function, given))
    for recipe, name, function, every in (
        ("ensemble", "open", lambda r, **g: slideway.open(r.slideway.path, **g), [{"group": g} for g in ("", 3, "a/b", "y", ["y"])]),
        ("ensemble", "scene", slideway.scene, [{"member": m} for m in ("a", 2.5, -1, 64, [0.5], None.__class__)]),
        ("poincare", "sections", slideway.sections, [{"member": m} for m in ("a", 1.5, 99, [], {})]),
        ("ensemble", "stats", slideway.stats, [{"variable": 3}, {"variable": "no"}, {"member": "a"}, {"member": 99}, {"delays": 3},
                                               {"delay": "x"}, {"fit": "a"}, {"program": "/nowhere"}, {"program": 5}]),
        ("ensemble", "time_series", plot.time_series, [{"name": n} for n in (3, None, "", "no", "status", "peak_normal_force", "member")]
         + [{"member": m} for m in ("a", 0.5, -1, 64, [], [[0]], {}, True)] + [{"ax": a} for a in (3, "ax", plt)]),
        ("ensemble", "cumulative_area", plot.cumulative_area, [{}, {"name": "peak_tilt"}, {"name": "y", "member": "a"}]),
        ("ensemble", "spectrum", plot.spectrum, [{"name": "peak_tilt"}, {"name": "y", "reference": 0}, {"name": "y", "reference": "g"},
                                                 {"name": "y", "span": -1}, {"name": "y", "ax": 1}]),
        ("single", "force_histogram", plot.force_histogram, [{"bins": b} for b in (0, -3, 2.5, "many", None, [1, 2], 10**9)]),
        ("ensemble", "orbit_yz", plot.orbit_yz, [{"member": m} for m in (99, "0", np.nan)] + [{"ax": []}]),
        ("poincare", "poincare", plot.poincare, [{"x": "no"}, {"y": 3}, {"x": None}, {"member": 7}]),
        ("sweep", "bifurcation", plot.bifurcation, [{"name": "no"}, {"name": 3}, {"ax": 3}]),
        ("sweep", "exponent_sweep", plot.exponent_sweep, [{"exponent": e} for e in (0, 2, "1", 1.5, None)]),
        ("lyapunov", "exponent_history", plot.exponent_history, [{"exponent": 0}, {"exponent": "a"}, {"member": 16}]),
        ("lyapunov", "exponent_histogram", plot.exponent_histogram, [{"exponent": 9}, {"bins": -1}, {"bins": "no"}, {"bins": {}}]),
        ("ensemble", "divergence", plot.divergence, [{"name": "no"}, {"member": 64}, {"name": 3}, {"speed": 1}]),
        ("correlations", "quantiles", plot.quantiles, [{"name": n} for n in (3, "", "no", "member", "mode_class", ["mode_time"])]),
        ("correlations", "sensitivity", plot.sensitivity, [{"name": 3}, {"name": "no"}, {"name": "mode_time", "component": "no"}]),
        ("stored", "statuses", slideway.statuses, [{}]),
        ("stored", "time_series of statistics", plot.time_series, [{}, {"name": "mode_time"}]),
        ("failing", "quantiles of failures", plot.quantiles, [{"name": "peak_tilt"}]),
    )
    for words, given in ((", ".join(f"{key}={value!r}" for key, value in given.items()), given) for given in every)
}


@pytest.mark.parametrize("call", CALLS)
def test_arguments_that_cannot_be_are_refused(call: str, result_of: Result, program: str) -> None:
    recipe, function = CALLS[call]
    with result_of(recipe) as result:
        one_line(lambda: function(result))


PLOTS = [getattr(plot, name) for name in plot.__all__]


@pytest.mark.parametrize("function", [*PLOTS, slideway.statuses, slideway.finished, slideway.sections, slideway.scene], ids=lambda f: f.__name__)
@pytest.mark.parametrize("what", [None, 3, "a", [], {}, np.zeros(3), xr.DataArray([1.0]), xr.Dataset(), xr.Dataset({"status": 3})], ids=repr)
def test_what_is_no_result_is_refused(function: Callable[[Any], object], what: Any) -> None:
    one_line(lambda: function(what))


RUNS: dict[str, tuple[Any, dict[str, Any]]] = {
    "no scene": (None, {}), "number": (3, {}), "list": ([1], {}), "missing file": ("nowhere.toml", {}), "folder": (".", {}), "empty": ({}, {}),
    "study is a number": ({"schema": 1, "study": 3}, {}), "no value": ({"schema": 1, "study": {"members": None}}, {}),
    "no text": ({"title": "\ud800"}, {}), "key is a number": ({3: 4}, {}),
    **{f"{key}={value!r}": (short, {key: value}) for key, value in (
        ("threads", 0), ("threads", "two"), ("threads", 1.5), ("threads", 10**6), ("backend", "gpu"), ("backend", 3), ("isa", "no"), ("isa", []),
        ("max_hours", "3 h"), ("max_hours", -1), ("max_hours", 0), ("max_failures", "many"), ("max_failures", -1), ("max_failures", []),
        ("members", "all"), ("members", -1), ("members", 2), ("members", (0, 1, 2)), ("members", (1, 0)), ("members", (0, "a")),
        ("set", 3), ("set", [("a", 1)]), ("set", {"a.b": 1}), ("set", {3: 1}), ("set", {"": 1}), ("set", {"study.members": None}),
        ("output", 3), ("output", ""), ("output", "nowhere/deep/a.nc"), ("program", "/nowhere"), ("program", 5), ("program", __file__),
        ("thread", 1), ("study__members", object()), ("study__members", -3), ("joint__clearance", "wide"))},
}  # fmt: skip


@pytest.mark.parametrize("name", RUNS)
def test_runs_that_cannot_be_are_refused(name: str, program: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    scene, given = RUNS[name]
    said = one_line(lambda: slideway.run(scene, progress=False, **given))
    assert os.path.join(tempfile.gettempdir(), "slideway_") not in said


@pytest.mark.parametrize("what", [{"result": xr.Dataset()}, {"result": 3}, {"out": 3}, {"out": ""}, {"out": "no/where.html"}, {"out": "."}], ids=repr)
def test_pages_that_cannot_be_are_refused(what: dict[str, Any], result_of: Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with result_of("poincare") as result:
        one_line(lambda: slideway.report.write(**{"result": result, "out": "p.html", **what}))
    assert list(tmp_path.iterdir()) == []


def test_own_error_of_a_library_is_the_cause(result_of: Result) -> None:
    with pytest.raises(slideway.SlidewayError) as caught, result_of("lyapunov") as result:
        plot.exponent_histogram(result, bins=-1)
    assert isinstance(caught.value.__cause__, ValueError)


@pytest.mark.parametrize(
    ("study", "said"),
    [
        ({"members": -4}, "study.members is -4 ("),
        ({"member": 4}, "study.member is no key of a scene"),
        ({"kind": "tolerance", "quantities": []}, "study"),
        ({"vary": {"initial.y": {"dist": "nif"}}}, 'study.vary.initial.y.dist is "nif"'),
    ],
)  # fmt: skip
def test_errors_of_dictionaries_name_keys(study: dict[str, Any], said: str, program: str) -> None:
    line = one_line(lambda: slideway.run({**short, "study": {**short["study"], **study}}, progress=False))  # type: ignore[dict-item]
    assert line.startswith(said)
    assert "scene.toml" not in line
    assert "slideway_" not in line


def test_errors_of_dictionaries_without_a_line_are_of_the_scene(program: str) -> None:
    assert one_line(lambda: slideway.run({}, progress=False)).startswith("schema is missing")


def test_errors_of_files_name_their_line(program: str, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text("schema = 1\n[study]\nmembers = -4\n")
    line = one_line(lambda: slideway.run(tmp_path / "mine.toml", tmp_path / "a.nc", progress=False))
    assert line.startswith(f"{tmp_path}/mine.toml:3: study.members is -4")


def test_warnings_of_dictionaries_name_keys(program: str, capfd: pytest.CaptureFixture[str]) -> None:
    slideway.run({**short, "study": {**short["study"], "base": 16}}, progress=False)  # type: ignore[dict-item]
    said = capfd.readouterr().err
    assert "study.base has no effect" in said
    assert "scene.toml" not in said
