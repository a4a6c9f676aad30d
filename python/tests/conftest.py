"""Results that tests share: the program runs once for each of them in a session."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import matplotlib
import matplotlib.pyplot as plt
import pytest
import slideway
import xarray as xr
from matplotlib.axes import Axes

matplotlib.use("Agg")

root = Path(__file__).resolve().parents[2]
scenes = root / "scenes"
Result = Callable[[str], xr.Dataset]  # of a recipe


def labels_of(ax: Axes) -> list[str]:
    """What a legend names, or would name."""
    return [str(label) for label in ax.get_legend_handles_labels()[1]]


def slow(*values: Any) -> list[Any]:
    """Values of a test that CI leaves out, for what they take."""
    return [pytest.param(*(value if isinstance(value, tuple) else (value,)), marks=pytest.mark.slow) for value in values]


# name: scene file and what makes it small
recipes: dict[str, tuple[str, dict[str, object]]] = {
    "single": ("slider_crank_0.1mm.toml", {
        "study.revolutions": 0.2, "study.samples_per_revolution": 20000,
        "study.quantities": ["x", "vx", "normal_force", "surfaces", "lines", "points", "mode_time", "energy_residual"]}),
    "ensemble": ("ensemble_starts.toml", {"study.members": 64, "study.samples": 401, "study.duration": "20 ms"}),
    "lyapunov": ("lyapunov_0.1mm.toml", {
        "study.members": 16, "study.transient_revolutions": 0, "study.revolutions": 0.1, "study.history": 40}),
    "poincare": ("poincare_0.1mm.toml", {
        "study.members": 3, "study.transient_revolutions": 0, "study.revolutions": 2, "mechanism.crank_speed": "120 rpm"}),
    "crossings": ("poincare_0.1mm.toml", {
        "study.members": 3, "study.transient_revolutions": 0, "study.revolutions": 0.05, "study.section": {"on": "vy"},
        "study.vary": {"initial.y": {"dist": "unif", "low": "-0.03 mm", "high": "0.03 mm"}}}),
    "sweep": ("sweep_clearance.toml", {
        "study.members": 2, "study.points": 5, "study.transient_revolutions": 0, "study.revolutions": 2, "mechanism.crank_speed": "600 rpm"}),
    "columns": ("sweep_clearance.toml", {
        "study.members": 3, "study.points": 4, "study.transient_revolutions": 0, "study.revolutions": 2, "contact.law": "conservative",
        "mechanism.crank_speed": "600 rpm",
        "study.quantities": ["peak_normal_force", "mode_time", "energy_residual", "drive_work", "friction_loss", "damping_loss"]}),
    "coarse": ("ensemble_starts.toml", {"study.members": 12, "study.samples": 81, "study.duration": "400 ms"}),
    "tolerance": ("tolerance_0.1mm.toml", {"study.base": 16, "study.duration": "20 ms"}),
    "correlations": ("tolerance_0.1mm.toml", {
        "study.design": "lhs", "study.members": 64, "study.duration": "20 ms"}),
    "stored": ("ensemble_starts.toml", {"study.members": 64, "study.duration": "20 ms", "study.store": "statistics"}),
    "linkage": ("four_bar_journals.toml", {"study.members": 3, "study.revolutions": 0.5}),
    "failing": ("ensemble_starts.toml", {
        "study.members": 8, "study.samples": 11, "study.duration": "20 ms", "integrator.max_steps": 40}),
}


small: dict[str, Any] = {
    "schema": 1,
    "study": {"kind": "ensemble", "members": 6, "duration": "1 ms", "quantities": ["peak_normal_force"],
              "vary": {"joint.clearance": {"dist": "unif", "low": "50 um", "high": "0.1 mm"}}},
}  # fmt: skip


@pytest.fixture(autouse=True)
def _figures() -> Iterator[None]:
    """Closes the figures of each test."""
    yield
    plt.close("all")


@pytest.fixture(scope="session")
def program() -> str:
    """The program: SLIDEWAY_PROGRAM, else what the release build made."""
    given = os.environ.get("SLIDEWAY_PROGRAM", str(root / "build/release/bin/slideway"))
    os.environ["SLIDEWAY_PROGRAM"] = given
    return slideway.program.find_program()


@pytest.fixture(scope="session")
def result_of(program: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[[str], xr.Dataset]]:
    """The result of a recipe, run and opened when it is first asked for; each test has a copy, which reads the file when it is used."""
    folder = tmp_path_factory.mktemp("results")
    opened: dict[str, xr.Dataset] = {}

    def of(name: str) -> xr.Dataset:
        if name not in opened:
            scene, changes = recipes[name]
            slideway.run(scenes / scene, folder / f"{name}.nc", set=changes, threads=2, progress=False, max_failures="100%").close()
            opened[name] = slideway.open(folder / f"{name}.nc")
        return opened[name].copy()

    yield of
    for result in opened.values():
        result.close()
