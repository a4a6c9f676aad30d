"""Figures of time series: of single members, orbits, and forces by contact."""

from __future__ import annotations

import textwrap
from collections.abc import Callable
from functools import partial

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from slideway.ideal import rod_reach
from slideway.sampling import sample_axis, too_coarse
from slideway.way import may_be_misaligned

from .contact import mode_classes
from .members import chosen
from .numbers import counted, number, unit_words
from .poses import Poses
from .traces import Figure, Trace, Variant, bars_of, line, packed, points, rows, text, thinned

CLASSES = ("free", "point", "line", "surface")
STATES = ("y", "z", "roll", "yaw", "pitch", "vy", "vz", "wx", "wy", "wz")
COUNTS = ("surfaces", "lines", "points")
BAND_MEMBERS = 2000

# (unit, series, factor to this unit) of each row of states.
PLACE = [("mm", ("y", "z"), 1e3), ("mrad", ("roll", "yaw", "pitch"), 1e3)]
RATE = [("mm/s", ("vy", "vz"), 1e3), ("rad/s", ("wx", "wy", "wz"), 1.0)]
COLOURS = ("@c1", "@c2", "@c3")


def series_names(result: xr.Dataset) -> list[str]:
    """Variables along member and sample."""
    return [str(name) for name in result.data_vars if set(result[name].dims) == {"member", "sample"}]


def time_series(result: xr.Dataset, seen: dict[int, Poses]) -> list[Figure]:
    """What the chosen members did over time: place and tilt with what the scene asked for, and the velocities."""
    names = series_names(result)
    asked = [name for name in names if name not in STATES and name not in COUNTS]
    figures = []
    for name, title, groups, extra in (("series", "Time series", PLACE, asked), ("rates", "Velocities", RATE, [])):
        kept = [(unit, [s for s in states if s in names], factor) for unit, states, factor in groups]
        drawn = [(f"{', '.join(states)}{_origin(result, states)}<br>[{unit}]", states, factor) for unit, states, factor in kept if states]
        titles = [head for head, _, _ in drawn] + [_axis_title(result, one) for one in extra]
        if not titles:
            continue
        variants = [Variant(label, _rows_of(result, member, drawn, extra, seen[member]), rows(titles, "time [s]")) for member, label in chosen(result).items()]
        if name == "series":
            for variant, pose in zip(variants, seen.values(), strict=True):
                variant.layout["shapes"] = _walls(pose)
        figures.append(Figure(name, title, _series_caption(result, name), variants, height=110 + 150 * len(titles), choice="Member"))
    return figures


def _origin(result: xr.Dataset, states: list[str]) -> str:
    """What y and z are from, where that is not the inertial axis."""
    return "<br>from the way's axis" if "y" in states and may_be_misaligned(result) else ""


def _axis_title(result: xr.Dataset, name: str) -> str:
    units = str(result[name].attrs.get("units", "1"))
    lines = textwrap.wrap(name.replace("_", " "), 16) + ([] if units == "1" else [f"[{unit_words(units)}]"])
    return "<br>".join(map(text, lines))


def _rows_of(result: xr.Dataset, member: int, groups: list[tuple[str, list[str], float]], extra: list[str], pose: Poses) -> list[Trace]:
    row = result.sel(member=member).isel(sample=pose.samples)
    rough = {name: too_coarse(result, [member], name) for name in [*STATES, *extra]}
    across = {"y": pose.y, "z": pose.z}  # from the way's axis, as the walls
    data: list[Trace] = []
    for place, (_, names, factor) in enumerate(groups, start=1):
        data += [
            _drawn(rough[name])(pose.time, (across[name] if name in across else row[name].values) * factor, name, colour, place)
            for name, colour in zip(names, COLOURS, strict=False)
        ]
    for place, name in enumerate(extra, start=len(groups) + 1):
        if name == "x" and pose.crank is not None and pose.links is not None:
            r, rod = pose.links
            data.append(line(pose.time, rod_reach(r, rod, pose.crank), "x of the ideal mechanism", "@muted", place, width=4))
        data.append(_drawn(rough[name])(pose.time, row[name].values, name, "@c1", place, showlegend=name == "x"))
    return data


def _drawn(rough: bool) -> Callable[..., Trace]:
    """How samples are drawn: joined, or as points where they are too far apart for that."""
    return partial(points, size=3) if rough else line


def _walls(pose: Poses) -> list[dict[str, object]]:
    """How far the slider can move without tilt, behind y and z."""
    gaps = {pose.joint.gap_y, pose.joint.gap_z} - {0.0}
    style = {"color": "@muted", "width": 1, "dash": "dot"}
    return [
        {"type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": side * gap * 1e3, "y1": side * gap * 1e3, "line": style}
        for gap in sorted(gaps)
        for side in (-1, 1)
    ]


