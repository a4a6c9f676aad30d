"""The page: what was run, how it ended, what it means, and pictures to look into."""

from __future__ import annotations

import os
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

import xarray as xr

import slideway
from slideway.errors import SlidewayError
from slideway.results import StrPath

from . import animation, energy, facts, figures_members, figures_orbits, figures_series, figures_tolerance, poses, statuses
from .columns import Column, columns
from .markup import data_block, table, tag, words
from .markup import facts as fact_list
from .members import chosen
from .numbers import number, percent, scaled, unit_words
from .traces import Figure

# Nothing is fetched: the page may run its own scripts and show its own pictures, no more.
POLICY = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'"


@dataclass(frozen=True)
class Section:
    """A part of the page with a place in its table of contents."""

    name: str
    title: str
    body: str


def write(result: StrPath | xr.Dataset, out: StrPath) -> Path:
    """Write a page about a result: one HTML file that needs no network and no other file.

    Args:
        result: a file of slideway run, or its Dataset from slideway.open.
        out: the page; an older one is replaced once the new one is complete.

    Returns:
        The path of the page.

    Raises:
        SlidewayError: the result cannot be read, or the page cannot be written.
    """
    if isinstance(result, xr.Dataset):
        text = html_of(result)
    else:
        with slideway.open(result) as opened:
            text = html_of(opened)
    path = Path(os.fspath(out))
    part = path.with_name(path.name + ".part")
    try:
        part.write_text(text, encoding="utf-8")
        os.replace(part, path)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise SlidewayError(f"{path}: cannot write the report: {error.strerror or error}") from error
    return path


def html_of(result: xr.Dataset) -> str:
    """The page's text."""
    every = columns(result)
    ended = statuses.endings(result)
    judged = energy.verdict(result, every)
    film_or_why = _film(result)
    figures = _figures(result, every, film_or_why)
    pieces = [
        _endings_section(result, ended),
        _animation_section(film_or_why),
        _energy_section(result, every, judged, figures),
        _summary_section(result, every, figures),
        _plots_section(figures),
        _run_section(result, sum(ending.count for ending in ended)),
    ]
    sections = [piece for piece in pieces if piece]
    title = str(result.attrs.get("title") or os.path.basename(slideway.results.path_of(result)))
    body = (
        tag("a", "Skip to the content", class_="skip", href="#content")
        + tag("div", _header(result, title, ended, judged, sections), _main(sections), _footer(result), class_="wrap")
        + _scripts(figures, film_or_why)
    )
    head = (
        '<meta charset="utf-8">'
        + f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">'
        + '<meta name="viewport" content="width=device-width, initial-scale=1">'
        + tag("title", words(f"{title} – slideway report"))
        + tag("style", _asset("page.css"))
    )
    return "<!doctype html>\n" + tag("html", tag("head", head), tag("body", body), lang="en") + "\n"


Film = tuple[dict[int, poses.Poses], dict[str, object]]


def _film(result: xr.Dataset) -> Film | str:
    """Poses of the chosen members and the frames of them, or in one line why there are none."""
    why = poses.why_none(result)
    if why is not None:
        return why
    seen = {member: poses.poses(result, member) for member in chosen(result)}
    if not seen or any(len(pose.time) == 0 for pose in seen.values()):
        return "No member has any samples, so there is nothing to draw."
    return seen, animation.frames(result, seen)


def _figures(result: xr.Dataset, every: list[Column], film: Film | str) -> dict[str, Figure]:
    """All figures that suit the result, in their order on the page."""
    made: list[Figure | None] = []
    if not isinstance(film, str):
        seen, _ = film
        made += figures_series.time_series(result, seen)
        made += [figures_series.bands(result), figures_series.orbit(result, seen), figures_series.forces(result, seen)]
    if "status" in result:
        sweep = figures_orbits.bifurcation(result)
        made += [sweep or figures_orbits.poincare(result), *figures_orbits.exponents(result)]
    limits = slideway.scene(result).get("study", {}).get("limits", {})
    terms = energy.balance(result, every)
    made += [
        figures_members.mode_shares(every),
        figures_tolerance.sensitivity(result),
        figures_tolerance.quantiles(every, limits),
        figures_members.histograms(every),
        figures_members.energy_balance(terms) if terms else None,
    ]
    return {figure.name: figure for figure in made if figure}


