"""Tables for other programs: what the program and the package make of a result, against the bare NetCDF file."""

from __future__ import annotations

import csv
import subprocess
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pandas as pd
import pytest
import scipy.io
import slideway
import xarray as xr
from conftest import Result, scenes

NAMES = ["ensemble", "lyapunov", "poincare", "crossings", "sweep", "columns", "tolerance", "failing"]


def exported(program: str, result: xr.Dataset, output: Path, *options: str) -> Path:
    subprocess.run([program, "export", result.slideway.path, "-o", str(output), *options], check=True, capture_output=True)
    return output


def csv_of(path: Path) -> pd.DataFrame:
    """Read by Python itself: older versions of pandas round numbers."""
    with path.open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    columns = zip(header, zip(*rows, strict=True), strict=True)
    return pd.DataFrame({name: cells if name in ("status", "member_label") else [float(c) if c else np.nan for c in cells] for name, cells in columns})


def test_pandas_reads_missing_numbers(program: str, result_of: Result, tmp_path: Path) -> None:
    result = result_of("failing")
    frame = pd.read_csv(exported(program, result, tmp_path / "o.csv"))
    np.testing.assert_allclose(frame["peak_normal_force [N]"].values, bare(result)["peak_normal_force"][1], rtol=1e-14)
    assert set(frame["status"]) == {"max_steps"} or frame["status"].nunique() == 2


def bare(result: xr.Dataset) -> dict[str, Any]:
    """Variables as they are stored, by names that netCDF4 gives."""
    with netCDF4.Dataset(result.slideway.path) as file:
        file.set_auto_mask(False)
        return {name: (variable.dimensions, np.asarray(variable[:]), getattr(variable, "units", "1")) for name, variable in file.variables.items()}


def mat_of(path: Path) -> dict[str, Any]:
    found: dict[str, Any] = scipy.io.loadmat(path, squeeze_me=False, struct_as_record=False)
    return found


@pytest.mark.parametrize("name", NAMES)
def test_members_have_the_numbers_of_the_file(program: str, result_of: Result, tmp_path: Path, name: str) -> None:
    result = result_of(name)
    frame = csv_of(exported(program, result, tmp_path / "o.csv"))
    members = mat_of(exported(program, result, tmp_path / "o.mat"))["members"][0, 0]
    stored = bare(result)
    vary = slideway.scenes.varied(result)
    seen = {"member", "status"}
    for variable, (dimensions, values, unit) in stored.items():
        if dimensions[:1] != ("member",) or "sample" in dimensions or variable == "status":
            continue
        key = next((key for key, named in vary.items() if named == variable), variable)
        flat = values.reshape(len(values), -1)
        suffix = "" if unit == "1" else f" [{unit}]"
        columns = [c for c in frame if c == f"{key}{suffix}" or (c.startswith(f"{key}[") and c.endswith(suffix) and len(dimensions) > 1)]
        assert len(columns) == flat.shape[1], variable
        np.testing.assert_array_equal(frame[columns].values, flat)
        for k, column in enumerate(columns):
            field = column.removesuffix(suffix).replace("][", "_").replace("[", "_").replace("]", "").replace(".", "_")
            assert getattr(members, field).shape == (len(values), 1)
            np.testing.assert_array_equal(getattr(members, field)[:, 0], flat[:, k])
        seen |= set(columns)
    assert seen == set(frame)
    np.testing.assert_array_equal(frame["status"].values, slideway.statuses(result).values)
    assert [str(word[0][0]) for word in members.status] == list(slideway.statuses(result).values)


@pytest.mark.parametrize("name", NAMES)
def test_frames_are_the_table_of_the_program(program: str, result_of: Result, tmp_path: Path, name: str) -> None:
    result = result_of(name)
    frame = result.slideway.members_table()
    table = csv_of(exported(program, result, tmp_path / "o.csv")).set_index("member")
    units = frame.attrs["units"]
    assert list(table) == [f"{column} [{units[column]}]" if column in units else column for column in frame]
    for column, other in zip(frame, table, strict=True):
        np.testing.assert_array_equal(frame[column].values, table[other].values)
    np.testing.assert_array_equal(frame.index, table.index)


