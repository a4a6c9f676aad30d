"""The pages in headless Chromium without a network."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
import xarray as xr
from slideway import report

from .browser import Browser, Seen
from .test_page import SUITED, hostile

Looks = Callable[..., Seen]


@pytest.mark.parametrize("name", ["ensemble", "sweep", "tolerance", "stored", "lyapunov", "poincare", "failing"])
def test_a_page_draws_all_its_plots_and_fetches_nothing(name: str, seen_of: Looks) -> None:
    seen = seen_of(name)
    assert seen.complaints == []
    assert seen.fetched == []
    drawn = seen.found["plots"]["drawn"]
    assert SUITED[name] - {"convergence"} <= set(drawn)
    assert all(count > 0 for count in drawn.values()), drawn


def test_complaints_of_a_page_are_heard(seen_of: Looks) -> None:
    seen = seen_of("stored").after["complaints"]
    assert seen.found == "refused"
    assert any("on purpose" in line for line in seen.complaints)
    assert any("Content Security Policy" in line for line in seen.complaints)


def test_the_animation_runs_and_obeys_its_controls(seen_of: Looks) -> None:
    found = seen_of("ensemble").after["play"].found
    assert found["start"][0] == 0
    assert found["later"][0] > 0
    assert found["later"][1] != found["start"][1]
    assert found["later"][2] != found["start"][2]
    assert found["paused"][0] == found["later"][0]
    assert found["still"] > found["paused"][0]
    assert "free" not in found["mode"]
    assert found["slid"][0] == 5


def test_what_is_lit_touches_in_the_drawing(seen_of: Looks) -> None:
    rows = seen_of("ensemble").after["touch"].found
    touching = [distance for lit, distance in rows if lit]
    clear = [distance for lit, distance in rows if not lit]
    assert len(touching) >= 40
    assert max(touching) < 0.2  # the drawn clearance is 1.8 mm, and impacts press 18 times some micrometres
    assert sum(clear) / len(clear) > 0.5


@pytest.mark.parametrize("dark", [False, True])
def test_a_page_follows_the_readers_colours(dark: bool, seen_of: Looks) -> None:
    found = seen_of("stored", dark=dark).found["colours"]
    assert (found["paper"] < 0.3) == dark
    assert (found["ink"] > 0.7) == dark
    assert (found["label"] > 0.7) == dark


@pytest.mark.parametrize("name", ["ensemble", "failing"])
def test_a_page_fits_a_phone(name: str, seen_of: Looks) -> None:
    found = seen_of(name, width=390).found["plots"]
    assert found["overflow"] <= 0
    assert found["beyond"] <= 0


def test_hostile_text_does_nothing(result_of: Callable[[str], xr.Dataset], browser: Browser, tmp_path: Path) -> None:
    with result_of("ensemble") as result:
        path = report.write(hostile(result), tmp_path / "hostile.html")
    seen = browser.look(path, "return document.title")
    assert seen.complaints == []
    assert seen.found.startswith("</script><script>")
