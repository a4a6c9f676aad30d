"""The pages in headless Chromium without a network."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
import xarray as xr
from slideway import report

from .browser import Browser, Seen
from .conftest import Page
from .test_page import SUITED, hostile

Pages = Callable[[str], Page]
Looks = Callable[..., Seen]

@pytest.mark.parametrize("name", ["ensemble", "lyapunov", "poincare", "sweep", "tolerance", "stored", "failing"])
def test_a_page_draws_all_its_plots_and_fetches_nothing(name: str, seen_of: Looks) -> None:
    seen = seen_of(name)
    assert seen.complaints == []
    assert seen.fetched == []
    drawn = seen.found["plots"]["drawn"]
    assert SUITED[name] - {"convergence"} <= set(drawn)
    assert all(count > 0 for count in drawn.values()), drawn


def test_complaints_of_a_page_are_heard(page_of: Pages, browser: Browser) -> None:
    probe = """
      setTimeout(() => { throw new Error("on purpose") });
      const answer = await fetch("https://example.org").catch(() => "refused");
      await new Promise((done) => setTimeout(done, 100));
      return answer;
    """
    seen = browser.look(page_of("stored").path, probe)
    assert seen.found == "refused"
    assert any("on purpose" in line for line in seen.complaints)
    assert any("Content Security Policy" in line for line in seen.complaints)


PLAY = """
  const stage = document.getElementById("stage"), wait = (ms) => new Promise((done) => setTimeout(done, ms));
  const state = () => [Number(stage.dataset.frame), document.getElementById("now-time").textContent,
                       document.querySelector("#view-end .near").getAttribute("d")];
  const start = state();
  document.getElementById("play").click();
  await wait(600);
  const later = state();
  document.getElementById("play").click();
  const paused = state();
  await wait(200);
  document.getElementById("contact").click();
  const still = Number(stage.dataset.frame), mode = document.getElementById("now-mode").textContent;
  const slide = document.getElementById("frame");
  slide.value = 5;
  slide.dispatchEvent(new Event("input"));
  return { start, later, paused, still, mode, slid: state() };
"""


def test_the_animation_runs_and_obeys_its_controls(page_of: Pages, browser: Browser) -> None:
    found = browser.look(page_of("ensemble").path, PLAY).found
    assert found["start"][0] == 0
    assert found["later"][0] > 0
    assert found["later"][1] != found["start"][1]
    assert found["later"][2] != found["start"][2]
    assert found["paused"][0] == found["later"][0]
    assert found["still"] > found["paused"][0]
    assert "free" not in found["mode"]
    assert found["slid"][0] == 5


# Distance of the drawn slider from each apex, by the outline of the end at which the apex is, in millimetres of the drawing.
TOUCH = """
  const near = (px, py, [ax, ay], [bx, by]) => {
    const t = Math.max(0, Math.min(1, ((px - ax) * (bx - ax) + (py - ay) * (by - ay)) / ((bx - ax) ** 2 + (by - ay) ** 2)));
    return Math.hypot(px - ax - t * (bx - ax), py - ay - t * (by - ay));
  };
  const rows = [];
  for (let k = 0; k < 40; ++k) {
    document.getElementById("contact").click();
    for (const apex of document.querySelectorAll("#view-end .apex")) {
      const end = apex.classList.contains("back") ? "#view-end .far" : "#view-end .near";
      const hole = document.querySelector(end).getAttribute("d").split("Z")[1].slice(1);
      const ring = hole.split("L").map((corner) => corner.split(",").map(Number));
      const [x, y] = [Number(apex.getAttribute("cx")), Number(apex.getAttribute("cy"))];
      const distance = Math.min(...ring.map((corner, i) => near(x, y, corner, ring[(i + 1) % 4])));
      rows.push([/ on[123]/.test(apex.getAttribute("class")), distance]);
    }
  }
  return rows;
"""


def test_what_is_lit_touches_in_the_drawing(page_of: Pages, browser: Browser) -> None:
    rows = browser.look(page_of("ensemble").path, TOUCH).found
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
