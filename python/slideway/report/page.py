"""The page: what was run, how it ended, what it means, and pictures to look into."""

from __future__ import annotations

import os
import tempfile
from importlib import resources
from pathlib import Path
from typing import Any

import xarray as xr

import slideway
from slideway.arguments import one_line
from slideway.arguments import path as path_text
from slideway.columns import columns
from slideway.errors import SlidewayError
from slideway.members import with_members
from slideway.palette import style_sheet
from slideway.results import StrPath

from . import animation, energy, linkages, poses, sections, statuses
from .figures import figures as figures_of
from .findings import exponent_words, yields
from .markup import Section, data_block, tag, words
from .members import chosen
from .numbers import counted, percent
from .traces import Figure, library, plot

# Nothing is fetched: the page may run its own scripts and show its own pictures, no more.
POLICY = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'"

# By which the program and this package know a page again.
GENERATOR = '<meta name="generator" content="slideway">'


@one_line
def write(result: StrPath | xr.Dataset, out: StrPath) -> Path:
    """Write a page about a result: one HTML file that needs no network and no other file.

    Args:
        result: a file of slideway run, or its Dataset from slideway.open.
        out: the page; an older page of slideway is replaced once the new one is complete, any other file is left.

    Returns:
        The path of the page.

    Raises:
        SlidewayError: the result cannot be read, the page cannot be written, or `out` is a file that is no page of slideway.

    >>> page = slideway.report.write(example_file, os.path.join(os.path.dirname(example_file), "page.html"))
    >>> page.read_text(encoding="utf-8")[:15]
    '<!doctype html>'
    """
    path = Path(path_text(out, "out"))
    place = Path(os.path.realpath(path))  # a link is followed, as by the program
    if os.path.exists(path) and not os.path.isfile(path):
        raise SlidewayError(f"{path}: is a folder, a device or a pipe; give the name of a file")
    if not _may_replace(place):
        raise SlidewayError(f"{path}: is there already, and is no page of slideway; give another name, or move it away")
    if isinstance(result, xr.Dataset):
        text = html_of(result)
    else:
        with slideway.open(result) as opened:
            text = html_of(opened)
    try:
        replace(place, text)
    except OSError as error:
        raise SlidewayError(f"{path}: cannot write the report: {error.strerror or error}") from error
    return path


def _may_replace(path: Path) -> bool:
    """Whether there is nothing that could be lost: no file, an empty one, or a page."""
    if not path.is_file():
        return True
    with open(path, encoding="utf-8", errors="replace") as file:
        head = file.read(1024)
    return not head or GENERATOR in head