def _header(
    result: xr.Dataset, title: str, ended: list[statuses.Ending], judged: energy.Verdict, sections: list[Section]
) -> str:
    cards = [(*statuses.headline(ended), "Members", "endings"), (judged.grade, judged.headline, "Energy", "energy")]
    exponents = figures_orbits.exponent_words(result) if "status" in result else []
    if exponents:
        cards.append(("none", exponents[0].split(", from")[0], "Chaos", "plots"))
    yields = figures_tolerance.yields(result)
    if yields:
        *_, share, low, high = yields[-1]
        interval = f" ({percent(low)} to {percent(high)})" if low == low else ""
        cards.append(("none", f"{percent(share)}{interval} meet all limits", "Yield", "summary"))
    items = [
        tag("li", tag("span", words(about)), tag("a", words(line), href=f"#{target}"), class_=grade)
        for grade, line, about, target in cards
    ]
    links = [tag("li", tag("a", words(section.title), href=f"#{section.name}")) for section in sections]
    study = str(slideway.scene(result).get("study", {}).get("kind", ""))
    created = str(result.attrs.get("created", "")).replace("T", " ").replace("Z", " UTC")
    return tag(
        "header",
        tag("p", words(f"slideway report, study {study}, run {created}")),
        tag("h1", words(title)),
        tag("ul", *items, class_="cards"),
        tag("nav", tag("ul", *links), aria_label="Contents"),
    )


def _main(sections: list[Section]) -> str:
    parts = [
        tag("section", tag("h2", words(one.title), id=f"{one.name}-title"), one.body, id=one.name, aria_labelledby=f"{one.name}-title")
        for one in sections
    ]
    return tag("main", *parts, id="content")


def _footer(result: xr.Dataset) -> str:
    version = result.attrs.get("version", "")
    return tag("footer", words(f"Made by slideway's Python companion {slideway.__version__} from a result of slideway {version}. Quantities are in SI units unless a label says otherwise."))


def _endings_section(result: xr.Dataset, ended: list[statuses.Ending]) -> Section:
    total = sum(ending.count for ending in ended)
    rows = [(one.status, f"{one.count:,}", percent(one.count / total), one.meaning) for one in ended]
    if [one.status for one in ended] == ["finished"]:
        return Section("endings", "How the members ended", tag("p", words(statuses.headline(ended)[1].replace("finished", "reached the end time") + ".")))
    body = table(("status", "members", "share", "meaning"), rows, "Members by how they ended", numeric=9)
    failed = statuses.failures(result)
    if failed:
        shown = sum(1 for _ in failed)
        all_failed = sum(one.count for one in ended if one.status not in ("finished", "not_run"))
        caption = "Members that failed" + (f", the first {shown} of {all_failed:,}" if all_failed > shown else "")
        lines = [(f"member {one.member}", one.status, f"{number(one.time)} s", one.where) for one in failed]
        named = table(("member", "why", "at time", "where it was"), lines, caption, numeric=9)
        body += tag("details", tag("summary", words(caption)), named, open=len(failed) <= 5)
        body += tag("p", "One of them runs alone, with the inputs it has here, by ", tag("code", words(f"slideway run SCENE --member {failed[0].member}")), ".")
    return Section("endings", "How the members ended", body)


