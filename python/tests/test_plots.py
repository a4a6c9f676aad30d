"""Plots: what they draw of which numbers, and what they say where there is nothing to draw."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator

import matplotlib.pyplot as plt
import numpy as np
import pytest
import slideway
import xarray as xr
from conftest import Result, labels_of, root
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection
from slideway.report.figures import _exponents, _poincare
from slideway.report.numbers import number
from slideway.units import scaled

plot = slideway.plot


@pytest.fixture
def ax() -> Iterator[Axes]:
    figure, axis = plt.subplots()
    yield axis
    with warnings.catch_warnings():
        warnings.simplefilter("error", UserWarning)  # of layout and missing glyphs
        figure.canvas.draw()
    plt.close(figure)


def dots_of(ax: Axes) -> np.ndarray:
    return np.concatenate([np.asarray(c.get_offsets()) for c in ax.collections if isinstance(c, PathCollection)])


def test_plots_return_the_axis_they_are_given(result_of: Result, ax: Axes) -> None:
    assert plot.time_series(result_of("single"), "y", ax=ax) is ax


def test_time_series_of_one_member_is_its_line_before_the_axis(result_of: Result, ax: Axes) -> None:
    result = result_of("single")
    plot.time_series(result, "y", ax=ax)
    axis_of_way = next(line for line in ax.lines if line.get_label() == "axis of the way")
    np.testing.assert_array_equal(axis_of_way.get_ydata(), 0)
    np.testing.assert_allclose(ax.lines[-1].get_ydata(), 1e6 * result.y.values[0])
    ends = sorted(float(line.get_ydata()[0]) for line in ax.lines if line.get_linestyle() == ":")
    assert ends == pytest.approx([-100, 100])  # the clearance of 0.1 mm
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("time [ms]", "y [µm]")


def test_time_series_has_the_ideal_mechanism_behind_it(result_of: Result, ax: Axes) -> None:
    result = result_of("single")
    plot.time_series(result, "x", ax=ax)
    behind, line = ax.lines
    assert behind.get_zorder() < line.get_zorder()
    np.testing.assert_allclose(behind.get_ydata(), line.get_ydata(), atol=0.05)  # mm
    assert behind.get_ydata()[0] == pytest.approx(1e3 * (0.05 + 0.1422))


def test_time_series_shows_small_differences(result_of: Result, ax: Axes) -> None:
    plot.time_series(result_of("single"), "x", difference=True, ax=ax)
    assert ax.get_ylabel() == "x − ideal [µm]"
    assert len(ax.lines) == 1


def test_time_series_of_many_members_are_bands_around_the_median(result_of: Result, ax: Axes) -> None:
    result = result_of("ensemble")
    plot.time_series(result, "y", ax=ax)
    median = next(line for line in ax.lines if line.get_label() == "median")
    np.testing.assert_allclose(median.get_ydata(), 1e6 * np.median(result.y.values, axis=0))
    assert "all 64 members" in labels_of(ax)


def test_time_series_of_chosen_members_are_lines(result_of: Result, ax: Axes) -> None:
    plot.time_series(result_of("ensemble"), "vy", member=[3, 11], ax=ax)
    assert labels_of(ax)[-2:] == ["member 3", "member 11"]


def test_time_series_counts_members_that_failed(ax: Axes) -> None:
    plot.time_series(slideway.example(), "y", ax=ax)
    assert "all 12 members (1 failed)" in labels_of(ax)


def test_series_of_members_that_all_failed_can_be_drawn(result_of: Result, ax: Axes) -> None:
    plot.time_series(result_of("failing"), "y", ax=ax)


def test_cumulative_area_ends_at_the_integral(ax: Axes) -> None:
    result = slideway.example()
    plot.cumulative_area(result, "vy", member=0, ax=ax)
    speed = np.abs(result.vy.values[0])
    assert ax.get_ylabel() == "∫|vy| dt [mm]"
    assert ax.lines[-1].get_ydata()[-1] == pytest.approx(1e3 * 0.5 * np.sum((speed[1:] + speed[:-1]) * np.diff(result.time.values)), rel=1e-9)


def test_force_histogram_tells_the_time_in_each_class(result_of: Result, ax: Axes) -> None:
    result = result_of("single")
    plot.force_histogram(result, ax=ax)
    hard = np.where(result.surfaces > 0, "surface", np.where(result.lines > 0, "line", np.where(result.points > 0, "point", "free")))
    shares = {name: float((hard == name).mean()) for name in ("point", "line", "surface", "free")}
    words = labels_of(ax)
    assert words[0] == f"point, {shares['point']:.2%} of the time"
    assert words[1] == f"line, {shares['line']:.2%} of the time"
    assert words[3] == f"free flight, {shares['free']:.2%}"


def test_orbit_lies_in_its_clearance(result_of: Result, ax: Axes) -> None:
    plot.orbit_yz(result_of("single"), ax=ax)
    (gap,) = ax.patches
    assert gap.get_path().get_extents().bounds == pytest.approx((-100, -100, 200, 200))
    assert ax.get_aspect() == 1


def test_orbits_of_many_members_are_a_map_of_all_samples(result_of: Result, ax: Axes) -> None:
    plot.orbit_yz(result_of("ensemble"), ax=ax)
    assert float(ax.collections[0].get_array().sum()) == 64 * 401


def test_poincare_map_has_every_section(result_of: Result, ax: Axes) -> None:
    result = result_of("crossings")
    plot.poincare(result, "z", "y", ax=ax)
    rows = slideway.sections(result)
    np.testing.assert_allclose(dots_of(ax), 1e6 * np.column_stack([rows.z, rows.y]))


def test_poincare_map_of_a_member_has_its_sections_alone(result_of: Result, ax: Axes) -> None:
    result = result_of("crossings")
    plot.poincare(result, member=1, ax=ax)
    assert len(dots_of(ax)) == int(result.section_count[1])


def test_divergence_has_a_line_of_the_fitted_slope(ax: Axes) -> None:
    time = np.arange(30) * 1e-3
    curve = slideway.SeriesStatistics({}, time, np.minimum(500 * time, 6) - 12, 500.0, 4.0, (1, 9))
    plot.divergence(curve, ax=ax)
    line = ax.lines[-1]
    x, y = line.get_xdata(), line.get_ydata()
    assert (y[-1] - y[0]) / (x[-1] - x[0]) == pytest.approx(0.5)  # per ms
    np.testing.assert_allclose(y, curve.mean_log_distance[1:10])
    assert "500.0 ± 4.0" in labels_of(ax)[1]


def test_divergence_asks_the_program_for_a_result(result_of: Result, ax: Axes) -> None:
    plot.divergence(result_of("single"), "vy", ax=ax)
    assert ax.lines[0].get_xdata().size > 3


def test_exponent_history_ends_at_the_exponents(result_of: Result, ax: Axes) -> None:
    result = result_of("lyapunov")
    plot.exponent_history(result, member=[2], ax=ax)
    assert ax.lines[-1].get_ydata()[-1] == pytest.approx(float(result.lyapunov_exponent[2, 0]), rel=1e-9)
    assert ax.lines[-1].get_xdata()[-1] == pytest.approx(1e3 * float(result.lyapunov_time[2]), rel=1e-6)  # ms


def test_a_phase_is_a_crank_angle_of_cranks_at_constant_speed_alone(result_of: Result) -> None:
    result = result_of("poincare")
    scene = result.attrs["scene"]

    def caption() -> str:
        return getattr(_poincare(result), "caption", "")

    assert " at the crank angle 0 rad. " in caption()
    for of_scene, other in (('kind = "slider_crank"', 'kind = "carriage"'), ('[joint]', '[drive]\nkind = "profile"\n[joint]')):
        result.attrs["scene"] = scene.replace(of_scene, other, 1)
        assert " at the phase 0 rad of the drive's period. " in caption()


def test_exponents_over_different_times_are_drawn_over_rescalings(result_of: Result, ax: Axes) -> None:
    result = result_of("lyapunov")
    result["lyapunov_time"] = result["lyapunov_time"] * np.where(result.member == 2, 0.1, 1.0)
    plot.exponent_history(result, ax=ax)
    assert ax.get_xlabel() == "rescalings"
    assert ax.lines[-1].get_xdata()[-1] == float(result.history[-1])
    words = [figure.caption for figure in _exponents(result) if figure is not None]
    shortest, longest = (number(float(edge)) for edge in (result.lyapunov_time.min(), result.lyapunov_time.max()))
    assert f" over {shortest} to {longest} s each" in words[0]


def test_exponent_histogram_of_a_sweep_averages_over_no_column(ax: Axes) -> None:
    result = slideway.example().copy(deep=True)
    name = str(result.attrs["sweep_parameter"])
    columns = np.unique(result[name])
    assert len(columns) > 1
    plot.exponent_histogram(result, ax=ax)
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    values = result["lyapunov_exponent"].isel(exponent=0)
    for value, said in zip(columns, labels, strict=True):
        own = values[(result[name] == value).values].values
        own = own[np.isfinite(own)]
        assert said.startswith(f"{1e6 * value:.4g} µm: ")
        assert f"{own.size} members" in said or "one member" in said
        assert any(np.isclose(line.get_xdata()[0], own.mean()) for line in ax.lines)
    many = result.isel(member=np.zeros(9, dtype=int)).assign_coords(member=np.arange(9))
    many[name] = ("member", np.linspace(1e-4, 2e-4, 9), result[name].attrs)
    with pytest.raises(slideway.SlidewayError, match="9 columns"):
        plot.exponent_histogram(many)


def test_exponent_histogram_counts_members_that_finished(ax: Axes) -> None:
    result = slideway.example()
    del result.attrs["sweep_parameter"]
    plot.exponent_histogram(result, ax=ax)
    assert sum(patch.get_height() for patch in ax.patches[:-1]) == 11
    values = result.lyapunov_exponent.values[:-1, 0]
    half = 2.22814 * values.std(ddof=1) / np.sqrt(11)  # Student's t of 10 degrees of freedom
    assert labels_of(ax) == [f"({values.mean():.0f} ± {half:.0f}) 1/s, 11 members, 1 failed"]


def test_exponent_of_one_member_has_its_own_interval(result_of: Result, ax: Axes) -> None:
    one = result_of("lyapunov").isel(member=[0])
    plot.exponent_histogram(one, ax=ax)
    band = ax.transData.inverted().transform_bbox(ax.patches[0].get_window_extent())
    assert band.width == pytest.approx(2 * float(one.lyapunov_exponent_half_width[0, 0]))


def test_bifurcation_diagram_has_columns_of_the_parameter(result_of: Result, ax: Axes) -> None:
    result = result_of("sweep")
    plot.bifurcation(result, "z", ax=ax)
    assert ax.get_xlabel() == "joint.clearance [µm]"
    np.testing.assert_allclose(np.unique(dots_of(ax)[:, 0].round(6)), [50, 162.5, 275, 387.5, 500])


def test_exponents_of_a_sweep_have_their_median(result_of: Result, ax: Axes) -> None:
    result = result_of("sweep")
    plot.exponent_sweep(result, ax=ax)
    expected = result.lyapunov_exponent.values[:, 0].reshape(5, 2).mean(axis=1)  # the median of two
    np.testing.assert_allclose(ax.lines[-1].get_ydata(), expected)


def test_spectrum_is_in_decibels_of_g(ax: Axes) -> None:
    result = slideway.example().isel(sample=slice(0, 1600))
    result["acceleration_top"][0] = 98.0665 * np.sin(2 * np.pi * 50 * result.time)
    plot.spectrum(result, member=0, ax=ax)
    line = ax.lines[-1]
    peak = line.get_ydata().argmax()
    assert line.get_xdata()[peak] == pytest.approx(50)
    assert line.get_ydata()[peak] == pytest.approx(20, abs=1e-6)  # ten g
    assert ax.get_ylabel() == "acceleration top [dB re g]"


def test_spectrum_leaves_out_members_that_failed(ax: Axes) -> None:
    plot.spectrum(slideway.example(), "y", reference=1e-6, ax=ax)
    assert labels_of(ax)[-1] == "root mean square of 11 members"
    assert ax.get_ylabel() == "y [dB re 1e-06 m]"


def test_work_precision_draws_the_measured_table(ax: Axes) -> None:
    plot.work_precision(root / "bench/results/work_precision.csv", "rattling_energy", ax=ax)
    assert "slideway auto, avx512" in labels_of(ax)
    assert (ax.get_xscale(), ax.get_yscale()) == ("log", "log")
    assert ax.get_ylabel() == "error, 95th percentile [J]"
    ax.get_legend().remove()  # it lies outside, where this figure has no room


def test_work_precision_asks_for_the_problem() -> None:
    with pytest.raises(slideway.SlidewayError, match="several problems; give problem="):
        plot.work_precision(root / "bench/results/work_precision.csv")
    with pytest.raises(slideway.SlidewayError, match="no problem decay"):
        plot.work_precision(root / "bench/results/work_precision.csv", "decay")
    with pytest.raises(slideway.SlidewayError, match="no column method"):
        plot.work_precision({"problem": ["a"]})


def test_quantiles_without_statistics_are_those_of_the_members(result_of: Result, ax: Axes) -> None:
    result = result_of("ensemble")
    plot.quantiles(result, "peak_normal_force", ax=ax)
    x, y = ax.lines[0].get_xdata(), ax.lines[0].get_ydata()
    np.testing.assert_allclose(x[1:], np.sort(result.peak_normal_force.values))
    assert (x[0], y[0], y[1], y[-1]) == (x[1], 0, pytest.approx(100 / 64), 100)


@pytest.mark.parametrize("name", ["correlations", "stored", "tolerance"])
def test_quantiles_of_several_values_have_a_curve_each(result_of: Result, name: str, ax: Axes) -> None:
    plot.quantiles(result_of(name), "mode_time", ax=ax)
    assert labels_of(ax)[:4] == ["free", "point", "line", "surface"]


def test_sensitivity_shows_sobol_indices_of_a_saltelli_design(result_of: Result, ax: Axes) -> None:
    result = result_of("tolerance")
    plot.sensitivity(result, "friction_loss", ax=ax)
    group = result.slideway.sensitivity
    top = ax.get_yticklabels()[-1].get_text()
    assert top == str(group.input.values[np.abs(group.friction_loss_total).values.argmax()])
    bars = ax.patches[: group.sizes["input"]]
    assert bars[-1].get_width() == pytest.approx(float(group.friction_loss_total.max()))


def test_sensitivity_shows_rank_correlations_of_other_designs(result_of: Result, ax: Axes) -> None:
    result = result_of("correlations")
    plot.sensitivity(result, "mode_time", "line", ax=ax)
    assert ax.get_xlabel() == "rank correlation of mode time [line]"
    expected = result.slideway.sensitivity.mode_time_rank_correlation.sel(mode_class="line")
    widths = sorted(bar.get_width() for bar in ax.patches)
    np.testing.assert_allclose(widths, np.sort(expected.values))


@pytest.mark.parametrize(
    ("name", "draw", "words"),
    [
        ("lyapunov", lambda r: plot.time_series(r, "y"), "add study.samples_per_revolution = 200"),
        ("ensemble", lambda r: plot.time_series(r, "crank_torque"), 'add "crank_torque" to study.quantities'),
        ("ensemble", lambda r: plot.time_series(r, "peak_normal_force"), "is no series over the time"),
        ("ensemble", lambda r: plot.time_series(r, "y", member=64), "no member 64"),
        ("ensemble", lambda r: plot.poincare(r), 'use study.kind = "poincare" or "sweep"'),
        ("poincare", lambda r: plot.poincare(r, "w"), "the sections have no w, but time, y"),
        ("ensemble", lambda r: plot.bifurcation(r), 'is no sweep; use study.kind = "sweep"'),
        ("ensemble", lambda r: plot.exponent_histogram(r), 'use study.kind = "lyapunov"'),
        ("stored", lambda r: plot.quantiles(r, "rms_crank_torque"), 'run it with study.store = "members"'),
        ("stored", lambda r: plot.orbit_yz(r), 'run it with study.store = "members"'),
        ("ensemble", lambda r: plot.force_histogram(r), 'lacks "normal_force", "surfaces", "lines", "points"; add to study.quantities'),
        ("lyapunov", lambda r: plot.exponent_histogram(r, exponent=2), "no exponent 2 .* use study.exponents = 2"),
        ("failing", lambda r: plot.spectrum(r, "y"), "none of these members has all samples"),
        ("ensemble", lambda r: plot.quantiles(r, "y"), "is a series over the time"),
        ("ensemble", lambda r: plot.sensitivity(r, "peak_normal_force"), "has no sensitivities"),
        ("correlations", lambda r: plot.sensitivity(r, "peak_tilt"), 'no peak_tilt; add "peak_tilt" to study.quantities'),
        ("correlations", lambda r: plot.sensitivity(r, "mode_time", "flying"), "no component flying, but free, point"),
    ],
)
def test_what_a_result_lacks_is_said_in_one_line(result_of: Result, name: str, draw: Callable[[xr.Dataset], Axes], words: str) -> None:
    with pytest.raises(slideway.SlidewayError, match=words) as caught:
        draw(result_of(name))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("units, values, expected", [
    ("m", 2.5e-5, "µm"), ("m", 0.15, "mm"), ("m", 0.0, "m"), ("N", 3900.0, "N"), ("N", 39000.0, "kN"), ("J", 9e-4, "µJ"),
    ("m s-2", 9.81, "m/s²"), ("s", 4000.0, "s"), ("1", 3.0, ""), ("kg", 2.0, "kg"), ("m s-1", float("nan"), "m/s"),
])
def test_units_are_handy(units: str, values: float, expected: str) -> None:
    factor, unit = scaled(units, values)
    assert unit == expected
    assert factor == {"µm": 1e6, "mm": 1e3, "kN": 1e-3, "µJ": 1e6}.get(expected, 1.0)


def planar() -> xr.Dataset:
    """A made-up result of a mechanism that moves in one plane."""
    result = slideway.example().drop_vars(["z", "lines"])
    result.attrs["scene"] = result.attrs["scene"].replace('"slider_crank"', '"planar_slider_crank"')
    return result


def test_planar_mechanisms_have_forces_without_lines(ax: Axes) -> None:
    plot.force_histogram(planar(), ax=ax)
    assert "line, 0.00% of the time" in labels_of(ax)


def test_planar_mechanisms_have_no_lateral_motion() -> None:
    with pytest.raises(slideway.SlidewayError, match="moves in one plane and has no z"):
        plot.orbit_yz(planar())


def test_quantities_with_any_dimension_have_a_curve_for_each_label(ax: Axes) -> None:
    result = slideway.example()
    values = np.arange(24.0).reshape(12, 2)
    result["acceleration_area"] = (("member", "channel"), values, {"units": "m s-1"})
    result = result.assign_coords(channel=["top", "front"])
    plot.quantiles(result, "acceleration_area", ax=ax)
    assert labels_of(ax) == ["top", "front"]
    np.testing.assert_allclose(ax.lines[1].get_xdata()[1:], values[:-1, 1])  # the last member failed
