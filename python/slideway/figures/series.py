"""Series over the time: themselves, their spectra, and how often which force acts."""

from __future__ import annotations


import numpy as np
import xarray as xr

from ..arguments import positive, whole
from ..errors import SlidewayError
from ..ideal import ideal
from ..palette import class_colours, colours, grey
from ..sampling import coarse_words, sample_axis, too_coarse
from ..scenes import scene, varied
from ..signals import amplitude_spectrum, even_step, running_integral
from ..units import scaled, spelled
from ..way import across, may_be_misaligned, mean_clearance
from .base import Axes, Members, by_contact, chosen, drawn, failures, kind_of, members_over, most_lines, series_of, variable, words_of
from .marks import Axis, Band, Bars, Curve, Level, Mark, Note, Panel

standard_gravity = 9.80665  # m/s²


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
        marks.append(Curve(second * time, factor * background, of, grey, 0.6, 2.5, order=1))
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
    if len(members) > 1 and any(key.startswith("joint.") for key in varied(result)):
        return None
    first, last = (mean_clearance(scene(result, m).get("joint", {}), name) for m in (members[0], members[-1]))
    return first if first == last else None


@drawn
def spectrum(
    result: xr.Dataset, name: str = "acceleration_top", member: Members = None, ax: Axes | None = None, *, reference: float | None = None, span: float = 100.0
) -> Panel:
    """One-sided amplitude spectrum with a Hann window, in decibels (Fig. 5 of Qian et al. 2020).

    20 log10(amplitude / reference). Up to eight members are lines; of more the root mean square of their amplitudes is drawn,
    within the band of 90 % of them. Members that did not finish are left out.

    Args:
        name: of the series.
        member: number of a member, or several; left out: all.
        reference: in the unit of the series; left out: 1 g of an acceleration, else 1 of the unit.
        span: what lies so many decibels below the peak is cut off.

    Raises:
        SlidewayError: there is no such series, or no member has all samples.

    >>> slideway.plot.spectrum(slideway.example(), "y", member=0).get_xlabel()
    'frequency [Hz]'
    """
    data = series_of(result, name)
    if reference is not None:
        positive(reference, "reference")
    positive(span, "span")
    units = str(data.attrs.get("units", "1"))
    members = chosen(result, member)
    rows = data.sel(member=members).values
    whole = np.isfinite(rows).all(axis=1)
    if not whole.any():
        raise SlidewayError("none of these members has all samples, for they failed; see slideway.statuses(result)")
    members = [number for number, complete in zip(members, whole, strict=True) if complete]
    frequency, amplitude = amplitude_spectrum(rows[whole], even_step(result["time"].values))
    of_gravity = reference is None and units == "m s-2"
    level = standard_gravity if of_gravity else 1.0 if reference is None else reference
    against = "g" if of_gravity else f"{level:g} {spelled(units)}".strip()

    def decibels(amplitudes: np.ndarray) -> np.ndarray:
        return np.asarray(20 * np.log10(np.maximum(amplitudes, np.finfo(float).tiny) / level))

    factor, hertz = scaled("Hz", frequency)
    x = factor * frequency
    if len(members) <= most_lines:
        shown = decibels(amplitude)
        names = [f"member {number}" if len(members) > 1 else None for number in members]
        marks: list[Mark] = [Curve(x, line, name, colour, width=0.8) for name, line, colour in zip(names, shown, colours, strict=False)]
    else:
        middle = decibels(np.sqrt(np.mean(amplitude**2, axis=0)))
        low, high = shown = decibels(np.quantile(amplitude, (0.05, 0.95), axis=0))
        marks = [Band(x, low, high, "90 % of the members"), Curve(x, middle, f"root mean square of {len(members)} members", width=1)]
    # Single zeros of a spectrum would stretch the axis.
    peak, floor = float(shown.max()), float(np.quantile(shown, 0.01))
    return Panel(marks, Axis("frequency", hertz, tight=True), Axis(words_of(name), f"dB re {against}", low=max(peak - span, floor - 5), high=peak + 5))


@drawn
def force_histogram(result: xr.Dataset, member: Members = None, ax: Axes | None = None, *, bins: int = 40) -> Panel:
    """How often which normal force acts, by the class of the contact mode (Fig. 11 of Qian et al. 2020).

    By the hardest contact of the moment: a surface, else a line, else a point. Both axes are logarithmic, for the rare contacts of
    lines and surfaces have the largest forces. All shares, those of the legend too, are of all samples: of the time, unless they are
    taken at angles of a crank that turns freely.

    Args:
        member: number of a member, or several; left out: all.
        bins: of the forces.

    Raises:
        SlidewayError: normal_force, surfaces, lines or points are not in the result, or nothing touches.

    >>> slideway.plot.force_histogram(slideway.example()).get_xlabel()
    'normal force [N]'
    """
    # Corners between two walls touch at points or with a face.
    lines = () if kind_of(result) == "planar_slider_crank" else ("lines",)
    missing = [name for name in ("normal_force", "surfaces", *lines, "points") if name not in result]
    if missing and "sample" in result.dims:
        listed = ", ".join(f'"{name}"' for name in missing)
        raise SlidewayError(f"this result lacks {listed}; add to study.quantities, with study.samples_per_revolution = 200 or more")
    members, bins = chosen(result, member), whole(bins, "bins", 1, 10000)

    def taken(name: str) -> np.ndarray:
        return np.asarray(variable(result, name).sel(member=members).values, dtype=float).ravel()

    force = taken("normal_force")
    there = np.isfinite(force)
    of_class = by_contact(taken("surfaces") > 0, taken("lines") > 0 if lines else np.zeros_like(there), taken("points") > 0)
    touching = ~of_class.pop("free")
    pushing = touching & (force > 0)  # damping takes the force of some contacts that open
    if not pushing.any():
        raise SlidewayError("the slider touches nothing at any sample; run it longer or with more samples")
    factor, unit = scaled(str(result["normal_force"].attrs["units"]), force)
    # The thousandth of the samples that grazes with least force would stretch the axis over many decades, and is left out.
    low, high = np.quantile(force[pushing], (0.001, 1.0))
    edges = factor * np.geomspace(max(low, 1e-6 * high), high * 1.0001, bins + 1)
    least = 100 / there.sum()  # one sample
    of = "time" if sample_axis(result)[1] == "s" else "samples"
    marks: list[Mark] = []
    for name, own in of_class.items():
        counts = np.histogram(factor * force[own], edges)[0] * least
        share = own.sum() / there.sum()
        heights = np.maximum(counts, 0.5 * least)
        marks.append(Bars(edges, heights, f"{name}, {share:.2%} of the {of}", class_colours[name], base=0.5 * least, outlined=True))
    marks.append(Note(f"free flight, {1 - touching.sum() / there.sum():.2%}"))
    return Panel(marks, Axis("normal force", unit, log=True), Axis("share of all samples", "%", log=True, low=0.5 * least))
