"""What the pages say about the results of each kind of study."""

from __future__ import annotations

import re
from collections.abc import Callable

import numpy as np
import pytest
import slideway
import xarray as xr
from slideway import report
from slideway.report.numbers import number
from slideway.units import scaled

from .conftest import Page, Reader, unpacked

Pages = Callable[[str], Page]
Results = Callable[[str], xr.Dataset]

SUITED = {
    "single": {"series", "rates", "orbit", "forces", "modes"},
    "ensemble": {"series", "rates", "bands", "orbit", "modes", "histograms", "balance"},
    "lyapunov": {"exponents", "convergence", "histograms"},
    "poincare": {"poincare", "modes"},
    "crossings": {"poincare", "modes"},
    "sweep": {"bifurcation", "convergence"},
    "tolerance": {"sensitivity", "quantiles", "histograms", "modes", "balance"},
    "correlations": {"sensitivity", "quantiles", "histograms", "modes", "balance"},
    "stored": {"quantiles", "histograms", "modes", "balance"},
    "failing": {"series", "rates", "orbit"},
}


@pytest.mark.parametrize("name", SUITED)
def test_plots_suit_the_study(name: str, page_of: Pages) -> None:
    read = page_of(name).read
    there = set(read.data["figures"])
    assert SUITED[name] - {"convergence"} <= there
    assert there <= SUITED[name] | {"convergence", "forces", "bands"}
    assert there <= read.ids


@pytest.mark.parametrize("name", SUITED)
def test_a_page_stands_alone(name: str, page_of: Pages) -> None:
    page = page_of(name)
    assert len(page.html) < 8e6
    for tag, attributes in page.read.tags:
        assert tag not in ("link", "iframe", "img", "base")
        assert "src" not in attributes
        target = attributes.get("href", "#")
        assert str(target).startswith("#")
        assert str(target)[1:] in page.read.ids | {""}
    assert page.html.count("plotly.js v") == 1


def test_what_was_run_is_there(page_of: Pages, result_of: Results) -> None:
    text = page_of("ensemble").read.text
    with result_of("ensemble") as result:
        for name in ("title", "version", "commit", "compiler", "isa", "backend", "created", "payload_hash"):
            assert str(result.attrs[name]) in text
        for line in result.attrs["scene"].splitlines():
            assert " ".join(line.split()) in text
        for name in ("mechanism_meaning", "contact_law_meaning"):
            assert str(result.attrs[name]) in text
    assert "paper: one mode per face" in text
    assert "unif: low −40 µm, high 40 µm" in text


def test_statuses_are_counted_and_failures_named(page_of: Pages, result_of: Results) -> None:
    read = page_of("failing").read
    with result_of("failing") as result:
        spent = int((slideway.statuses(result) == "max_steps").sum())
        end = float(result["end_time"][0])
    assert spent == 8
    assert read.row("max_steps")[1:3] == ["8", "100 %"]
    assert "max_steps allows" in read.row("max_steps")[3]
    assert read.row("member 0")[1:3] == ["max_steps", f"{number(end)} s"]
    assert "0 of 8 members finished" in read.text
    assert "All 64 members finished" in page_of("ensemble").read.text


def test_the_summary_holds_moments_and_quantiles(page_of: Pages, result_of: Results) -> None:
    with result_of("ensemble") as result:
        force = result["peak_normal_force"].values
    row = page_of("ensemble").read.row("peak_normal_force")
    factor, unit = scaled("N", force.max())
    ends = (force.min(), *np.quantile(force, [0.05, 0.5, 0.95]), force.max())
    expected = [unit, "64", *(number(v * factor) for v in (force.mean(), force.std(ddof=1), *ends))]
    assert row[1:] == expected


def test_statistics_without_members_are_summarised(page_of: Pages, result_of: Results) -> None:
    with result_of("stored") as result, result.slideway.statistics as statistics:
        mean = float(statistics["peak_normal_force_mean"])
        high = float(statistics["peak_normal_force_max"])
    factor, unit = scaled("N", high)
    assert page_of("stored").read.row("peak_normal_force")[1:4] == [unit, "64", number(mean * factor)]


def test_yields_stand_with_their_intervals(page_of: Pages, result_of: Results) -> None:
    with result_of("correlations") as result, result.slideway.yields as group:
        met, share = int(group["met"][0]), float(group["share"][0])
        low, high = group["share_interval"].values[0]
    row = page_of("correlations").read.row("peak_normal_force ≤ 1000 N")
    assert row[1:] == [str(met), "64", f"{100 * share:.3g} %", f"{100 * low:.3g} % to {100 * high:.3g} %"]


def test_drawn_series_are_the_stored_ones(page_of: Pages, result_of: Results) -> None:
    with result_of("ensemble") as result:
        y = result["y"].sel(member=0).values
        time = result["time"].values
    trace = page_of("ensemble").read.figure("series")[0]["data"][0]
    assert trace["name"] == "y"
    assert np.allclose(unpacked(trace["x"]), time * 1e3, rtol=1e-6)
    assert np.allclose(unpacked(trace["y"]), y * 1e6, rtol=1e-6, atol=1e-6)


def test_long_series_are_thinned_but_keep_their_extremes(page_of: Pages, result_of: Results) -> None:
    read = page_of("single").read
    with result_of("single") as result:
        assert result.sizes["sample"] == 4001
        force = result["normal_force"].values[0]
    traces = [trace for trace in read.figure("series")[0]["data"] if trace["name"] == "normal force"]
    assert np.isclose(unpacked(traces[0]["y"]).max(), force.max(), rtol=1e-6)
    assert all(len(unpacked(trace["y"])) <= 5000 for variant in read.figure("series") for trace in variant["data"])