def replace(path: Path, content: str | bytes) -> None:
    """Puts a text in a file that others see old or new, never in part; its unfinished name is this call's own."""
    descriptor, part = tempfile.mkstemp(prefix=f".{path.name}.", suffix=".part", dir=path.parent)
    try:
        with open(descriptor, "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        os.chmod(part, _usual_mode(path))
        os.replace(part, path)
    except BaseException:
        os.unlink(part)
        raise


def _usual_mode(path: Path) -> int:
    """Permissions of the file as it is, or of any new one: those of a temporary file are for its owner alone."""
    if path.exists():
        return path.stat().st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask


def html_of(result: xr.Dataset) -> str:
    """The page's text."""
    result = with_members(result)
    every = columns(result)
    ended = statuses.endings(result)
    audit = energy.audit(result, every)
    judged = audit.verdict
    resolved = slideway.resolution(result)
    film = _film(result)
    figures = linkages.figures(result) | figures_of(result, every, {} if isinstance(film, str) else film[0], audit)
    plots = [figure for name, figure in figures.items() if name != "balance"]
    parts = [
        sections.endings_section(result, ended),
        linkages.film_section(result) if linkages.is_linkage(result) else animation.animation_section(film if isinstance(film, str) else film[1]),
        sections.energy_section(judged, figures.get("balance")),
        sections.resolution_section(resolved),
        sections.summary_section(result, every),
        sections.plots_section(plots),
        sections.run_section(result, sum(ending.count for ending in ended)),
    ]
    there = [part for part in parts if part]
    title = str(result.attrs.get("title") or os.path.basename(slideway.results.path_of(result)))
    body = (
        tag("a", "Skip to the content", class_="skip", href="#content")
        + tag("div", _header(result, title, ended, judged, resolved, there), _main(there), _footer(result), class_="wrap")
        + _scripts(figures, film)
    )
    head = (
        '<meta charset="utf-8">'
        + GENERATOR
        + f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">'
        + '<meta name="viewport" content="width=device-width, initial-scale=1">'
        + tag("title", words(f"{title} – slideway report"))
        + tag("style", style_sheet() + _asset("page.css"))
    )
    return "<!doctype html>\n" + tag("html", tag("head", head), tag("body", body), lang="en") + "\n"


Film = tuple[dict[int, poses.Poses], dict[str, Any]]


def _film(result: xr.Dataset) -> Film | str:
    """Poses of the chosen members and the frames of them, or in one line why there are none."""
    why = poses.why_none(result)
    if why is not None:
        return why
    seen = {member: poses.poses(result, member) for member in chosen(result)}
    if not seen:
        return "No member has any samples, so there is nothing to draw."
    return seen, animation.frames(result, seen)


def _header(
    result: xr.Dataset, title: str, ended: list[statuses.Ending], judged: energy.Verdict, resolved: slideway.Resolution | None, parts: list[Section]
) -> str:
    cards = [(*statuses.headline(ended), "Members", "endings"), (judged.grade, judged.headline, "Energy", "energy")]
    if resolved is not None:
        grade, headline = sections.RESOLUTIONS.get(resolved.verdict, ("none", resolved.verdict))
        cards.append((grade, headline.split(":")[0], "Resolution", "resolution"))
    exponents = exponent_words(result) if "status" in result else []
    if exponents:
        cards.append(("none", exponents[0].split(", from")[0], "Chaos", "plots"))
    if limits := yields(result):
        _, _, trials, share, low, high = limits[-1]
        interval = f" ({percent(low, 3)} to {percent(high, 3)})" if low == low else ""
        cards.append(("none", f"{percent(share, 3)}{interval} of {counted(trials, 'member')} that ran meet all limits", "Yield", "summary"))
    items = [tag("li", tag("span", words(about)), tag("a", words(line), href=f"#{target}"), class_=grade) for grade, line, about, target in cards]
    links = [tag("li", tag("a", words(section.title), href=f"#{section.name}")) for section in parts]
    study = str(slideway.scene(result).get("study", {}).get("kind", ""))
    created = str(result.attrs.get("created", "")).replace("T", " ").replace("Z", " UTC")
    return tag(
        "header",
        tag("p", words(f"slideway report, study {study}, run {created}")),
        tag("h1", words(title)),
        tag("ul", *items, class_="cards"),
        tag("nav", tag("ul", *links), aria_label="Contents"),
    )


def _main(parts: list[Section]) -> str:
    def written(part: Section) -> str:
        heading = tag("h2", words(part.title), id=f"{part.name}-title")
        return tag("section", heading, part.body, id=part.name, aria_labelledby=f"{part.name}-title")

    return tag("main", *map(written, parts), id="content")


def _footer(result: xr.Dataset) -> str:
    version = result.attrs.get("version", "")
    made = f"Made by slideway's Python companion {slideway.__version__} from a result of slideway {version}."
    return tag("footer", words(f"{made} Quantities are in SI units unless a label says otherwise."))


def _scripts(figures: dict[str, Figure], film: Film | str) -> str:
    blocks = ""
    if figures:
        blocks += tag("script", library())
    data = {figure.name: {"height": figure.height, "variants": [plot(variant.panels) for variant in figure.variants]} for figure in figures.values()}
    blocks += data_block("figures", data)
    if not isinstance(film, str):
        blocks += data_block("film", film[1])
    return blocks + tag("script", _asset("page.js")) + tag("script", _asset("animation.js"))


def _asset(name: str) -> str:
    return resources.files(__package__).joinpath("assets", name).read_text(encoding="utf-8")
