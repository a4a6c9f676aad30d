"""What goes to other processes: ensembles, results and errors; studies that are spread over processes."""

from __future__ import annotations

import copy
import pickle
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import slideway
import xarray as xr
from conftest import root, small

example = root / "python" / "examples" / "spread_study.py"


@pytest.fixture(autouse=True)
def _program(program: str) -> None:
    """Every test here has one."""


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda ensemble: pickle.loads(pickle.dumps(ensemble))], ids=["copy", "deepcopy", "pickle"])
def test_a_copy_of_an_ensemble_has_its_scene_settings_and_bits(copied: Callable[[slideway.Ensemble], slideway.Ensemble]) -> None:
    original = slideway.Ensemble(small, threads=1, contact__law="conservative", set={"study.members": 5})
    other = copied(original)
    assert len(other) == 5 and other.resolved == original.resolved
    xr.testing.assert_identical(other.run().assign_attrs(created=""), original.run().assign_attrs(created=""))
    with pytest.raises(slideway.SceneError, match="joint.clearance is -1"):
        other.run(joint__clearance=-1.0)


def test_a_scene_beside_its_table_is_found_from_another_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "rows.csv").write_text("joint.clearance\n1e-4\n2e-4\n", encoding="utf-8")
    study = 'kind = "tolerance"\ndesign = "table"\ntable = "rows.csv"\nduration = "1 ms"\nquantities = ["peak_tilt"]\n'
    (tmp_path / "own.toml").write_text(f"schema = 1\n[study]\n{study}", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    pickled = pickle.dumps(slideway.Ensemble("own.toml"))
    monkeypatch.chdir(root)
    assert pickle.loads(pickled).members().joint_clearance.values.tolist() == [1e-4, 2e-4]


def test_a_result_in_memory_takes_its_file_along(tmp_path: Path) -> None:
    script = f"import slideway, sys, pickle; pickle.dump(slideway.Ensemble({small!r}, verify=True).run(), sys.stdout.buffer)"
    received = pickle.loads(subprocess.run([sys.executable, "-c", script], cwd=tmp_path, capture_output=True, check=True).stdout)
    own = slideway.Ensemble(small, verify=True).run()
    np.testing.assert_array_equal(received.peak_normal_force, own.peak_normal_force)
    assert slideway.groups(received) == ["verification"]
    with slideway.open(received.slideway.path) as file, slideway.open(own.slideway.path) as expected:
        assert file.attrs["payload_hash"] == expected.attrs["payload_hash"]


def test_results_of_the_program_go_to_other_processes(tmp_path: Path) -> None:
    for result in (slideway.run(small, progress=False), slideway.run(small, tmp_path / "a.nc", progress=False)):
        other = pickle.loads(pickle.dumps(result))
        np.testing.assert_array_equal(other.peak_normal_force, result.peak_normal_force)
        other.close()
        assert Path(result.slideway.path).exists()


def test_errors_go_to_other_processes(tmp_path: Path) -> None:
    for call, kind in ((lambda: slideway.run(small, progress=False, study__members=0), slideway.SceneError),
                       (lambda: slideway.run(small, progress=False, integrator__max_steps=2), slideway.TooManyFailures),
                       (lambda: slideway.open(tmp_path / "gone.nc"), slideway.SlidewayError)):  # fmt: skip
        with pytest.raises(kind) as caught:
            call()
        other = pickle.loads(pickle.dumps(caught.value))
        assert type(other) is kind and str(other) == str(caught.value) and getattr(other, "code", 0) == getattr(caught.value, "code", 0)


def spread(way: str) -> str:
    done = subprocess.run([sys.executable, str(example), way, "2"], capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.slow
def test_a_study_spread_by_joblib_has_the_payload_hash_of_one_process() -> None:
    pytest.importorskip("joblib")
    alone = spread("serial")
    assert "48 members" in alone and alone == spread("joblib")


@pytest.mark.slow
def test_a_study_spread_by_dask_has_the_payload_hash_of_one_process() -> None:
    pytest.importorskip("distributed")
    assert spread("dask") == spread("serial")


@pytest.mark.parametrize(
    ("values", "says"),
    [
        (np.array([1e-4 + 1j]), "complex; give real numbers"),
        (np.array([1e-4 + 0j]), "complex; give real numbers"),
        ([1e-4, 1e-4j], "complex; give real numbers"),
        (xr.DataArray([1j]), "complex; give real numbers"),
        (np.ma.masked_equal([1e-4, 0.0], 0.0), "has masked entries"),
        ([np.ma.masked_equal([1e-4, 0.0], 0.0)], "has masked entries"),
        ([1e-4, np.ma.masked], "has masked entries"),
        (np.array([1], "m8[s]"), "dates or durations"),
    ],
)
def test_parts_of_numbers_are_not_left_out_without_a_word(values: Any, says: str) -> None:
    ensemble = slideway.Ensemble(small)
    for call in (lambda: ensemble.run(inputs={"joint.clearance": values}), lambda: ensemble.probe({"y": values}), lambda: ensemble.probe({"y": 0.0}, values),
                 lambda: slideway.control_variate(values, [1.0, 2.0])):  # fmt: skip
        with pytest.raises(slideway.SlidewayError, match=says):
            call()


def test_masks_that_hide_nothing_are_taken() -> None:
    given = slideway.Ensemble(small).run(inputs={"joint.clearance": np.ma.array([1e-4, 2e-4])})
    assert given.joint_clearance.values.tolist() == [1e-4, 2e-4]
