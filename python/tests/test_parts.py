"""A study in parts: what each takes, and what merging them does to the file that is there."""

from __future__ import annotations

import fcntl
import os
from pathlib import Path

import pytest
import slideway
from conftest import small


@pytest.fixture
def former(program: str, tmp_path: Path) -> bytes:
    """The second half of a study ran; out.nc is the result of a former one, with these bytes."""
    slideway.run_part(small, tmp_path / "out.nc", 2, 2)
    slideway.run(small, tmp_path / "former.nc", progress=False).close()
    os.rename(tmp_path / "former.nc", tmp_path / "out.nc")
    return (tmp_path / "out.nc").read_bytes()


def left(folder: Path) -> list[str]:
    return sorted(os.listdir(folder))


def test_parts_make_the_result_of_the_whole(program: str, tmp_path: Path) -> None:
    whole = slideway.run(small, tmp_path / "whole.nc", progress=False)
    output = tmp_path / "parts.nc"
    with pytest.raises(slideway.SlidewayError, match="run the parts of this output first"):
        slideway.merge(output)
    slideway.run_part(small, output, 2, 2)
    with pytest.raises(slideway.StoppedEarly, match="^slideway: 3 of 6 members have not run; run them and merge again$") as caught:
        slideway.merge(output)
    assert slideway.statuses(caught.value.dataset).values.tolist() == ["not_run"] * 3 + ["finished"] * 3
    slideway.run_part(small, output, 1, 2)
    for force in (False, True):
        assert slideway.merge(output, force=force).attrs["payload_hash"] == whole.attrs["payload_hash"]
    assert left(tmp_path) == ["parts.nc", "parts.nc.shards", "whole.nc"]
    with pytest.raises(slideway.SlidewayError, match="part is 3; give a whole number from 1 to 2"):
        slideway.run_part(small, output, 3, 2)


def test_merge_without_all_members_leaves_the_file_that_is_there(former: bytes, tmp_path: Path) -> None:
    output = tmp_path / "out.nc"
    with pytest.raises(slideway.StoppedEarly, match="3 of 6 members have not run"):
        slideway.merge(output, force=True)
    assert output.read_bytes() == former and left(tmp_path) == ["out.nc", "out.nc.shards"]


@pytest.mark.parametrize("force", [False, True])
def test_merge_that_a_signal_ends_leaves_what_is_there(former: bytes, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, force: bool) -> None:
    output = tmp_path / "out.nc"
    if not force:
        output.unlink()
    stopped = tmp_path / "stopped"
    line = "slideway: stopped early (signal): $4 was not made, and $2 is as it was: merge again"
    stopped.write_text(f'#!/bin/sh\necho "{line}" >&2\nexit 5\n', encoding="utf-8")
    stopped.chmod(0o755)
    monkeypatch.setenv("SLIDEWAY_PROGRAM", str(stopped))
    with pytest.raises(slideway.StoppedEarly) as caught:
        slideway.merge(output, force=force)
    assert str(caught.value) == f"slideway: stopped early (signal): {output} was not made, and {output}.shards is as it was: merge again"
    assert left(tmp_path) == ["out.nc"] * force + ["out.nc.shards", "stopped"]
    assert not force or output.read_bytes() == former


def test_merge_replaces_what_the_program_would(former: bytes, tmp_path: Path) -> None:
    output = tmp_path / "out.nc"
    with pytest.raises(slideway.FileError, match=f"^{output}: is there already; add --force"):
        slideway.merge(output)
    assert output.read_bytes() == former
    output.write_text("a letter", encoding="utf-8")
    with pytest.raises(slideway.FileError, match=f"^{output}: is there already, and is no file of slideway"):
        slideway.merge(output, force=True)
    assert output.read_text(encoding="utf-8") == "a letter"
    output.unlink()
    output.mkdir()
    with pytest.raises(slideway.FileError, match=f"^{output}: is no file"):
        slideway.merge(output, force=True)
    assert left(tmp_path) == ["out.nc", "out.nc.shards"]


def test_merge_goes_through_a_link(program: str, tmp_path: Path) -> None:
    slideway.run_part(small, tmp_path / "out.nc", 1, 1)
    (tmp_path / "disk").mkdir()
    (tmp_path / "out.nc").symlink_to("disk/far.nc")
    slideway.merge(tmp_path / "out.nc").close()
    assert (tmp_path / "out.nc").is_symlink() and left(tmp_path / "disk") == ["far.nc"]


def test_parts_and_errors_go_through_a_link_that_was_there_before(program: str, tmp_path: Path) -> None:
    (tmp_path / "link.nc").symlink_to("real.nc")
    slideway.run_part(small, tmp_path / "link.nc", 2, 2)
    assert left(tmp_path) == ["link.nc", "real.nc.shards"]
    with pytest.raises(slideway.StoppedEarly) as caught:
        slideway.merge(tmp_path / "link.nc")
    assert int((caught.value.dataset.status == 0).sum()) == 3
    slideway.run_part(small, tmp_path / "link.nc", 1, 2)
    assert slideway.merge(tmp_path / "link.nc").sizes["member"] == 6
    assert (tmp_path / "link.nc").is_symlink() and (tmp_path / "real.nc").is_file()


def test_merge_is_refused_while_a_part_is_at_work(former: bytes, tmp_path: Path) -> None:
    output = tmp_path / "out.nc"
    with open(f"{output}.shards/lock", "rb+") as lock:
        fcntl.flock(lock, fcntl.LOCK_SH)  # as a part has it while it runs
        with pytest.raises(slideway.FileError, match=f"^{output}: is being written by"):
            slideway.merge(output, force=True)
    assert output.read_bytes() == former


def test_parts_take_any_start_if_told_to(program: str, tmp_path: Path) -> None:
    with pytest.raises(slideway.SceneError, match="6 of 6 members start inside the way"):
        slideway.run_part(small, tmp_path / "out.nc", 1, 1, initial__z=3e-4, study__duration="1 us")
    slideway.run_part(small, tmp_path / "out.nc", 1, 1, any_start=True, initial__z=3e-4, study__duration="1 us")
    assert slideway.merge(tmp_path / "out.nc").sizes["member"] == 6
