"""Results of which something has changed on the disk, and results of other formats."""

from __future__ import annotations

import shutil
import warnings
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import slideway
import xarray as xr
from conftest import Result

format_1, format_2 = (Path(__file__).resolve().parents[2] / "tests" / "formats" / f"result_{k}.nc" for k in (1, 2))


@pytest.fixture
def copy(result_of: Result, tmp_path: Path) -> Path:
    """A result of its own."""
    return Path(shutil.copy(result_of("coarse").slideway.path, tmp_path / "a.nc"))


def refusal(path: Path) -> str:
    """What open says; groups and report.write say it too."""
    with pytest.raises(slideway.FileError) as caught:
        slideway.open(path)
    said = str(caught.value)
    assert caught.value.code == 4
    assert said.startswith(str(path)) and "\n" not in said
    page = path.with_suffix(".html")
    for call in (lambda: slideway.groups(path), lambda: slideway.report.write(path, page)):
        with pytest.raises(slideway.FileError) as again:
            call()
        assert str(again.value) == said
    assert not page.exists()
    return said


def test_changed_number_is_refused(copy: Path) -> None:
    with netCDF4.Dataset(copy, "a") as file:
        file["y"][0, 0] = 1.0
    assert "the data do not match their hash" in refusal(copy)
    with slideway.open(copy, check=False) as result:
        assert float(result.y[0, 0]) == 1.0


def test_changed_attribute_is_refused(copy: Path) -> None:
    with netCDF4.Dataset(copy, "a") as file:
        file["y"].units = "mm"
    assert "the attributes, names or group verification do not match their hash" in refusal(copy)
    with slideway.open(copy, check=False) as result:
        assert result.y.units == "mm"


def test_damage_after_the_first_look_is_seen(copy: Path) -> None:
    slideway.open(copy).close()
    with netCDF4.Dataset(copy, "a") as file:
        file["y"][0, 0] = 1.0
    refusal(copy)


def test_any_changed_byte_is_refused_or_does_not_matter(copy: Path) -> None:
    whole = copy.read_bytes()
    with slideway.open(copy) as result:
        expected = result.load()
    for at in range(3, len(whole), len(whole) // 40):
        copy.write_bytes(whole[:at] + bytes([whole[at] ^ 0x55]) + whole[at + 1 :])
        try:
            result = slideway.open(copy)
        except slideway.FileError as error:
            assert "\n" not in str(error)
        else:
            with result:
                xr.testing.assert_identical(result.load(), expected)


def test_newer_format_is_refused(copy: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    with netCDF4.Dataset(copy, "a") as file:
        file.format_version = np.int32(4)
    assert "is of format 4" in refusal(copy)
    with pytest.raises(slideway.SlidewayError, match="is of format 4, and this package reads formats 1 to 3"):
        slideway.open(copy, check=False)


@pytest.mark.parametrize("check", [True, False])
def test_format_1_is_read(check: bool, program: str, tmp_path: Path) -> None:
    with slideway.open(format_1, check=check) as result, netCDF4.Dataset(format_1) as file:
        np.testing.assert_array_equal(result.peak_normal_force.values, file["peak_normal_force"][:])
        assert slideway.statuses(result).values.tolist() == ["finished"] * 4
    assert slideway.groups(format_1) == ["statistics", "yield", "sensitivity", "verification"]
    with slideway.open(format_1, group="yield", check=check) as yields:
        assert yields.all_share.item() == 1.0  # no force is above the limit of 200 N
    if check:
        page = slideway.report.write(format_1, tmp_path / "p.html").read_text(encoding="utf-8")
        assert "A result of format 1" in page


@pytest.mark.parametrize("check", [True, False])
def test_format_2_is_read_under_the_names_of_now(check: bool, program: str, tmp_path: Path) -> None:
    with slideway.open(format_2, check=check) as result, netCDF4.Dataset(format_2) as file:
        assert "crank_work" not in result
        np.testing.assert_array_equal(result.drive_work.values, file["crank_work"][:])
        assert slideway.scene(result)["study"]["quantities"] == ["peak_normal_force", "drive_work"]
        assert list(slideway.members_table(result).columns)[1:4] == ["initial.y", "peak_normal_force", "drive_work"]
        mean = float(result.drive_work.mean())
    with slideway.open(format_2, check=check, variables=["drive_work"]) as result:
        assert list(result.data_vars) == ["drive_work"]
    with slideway.open(format_2, group="statistics", check=check) as statistics:
        np.testing.assert_allclose(statistics.drive_work_mean.item(), mean, rtol=1e-14)
    with slideway.open(format_2, group="yield", check=check) as yields:
        assert yields.limit.values.tolist() == ["drive_work"]
    with slideway.open(format_2, group="verification", check=check) as verification:
        assert verification.checked.values.tolist()[1:3] == ["drive_work [J]", "yield of drive_work [1]"]
    if check:
        page = slideway.report.write(format_2, tmp_path / "p.html").read_text(encoding="utf-8")
        assert "A result of format 2" in page and "drive_work" in page


def test_without_the_program_a_warning_says_so(copy: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr("slideway.program._packaged", lambda: None)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("SLIDEWAY_PROGRAM")
    with pytest.warns(UserWarning, match="a.nc: was not checked for damage .the program slideway was not found.") as said:
        slideway.open(copy).close()
    assert len(said) == 1
    assert said[0].filename == __file__
    assert "\n" not in str(said[0].message)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        slideway.open(copy, check=False).close()
