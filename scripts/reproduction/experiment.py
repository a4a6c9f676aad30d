"""The experiment of section 2: Table 1 and Figs. 3 to 5."""

from __future__ import annotations

from functools import partial

import numpy as np
from slideway.figures.marks import Axis, Curve, Panel
from slideway.palette import colours
from slideway.signals import amplitude_spectrum, even_step, running_integral

from .claims import Claim, Finding, claim, said
from .estimates import estimate
from .plan import CASES
from .sections import Bench, Quantity, Section, Table, by_law, draw, values

GRAVITY = 9.80665  # m/s²
CHANNELS = {"top": "channel 1 (top)", "front": "channel 2 (front)"}
COMPARED = {"2": "a clearance of 0.15 mm instead of 0.25 mm", "3": "9.3 cm/s instead of 6 cm/s", "4": "a way inclined by 30°"}


def section(bench: Bench) -> Section:
    """Judges the experiment.

    Accelerations are those of the two sensors of model.md 7; a cycle is one way there and back. All numbers are of the second
    cycle, for the paper shows the steady state.
    """
    page = Section(
        "Table 1 and Figs. 3–5: the experiment",
        [
            "A carriage moved to and fro at constant speed, its accelerations felt by two sensors. The paper's curves come from a real rig; "
            "here are the model's, so that what is judged is whether the model makes what the rig showed. Of case 2 against case 1 the paper's "
            "sentence says greater, though its clearance is smaller, while section 4.6 has acceleration grow with clearance: both cannot be true of it."
        ],
    )
    measures: tuple[tuple[str, str, Quantity], ...] = (
        ("Fig. 4", "mean magnitude (the slope of the cumulative area)", _mean_magnitude("top")),
        ("Fig. 3", "largest value", _peak("top")),
        # Along the channel's axis; over all steps, which a sensor's samples miss.
        ("Fig. 3", "root mean square, of the slider's centre", values("rms_acceleration", "y", family="carriage")),
    )
    for case, change in COMPARED.items():
        for place, what, quantity in measures:
            words, cases = f"Acceleration on channel 1 is greater with {change}: its {what}.", {"case 1": "1", f"case {case}": case}
            page.claims.append(bench.growth(f"{place}, case {case}", words, quantity, cases, "settled", "m/s²", floor=1e-3 * GRAVITY))
    page.claims.append(_lift_offs(bench))
    page.claims.append(_channels(bench))
    page.figures = [
        draw("Fig. 3: acceleration on channel 1, case 1, one start, 0.1 s of the second cycle.", partial(_time, bench)),
        draw("Fig. 4: cumulative area ∫|a| dt of channel 1 over a cycle, mean of the starts.", partial(_area, bench)),
        draw("Fig. 5: spectra of both channels, case 1 (Hann window, rms of the starts).", partial(_spectra, bench)),
    ]
    page.tables = [_numbers(bench), bench.audit("carriage", list(CASES.items()), "settled", bench.scale.carriage_revolutions)]
    return page


def _duration(bench: Bench, case: str, law: str) -> float:
    return float(bench.result("carriage", case, "settled", law)["time"].values[-1])


def _mean_magnitude(channel: str) -> Quantity:
    area = values("acceleration_area", channel, family="carriage")
    return lambda bench, case, window, law: area(bench, case, window, law) / _duration(bench, case, law)


def _peak(channel: str) -> Quantity:
    return values("peak_channel_acceleration", channel, family="carriage")


def _lift_offs(bench: Bench) -> Claim:
    def finding(law: str) -> Finding:
        count = estimate(bench.values("carriage", "1", "settled", law, "contact_onsets") / bench.scale.carriage_revolutions)
        free = bench.values("carriage", "1", "settled", law, "mode_time", "free") / _duration(bench, "1", law)
        lines = (said(count, "landings a cycle"), f"in flight {said(estimate(free), '% of the time', 100)}")
        return Finding(lines, True if count.low > 1 else False if count.high < 1 else None)

    return claim("Fig. 3a", "In the steady state the slider keeps colliding with its way: it leaves it and lands at least once a cycle.", finding)