def _animation_section(film: Film | str) -> Section:
    if isinstance(film, str):
        return Section("animation", "The slider in its way", tag("p", words(film), class_="absent"))
    _, data = film
    members: list[dict[str, object]] = data["members"]  # type: ignore[assignment]
    factor = number(float(data["magnification"]))  # type: ignore[arg-type]
    planar = bool(data["planar"])
    body = tag(
        "p",
        words(
            f"Bodies are to scale; gaps and tilts are drawn {factor} times as large, so that what touches in the drawing touches in the joint. "
            f"A frame is {_frames(members[0])}; what is shorter than their spacing, as most impacts are, falls between the frames."
        ),
    )
    key = (("var(--point)", "point"), ("var(--line)", "line"), ("var(--surface)", "surface"), ("var(--free)", "free (below the pictures)"))
    body += tag("ul", *(tag("li", tag("i", style=f"background:{colour}"), words(name)) for colour, name in key), class_="key", aria_label="Colours of contacts")
    names = {"side": "From the side: X along the way, Y up"} if planar else {
        "end": "Along the way: Z to the right, Y up",
        "side": "From the side: X to the right, Y up",
        "top": "From above: X to the right, Z down",
    }
    solid = " Solid and dots: the slider and its apices at the nearer end; dashed and rings: at the farther one."
    views = [
        tag(
            "figure",
            tag("svg", id=f"view-{name}", role="img", aria_label=f"Slider and way. {caption}"),
            tag("figcaption", words(caption + "." + (solid if name in ("end",) else ""))),
        )
        for name, caption in names.items()
    ]
    body += tag("div", *views, class_="views single" if planar else "views", id="stage")
    body += _film_controls([str(member["label"]) for member in members])
    if "x" in members[0]:
        body += tag("figure", tag("svg", id="view-strip", role="img", aria_label="The mechanism to scale"), tag("figcaption", "The mechanism, to scale."), class_="strip")
    return Section("animation", "The slider in its way", body)


def _frames(member: dict[str, object]) -> str:
    shown, stored = member["count"], member["of"]
    return "a stored sample" if shown == stored else f"one of {stored:,} stored samples, an even choice of {shown:,}"


def _film_controls(labels: list[str]) -> str:
    def button(name: str, text: str) -> str:
        return tag("button", words(text), type="button", id=name)

    speeds = [tag("option", words(f"{speed:g}×"), value=speed, selected=speed == 1) for speed in (0.1, 0.25, 0.5, 1, 2, 4)]
    parts = [button("play", "Play"), button("back", "◂ Frame"), button("forward", "Frame ▸"), button("contact", "Next contact")]
    parts.append(tag("label", "Speed", tag("select", *speeds, id="speed")))
    if len(labels) > 1:
        parts.append(tag("label", "Member", tag("select", *(tag("option", words(label)) for label in labels), id="film-choice")))
    parts.append(tag("span", id="pace"))
    now = tag("p", tag("span", "t = ", tag("b", id="now-time")), tag("span", "mode (surfaces, lines, points) ", tag("b", id="now-mode")), tag("span", id="now-place"), class_="now")
    slider = tag("canvas", id="timeline", aria_hidden="true") + '<input type="range" id="frame" min="0" max="0" value="0" aria-label="Time">'
    return now + tag("div", slider, class_="frames") + tag("div", *parts, class_="controls")


def _energy_section(
    result: xr.Dataset, every: list[Column], judged: energy.Verdict, figures: dict[str, Figure]
) -> Section:
    body = tag("div", tag("strong", words(judged.headline)), tag("p", words(" ".join(judged.sentences))), class_=f"verdict {judged.grade}")
    terms = energy.balance(result, every)
    if terms:
        reading = "The residual is E(t) − E(0) − W + D_f + D_d: mechanical energy gained, less the drive's work W, plus what friction and contact damping took. It is zero for exact physics and exact integration."
        body += tag("p", words(reading))
    if "balance" in figures:
        body += _figure(figures["balance"])
    return Section("energy", "Energy audit", body)


