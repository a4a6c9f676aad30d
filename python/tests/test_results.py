"""Result files as Datasets, against what the bare netCDF4 library reads of them."""

from __future__ import annotations

from pathlib import Path

import netCDF4
import numpy as np
import pytest
import slideway
import xarray as xr
from conftest import Result


def test_numbers_are_those_of_the_file(result_of: Result) -> None:
    result = result_of("ensemble")
    with netCDF4.Dataset(result.slideway.path) as file:
        np.testing.assert_array_equal(result.y.values, file["y"][:].filled(np.nan))
        np.testing.assert_array_equal(result.peak_apex_force.sel(apex="P3").values, file["peak_apex_force"][:, 2])
        assert result.y.units == file["y"].units == "m"


def test_samples_are_found_by_time(result_of: Result) -> None:
    result = result_of("ensemble")  # 401 samples over 20 ms
    np.testing.assert_array_equal(result.z.sel(time=0.005, method="nearest").values, result.z.values[:, 100])


def test_impact_speeds_have_faces_and_speeds_for_labels(program: str, tmp_path: Path) -> None:
    scene = {"schema": 1, "contact": {"law": "conservative"}, "study": {
        "members": 4, "duration": "20 ms", "quantities": ["impact_speeds", "face_onsets", "peak_apex_force"],
        "vary": {"initial.y": {"dist": "unif", "low": "-0.05 mm", "high": "0.05 mm"}}}}  # fmt: skip
    speeds = ["0", "0.001", "0.003", "0.01", "0.03", "0.1", "0.3", "1"]
    names = [f"{face}_{speed}" for face in ("y_plus", "y_minus", "z_plus", "z_minus") for speed in speeds]
    for result in (slideway.run(scene, progress=False), slideway.run(scene, tmp_path / "a.nc", progress=False)):
        assert list(result.face_speed.values) == names
        assert list(result.apex.values) == [f"P{k}" for k in range(1, 9)]
        np.testing.assert_array_equal(result.impact_speeds.values.reshape(4, 4, 8).sum(axis=2), result.face_onsets.values)
        assert result.face_onsets.sum() > 0
        assert list(slideway.members_table(result).filter(like="impact_speeds").columns) == [f"impact_speeds[{name}]" for name in names]
    scene["study"]["store"] = "statistics"  # type: ignore[index]
    kept = slideway.run(scene, tmp_path / "k.nc", progress=False)
    np.testing.assert_allclose(kept.slideway.statistics.impact_speeds_mean.values, result.impact_speeds.mean("member").values, rtol=1e-12)


def test_modes_are_found_by_name(result_of: Result) -> None:
    result = result_of("ensemble")
    assert list(result.mode_class.values) == ["free", "point", "line", "surface"]
    np.testing.assert_allclose(result.mode_time.sum("mode_class").values, 0.02, rtol=1e-9)


@pytest.mark.parametrize(
    ("name", "groups"),
    [
        ("ensemble", ["verification"]),
        ("tolerance", ["statistics", "yield", "sensitivity", "verification"]),
        ("stored", ["statistics", "verification"]),
    ],
)
def test_groups_are_listed(result_of: Result, name: str, groups: list[str]) -> None:
    assert slideway.groups(result_of(name)) == groups


def test_groups_have_the_labels_of_the_file(result_of: Result) -> None:
    statistics = result_of("correlations").slideway.statistics
    assert list(statistics.mode_time_mean.mode_class.values) == ["free", "point", "line", "surface"]
    assert list(statistics.bound.values) == ["low", "high"]


def test_statistics_are_those_of_the_members(result_of: Result) -> None:
    result = result_of("correlations")
    mean = result.slideway.statistics.mode_time_mean.sel(mode_class="point")
    assert float(mean) == pytest.approx(float(result.mode_time.sel(mode_class="point").mean()), rel=1e-12)


