"""What a run says of its own numbers, in Python."""

from __future__ import annotations

from pathlib import Path

import pytest
import slideway

FALL = """schema = 1
[mechanism]
kind = "scotch_yoke"
[contact]
law = "rigid"
restitution = 0.5
[study]
members = 40
duration = "{duration}"
quantities = ["damping_loss", "contact_onsets"]
verify = {verify}
[study.vary]
"initial.y" = {{ dist = "unif", low = "-0.05 mm", high = "0.05 mm" }}
"mechanism.crank_speed" = {{ dist = "values", values = [3, 30] }}
"""


def run(folder: Path, program: str, duration: str, verify: int) -> slideway.Resolution:
    scene = folder / "fall.toml"
    scene.write_text(FALL.format(duration=duration, verify=verify))
    with slideway.run(scene, output=folder / f"fall_{verify}.nc") as result:
        found = slideway.resolution(result)
    assert found is not None
    return found


def test_each_number_of_each_group_has_a_verdict(tmp_path: Path, program: str) -> None:
    found = run(tmp_path, program, "5 ms", 40)
    assert set(found.numbers.sizes) >= {"members_of", "checked"}
    assert found.numbers.sizes["members_of"] == 3, "all members, and those of either speed"
    everybody = found.numbers.sel(members_of="all members")
    assert set(everybody.verdict.values.tolist()) <= {"resolved", "error_bounded", "undecided", "not_resolved"}
    # Before anything touches no loss is made by anybody.
    assert found.verdict == "resolved"
    assert found
    assert (everybody.error_bound.values <= everybody.margin.values).all()
    assert (found.numbers.pairs.values[0] == 40).any() or (found.numbers.pairs.values[0] >= 8).all()


def test_what_was_not_checked_has_no_numbers(tmp_path: Path, program: str) -> None:
    found = run(tmp_path, program, "1 ms", 0)
    assert found.verdict == "not_checked"
    assert not found
    assert not found.numbers.sizes
    assert "study.verify is 0" in found.summary


def test_a_file_is_as_good_as_its_dataset(tmp_path: Path, program: str) -> None:
    run(tmp_path, program, "1 ms", 0)
    assert slideway.resolution(tmp_path / "fall_0.nc") is not None
    with pytest.raises(slideway.SlidewayError):
        slideway.resolution(tmp_path / "missing.nc")
