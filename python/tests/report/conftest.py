"""Pages of reports, written once for each recipe, and a browser to open them."""

from __future__ import annotations

import base64
import functools
import json
import shutil
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from slideway import report

from . import surveys
from .browser import Browser, Seen

kinds = {"f4": "<f4", "f8": "<f8", "u1": "<u1", "u2": "<u2"}


def unpacked(block: dict[str, str]) -> np.ndarray:
    """Numbers of a page, decoded apart from what packed them."""
    return np.frombuffer(base64.b64decode(block["bdata"]), kinds[block["dtype"]])


class Reader(HTMLParser):
    """What stands in a page: text, tables, elements by their id, data."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.ids: set[str] = set()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.words: list[str] = []
        self.rows: list[list[str]] = []
        self.data: dict[str, Any] = {}
        self._inside: list[str] = []
        self._script: str | None = None
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        known = dict(attrs)
        self.tags.append((tag, known))
        if known.get("id"):
            self.ids.add(str(known["id"]))
        if tag == "script" and known.get("type") == "application/json":
            self._script = known["id"]
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")
        self._inside.append(tag)

    def handle_endtag(self, tag: str) -> None:
        while self._inside and self._inside.pop() != tag:
            pass
        self._script = None

    def handle_data(self, data: str) -> None:
        if self._script:
            self.data[self._script] = json.loads(data)
        elif "script" not in self._inside and "style" not in self._inside:
            self.words.append(data)
            if self._inside and self._inside[-1] in ("td", "th"):
                self.rows[-1][-1] += data

    @property
    def text(self) -> str:
        return " ".join(" ".join(self.words).split())

    def row(self, first: str) -> list[str]:
        """The row of a table that begins so."""
        return next(row for row in self.rows if row and row[0] == first)

    def figure(self, name: str) -> list[dict[str, Any]]:
        """The variants of a figure."""
        return self.data["figures"][name]["variants"]


@dataclass(frozen=True)
class Page:
    path: Path
    html: str
    read: Reader


@pytest.fixture(scope="session")
def page_of(result_of: Callable[[str], xr.Dataset], tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Page]:
    """The page about a recipe's result."""
    folder = tmp_path_factory.mktemp("pages")
    made: dict[str, Page] = {}

    def of(name: str) -> Page:
        if name not in made:
            with result_of(name) as result:
                path = report.write(result, folder / f"{name}.html")
            text = path.read_text(encoding="utf-8")
            made[name] = Page(path, text, Reader(text))
        return made[name]

    return of


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Tests that open a page are slow ones: a browser is a quarter of what CI would have to install."""
    for item in items:
        if "browser" in getattr(item, "fixturenames", ()):
            item.add_marker(pytest.mark.slow)


@pytest.fixture(scope="session")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    """Headless Chromium; tests that need it are skipped where there is none."""
    program = shutil.which("chromium") or shutil.which("chromium-browser")
    if program is None:
        pytest.skip("there is no chromium to open pages with; scripts/setup.sh nightly installs it")
    opened = Browser(program, tmp_path_factory.mktemp("profile"))
    yield opened
    opened.close()


@pytest.fixture(scope="session")
def seen_of(page_of: Callable[[str], Page], browser: Browser) -> Callable[..., Seen]:
    """What all surveys found on the page about a recipe's result, opened once for each size and colours."""

    @functools.cache
    def of(name: str, width: int = 1200, dark: bool = False) -> Seen:
        after = surveys.CHANGING.get(name) if (width, dark) == (1200, False) else None
        return browser.look(page_of(name).path, surveys.ALL, width, dark, after)

    return lambda name, width=1200, dark=False: of(name, width, dark)