def test_yield_and_sensitivity_are_reached(result_of: Result) -> None:
    result = result_of("correlations")
    kept = float((result.peak_normal_force <= 1000).mean())
    assert float(result.slideway.yields["share"].sel(limit="peak_normal_force")) == pytest.approx(kept)
    assert "way.roll" in result.slideway.sensitivity.input.values


@pytest.mark.parametrize("name", ["ensemble", "tolerance", "stored"])
def test_tree_has_the_members_and_every_group(result_of: Result, name: str) -> None:
    path = result_of(name).slideway.path
    tree = slideway.tree(path)
    assert sorted(tree.children) == sorted(slideway.groups(path))
    xr.testing.assert_identical(tree.to_dataset(), slideway.open(path))
    for group in slideway.groups(path):
        opened, within = slideway.open(path, group=group), tree[group].to_dataset()  # labels of the file's dimensions are the root's
        assert within.attrs == opened.attrs
        assert all(within[key].variable.identical(variable) for key, variable in opened.variables.items())


def test_group_that_is_not_there_names_those_that_are(result_of: Result) -> None:
    path = result_of("stored").slideway.path
    with pytest.raises(slideway.SlidewayError, match='has no group "yield", but statistics'):
        slideway.open(path, group="yield")


def test_failed_members_have_their_status_in_words(result_of: Result) -> None:
    result = result_of("failing")
    words = slideway.statuses(result)
    assert set(words.values) == {"max_steps"}
    assert not slideway.finished(result).any()
    assert set(slideway.statuses(result_of("ensemble")).values) == {"finished"}


def test_unknown_status_is_said_by_its_number() -> None:
    result = slideway.example()
    result["status"][0] = 77
    assert slideway.statuses(result).values[0] == "status 77"


def test_file_of_statistics_has_no_statuses(result_of: Result) -> None:
    with pytest.raises(slideway.SlidewayError, match="holds no members"):
        slideway.statuses(result_of("stored"))


def test_what_is_no_result_is_refused_in_one_line(tmp_path: Path) -> None:
    (tmp_path / "text.nc").write_text("no NetCDF")
    xr.Dataset({"a": 1}).to_netcdf(tmp_path / "other.nc")
    (tmp_path / "a.nc.shards").mkdir()
    for name, words in (("text.nc", "is no netCDF file"), ("other.nc", "not a result of slideway"), ("gone.nc", "no such file"),
                        ("a.nc.shards", "is a folder.*slideway merge")):
        with pytest.raises(slideway.SlidewayError, match=words) as caught:
            slideway.open(tmp_path / name)
        assert "\n" not in str(caught.value)
        assert str(tmp_path / name) in str(caught.value)


def test_dataset_without_file_says_so() -> None:
    with pytest.raises(slideway.SlidewayError, match="does not know its file"):
        _ = slideway.example().slideway.path


@pytest.mark.parametrize("name", ["poincare", "crossings", "sweep"])
def test_sections_are_those_of_their_member(result_of: Result, name: str) -> None:
    result = result_of(name)
    with netCDF4.Dataset(result.slideway.path) as file:
        counts = file["section_count"][:].astype(int)
        values = file["section_vy"][:]
    ends = np.cumsum(counts)
    assert counts.sum() > 0
    for member, (end, count) in enumerate(zip(ends, counts, strict=True)):
        own = slideway.sections(result, member=member)
        np.testing.assert_array_equal(own.vy.values, values[end - count : end])
        assert set(own.member.values) <= {member}


def test_sections_survive_a_selection_of_members(result_of: Result) -> None:
    result = result_of("poincare")
    one = slideway.sections(result.sel(member=[2]), member=2)
    np.testing.assert_array_equal(one.y.values, slideway.sections(result, member=2).y.values)


def test_sections_that_are_not_there_are_refused(result_of: Result) -> None:
    with pytest.raises(slideway.SlidewayError, match="has no sections"):
        slideway.sections(result_of("ensemble"))
    with pytest.raises(slideway.SlidewayError, match="no member 99"):
        slideway.sections(result_of("poincare"), member=99)