def test_histograms_count_every_member(page_of: Pages) -> None:
    for name in ("ensemble", "stored"):
        for variant in page_of(name).read.figure("histograms"):
            assert unpacked(variant["data"][0]["y"]).sum() == 64


def test_the_map_holds_every_section(page_of: Pages, result_of: Results) -> None:
    with result_of("poincare") as result:
        y = result["section_y"].values * 1e6
    drawn = [unpacked(trace["x"]) for trace in page_of("poincare").read.figure("poincare")[0]["data"]]
    assert np.allclose(np.sort(np.concatenate(drawn)), np.sort(y), rtol=1e-6, atol=1e-6)


def test_bifurcations_stand_at_their_parameter(page_of: Pages, result_of: Results) -> None:
    with result_of("sweep") as result:
        columns = np.unique(result["joint_clearance"].values) * 1e6
        count = result.sizes["section"]
    trace = page_of("sweep").read.figure("bifurcation")[0]["data"][0]
    assert len(unpacked(trace["x"])) == count
    assert np.allclose(np.unique(unpacked(trace["x"])), columns, rtol=1e-6)


def test_indices_are_sorted_with_the_strongest_on_top(page_of: Pages, result_of: Results) -> None:
    with result_of("tolerance") as result, result.slideway.sensitivity as group:
        totals = dict(zip(group["input"].values.tolist(), group["peak_normal_force_total"].values.tolist(), strict=True))
    trace = page_of("tolerance").read.figure("sensitivity")[0]["data"][0]
    assert np.allclose(unpacked(trace["x"]), [totals[name] for name in trace["y"]], rtol=1e-6)
    assert trace["y"][-1] == max(totals, key=lambda name: abs(totals[name]))


def test_the_film_holds_the_stored_poses(page_of: Pages, result_of: Results) -> None:
    film = page_of("single").read.data["film"]
    one = film["members"][0]
    count = one["count"]
    assert count == 2000
    assert one["of"] == 4001
    with result_of("single") as result:
        time = result["time"].values
        kept = np.searchsorted(time, unpacked(one["time"]) - 1e-12)
        stored = np.stack([result[name].values[0, kept] for name in ("surfaces", "lines", "points")], 1)
        assert np.allclose(unpacked(one["y"]), result["y"].values[0, kept] * 1e3, rtol=1e-6, atol=1e-9)
    assert (unpacked(one["modes"]).reshape(-1, 3) == stored).all()
    assert ((unpacked(one["touching"]) > 0) == (stored.sum(1) > 0)).all()


@pytest.mark.parametrize("name", ["lyapunov", "stored"])
def test_without_series_there_is_one_line_in_place_of_the_film(name: str, page_of: Pages) -> None:
    read = page_of(name).read
    assert "film" not in read.data
    assert "play" not in read.ids
    assert re.search("no time series", read.text)


def test_controls_are_elements_of_the_keyboard_with_names(page_of: Pages) -> None:
    read = page_of("ensemble").read
    for name in ("play", "back", "forward", "contact", "speed", "frame", "film-choice", "series-choice"):
        tag, attributes = next((tag, known) for tag, known in read.tags if known.get("id") == name)
        assert tag in ("button", "select", "input")
        assert attributes.get("tabindex") is None
    headings = [tag for tag, _ in read.tags if re.fullmatch("h[1-6]", tag)]
    assert headings[0] == "h1"
    assert headings.count("h1") == 1
    assert all(attributes.get("aria-label") for tag, attributes in read.tags if attributes.get("role") == "img")


HOSTILE = '</script><script>document.title="harmed"</script><img src=x onerror=alert(1)>&amp;"\''


def hostile(result: xr.Dataset) -> xr.Dataset:
    """A result whose every text wants to be code."""
    made = result.load().copy()
    made.encoding = dict(result.encoding)
    made.attrs |= {"title": HOSTILE, "commit": HOSTILE, "compiler": HOSTILE}
    made.attrs["scene"] += "# " + HOSTILE
    for name in made.data_vars:
        made[name].attrs["long_name"] = HOSTILE
    return made


def test_text_of_a_file_is_no_code(result_of: Results, tmp_path: object) -> None:
    with result_of("ensemble") as result:
        plain = Reader(report.page.html_of(result))
        text = report.page.html_of(hostile(result))
    read = Reader(text)
    assert HOSTILE in read.text
    assert [tag for tag, _ in read.tags].count("script") == [tag for tag, _ in plain.tags].count("script")
    assert not any(tag == "img" for tag, _ in read.tags)


def test_text_of_a_file_neither_moves_a_cursor_nor_turns_around(result_of: Results) -> None:
    with result_of("ensemble") as result:
        made = result.copy()
    made.attrs |= {"title": "a \x9b2J \u202e txet \x1b[2J"}
    text = report.page.html_of(made)
    assert not re.search("[\x1b\x80-\x9f\u202a-\u202e\u2066-\u2069]", text.split("<script")[0])
    assert "a \\u009b2J \\u202e txet \\u001b[2J" in Reader(text).text


def test_resolution_is_what_the_program_says(page_of: Pages) -> None:
    page = page_of("ensemble")
    assert "resolution" in page.read.ids
    assert "Not checked against tighter tolerances" in page.read.text
