"""Results of cranks that turn freely, sampled at equal angles: each member has times of its own."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import slideway
import xarray as xr
from slideway import report

SCENE = """
schema = 1
[mechanism]
kind = "scotch_yoke"
crank_speed = "9 rad/s"
[drive]
kind = "torque"
torque = "0.4 N m"
no_load_speed = "25 rad/s"
inertia = 0.004
[contact]
law = "conservative"
restitution = 0.6
[friction]
[study]
members = 12
revolutions = 1.5
time_limit = "20 s"
samples_per_revolution = 40
quantities = ["energy_residual", "ax", "normal_force", "surfaces", "lines", "points"]
[study.vary]
"initial.y" = { dist = "unif", low = "-0.09 mm", high = "0.09 mm" }
"""


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> xr.Dataset:
    path = Path(tmp_path_factory.mktemp("turns")) / "s.toml"
    path.write_text(SCENE)
    return slideway.run(path, progress=False)


def test_shares_of_samples_by_angle_are_not_called_time(result: xr.Dataset) -> None:
    words = [text.get_text() for text in slideway.plot.force_histogram(result).get_legend().get_texts()]
    assert any(word.startswith("point, ") and word.endswith(" of the samples") for word in words), words
    assert not any("time" in word for word in words)


def test_samples_are_found_by_angle_and_have_times(result: xr.Dataset) -> None:
    np.testing.assert_allclose(result.turned, np.linspace(0, 3 * np.pi, 61), atol=1e-14)
    assert result.time.dims == ("member", "sample") and "time" in result.coords
    np.testing.assert_array_equal(result.time[:, -1], result.end_time)
    np.testing.assert_allclose(result.crank_angle, result.turned.broadcast_like(result.crank_angle), atol=1e-10)
    half = result.y.sel(member=3, turned=np.pi, method="nearest")
    assert float(half.turned) == pytest.approx(np.pi) and float(half.time) == float(result.time[3, 20])


def test_tables_have_the_angle_as_index(result: xr.Dataset) -> None:
    frame = slideway.series(result, "y")
    assert list(frame.columns) == ["time", "y"] and frame.index.names == ["member", "turned"]
    assert isinstance(frame.index, pd.MultiIndex) and len(frame) == 12 * 61
    assert frame.attrs["units"] == {"time": "s", "y": "m"}
    np.testing.assert_array_equal(frame["time"].to_numpy(), result.time.values.ravel())


def test_series_are_drawn_over_turns(result: xr.Dataset) -> None:
    ax = slideway.plot.time_series(result, "y", member=[0, 1])
    assert ax.get_xlabel() == "turns of the crank"
    np.testing.assert_allclose(ax.lines[-1].get_xdata()[[0, -1]], [0, 1.5])
    assert slideway.plot.cumulative_area(result, "ax", member=0).get_xlabel() == "turns of the crank"
    with pytest.raises(slideway.SlidewayError, match="at equal angles"):
        slideway.plot.spectrum(result, "y", member=0)


def test_the_page_says_what_lies_at_which_angle(result: xr.Dataset) -> None:
    page = report.page.html_of(result)
    assert "9 degrees that the crank turns" in page and "turns of the crank" in page


def test_a_member_that_is_late_has_its_own_status(tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(SCENE)
    late = slideway.run(tmp_path / "s.toml", progress=False, max_failures="100%", study__time_limit="0.1 s")
    assert set(slideway.statuses(late).values) == {"out_of_time"}
    assert np.isfinite(late.time[:, 0]).all() and np.isnan(late.time[:, -1]).all()
