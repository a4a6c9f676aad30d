"""Series over the time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from ..errors import SlidewayError
from ..ideal import ideal
from ..palette import grey
from ..sampling import coarse_words, sample_axis, too_coarse
from ..scenes import scene
from ..signals import running_integral
from ..units import scaled
from ..way import across, may_be_misaligned, mean_clearance
from .base import Members, chosen, drawn, failures, members_over, series_of, words_of
from .marks import Axis, Curve, Level, Mark, Panel

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@drawn
def time_series(
    result: xr.Dataset, name: str = "y", member: Members = None, ax: Axes | None = None, *, difference: bool = False, gap: bool = True
) -> Panel:
    """A series over the time, with the mechanism without clearance behind it.

    Up to eight members are lines, more of them bands; samples that are far coarser than the contacts are points. Of y and z the
    ideal is the axis of the way, and dotted lines are the ends of the clearance, where a slider that is not tilted touches. Where
    the scene's [way] moves or turns the way, y and z are drawn from its axis, and the axis says so.

    Args:
        name: of the series.
        member: number of a member, or several; left out: all.
        difference: draw the difference to the ideal mechanism, as of x, whose deviations are small beside its travel.
        gap: draw the ends of the clearance.

    Raises:
        SlidewayError: there is no such series; the text says what to add to the scene.

    >>> slideway.plot.time_series(slideway.example(), "y", member=0).get_ylabel()
    'y [µm]'
    """
    data = series_of(result, name)
    members = chosen(result, member)
    time, time_unit = sample_axis(result)
    rows = np.array(data.sel(member=members).values)
    background = ideal(scene(result, members[0] if len(members) == 1 else None), name, time)
    words = words_of(name)
    if may_be_misaligned(result) and name not in ("x", "vx", "ax"):
        background = None  # the way has a height, a slope and an attitude of its own
        turned = across(result, members) if name in ("y", "z") else None
        if turned is not None:
            rows, background, words = turned[name == "z"].copy(), np.zeros_like(time), f"{name} from the way's axis"
    if difference:
        if background is None:
            raise SlidewayError(f"there is no ideal {name} to take the difference to; leave out difference=True")
        for row, number in zip(rows, members, strict=True):
            own = ideal(scene(result, number), name, time)
            row -= background if own is None else own
        background, words = None, f"{words} − ideal"
    factor, unit = scaled(str(data.attrs.get("units", "1")), rows)
    second, x = time_axis(time, time_unit)
    marks: list[Mark] = []
    if background is not None:
        of = "axis of the way" if name in ("y", "z") else "ideal mechanism"
        marks.append(Curve(second * time, factor * background, of, grey, 0.6, 2.5, behind=True))
    clearance = _clearance(result, members, name) if gap and background is not None and not difference else None
    if clearance is not None:
        marks += [Level(factor * end, label=label, dash=":") for end, label in ((clearance, "clearance"), (-clearance, None))]
    coarse = coarse_words(result) if too_coarse(result, members, name) else None
    marks += members_over(second * time, factor * rows, members, failures(result, members), coarse)
    return Panel(marks, x, Axis(words, unit))


@drawn
def cumulative_area(result: xr.Dataset, name: str = "acceleration_top", member: Members = None, ax: Axes | None = None) -> Panel:
    """∫|a| dt over the time, as Fig. 4 of Qian et al. (2020): its slope is the mean magnitude of an acceleration.

    Args:
        name: of the series, an acceleration or any other.
        member: number of a member, or several; left out: all.

    Raises:
        SlidewayError: there is no such series.

    >>> slideway.plot.cumulative_area(slideway.example()).get_ylabel()
    '∫|acceleration top| dt [mm/s]'
    """
    data = series_of(result, name)
    members = chosen(result, member)
    time, time_unit = sample_axis(result)
    own = result["time"].sel(member=members) if "member" in result["time"].dims else result["time"]
    rows = running_integral(np.abs(data.sel(member=members).values), own.values)
    units = str(data.attrs.get("units", "1"))
    factor, unit = scaled({"m s-2": "m s-1", "m s-1": "m", "rad s-1": "rad"}.get(units, f"{units} s".removeprefix("1 ")), rows)
    second, x = time_axis(time, time_unit)
    return Panel(members_over(second * time, factor * rows, members, failures(result, members)), x, Axis(f"∫|{words_of(name)}| dt", unit, low=0.0))


def time_axis(time: np.ndarray, unit: str) -> tuple[float, Axis]:
    """What brings places of samples into the unit of their axis, and this axis."""
    if unit == "turns":
        return 1.0, Axis("turns of the crank", tight=True)
    second, handy = scaled("s", time)
    return second, Axis("time", handy, tight=True)


def _clearance(result: xr.Dataset, members: list[int], name: str) -> float | None:
    """Half the play of y or z [m], where all members share it."""
    if name not in ("y", "z"):
        return None
    if len(members) > 1 and any(key.startswith("joint.") for key in scene(result).get("study", {}).get("vary", {})):
        return None
    first, last = (mean_clearance(scene(result, m).get("joint", {}), name) for m in (members[0], members[-1]))
    return first if first == last else None