def _series_caption(result: xr.Dataset, name: str) -> str:
    samples = result.sizes["sample"]
    caption = f"{counted(samples, 'sample')}, every {_spacing(result)}."
    if too_coarse(result, list(chosen(result))):
        caption += " That is far coarser than the contacts: samples are points, for a line between them would show what never was."
    if name == "series":
        caption += " Dotted: the clearance, where the slider without tilt would touch."
        if may_be_misaligned(result):
            caption += " y and z are from the way's axis, all else is not."
    if samples > 5000:
        caption += " Of so many, the least and the largest of each short stretch are drawn (at most 5,000 points a curve)."
    return caption


def _spacing(result: xr.Dataset) -> str:
    places, unit = sample_axis(result)
    step = float((places[-1] - places[0]) / max(len(places) - 1, 1))
    return f"{number(step)} s" if unit == "s" else f"{number(360 * step)} degrees that the crank turns"


def orbit(result: xr.Dataset, seen: dict[int, Poses]) -> Figure | None:
    """Path of the slider's centre in the gap, seen along the way."""
    if "z" not in result:
        return None
    variants = []
    for member, label in chosen(result).items():
        pose = seen[member]
        y, z = pose.y * 1e3, pose.z * 1e3
        kept = np.unique(np.concatenate([thinned(y), thinned(z)])) if len(y) > 5000 else np.arange(len(y))
        rough = too_coarse(result, [member])
        drawn = points([], [], "centre", "@c1/0.7", size=3) if rough else line([], [], "centre", "@c1/0.55", width=0.8)
        path = {**drawn, **_xy(z[kept], y[kept])}
        start = points(z[:1], y[:1], "start", "@c1", size=9)
        joint = pose.joint
        across, up = joint.gap_z * 1e3, joint.gap_y * 1e3
        walls = {"type": "rect", "x0": -across, "x1": across, "y0": -up, "y1": up, "line": {"color": "@muted", "dash": "dot", "width": 1}}
        origin = " from the way's axis" if may_be_misaligned(result) else ""
        layout = rows([f"y{origin} [mm]"], f"z{origin} [mm]")
        layout["yaxis"] |= {"scaleanchor": "x", "scaleratio": 1, "constrain": "domain"}
        layout["xaxis"] |= {"constrain": "domain"}
        variants.append(Variant(label, [path, start], {**layout, "shapes": [walls]}))
    caption = "The slider's centre, seen along the way. Dotted: how far it can go without tilt."
    if too_coarse(result, list(seen)):
        caption += " Samples are far coarser than the contacts, and so are points."
    return Figure("orbit", "Orbit in the gap", caption, variants, height=460, choice="Member")


def _xy(x: NDArray[np.float64], y: NDArray[np.float64]) -> Trace:
    return {"x": packed(x), "y": packed(y)}


def forces(result: xr.Dataset, seen: dict[int, Poses]) -> Figure | None:
    """How often which contact force was seen, by the stiffest contact at that time."""
    if "normal_force" not in result:
        return None
    if set(COUNTS) <= set(map(str, result)):
        some = result.isel(member=slice(None, None, -(-result.sizes["member"] // BAND_MEMBERS)))
        values, *counts = (some[name].transpose("member", "sample").values.ravel() for name in ("normal_force", *COUNTS))
        there = np.isfinite(values)
        values, classes = values[there], mode_classes(np.stack(counts, 1)[there].astype(int))
        members = some.sizes["member"]
    else:
        values = np.concatenate([result["normal_force"].sel(member=m).values[pose.samples] for m, pose in seen.items()])
        classes = np.concatenate([mode_classes(pose.modes) for pose in seen.values()])
        members = len(seen)
    loaded = (values > 0) & (classes > 0)
    if not loaded.any():
        return None
    edges = np.linspace(np.floor(np.log10(values[loaded].min())), np.ceil(np.log10(values[loaded].max())), 41)
    data = []
    for kind in (1, 2, 3):
        held = np.log10(values[loaded & (classes == kind)])
        if len(held):
            data.append(bars_of(edges, np.histogram(held, edges)[0], CLASSES[kind], f"@{CLASSES[kind]}"))
    low, high = int(np.floor(edges[0])), int(np.ceil(edges[-1]))
    ticks = list(range(low, high + 1, max(1, (high - low) // 8)))
    layout = rows(["samples"], "sum of the normal forces [N]", tickvals=ticks, ticktext=[f"10<sup>{k}</sup>" for k in ticks])
    free = int((classes == 0).sum())
    caption = (
        f"{counted(int(loaded.sum()), 'sample')} in contact of {counted(members, 'member')}, by the stiffest contact of each; "
        f"{counted(free, 'sample')} in free flight {'is' if free == 1 else 'are'} left out."
    )
    return Figure("forces", "Contact forces by mode", caption, [Variant("all", data, {**layout, "barmode": "stack"})])
