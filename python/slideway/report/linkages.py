"""What pages show of linkages, in the place of a slider in its way: the mechanism as a film, and series by the names of bodies and joints."""

from __future__ import annotations

import base64

import xarray as xr

import slideway
from slideway.errors import SlidewayError
from slideway.figures import base, mechanism, orbits, series

from .figures import bands, of, panel_of, spacing
from .markup import Section, tag, words
from .members import chosen
from .numbers import counted, number
from .traces import Figure

FRAMES, SECONDS = 240, 8.0
RATES = ("_vx", "_vy", "_velocity")


def is_linkage(result: xr.Dataset) -> bool:
    """Whether the result is of bodies and joints that its scene describes."""
    return base.kind_of(result) == "linkage"


def film_section(result: xr.Dataset) -> Section:
    """The mechanism over the time series of the first of the chosen members, or in one line why there is none."""
    from slideway.plot.axes import picture  # matplotlib takes its time

    name, title = "animation", "The mechanism"
    try:
        run = mechanism.stored(result)
        member, label = next(iter(chosen(result).items()))
        run = mechanism.stored(result, member)
        svg = picture([mechanism.film(run, FRAMES, SECONDS)], height=4.2, width=6.2)
    except (SlidewayError, StopIteration) as error:
        return Section(name, title, tag("p", words(str(error) or "No member has any samples, so there is nothing to draw."), class_="absent"))
    time = run.state["time"]
    slowed = SECONDS / (time[-1] - time[0]) if time[-1] > time[0] else 1.0
    caption = (
        f"{label[0].upper()}{label[1:]}, {number(time[0])} to {number(time[-1])} s, {number(slowed)} times as long here. Bodies are to scale, clearances as much larger as it "
        "says; what is shorter than the spacing of the samples, as most impacts are, falls between the frames."
    )
    image = tag("img", src="data:image/svg+xml;base64," + base64.b64encode(svg.encode()).decode(), alt="The mechanism in motion", width="100%")
    return Section(name, title, tag("div", tag("figure", image, tag("figcaption", words(caption))), class_="views single"))


def figures(result: xr.Dataset) -> dict[str, Figure]:
    """Figures of a result's time series by their names; none where it has none of members."""
    if not is_linkage(result) or "status" not in result or not result.sizes.get("sample", 0):
        return {}
    names = [str(name) for name in result.data_vars if set(result[name].dims) == {"member", "sample"}]
    journals = [name for name, link in slideway.scene(result)["link"].items() if link["kind"] == "journal" and {f"{name}_x", f"{name}_y"} <= {*names}]
    rates = [name for name in names if name.endswith(RATES)]
    placed = [f"{name}_{axis}" for name in journals for axis in "xy"]
    made = [
        _stack(result, "series", "Time series", [name for name in names if name not in rates + placed]),
        _stack(result, "rates", "Velocities", rates),
        bands(result),
        _journals(result, journals),
    ]
    return {figure.name: figure for figure in made if figure}


def _stack(result: xr.Dataset, name: str, title: str, names: list[str]) -> Figure | None:
    """Series of the chosen members, one below the other."""
    caption = f"{counted(result.sizes['sample'], 'sample')}, every {spacing(result)}."
    variants = ((label, [panel for one in names if (panel := panel_of(series.time_series, result, one, member))]) for member, label in chosen(result).items())
    return of(name, title, caption, variants, 110 + 110 * len(names), "Member")


def _journals(result: xr.Dataset, journals: list[str]) -> Figure | None:
    """Where journals go in their bearings."""
    caption = "The journal's centre in its bearing, along the ground's axes. Dashed: the clearance; beyond it the journal is pressed into the bearing."
    variants = ((f"{name}, {label}", panel_of(orbits.journal, result, name, member)) for name in journals for member, label in chosen(result).items())
    return of("journals", "Journals in their bearings", caption, variants, 460, "Joint")