def _channels(bench: Bench) -> Claim:
    def finding(law: str) -> Finding:
        top, front = (_mean_magnitude(channel)(bench, "1", "settled", law) for channel in CHANNELS)
        level = estimate(20 * np.log10(top / front))
        differs = True if level.low > 1 or level.high < -1 else False if abs(level.mean) + level.half_width < 1 else None
        return Finding((f"channel 1 over channel 2: {said(level, 'dB')}",), differs)

    return claim("Fig. 5", "The two channels feel different vibrations (by more than 1 dB of their mean magnitudes).", finding)


def _spectrum(bench: Bench, case: str, law: str, channel: str) -> tuple[np.ndarray, np.ndarray]:
    result = bench.result("carriage", case, "dense", law)
    return amplitude_spectrum(bench.series("carriage", case, "dense", law, f"acceleration_{channel}"), even_step(result["time"].values))


def _numbers(bench: Bench) -> Table:
    def cells(case: str, channel: str, law: str) -> list[str]:
        frequency, amplitude = _spectrum(bench, case, law, channel)
        # From 50 Hz: five of the window's shapes, below them is the motion of the carriage.
        heard = frequency >= 50
        strongest = frequency[heard][amplitude[:, heard].argmax(axis=1)] / 1e3
        level = 20 * np.log10(np.sqrt((amplitude**2).sum(axis=1) / 2 / 1.5) / GRAVITY)
        mean, peak = (of(channel)(bench, case, "settled", law) for of in (_mean_magnitude, _peak))
        return [*(said(estimate(each), "") for each in (mean, peak, level)), f"{np.median(strongest):.3g} ({strongest.min():.3g} to {strongest.max():.3g})"]

    columns = ("mean |a| [m/s²]", "peak [m/s²]", "rms level [dB re g]", "strongest frequency [kHz], median (range of the starts)")
    rows = {f"{words}, {of}": partial(cells, case, channel) for words, case in CASES.items() for channel, of in CHANNELS.items()}
    return by_law("Accelerations of the four cases. Level and frequency are of 0.1 s at 200 kHz.", "case", columns, rows)


def _time(bench: Bench, law: str) -> Panel:
    time = bench.result("carriage", "1", "dense", law)["time"].values
    curve = Curve(1e3 * time, bench.series("carriage", "1", "dense", law, "acceleration_top")[0], width=0.6)
    return Panel([curve], Axis("time", "ms", tight=True), Axis("acceleration, channel 1", "m/s²"))


def _area(bench: Bench, law: str) -> Panel:
    curves = []
    for (words, case), colour in zip(CASES.items(), colours):
        time = bench.result("carriage", case, "settled", law)["time"].values
        area = running_integral(np.abs(bench.series("carriage", case, "settled", law, "acceleration_top")), time).mean(axis=0)
        # Samples miss most impacts; the law of their sum is right, and its end is the integral over all steps.
        whole = np.nanmean(bench.values("carriage", case, "settled", law, "acceleration_area", "top"))
        curves.append(Curve(time, area * whole / area[-1], words, colour, width=1.6))
    return Panel(curves, Axis("time", "s", tight=True), Axis("∫|a| dt, channel 1", "m/s", low=0))


def _spectra(bench: Bench, law: str) -> Panel:
    curves = []
    for (channel, words), colour in zip(CHANNELS.items(), colours):
        frequency, amplitude = _spectrum(bench, "1", law, channel)
        level = 20 * np.log10(np.sqrt(np.mean(amplitude[:, 1:] ** 2, axis=0)) / GRAVITY)
        curves.append(Curve(frequency[1:] / 1e3, level, words, colour, width=0.7))
    top, low = max(float(curve.y.max()) for curve in curves), min(float(np.quantile(curve.y, 0.02)) for curve in curves)
    return Panel(curves, Axis("frequency", "kHz", log=True, tight=True), Axis("amplitude", "dB re g", low=max(top - 110, low - 8), high=top + 8))
