"""Figures of the pages: exact, without claims that nobody can make, and readable on a phone."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import xarray as xr
from slideway import palette
from slideway.columns import Column
from slideway.figures.tolerance import distribution
from slideway.report.traces import plot
from slideway.report.numbers import amount, number
from slideway.units import scaled

from .browser import Seen
from .conftest import Page, unpacked

Pages = Callable[[str], Page]
Looks = Callable[..., Seen]
Results = Callable[[str], xr.Dataset]


def variant(page: Page, figure: str, place: int = 0) -> dict[str, Any]:
    return page.read.figure(figure)[place]


def test_distribution_says_at_a_limit_what_the_file_says(page_of: Pages, result_of: Results) -> None:
    with result_of("correlations") as result, result.slideway.yields as yields:
        values = np.sort(result.peak_normal_force.values)
        share = 100 * float(yields["share"][0])
    drawn = variant(page_of("correlations"), "quantiles")
    curve = drawn["data"][0]
    x, y = unpacked(curve["x"]), unpacked(curve["y"])
    assert curve["line"]["shape"] == "hv"
    np.testing.assert_allclose(x, [values[0], *values], rtol=1e-12)
    np.testing.assert_allclose(y, 100 * np.arange(65) / 64, rtol=1e-6)
    assert y[np.searchsorted(x, 1000, side="right") - 1] == pytest.approx(share)
    assert drawn["layout"]["annotations"][0]["text"] == f"limit, kept by {share:.1f}%"
    assert drawn["layout"]["yaxis"]["title"]["text"] == "share of the 64 members that ran [%]"
    assert f"{number(share, 3)} % (" in page_of("correlations").read.text  # on top of the page
    assert "of 64 members that ran meet all limits" in page_of("correlations").read.text


def test_long_distributions_are_exact_at_their_limits() -> None:
    values = np.random.default_rng(0).lognormal(size=40_001)
    edge = float(np.sort(values)[12_345]) * (1 + 1e-12)
    quantiles = {p: float(np.quantile(values, p)) for p in np.linspace(0.1, 0.9, 9)}
    one = Column("q", "", "1", values.size, 1.0, 1.0, values.min(), values.max(), quantiles, {}, values, None)
    curve = plot([distribution([one], {"q": {"max": edge}}, {}, 40_001, "members")])["data"][0]
    x, y = unpacked(curve["x"]), unpacked(curve["y"])
    assert x.size <= 5004
    assert y[np.searchsorted(x, edge, side="right") - 1] == pytest.approx(100 * 12_346 / 40_001, rel=1e-6)


def test_function_of_statistics_alone_is_a_band(page_of: Pages, result_of: Results) -> None:
    with result_of("stored") as result, result.slideway.statistics as statistics:
        below = 100 * np.cumsum(statistics.peak_normal_force_bin_count.values)[:2] / 64
    low, high = variant(page_of("stored"), "quantiles")["data"][:2]
    assert high["fill"] == "tonexty"
    np.testing.assert_allclose(unpacked(low["y"])[:4], [0, 0, below[0], below[0]], rtol=1e-6)
    np.testing.assert_allclose(unpacked(high["y"])[:4], [below[0], below[0], below[1], below[1]], rtol=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["correlations", "tolerance", "stored", "sweep", "columns"])
def test_error_bars_have_no_caps(name: str, page_of: Pages) -> None:
    bars = [
        trace[side]
        for figure in page_of(name).read.data["figures"].values()
        for one in figure["variants"]
        for trace in one["data"]
        for side in ("error_x", "error_y")
        if side in trace
    ]
    assert bars
    assert all(bar["width"] == 0 for bar in bars)


def test_a_sweep_is_told_column_by_column(page_of: Pages, result_of: Results) -> None:
    read = page_of("columns").read
    assert {"columns", "bifurcation", "balance"} <= set(read.data["figures"])
    assert not {"histograms", "modes", "quantiles", "exponents", "bands"} & set(read.data["figures"])
    assert "on average of" not in read.text
    assert "mean" not in " ".join(word for row in read.rows for word in row)
    with result_of("columns") as result:
        force = result.peak_normal_force.values.reshape(4, 3)  # columns, starts
        gaps = result.joint_clearance.values.reshape(4, 3)[:, 0]
        exponents = np.median(result.lyapunov_exponent.values[:, 0].reshape(4, 3), axis=1)
    medians = np.median(force, axis=1)
    factor, unit = scaled("N", medians.max())
    ends = (f"{number(medians[k] * factor)} at {amount(gaps[k], 'm')}" for k in (medians.argmin(), medians.argmax()))
    assert read.row("peak_normal_force") == ["peak_normal_force", unit, *ends]
    points, middle = variant(page_of("columns"), "columns")["data"]
    np.testing.assert_allclose(unpacked(points["y"]), force.ravel() * factor, rtol=1e-6)
    np.testing.assert_allclose(unpacked(middle["y"]), medians * factor, rtol=1e-6)
    assert f"between {number(exponents.min())} s⁻¹ at" in read.text
    assert f"and {number(exponents.max())} s⁻¹ at" in read.text


def test_the_audit_of_a_sweep_is_that_of_its_worst_column(page_of: Pages, result_of: Results) -> None:
    with result_of("columns") as result:
        loss = (result.friction_loss + result.damping_loss).values.reshape(4, 3).mean(axis=1)
        work = np.abs(result.drive_work.values.reshape(4, 3).mean(axis=1))
        worst = np.abs(result.energy_residual.values.reshape(4, 3)).max(axis=1) / np.maximum(loss, work)
        gap = float(result.joint_clearance.values.reshape(4, 3)[worst.argmax(), 0])
    text = page_of("columns").read.text
    assert f"largest share of 4 columns, joint.clearance = {amount(gap, 'm')}" in text
    assert f"Means over the members with joint.clearance = {amount(gap, 'm')}" in text


def test_coarse_samples_are_points_with_a_word(page_of: Pages) -> None:
    page = page_of("coarse")
    for name in ("series", "rates"):
        assert {trace["mode"] for trace in variant(page, name)["data"]} == {"markers"}
    assert {trace["mode"] for trace in variant(page, "orbit")["data"]} == {"markers"}
    assert "far coarser than the contacts: samples are points" in page.read.text
    assert {trace["mode"] for trace in variant(page_of("ensemble"), "series")["data"]} == {"lines"}
    assert "far coarser" not in page_of("ensemble").read.text


def test_colours_of_the_page_are_those_of_the_plots(page_of: Pages) -> None:
    page = page_of("tolerance")
    assert palette.style_sheet() in page.html
    by_name = {one["data"][0]["line"]["color"] for one in page.read.figure("quantiles") if "data" in one}
    assert {"@c1", "@free", "@point", "@line"} <= by_name
    total, first = variant(page, "sensitivity")["data"]
    assert (total["marker"]["color"], first["marker"]["color"]) == ("@c1", "@c2")


@pytest.mark.parametrize("name", ["ensemble", "columns", "tolerance", "stored", "correlations"])
def test_the_summary_is_read_on_a_phone_without_scrolling(name: str, seen_of: Looks) -> None:
    found = seen_of(name, width=390).found["phone"]
    assert found["tables"] > 0
    assert found["beyond"] <= 0
    assert 0 <= found["left"] < found["right"] <= 390
    assert found["size"] >= 13
    assert json.loads(found["named"]) in ("unit", "met by")  # the column's name beside the number


@pytest.mark.parametrize(
    ("name", "width"),
    [("single", 390), ("ensemble", 1200), ("ensemble", 390), ("sweep", 1200), ("columns", 390), ("tolerance", 1200),
     ("lyapunov", 1200), ("poincare", 390), ("coarse", 390)],
)
def test_legends_stand_outside_the_axes(name: str, width: int, seen_of: Looks) -> None:
    assert seen_of(name, width=width).found["legends"] == []
