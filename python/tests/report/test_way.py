"""Drawings in a way that is moved and turned: places are made in the way and brought out of it by hand."""

from __future__ import annotations

import html
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
import slideway
import xarray as xr
from slideway.report import page

from .conftest import Reader, unpacked

gap, offset, pitch = 1e-4, 0.05, 0.02
time = np.linspace(0.0, 2.0, 201)
own_y, own_z = gap * np.sin(5 * time), gap * np.cos(5 * time)  # from the way's axis
mechanisms = {
    "carriage": "carriage_speed = 0.06\nstroke = 0.15\nreversal_time = 0.02",
    "slider_crank": "crank_length = 0.05\nrod_length = 0.2\ncrank_speed = 3.0",
    "free_slider": "",
}


def scene_of(kind: str) -> str:
    return f"""
[mechanism]
kind = "{kind}"
{mechanisms[kind]}
[joint]
slider_length = 0.04
way_width = 0.02
way_depth = 0.03
clearance_y = {gap}
clearance_z = {gap}
[way]
offset_y = {offset}
offset_z = 0.0
roll = 0.0
yaw = 0.0
pitch = {pitch}
[contact]
law = "conservative"
[study]
kind = "ensemble"
"""


def result_of(kind: str, s: np.ndarray, with_x: bool) -> xr.Dataset:
    """A member that was at s along the way: u = u_l + s (cos ψ, sin ψ, 0) + p_y (−sin ψ, cos ψ, 0) + p_z (0, 0, 1)."""
    length = 0.2 if kind == "slider_crank" else 0.0
    x = length + s * np.cos(pitch) - own_y * np.sin(pitch)
    y = offset + s * np.sin(pitch) + own_y * np.cos(pitch)
    zero = np.zeros_like(time)
    series = {"y": y, "z": own_z, "roll": zero, "yaw": zero, "pitch": zero + pitch} | ({"x": x} if with_x else {})
    flags = {"flag_values": np.array([0], "i1"), "flag_meanings": "finished"}
    return xr.Dataset(
        {name: (("member", "sample"), [values], {"units": "m"}) for name, values in series.items()}
        | {"status": ("member", np.array([0], "i1"), flags), "end_time": ("member", time[-1:])},
        coords={"member": [0], "time": ("sample", time)},
        attrs={"source": "slideway 0.1.0", "scene": scene_of(kind), "title": "made up"},
    )


def of_rod() -> np.ndarray:
    """s of a slider that a rod of 0.2 m reaches from the pin of a crank of 0.05 m: the root of |u − A| = L, by Newton."""
    pin = 0.05 * np.exp(3j * time)
    s = np.zeros_like(time)
    for _ in range(20):
        arm = 0.2 + offset * 1j + (s + 1j * own_y) * np.exp(1j * pitch) - pin
        miss = np.abs(arm) ** 2 + own_z**2 - 0.2**2
        s -= miss / (2 * np.real(arm * np.exp(-1j * pitch)))
    assert np.abs(miss).max() < 1e-15
    return s


carriage_s = (np.minimum(0.06 * time, 1.0) + own_y * np.sin(pitch)) / np.cos(pitch)
results = {
    "x stored": result_of("free_slider", 0.3 * time, True),
    "x of the carriage": result_of("carriage", carriage_s, False),
    "x of the rod": result_of("slider_crank", of_rod(), False),
}


def read(result: xr.Dataset, folder: Path) -> Reader:
    """The page about a result, which has to have a file."""
    result.to_netcdf(folder / "way.nc", engine="netcdf4")
    with slideway.open(folder / "way.nc", check=False) as opened:
        return Reader(page.html_of(opened))


every = pytest.mark.parametrize("result", results.values(), ids=results.keys())


@every
def test_series_and_its_clearance_are_from_the_axis_of_the_way(result: xr.Dataset) -> None:
    ax = slideway.plot.time_series(result, "y")
    assert ax.get_ylabel() == "y from the way's axis [µm]"
    np.testing.assert_allclose(ax.lines[-1].get_ydata(), 1e6 * own_y, atol=1e-6)
    assert {str(line.get_label()) for line in ax.lines} >= {"axis of the way", "clearance"}
    ends = sorted(float(line.get_ydata()[0]) for line in ax.lines if line.get_linestyle() == ":")
    assert ends == pytest.approx([-100, 100])


@every
def test_orbit_is_in_the_clearance_about_the_axis_of_the_way(result: xr.Dataset) -> None:
    ax = slideway.plot.orbit_yz(result)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("z from the way's axis [µm]", "y from the way's axis [µm]")
    np.testing.assert_allclose(ax.lines[0].get_ydata(), 1e6 * own_y, atol=1e-6)
    np.testing.assert_allclose(ax.lines[0].get_xdata(), 1e6 * own_z, atol=1e-6)
    assert len(ax.patches) == 1


@every
def test_page_draws_the_walls_about_the_axis_of_the_way(result: xr.Dataset, tmp_path: Path) -> None:
    made = read(result, tmp_path)
    series = made.figure("series")[0]
    drawn = {trace["name"]: unpacked(trace["y"]) for trace in series["data"]}
    np.testing.assert_allclose(drawn["y"], 1e6 * own_y, atol=1e-5)
    assert {shape["y0"] for shape in series["layout"]["shapes"]} == {-1e6 * gap, 1e6 * gap}
    assert "from the way's axis" in html.unescape(series["layout"]["yaxis"]["title"]["text"]).replace("<br>", " ")
    orbit = made.figure("orbit")[0]
    np.testing.assert_allclose(unpacked(orbit["data"][0]["y"]), 1e6 * own_y, atol=1e-5)
    assert "from the way's axis" in html.unescape(orbit["layout"]["yaxis"]["title"]["text"])


def test_without_a_place_along_a_turned_way_nothing_is_claimed(tmp_path: Path) -> None:
    result = results["x stored"].drop_vars("x")
    ax = slideway.plot.time_series(result, "y")
    assert [ax.get_ylabel(), len(ax.lines)] == ["y [mm]", 1]  # neither axis nor clearance
    assert len(slideway.plot.orbit_yz(result, ax=plt.figure().add_subplot()).patches) == 0
    assert "lack x" in read(result, tmp_path).text


def test_attitude_in_a_turned_way_has_no_ideal_of_zero() -> None:
    assert len(slideway.plot.time_series(results["x stored"], "pitch").lines) == 1


def test_way_that_varies_is_each_members_own() -> None:
    one = results["x stored"]
    straight = one.assign(y=one.y * 0 + own_y, x=one.x * 0 + 0.3 * time).assign_coords(member=[1])
    both = xr.concat([one, straight], "member").assign(way_offset_y=("member", [offset, 0.0]), way_pitch=("member", [pitch, 0.0]))
    both.attrs["scene"] = scene_of("free_slider") + 'vary = { "way.offset_y" = 0, "way.pitch" = 0 }\n'
    lines = slideway.plot.time_series(both, "y", gap=False).lines
    for line in lines[-2:]:
        np.testing.assert_allclose(line.get_ydata(), 1e6 * own_y, atol=1e-6)
