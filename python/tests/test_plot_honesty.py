"""What plots must not do: round a distribution, hide data, claim what nobody knows, or name one thing by two colours."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest
import slideway
from conftest import Result, labels_of
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from matplotlib.transforms import Bbox
from slideway import palette
from slideway.columns import columns
from slideway.sampling import too_coarse

plot = slideway.plot


def at(ax: Axes, value: float) -> float:
    """The percentage that a stepped curve has at a value."""
    x, y = ax.lines[0].get_xdata(), ax.lines[0].get_ydata()
    return float(y[np.searchsorted(x, value, side="right") - 1])


@pytest.mark.parametrize(("name", "whose"), [("correlations", "64 members"), ("tolerance", "{} draws")])
def test_distribution_says_at_a_limit_what_the_file_says(name: str, whose: str, result_of: Result) -> None:
    with result_of(name) as result, result.slideway.yields as yields:
        ax = plot.quantiles(result, "peak_normal_force")
        share, trials = 100 * float(yields["share"][0]), int(yields["trials"])
    assert ax.lines[0].get_drawstyle() == "steps-post"
    assert at(ax, 1000) == pytest.approx(share)
    assert f"limit, kept by {share:.1f}%" in labels_of(ax)
    assert len(ax.containers) == 1  # the quantiles
    assert ax.get_ylabel() == f"share of the {whose.format(trials)} that ran [%]"


@pytest.mark.parametrize("name", ["correlations", "tolerance"])
def test_quantiles_lie_on_the_distribution_function(name: str, result_of: Result) -> None:
    with result_of(name) as result, result.slideway.statistics as statistics:
        ax = plot.quantiles(result, "peak_normal_force")
        count = int(statistics["peak_normal_force_count"])
    dots = ax.containers[0].lines[0]
    for value, share in zip(dots.get_xdata(), dots.get_ydata(), strict=True):
        assert at(ax, value) == pytest.approx(share, abs=101 / count)


def test_a_selection_of_a_radial_design_keeps_to_its_draws(result_of: Result) -> None:
    with result_of("tolerance") as result:
        row = result.sizes["member"] // 16
        some = result.sel(member=result.member != 1)  # as where B of the first row failed
        ax = plot.quantiles(some, "peak_normal_force")
        page = columns(some)
        alone = plot.quantiles(result.sel(member=[2, row - 1]), "peak_normal_force")
    assert ax.get_ylabel() == "share of the 31 draws that ran [%]"
    assert np.unique(ax.lines[0].get_xdata()).size == 31
    assert {one.count for one in page if one.name == "peak_normal_force"} == {31}
    assert alone.get_ylabel() == "share of the 2 members that ran [%]"


def test_failed_members_are_in_the_one_denominator() -> None:
    ax = plot.quantiles(slideway.example(), "peak_normal_force")  # 12 members, of which one failed
    assert ax.lines[0].get_ydata()[-1] == pytest.approx(100 * 11 / 12)
    assert ax.get_ylabel() == "share of the 12 members that ran [%]"


def test_function_of_statistics_alone_is_a_band_between_what_is_known(result_of: Result) -> None:
    with result_of("stored") as result, result.slideway.statistics as statistics:
        ax = plot.quantiles(result, "peak_normal_force")
        counts = statistics.peak_normal_force_bin_count.values
        edges = statistics.peak_normal_force_bin_edge.values
    corners = ax.collections[0].get_paths()[0].vertices
    below = 100 * np.cumsum(counts) / 64
    for edge, share in zip(edges[1:3], below[:2], strict=True):
        here = corners[np.isclose(corners[:, 0], edge)][:, 1]
        assert np.isclose(here, share).sum() >= 2  # the corner where the two bounds meet
    assert not any(line.get_linestyle() == "-" and len(line.get_xdata()) > 2 for line in ax.lines)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["stored", "correlations", "tolerance"])
def test_bars_have_no_caps(name: str, result_of: Result) -> None:
    with result_of(name) as result:
        axes = [plot.quantiles(result, "peak_normal_force"), plot.quantiles(result, "mode_time")]
        axes += [plot.sensitivity(result)] if name != "stored" else []
    for ax in axes:
        bars = [container for container in ax.containers if hasattr(container, "has_xerr")]
        assert bars
        for container in bars:
            assert container.lines[1] == ()  # the caps
            assert all(np.isfinite(segment).all() for lines in container.lines[2] for segment in lines.get_segments())


def test_ends_that_are_known_are_drawn(result_of: Result) -> None:
    with result_of("stored") as result, result.slideway.statistics as statistics:
        ax = plot.quantiles(result, "peak_normal_force")
        low = statistics.peak_normal_force_quantile_interval.sel(bound="low", probability=0.95)
    (bars,) = ax.containers[0].lines[2]
    assert np.isclose([segment[0][0] for segment in bars.get_segments()], float(low)).any()


@pytest.mark.parametrize("drawn", [True, False])
def test_exponent_is_drawn_where_the_verdict_lets_it(drawn: bool) -> None:
    time = np.arange(30) * 1e-3
    ax = plot.divergence(slideway.SeriesStatistics({}, time, 500 * time - 12, 500.0, 4.0, (1, 9), drawn))
    assert len(ax.lines) == 2
    assert ("500" in labels_of(ax)[1]) == drawn
    assert drawn or labels_of(ax)[1] == "no exponential growth is seen"


def test_exponent_of_a_result_is_that_of_the_verdict(result_of: Result) -> None:
    with result_of("single") as result:
        found = slideway.stats(result, "vy")
        ax = plot.divergence(result, "vy")
    assert found.growth_is_seen == (
        "no exponential growth" not in found.text["verdict"] and "means little" not in found.text["verdict"]
    )
    assert any("λ₁" in label for label in labels_of(ax)) == found.growth_is_seen


def test_force_shares_are_of_all_samples(result_of: Result) -> None:
    with result_of("single") as result:
        ax = plot.force_histogram(result, bins=30)
        touching = (result.surfaces + result.lines + result.points).values[0] > 0
        force = result.normal_force.values[0]
    least = 100 / touching.size
    outlines = [patch for patch in ax.patches if not patch.get_fill()]
    total = sum(float(np.where(patch.get_data().values > 0.5 * least, patch.get_data().values, 0).sum()) for patch in outlines)
    pushing = touching & (force > 0)
    shown = pushing & (force >= np.quantile(force[pushing], 0.001))
    assert total == pytest.approx(100 * shown.mean(), abs=2 * least)
    assert ax.get_ylabel() == "share of all samples [%]"


def test_coarse_samples_are_points_with_a_word(result_of: Result) -> None:
    with result_of("coarse") as result:
        for ax in (plot.time_series(result, "y", member=[0, 1]), plot.time_series(result, "vz", member=0), plot.orbit_yz(result, member=0)):
            drawn = [line for line in ax.lines if len(line.get_xdata()) == 81]
            assert drawn and all(line.get_linestyle() == "None" or line.get_label() in ("axis of the way", "ideal mechanism") for line in drawn)
            assert "samples every 5 ms,\nfar coarser than contacts" in labels_of(ax)


@pytest.mark.parametrize("name", ["single", "ensemble"])
def test_fine_samples_are_joined(name: str, result_of: Result) -> None:
    with result_of(name) as result:
        assert not too_coarse(result, result.member.values.tolist())
        assert plot.time_series(result, "y", member=0).lines[-1].get_linestyle() == "-"


def test_coarse_samples_of_a_smooth_series_are_joined(result_of: Result) -> None:
    with result_of("coarse") as result:
        assert not too_coarse(result, [0], "x")


DRAWN: dict[str, tuple[str, Callable[..., Axes], dict[str, Any]]] = {
    "one series": ("single", plot.time_series, {}),
    "eight series": ("ensemble", plot.time_series, {"member": list(range(8))}),
    "coarse series": ("coarse", plot.time_series, {"member": [0, 1]}),
    "coarse orbit": ("coarse", plot.orbit_yz, {"member": 0}),
    "bands": ("ensemble", plot.time_series, {}),
    "ideal": ("single", plot.time_series, {"name": "x"}),
    "spectra": ("ensemble", plot.spectrum, {"name": "vy", "member": [0, 1, 2]}),
    "forces": ("single", plot.force_histogram, {}),
    "orbit": ("single", plot.orbit_yz, {}),
    "orbits": ("ensemble", plot.orbit_yz, {"member": [0, 1, 2]}),
    "poincare": ("crossings", plot.poincare, {}),
    "sweep": ("sweep", plot.exponent_sweep, {}),
    "history": ("lyapunov", plot.exponent_history, {}),
    "histories": ("lyapunov", plot.exponent_history, {"member": [0, 1, 2]}),
    "exponents": ("lyapunov", plot.exponent_histogram, {}),
    "divergence": ("single", plot.divergence, {"name": "vy"}),
    "quantiles": ("correlations", plot.quantiles, {"name": "peak_normal_force"}),
    "quantiles by mode": ("correlations", plot.quantiles, {"name": "mode_time"}),
    "statistics": ("stored", plot.quantiles, {"name": "peak_normal_force"}),
    "sensitivity": ("tolerance", plot.sensitivity, {}),
}


def hidden(ax: Axes) -> float:
    """Share of the pixels under the legend that show more than paper and grid when the legend is away."""
    figure = ax.figure
    if (engine := figure.get_layout_engine()) is not None:
        engine.execute(figure)  # which moves axes
        for each in figure.axes:
            each.apply_aspect()
    legend = ax.get_legend()
    assert legend is not None
    box = legend.get_window_extent()
    frame = figure.bbox
    # Nothing is cut off; three pixels at each side are those of the frame that is not drawn.
    assert box.x1 <= frame.x1 + 3 and box.y0 >= frame.y0 - 3 and box.y1 <= frame.y1 + 3
    figure.set_layout_engine("none")  # the axes stay where they are
    legend.set_visible(False)
    figure.canvas.draw()
    pixels = np.asarray(figure.canvas.buffer_rgba())[..., :3].astype(int)
    inside = Bbox.intersection(box, frame)
    rows = slice(int(frame.y1 - inside.y1), int(frame.y1 - inside.y0))
    return float((pixels[rows, int(inside.x0) : int(inside.x1)].min(axis=-1) < 0xD0).mean())


@pytest.mark.slow
@pytest.mark.parametrize("place", ["own figure", "given axis", "one of three"])
@pytest.mark.parametrize("name", DRAWN)
def test_legends_hide_nothing(name: str, place: str, result_of: Result) -> None:
    recipe, function, given = DRAWN[name]
    with result_of(recipe) as result:
        if place == "own figure":
            ax = function(result, **given)
        else:
            axes = plt.subplots(1, 3, figsize=(18, 5))[1] if place == "one of three" else [plt.subplots()[1]]
            ax = function(result, ax=axes[0], **given)
            assert place != "one of three" or ax.get_legend().get_window_extent().x1 < axes[1].get_window_extent().x0
    assert hidden(ax) == 0


def test_axes_that_are_drawn_on_twice_stay_in_their_place(result_of: Result) -> None:
    first, second = plt.subplots(1, 2, figsize=(12, 4))[1]
    with result_of("ensemble") as result:
        for _ in range(3):
            plot.time_series(result, "y", ax=first)
    assert first.get_position().width > 0.5 * second.get_position().width
    assert first.get_legend().get_window_extent().x1 < second.get_window_extent().x0


def test_map_of_orbits_names_the_clearance_beside_its_colours(result_of: Result) -> None:
    with result_of("ensemble") as result:
        ax = plot.orbit_yz(result)
    assert ax.get_legend() is None
    assert ax.figure.axes[1].get_ylabel() == "samples of 64 members; dashed: clearance"


def test_hidden_data_would_be_seen() -> None:
    ax = plt.subplots()[1]
    ax.plot([0, 1], [0, 1], label="a line")
    ax.legend(loc="upper right")
    assert hidden(ax) > 0


def test_colours_of_contacts_are_those_of_the_page(result_of: Result) -> None:
    with result_of("correlations") as result:
        drawn = dict(zip(["free", "point", "line", "surface"], plot.quantiles(result, "mode_time").lines, strict=False))
    for name, line in drawn.items():
        assert to_hex(line.get_color()) == palette.class_colours[name]
        assert f"--{name}: {palette.class_colours[name]};" in palette.style_sheet()
