"""The parts of the page in words, tables and figures."""

from __future__ import annotations

import math

import xarray as xr

import slideway
from slideway.columns import Column
from slideway.units import scaled

from . import energy, facts, statuses
from .findings import column_table, exponent_words, sweep_of, yields
from .markup import Section, table, tag, words
from .markup import facts as fact_list
from .numbers import number, percent
from .traces import Figure

TEXT = 9  # a column beyond the last: no column of the table holds numbers
# Grade and headline of each verdict on the resolution.
RESOLUTIONS = {
    "resolved": ("good", "Resolved: the integration error is below the study's own intervals"),
    "error_bounded": ("none", "Integration error bounded: larger than the study's own intervals may be"),
    "undecided": ("none", "Resolution undecided: too few members ran again, some did not come to their end, or all numbers are 0"),
    "not_resolved": ("bad", "Not resolved: tighter tolerances say something else"),
    "not_checked": ("none", "Not checked against tighter tolerances"),
}
RESIDUAL = (
    "The residual is E(t) − E(0) − W − W_l − W_g + D_f + D_d + D_s + D_o: mechanical energy gained, less the works of drive, loads and the "
    "ground's motion, plus what friction, contact damping, dampers and oil film took. It is zero for exact physics and exact integration."
)


def endings_section(result: xr.Dataset, ended: list[statuses.Ending]) -> Section:
    """How the members ended, and which failed, why, when and where."""
    name, title = "endings", "How the members ended"
    if [one.status for one in ended] == ["finished"]:
        sentence = statuses.headline(ended)[1].replace("finished", "reached the end time") + "."
        return Section(name, title, tag("p", words(sentence)))
    total = sum(ending.count for ending in ended)
    rows = [(one.status, f"{one.count:,}", percent(one.count / total), one.meaning) for one in ended]
    body = table(("status", "members", "share", "meaning"), rows, "Members by how they ended", numeric=TEXT)
    failed = statuses.failures(result)
    if failed:
        every = sum(one.count for one in ended if one.status not in ("finished", "not_run"))
        caption = "Members that failed" + (f", the first {len(failed)} of {every:,}" if every > len(failed) else "")
        lines = [(f"member {one.member}", one.status, f"{number(one.time)} s", one.where) for one in failed]
        named = table(("member", "why", "at time", "where it was"), lines, caption, numeric=TEXT)
        body += tag("details", tag("summary", words(caption)), named, open=len(failed) <= 5)
        command = tag("code", words(f"slideway run SCENE --member {failed[0].member}"))
        body += tag("p", "One of them runs alone, with the inputs it has here, by ", command, ".")
    return Section(name, title, body)


def energy_section(judged: energy.Verdict, balance: Figure | None) -> Section:
    """The verdict on the energy audit, what its residual is, and where energy came from and went."""
    verdict = tag("strong", words(judged.headline)) + tag("p", words(" ".join(judged.sentences)))
    body = tag("div", verdict, class_=f"verdict {judged.grade}") + tag("p", words(RESIDUAL))
    return Section("energy", "Energy audit", body + (figure_element(balance) if balance else ""))


def resolution_section(found: slideway.Resolution | None) -> Section | None:
    """Whether tighter tolerances say the same, in the program's words; None where it was not asked (merged shards, earlier versions)."""
    if found is None:
        return None
    grade, headline = RESOLUTIONS.get(found.verdict, ("none", found.verdict))
    lines = "".join(tag("p", words(line.strip())) for line in found.summary.splitlines())
    return Section("resolution", "Resolution", tag("div", tag("strong", words(headline)) + lines, class_=f"verdict {grade}"))


def summary_section(result: xr.Dataset, every: list[Column]) -> Section | None:
    """What the study concludes: exponents, yields, quantities; None where there is nothing."""
    body = ""
    exponents = exponent_words(result) if "status" in result else []
    if exponents:
        body += tag("p", words(" ".join(exponents)))
    limits = yields(result)
    if limits:
        caption = "Yield: of the members that ran, those that meet the limits; one that failed meets none"
        head = ("limit", "met by", "that ran", "yield", "95 % interval")
        body += table(head, [_yield_row(*limit) for limit in limits], caption)
    shown = [one for one in every if one.count > 0]
    sweep = sweep_of(result)
    if sweep and shown:
        caption = f"Quantities of the members that finished: medians of the columns of {sweep.key}"
        named = ("quantity", "unit", "least", "largest")
        body += table(named, column_table(result, sweep), caption, numeric=2)
    elif shown:
        body += _quantities(shown)
    return Section("summary", "Summary", body) if body else None


def _yield_row(name: str, met: int, trials: int, share: float, low: float, high: float) -> tuple[str, ...]:
    interval = "–" if math.isnan(low) else f"{percent(low, 3)} to {percent(high, 3)}"
    return name, f"{met:,}", f"{trials:,}", percent(share, 3), interval


def _quantities(shown: list[Column]) -> str:
    caption = "Quantities of the members that finished, over the whole run, its transient included"
    if all(one.count == 1 for one in shown):
        rows = []
        for one in shown:
            factor, unit = scaled(one.unit, one.mean)
            rows.append((one.name, one.meaning, unit, number(one.mean * factor, 5)))
        return table(("quantity", "meaning", "unit", "value"), rows, caption, numeric=3)
    wanted = [p for p in (0.05, 0.5, 0.95) if all(p in one.quantiles for one in shown)]
    quantiles = (f"{100 * p:g} %" for p in wanted)
    head = ("quantity", "unit", "members", "mean", "sd", "least", *quantiles, "largest")
    meanings = tag(
        "details", tag("summary", "What the quantities mean"), fact_list((one.name, one.meaning) for one in shown)
    )
    return table(head, [_moments(one, wanted) for one in shown], caption, numeric=2) + meanings


def _moments(one: Column, wanted: list[float]) -> tuple[str, ...]:
    factor, unit = scaled(one.unit, (one.low, one.high))
    values = (one.mean, one.sd, one.low, *(one.quantiles[p] for p in wanted), one.high)
    return one.name, unit, f"{one.count:,}", *(number(value * factor) for value in values)


def plots_section(figures: list[Figure]) -> Section | None:
    """All figures one below the other; None where there are none."""
    if not figures:
        return None
    hint = tag("p", words("Drag to zoom, double-click to see all again, click an entry of a legend to hide it."))
    return Section("plots", "Plots", hint + "".join(map(figure_element, figures)))


def figure_element(figure: Figure) -> str:
    """A figure's place on the page, which assets/page.js fills, with a choice between its variants."""
    choice = ""
    if len(figure.variants) > 1:
        options = (tag("option", words(variant.label)) for variant in figure.variants)
        choice = tag("label", words(figure.choice), tag("select", *options, id=f"{figure.name}-choice"))
        choice = tag("div", choice, class_="controls")
    label = f"{figure.title}. {figure.caption}"
    plot = tag("div", id=figure.name, class_="plot", role="img", aria_label=label, style=f"min-height:{figure.height}px")
    return tag("figure", tag("h3", words(figure.title)), choice, plot, tag("figcaption", words(figure.caption)))


def run_section(result: xr.Dataset, members: int) -> Section:
    """What was run, by which program, and the whole scene."""
    scene = tag("pre", words(result.attrs.get("scene", "")))
    folded = tag("details", tag("summary", "The resolved scene, all defaults filled in"), scene)
    left = tag("div", tag("h3", "Scene"), fact_list(facts.of_scene(result, members)))
    right = tag("div", tag("h3", "Program"), fact_list(facts.of_run(result)))
    return Section("run", "What was run", tag("div", left, right, class_="columns") + folded)
