"""Large results: how large they are is said before they are read, and a part of them can be chosen."""

from __future__ import annotations

import os
import pickle
import shutil
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import slideway
import xarray as xr
from conftest import Result


@pytest.fixture
def vast(tmp_path: Path) -> Path:
    """A result of 1e9 members, none of which was written: a file of some kB."""
    path = tmp_path / "vast.nc"
    with netCDF4.Dataset(path, "w") as file:
        file.source, file.format_version, file.completeness = "slideway 0.2.0", 2, "complete"
        file.createDimension("member", 10**9)
        for name, kind, fill in (("member", "i4", 2**31 - 1), ("peak_normal_force", "f8", 0.0), ("status", "i1", 0)):  # numbers of members ascend
            file.createVariable(name, kind, ("member",), chunksizes=(10**6,), zlib=True, fill_value=fill)
        file["member"][:1000] = np.arange(1000)
        file["peak_normal_force"][:1000] = np.arange(1000) / 2
    return path


def test_a_thousand_million_members_say_their_size_before_they_are_read(vast: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("slideway.netcdf.read", lambda *given: pytest.fail("it was read"))
    with pytest.raises(slideway.SlidewayError, match=r"1,000,000,000 members, 13 GB of numbers in 3 variables.*4 GB of their labels; choose what you need: variables"):
        slideway.open(vast, check=False)


@pytest.mark.slow
def test_a_large_file_says_its_size_before_it_is_searched_for_damage(result_of: Result, monkeypatch: pytest.MonkeyPatch) -> None:
    path = result_of("single").slideway.path
    slideway.results._checked.pop(path, None)
    monkeypatch.setattr("slideway.sizes.largest_unsaid", 1000)
    with pytest.warns(UserWarning, match=r"single.nc: has [0-9.]+ [kM]B, all of which is read now to look for damage") as said:
        slideway.open(path).close()
    assert said[0].filename == __file__


def test_labels_of_a_large_file_are_refused_before_it_is_searched_for_damage(result_of: Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "copy.nc"
    shutil.copy(result_of("ensemble").slideway.path, path)
    monkeypatch.setattr("slideway.sizes.largest_unsaid", 1000)
    monkeypatch.setattr("slideway.sizes.largest_labels", 8)
    monkeypatch.setattr("slideway.results.call", lambda *given: pytest.fail("it was searched"))
    with pytest.raises(slideway.SlidewayError, match="holds 64 members"):
        slideway.open(path)


def test_variables_and_members_are_chosen(result_of: Result) -> None:
    path = result_of("ensemble").slideway.path
    whole = slideway.open(path)
    part = slideway.open(path, variables=["y", "mode_time"], members=(10, 19))
    assert set(part.data_vars) == {"y", "mode_time"} and set(part.coords) == {"member", "time", "mode_class"}
    xr.testing.assert_identical(part, whole[["y", "mode_time"]].sel(member=slice(10, 19)))
    xr.testing.assert_identical(slideway.open(path, members=(63, 99)), whole.sel(member=[63]))
    for wrong, says in (({"variables": ["yy"]}, 'no variable "yy"'), ({"variables": "y"}, "give a list of names"), ({"members": 3}, "the first and the last"),
                        ({"members": (64, 70)}, "no member from 64 to 70")):  # fmt: skip
        with pytest.raises(slideway.SlidewayError, match=says):
            slideway.open(path, **wrong)


@pytest.mark.parametrize("members", [(0, 0), (1, 2), (2, 9)])
def test_sections_of_chosen_members_are_theirs(result_of: Result, members: tuple[int, int]) -> None:
    path = result_of("poincare").slideway.path
    whole, part = slideway.open(path), slideway.open(path, members=members)
    there = [int(member) for member in part.member.values]
    assert there == [member for member in range(3) if members[0] <= member <= members[1]]
    for member in there:
        xr.testing.assert_equal(slideway.sections(part, member), slideway.sections(whole, member))
    assert part.sizes["section"] == sum(slideway.sections(whole, member).sizes["section"] for member in there)


def test_few_members_of_a_vast_result_are_read_at_once(vast: Path) -> None:
    part = slideway.open(vast, check=False, members=(998, 999), variables=["peak_normal_force"])
    assert part.peak_normal_force.values.tolist() == [499.0, 499.5] and part.member.values.tolist() == [998, 999]


@pytest.fixture
def beyond_limits(monkeypatch: pytest.MonkeyPatch) -> None:
    """All results are large."""
    monkeypatch.setattr("slideway.netcdf.largest_at_once", 0)
    monkeypatch.setattr("slideway.netcdf._small_column", 0)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["ensemble", "poincare", "tolerance", "stored", "failing"])
def test_what_is_read_when_it_is_used_is_the_same(result_of: Result, name: str, beyond_limits: None, tmp_path: Path) -> None:
    path = result_of(name).slideway.path
    lazily = slideway.open(path)
    assert not all(variable._in_memory for variable in lazily.variables.values())
    xr.testing.assert_identical(pickle.loads(pickle.dumps(lazily)), result_of(name))
    xr.testing.assert_identical(lazily, result_of(name))
    assert os.path.samefile(lazily.slideway.path, path)


def test_no_file_stays_open(result_of: Result, beyond_limits: None) -> None:
    result = slideway.open(result_of("ensemble").slideway.path)
    result.y[3, :5].load()
    files = [os.readlink(f"/proc/self/fd/{number}") for number in os.listdir("/proc/self/fd") if os.path.exists(f"/proc/self/fd/{number}")]
    assert not [name for name in files if name.endswith(".nc")]


def test_a_file_that_was_replaced_is_not_read_as_the_former(result_of: Result, beyond_limits: None, tmp_path: Path) -> None:
    path = tmp_path / "a.nc"
    shutil.copy(result_of("ensemble").slideway.path, path)
    result = slideway.open(path)
    shutil.copy(result_of("coarse").slideway.path, tmp_path / "b.nc")
    os.replace(tmp_path / "b.nc", path)
    with pytest.raises(slideway.SlidewayError, match="another file than when it was opened"):
        result.y.load()
    path.unlink()
    with pytest.raises(slideway.SlidewayError, match="is gone"):
        result.y.load()


def test_a_large_result_is_found_from_another_folder_and_written_again(result_of: Result, beyond_limits: None, tmp_path: Path,
                                                                         monkeypatch: pytest.MonkeyPatch) -> None:  # fmt: skip
    shutil.copy(result_of("ensemble").slideway.path, tmp_path / "a.nc")
    monkeypatch.chdir(tmp_path)
    result = slideway.open("a.nc")
    monkeypatch.chdir("/")
    result.to_netcdf(tmp_path / "b.nc")  # which holds xarray's lock while it writes
    with netCDF4.Dataset(tmp_path / "b.nc") as file:
        np.testing.assert_array_equal(file["y"][:], result_of("ensemble").y.values)
