"""python -m slideway report, as the program calls it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
import slideway
import xarray as xr
from slideway.__main__ import main


def test_a_page_lies_beside_the_result(result_of: Callable[[str], xr.Dataset], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with result_of("stored") as result:
        copy = tmp_path / "a.b.nc"
        copy.write_bytes(Path(result.slideway.path).read_bytes())
    assert main(["report", str(copy)]) == 0
    page = tmp_path / "a.b.html"
    assert page.read_text(encoding="utf-8").startswith("<!doctype html>")
    assert str(page) in capsys.readouterr().out
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.b.html", "a.b.nc"]


def test_trouble_with_files_is_one_line_and_code_4(result_of: Callable[[str], xr.Dataset], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with result_of("stored") as result:
        path = result.slideway.path
    for arguments in (["report", str(tmp_path / "no.nc")], ["report", path, "-o", str(tmp_path / "no" / "p.html")]):
        assert main(arguments) == 4
        error = capsys.readouterr().err
        assert error.count("\n") == 1
        assert "no" in error


def test_bad_usage_is_code_2() -> None:
    with pytest.raises(SystemExit) as ended:
        main(["report"])
    assert ended.value.code == 2


def test_a_page_can_be_written_from_python(result_of: Callable[[str], xr.Dataset], tmp_path: Path) -> None:
    from slideway import report

    with result_of("poincare") as result:
        assert report.write(result, tmp_path / "p.html") == tmp_path / "p.html"
        with pytest.raises(slideway.SlidewayError, match="cannot write"):
            report.write(result, tmp_path / "nowhere" / "p.html")


def test_a_page_that_cannot_be_put_in_place_leaves_nothing(result_of: Callable[[str], xr.Dataset], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from slideway import report

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("slideway.report.page.os.replace", full)
    with result_of("poincare") as result, pytest.raises(slideway.SlidewayError, match="cannot write the report: No space left"):
        report.write(result, tmp_path / "p.html")
    assert list(tmp_path.iterdir()) == []


def test_pages_leave_the_files_of_others_alone(result_of: Callable[[str], xr.Dataset], tmp_path: Path) -> None:
    from slideway import report

    (tmp_path / "p.html.part").write_text("of another")
    with result_of("poincare") as result:
        report.write(result, tmp_path / "p.html")
    assert (tmp_path / "p.html.part").read_text() == "of another"
    (tmp_path / "new").touch()
    assert (tmp_path / "p.html").stat().st_mode == (tmp_path / "new").stat().st_mode
    assert len(list(tmp_path.iterdir())) == 3
