"""Pages about mechanisms other than the spatial slider-crank, from results made up so that each contact is known."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray as xr

import slideway
from slideway import report

from .browser import Browser
from .conftest import Reader, unpacked

PLANAR = """
[mechanism]
kind = "planar_slider_crank"
crank_length = 0.15
rod_length = 0.3
crank_speed = 10.0
[joint]
slider_length = 0.1
slider_height = 0.05
clearance_y = 0.001
[contact]
restitution = 0.4
[study]
kind = "ensemble"
"""
CARRIAGE = """
[mechanism]
kind = "carriage"
carriage_speed = 0.06
stroke = 0.15
reversal_time = 0.02
[joint]
slider_length = 0.04
way_width = 0.02
way_depth = 0.03
clearance_y = 0.000125
clearance_z = 0.000125
[contact]
law = "conservative"
[study]
kind = "ensemble"
"""


def stored(path: Path, scene: str, time: np.ndarray, **series: np.ndarray) -> Path:
    """A result file of one member that finished."""
    flags = {"flag_values": np.array([0, 2], "i1"), "flag_meanings": "finished max_steps"}
    made = xr.Dataset(
        {name: (("member", "sample"), [values], {"units": "m"}) for name, values in series.items()}
        | {"status": ("member", np.array([0], "i1"), flags), "end_time": ("member", time[-1:]), "member": ("member", [0]), "time": ("sample", time)},
        attrs={"source": "slideway 0.1.0", "title": "made up", "scene": scene},
    )
    made.to_netcdf(path, engine="netcdf4")
    return path


STEPS = """
  const slide = document.getElementById("frame"), rows = [];
  for (let f = 0; f <= Number(slide.max); ++f) {
    slide.value = f;
    slide.dispatchEvent(new Event("input"));
    rows.push([document.getElementById("now-mode").textContent, document.querySelectorAll("#view-side .apex[class*=' on']").length,
               document.querySelectorAll("#view-side .face").length, document.querySelector("#view-strip rect.near").getAttribute("x")]);
  }
  return rows;
"""


def test_a_planar_block_lights_its_corners(browser: Browser, tmp_path: Path) -> None:
    gap, half = 1e-3, 0.05
    y = np.array([0.0, 1.001 * gap, 0.0, -0.5 * gap])
    pitch = np.array([0.0, 0.0, 1.1 * gap / half, 0.6 * gap / half])
    crank = np.array([0.0, 0.5, 1.0, 1.5])
    path = stored(tmp_path / "planar.nc", PLANAR, np.arange(4.0), y=y, pitch=pitch, crank_angle=crank)
    page = report.write(slideway.open(path, check=False), tmp_path / "planar.html")
    seen = browser.look(page, STEPS)
    assert seen.complaints == []
    assert [row[:3] for row in seen.found] == [
        ["(0, 0, 0) free flight", 0, 0],
        ["(1, 0, 0) 1 surface", 2, 1],
        ["(0, 0, 2) 2 points", 2, 2],
        ["(0, 0, 1) 1 point", 1, 1],
    ]
    place = 0.15 * np.cos(crank) + np.sqrt(0.3**2 - (y - 0.15 * np.sin(crank)) ** 2) - half
    assert np.allclose([float(row[3]) for row in seen.found], place * 1e3, rtol=1e-6)
    assert "Z up" not in Reader(page.read_text(encoding="utf-8")).text


def test_a_carriage_runs_as_prescribed_where_its_place_is_not_stored(browser: Browser, tmp_path: Path) -> None:
    time = np.array([0.0, 1.0, 2.5])
    zero = np.zeros(3)
    y = np.array([0.0, -0.000126, 0.0])  # down on the way with its whole upper face
    states = {"z": zero, "roll": zero, "yaw": zero, "pitch": zero}
    path = stored(tmp_path / "carriage.nc", CARRIAGE, time, y=y, **states)
    page = report.write(slideway.open(path, check=False), tmp_path / "carriage.html")
    read = Reader(page.read_text(encoding="utf-8"))
    one = read.data["film"]["members"][0]
    assert np.allclose(unpacked(one["x"]), [0, 60, 150])
    assert unpacked(one["modes"]).tolist() == [0, 0, 0, 1, 0, 0, 0, 0, 0]
    assert "links" not in one
    seen = browser.look(page, STEPS)
    assert seen.complaints == []
    assert [row[0] for row in seen.found] == ["(0, 0, 0) free flight", "(1, 0, 0) 1 surface", "(0, 0, 0) free flight"]


def test_spectra_are_in_decibels_of_g(tmp_path: Path) -> None:
    time = np.arange(1000) / 1000
    sine = 9.80665e-2 * np.sin(2 * np.pi * 50 * time)  # a hundredth of g: -40 dB
    zero = np.zeros(1000)
    states = {s: zero for s in ("y", "z", "roll", "yaw", "pitch")}
    path = stored(tmp_path / "s.nc", CARRIAGE, time, **states, acceleration_top=sine)
    with slideway.open(path, check=False) as result:
        trace = Reader(report.page.html_of(result)).figure("spectra")[0]["data"][0]
    level = unpacked(trace["y"])
    assert trace["name"] == "top sensor"
    assert np.isclose(unpacked(trace["x"])[level.argmax()], 50)
    assert np.isclose(level.max(), -40, atol=1e-3)


def test_a_member_without_samples_is_not_drawn(tmp_path: Path) -> None:
    nothing = np.full(3, np.nan)
    path = stored(tmp_path / "n.nc", CARRIAGE, np.arange(3.0), **{s: nothing for s in ("y", "z", "roll", "yaw", "pitch")})
    with slideway.open(path, check=False) as result:
        result["status"].values[:] = 2
        read = Reader(report.page.html_of(result))
    assert "film" not in read.data
    assert "No member has any samples" in read.text
