"""A selection of members in every plot, page and accessor: one of them without a dimension, one with it, several."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest
import slideway
import xarray as xr
from conftest import Result
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection

plot = slideway.plot

PLOTS: list[tuple[str, Callable[..., Any], dict[str, Any]]] = [
    ("ensemble", plot.time_series, {}),
    ("single", plot.time_series, {"name": "x", "difference": True}),
    ("single", plot.cumulative_area, {"name": "vx"}),
    ("ensemble", plot.spectrum, {"name": "vy"}),
    ("single", plot.force_histogram, {}),
    ("ensemble", plot.orbit_yz, {}),
    ("crossings", plot.poincare, {}),
    ("sweep", plot.bifurcation, {}),
    ("sweep", plot.exponent_sweep, {}),
    ("lyapunov", plot.exponent_history, {}),
    ("lyapunov", plot.exponent_histogram, {}),
    ("single", plot.divergence, {"name": "vy"}),
    ("correlations", plot.quantiles, {}),
    ("ensemble", plot.quantiles, {"name": "mode_time"}),
]
SELECTIONS: dict[str, Callable[[xr.Dataset], xr.Dataset]] = {
    "by number": lambda result: result.sel(member=0),
    "by place": lambda result: result.isel(member=-1),
    "one of a list": lambda result: result.sel(member=[0]),
    "loaded": lambda result: result.sel(member=0).load(),
}


def points_of(ax: Axes) -> list[np.ndarray]:
    """What lines and dots are drawn through."""
    dots = [np.asarray(one.get_offsets()) for one in ax.collections if isinstance(one, PathCollection)]
    return [np.array(line.get_xydata()) for line in ax.lines] + dots


@pytest.fixture(scope="module")
def alone() -> dict[object, list[np.ndarray]]:
    """Points of members alone, which several selections come to."""
    return {}


@pytest.mark.slow
@pytest.mark.parametrize("selection", SELECTIONS)
@pytest.mark.parametrize(("recipe", "function", "given"), PLOTS, ids=[f"{recipe}-{function.__name__}" for recipe, function, _ in PLOTS])
def test_one_member_is_drawn_alone(recipe: str, function: Callable[..., Any], given: dict[str, Any], selection: str, result_of: Result,
                                      alone: dict[object, list[np.ndarray]]) -> None:
    with result_of(recipe) as result:
        one = SELECTIONS[selection](result)
        ax = function(one, **given)
        ax.figure.set_layout_engine("none")  # it is laid out already
        ax.figure.canvas.draw()
        # The same as of this member alone, with its dimension.
        key = recipe, function, str(given), int(np.ravel(one.member)[0])
        if key not in alone:
            alone[key] = points_of(function(result.sel(member=[key[-1]]), **given))
        drawn, expected = points_of(ax), alone[key]
    assert len(drawn) == len(expected) > 0 or ax.patches
    for mine, theirs in zip(drawn, expected, strict=True):
        np.testing.assert_array_equal(mine, theirs)


def test_accessor_of_one_member_is_of_that_member(result_of: Result) -> None:
    with result_of("crossings") as result:
        one = result.sel(member=2)
        assert one.slideway.statuses.item() == "finished"
        assert bool(one.slideway.finished)
        np.testing.assert_array_equal(one.slideway.sections().vy, slideway.sections(result, 2).vy)
        assert one.slideway.scene["study"]["kind"] == "poincare"
        assert slideway.scene(one, member=2)["initial"]["y"] == float(one.initial_y)
        assert one.slideway.path == result.slideway.path
        with pytest.raises(slideway.SlidewayError, match="no member 1"):
            one.slideway.sections(member=1)


def test_statistics_of_a_selection_are_of_its_first_member(result_of: Result) -> None:
    with result_of("ensemble") as result:
        expected = slideway.stats(result, "y", 5).mean_log_distance
        for selected in (result.sel(member=5), result.sel(member=[5, 6])):
            np.testing.assert_array_equal(slideway.stats(selected, "y").mean_log_distance, expected)
        with pytest.raises(slideway.SlidewayError, match="no member 4"):
            slideway.stats(result.sel(member=5), "y", 4)


def test_sections_are_of_the_selected_members(result_of: Result) -> None:
    with result_of("sweep") as result:
        some = result.sel(member=[3, 8])
        assert set(slideway.sections(some).member.values) == {3, 8}
        ax = plot.bifurcation(some)
        assert len(np.asarray(ax.collections[0].get_offsets())) == int(some.section_count.sum())


def test_distribution_of_a_selection_is_its_own(result_of: Result) -> None:
    with result_of("correlations") as result:
        some = result.isel(member=slice(0, 10))
        ax = plot.quantiles(some, "peak_normal_force")
        np.testing.assert_array_equal(ax.lines[0].get_xdata()[1:], np.sort(some.peak_normal_force.values))
        assert not ax.containers  # the file's quantiles are of all members
        kept = float((some.peak_normal_force <= 1000).mean())
        assert f"limit, kept by {kept:.1%}" in ax.get_legend_handles_labels()[1]
        with pytest.raises(slideway.SlidewayError, match="of all members"):
            plot.sensitivity(some)


@pytest.mark.parametrize("recipe", ["ensemble", "single", "lyapunov", "crossings", "sweep", "correlations", "tolerance", "failing"])
def test_one_member_has_a_page(recipe: str, result_of: Result, tmp_path: Path) -> None:
    with result_of(recipe) as result:
        text = slideway.report.write(result.sel(member=0), tmp_path / "p.html").read_text(encoding="utf-8")
    assert "The member finished" in text or recipe == "failing"


def test_member_without_its_number_is_asked_for_it(result_of: Result) -> None:
    with result_of("ensemble") as result:
        nameless = result.isel(member=0, drop=True)
        for call in (plot.time_series, plot.orbit_yz, plot.spectrum, plot.quantiles, slideway.stats):
            with pytest.raises(slideway.SlidewayError, match=r"result.sel\(member=...\), without drop=True"):
                call(nameless)
        assert slideway.statuses(nameless).item() == "finished"


def test_figures_of_failed_calls_are_not_left(result_of: Result) -> None:
    with result_of("ensemble") as result, pytest.raises(slideway.SlidewayError):
        plot.quantiles(result.isel(member=[0]), "y")
    assert plt.get_fignums() == []