def test_series_have_the_numbers_of_the_file(program: str, result_of: Result, tmp_path: Path) -> None:
    result = result_of("ensemble")
    stored = bare(result)
    table = csv_of(exported(program, result, tmp_path / "o.csv", "--series", "y,wz"))
    assert list(table) == ["member", "time [s]", "y [m]", "wz [rad s-1]"]
    frame = result.slideway.series("y", "wz")
    for name, column in (("y", "y [m]"), ("wz", "wz [rad s-1]")):
        np.testing.assert_array_equal(table[column].values, stored[name][1].ravel())
        np.testing.assert_array_equal(frame[name].values, stored[name][1].ravel())
    np.testing.assert_array_equal(table["time [s]"].values, np.tile(stored["time"][1], 64))
    np.testing.assert_array_equal(table["member"].values, np.repeat(stored["member"][1], 401))
    np.testing.assert_array_equal(frame.reset_index()[["member", "time"]].values, table[["member", "time [s]"]].values)
    file = mat_of(exported(program, result, tmp_path / "o.mat", "--series", "all"))
    series, units = file["series"][0, 0], file["units"][0, 0].series[0, 0]
    np.testing.assert_array_equal(series.time[:, 0], stored["time"][1])
    names = [name for name, (dimensions, _, _) in stored.items() if dimensions == ("member", "sample")]
    assert set(series._fieldnames) == {"member", "time", *names}
    for name in names:
        np.testing.assert_array_equal(getattr(series, name), stored[name][1])
        assert str(getattr(units, name)[0]) == stored[name][2]


def test_sections_have_the_numbers_of_the_file(program: str, result_of: Result, tmp_path: Path) -> None:
    result = result_of("crossings")
    stored = bare(result)
    table = csv_of(exported(program, result, tmp_path / "o.csv", "--sections"))
    sections = mat_of(exported(program, result, tmp_path / "o.mat", "--sections"))["sections"][0, 0]
    np.testing.assert_array_equal(table["member"].values, np.repeat(stored["member"][1], stored["section_count"][1]))
    np.testing.assert_array_equal(table["vz [m s-1]"].values, stored["section_vz"][1])
    np.testing.assert_array_equal(sections.vz[:, 0], stored["section_vz"][1])
    assert len(table.columns) == 1 + sum(dimensions == ("section",) for dimensions, _, _ in stored.values())


def test_labels_of_any_script_come_back(program: str, tmp_path: Path) -> None:
    labels = ["Prüfling 1, links", 'say "no"', "試料", "\U0001d70b"]
    rows = ['"' + label.replace('"', '""') + f'",{i + 1}e-5' for i, label in enumerate(labels)]
    (tmp_path / "m.csv").write_text("\n".join(["part,initial.y", *rows]) + "\n", encoding="utf-8")
    set_ = {"study.design": "table", "study.table": str(tmp_path / "m.csv"), "study.duration": "1 ms", "study.samples": 0}
    scene = {"schema": 1, "contact": {"law": "paper"}, "study": {}}
    with slideway.run(scene, tmp_path / "r.nc", set=set_, progress=False) as result:
        frame = csv_of(exported(program, result, tmp_path / "o.csv"))
        members = mat_of(exported(program, result, tmp_path / "o.mat"))["members"][0, 0]
        assert list(frame["member_label"]) == list(result.slideway.members_table()["member_label"]) == labels
        # MATLAB and scipy count the last one as two and one characters.
        assert [str(word[0][0]) for word in members.member_label] == [*labels[:3], "\ufffd"]
        np.testing.assert_array_equal(frame["initial.y [m]"].values, [1e-5, 2e-5, 3e-5, 4e-5])


def test_frames_of_results_in_memory_and_of_selections(result_of: Result) -> None:
    ensemble = slideway.Ensemble(scenes / "ensemble_starts.toml", study__members=4, study__duration="1 ms", study__samples=5)
    run = ensemble.run()
    assert "initial.y" in run.slideway.members_table()
    one = run.sel(member=2)
    pd.testing.assert_frame_equal(one.slideway.members_table(), run.slideway.members_table().loc[[2]])
    pd.testing.assert_frame_equal(one.slideway.series("y"), run.slideway.series("y").loc[[2]])
    with pytest.raises(slideway.SlidewayError, match="has no time series"):
        slideway.series(result_of("tolerance"))
    with pytest.raises(slideway.SlidewayError, match='no series "q"'):
        run.slideway.series("q")
    with pytest.raises(slideway.SlidewayError, match="holds no members"):
        slideway.members_table(result_of("stored"))
