"""All of it at a size of seconds: every claim judged, every figure under both laws, and what happens when a part fails."""

import re
import shutil
import sys
from pathlib import Path

import pytest
import reproduction.__main__
from reproduction import maps, modes
from reproduction.__main__ import reproduce
from reproduction.claims import LAWS
from reproduction.sections import Section

Made = tuple[Path, list[Section], list[str]]


@pytest.fixture(scope="module")
def made(scenes: Path, tmp_path_factory: pytest.TempPathFactory) -> Made:
    output = tmp_path_factory.mktemp("reproduction")
    sections, failures = reproduce(scenes, output, "tiny", 2, lambda line: None)
    return output, sections, failures


def test_every_part_is_made(made: Made) -> None:
    assert made[2] == []
    titles = " ".join(section.title for section in made[1])
    for part in ("Table 1", "Figs. 3–5", "6–8", "Fig. 11", "Fig. 12", "Fig. 13", "Fig. 14", "Fig. 15", "Fig. 17", "Fig. 19"):
        assert part in titles


def test_every_claim_has_numbers_of_both_laws_and_a_verdict(made: Made) -> None:
    claims = [claim for section in made[1] for claim in section.claims]
    assert len(claims) > 40
    for claim in claims:
        for law in LAWS:
            assert any(re.search(r"\d", line) for line in claim.findings[law].lines), claim.words
        assert claim.verdict.words and claim.verdict.kind in ("yes", "part", "no", "open")


def test_every_section_with_claims_has_figures_of_both_laws_and_the_energy_audit(made: Made) -> None:
    for section in made[1]:
        if section.claims:
            assert section.figures
            assert any("ε" in table.caption for table in section.tables), section.title
        for figure in section.figures:
            assert set(figure.images) == set(LAWS)
            for law, image in figure.images.items():
                assert isinstance(image, bytes) and image.startswith(b"\x89PNG"), f"{figure.caption} {law}: {image[:80]!r}"


def test_the_page_shows_all_of_it_without_a_network(made: Made) -> None:
    text = (made[0] / "reproduction.html").read_text(encoding="utf-8")
    figures = sum(len(section.figures) for section in made[1])
    assert text.count('src="data:image/png;base64,') == 2 * figures
    assert text.count("<h3>law as published</h3>") == text.count("<h3>conservative law</h3>") == figures
    assert not re.search(r'(?:src|href)="(?!data:|#)', text)
    assert re.search(
        r"made -?\d+ to -?\d+ % of the drive's work out of nothing, the conservative law less than \S+ %", text.replace("&#x27;", "'")
    )
    assert "prefers-color-scheme: dark" in text and 'name="viewport"' in text


def test_a_part_that_fails_is_one_line_and_the_rest_is_there(
    made: Made, scenes: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    output, broken = tmp_path / "output", tmp_path / "scenes"
    shutil.copytree(made[0], output)
    shutil.copytree(scenes, broken)
    (broken / "slider_crank_0.15mm.toml").write_text("schema = 1\n[joint]\nclearance = -1\n")
    # A section that needs the scene, and one that does not: the others were drawn above.
    monkeypatch.setattr(reproduction.__main__, "SECTIONS", (modes.section, maps.section))
    monkeypatch.setattr(sys, "argv", ["reproduction", str(output), "--scale", "tiny", "--scenes", str(broken)])
    assert reproduction.__main__.main() == 1
    words = capsys.readouterr().err
    assert len(words.splitlines()) == 1 and "crank_0.15mm" in words
    text = (output / "reproduction.html").read_text(encoding="utf-8")
    assert "the section cannot be made" in text
    assert "Fig. 17: the map" in text