def _summary_section(result: xr.Dataset, every: list[Column], figures: dict[str, Figure]) -> Section | None:
    body = ""
    exponents = figures_orbits.exponent_words(result) if "status" in result else []
    if exponents:
        body += tag("p", words(" ".join(exponents)))
    limits = figures_tolerance.yields(result)
    if limits:
        rows = [
            (name, f"{met:,}", f"{trials:,}", percent3(share), f"{percent3(low)} to {percent3(high)}" if low == low else "–")
            for name, met, trials, share, low, high in limits
        ]
        body += table(("limit", "met by", "of", "yield", "95 % interval"), rows, "Yield: members that meet the limits; one that failed meets none")
    shown = [one for one in every if one.count > 0]
    if shown:
        wanted = [p for p in (0.05, 0.5, 0.95) if all(p in one.quantiles for one in shown)]
        single = all(one.count == 1 for one in shown)
        head = ("quantity", "meaning", "unit", "value") if single else ("quantity", "unit", "members", "mean", "sd", "least", *(f"{100 * p:g} %" for p in wanted), "largest")
        lines = [_summary_row(one, wanted, single) for one in shown]
        body += table(head, lines, "Quantities of the members that finished, over the whole run, its transient included", numeric=3 if single else 2)
        if not single:
            body += tag("details", tag("summary", "What the quantities mean"), fact_list((one.name, one.meaning) for one in shown))
    return Section("summary", "Summary", body) if body else None


def _summary_row(one: Column, wanted: list[float], single: bool) -> tuple[str, ...]:
    factor, unit = scaled(max(abs(one.low), abs(one.high)), one.unit)
    if single:
        return one.name, one.meaning, unit_words(unit), number(one.mean * factor, 5)
    values = (one.mean, one.sd, one.low, *(one.quantiles[p] for p in wanted), one.high)
    return one.name, unit_words(unit), f"{one.count:,}", *(number(value * factor) for value in values)


def percent3(share: float) -> str:
    """A share in percent with three digits, for yields."""
    return f"{100 * share:.3g} %" if share == share else "–"


def _plots_section(figures: dict[str, Figure]) -> Section | None:
    body = "".join(_figure(figure) for name, figure in figures.items() if name != "balance")
    hint = tag("p", words("Drag to zoom, double-click to see all again, click an entry of a legend to hide it."))
    return Section("plots", "Plots", hint + body) if body else None


def _figure(figure: Figure) -> str:
    choice = ""
    if len(figure.variants) > 1:
        options = [tag("option", words(variant.label)) for variant in figure.variants]
        choice = tag("div", tag("label", words(figure.choice), tag("select", *options, id=f"{figure.name}-choice")), class_="controls")
    plot = tag("div", id=figure.name, class_="plot", role="img", aria_label=f"{figure.title}. {figure.caption}", style=f"min-height:{figure.height}px")
    return tag("figure", tag("h3", words(figure.title)), choice, plot, tag("figcaption", words(figure.caption)))


def _run_section(result: xr.Dataset, members: int) -> Section:
    scene = tag("details", tag("summary", "The resolved scene, all defaults filled in"), tag("pre", words(result.attrs.get("scene", ""))))
    left = tag("div", tag("h3", "Scene"), fact_list(facts.of_scene(result, members)))
    right = tag("div", tag("h3", "Program"), fact_list(facts.of_run(result)))
    return Section("run", "What was run", tag("div", left, right, class_="columns") + scene)


def _scripts(figures: dict[str, Figure], film: Film | str) -> str:
    blocks = ""
    if figures:
        from plotly.offline import get_plotlyjs

        blocks += tag("script", get_plotlyjs())
    data = {
        figure.name: {
            "height": figure.height,
            "variants": [{"data": variant.data, "layout": variant.layout} for variant in figure.variants],
        }
        for figure in figures.values()
    }
    blocks += data_block("figures", data)
    if not isinstance(film, str):
        blocks += data_block("film", film[1])
    return blocks + tag("script", _asset("page.js")) + tag("script", _asset("animation.js"))


def _asset(name: str) -> str:
    return resources.files(__package__).joinpath("assets", name).read_text(encoding="utf-8")
