"""The experiment of section 2: Table 1 and Figs. 3 to 5."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from slideway.palette import colours
from slideway.plot.axes import finish
from slideway.signals import amplitude_spectrum, even_step, running_integral

from .claims import LAW_WORDS, LAWS, Claim, Finding, claim, growth, said
from .estimates import estimate
from .plan import CASES
from .sections import Bench, Section, Table, draw

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
    for case, change in COMPARED.items():
        for place, what, value, unit in (
            ("Fig. 4", "mean magnitude (the slope of the cumulative area)", _mean_magnitude, "m/s²"),
            ("Fig. 3", "largest value", _peak, "m/s²"),
            ("Fig. 3", "root mean square, of the slider's centre", _rms, "m/s²"),
        ):
            page.claims.append(
                growth(
                    f"{place}, case {case}",
                    f"Acceleration on channel 1 is greater with {change}: its {what}.",
                    ("case 1", f"case {case}"),
                    {law: [value(bench, c, law, "top") for c in ("1", case)] for law in LAWS},
                    unit,
                    floor=1e-3 * GRAVITY,
                )
            )
    page.claims.append(_lift_offs(bench))
    page.claims.append(_channels(bench))
    page.figures = [
        draw("Fig. 3: acceleration on channel 1, case 1, one start, 0.1 s of the second cycle.", lambda law, ax: _time(bench, law, ax)),
        draw("Fig. 4: cumulative area ∫|a| dt of channel 1 over a cycle, mean of the starts.", lambda law, ax: _area(bench, law, ax)),
        draw("Fig. 5: spectra of both channels, case 1 (Hann window, rms of the starts).", lambda law, ax: _spectra(bench, law, ax)),
    ]
    page.tables = [_numbers(bench), bench.audit("carriage", list(CASES.items()), "settled", bench.scale.carriage_revolutions)]
    return page


def _duration(bench: Bench, case: str, law: str) -> float:
    return float(bench.result("carriage", case, "settled", law)["time"].values[-1])


def _mean_magnitude(bench: Bench, case: str, law: str, channel: str) -> np.ndarray:
    return bench.values("carriage", case, "settled", law, "acceleration_area", channel) / _duration(bench, case, law)


def _peak(bench: Bench, case: str, law: str, channel: str) -> np.ndarray:
    return bench.values("carriage", case, "settled", law, "peak_channel_acceleration", channel)


def _rms(bench: Bench, case: str, law: str, channel: str) -> np.ndarray:
    """Along the channel's axis; over all steps, which a sensor's samples miss."""
    return bench.values("carriage", case, "settled", law, "rms_acceleration", {"top": "y", "front": "z"}[channel])


def _lift_offs(bench: Bench) -> Claim:
    findings = {}
    for law in LAWS:
        onsets = bench.values("carriage", "1", "settled", law, "contact_onsets") / bench.scale.carriage_revolutions
        free = bench.values("carriage", "1", "settled", law, "mode_time", "free") / _duration(bench, "1", law)
        count = estimate(onsets)
        findings[law] = Finding(
            (f"{said(count, 'landings a cycle')}", f"in flight {said(estimate(free), '% of the time', 100)}"),
            True if count.low > 1 else False if count.high < 1 else None,
        )
    return claim("Fig. 3a", "In the steady state the slider keeps colliding with its way: it leaves it and lands at least once a cycle.", findings)


def _channels(bench: Bench) -> Claim:
    findings = {}
    for law in LAWS:
        ratio = 20 * np.log10(_mean_magnitude(bench, "1", law, "top") / _mean_magnitude(bench, "1", law, "front"))
        level = estimate(ratio)
        differs = True if level.low > 1 or level.high < -1 else False if abs(level.mean) + level.half_width < 1 else None
        findings[law] = Finding((f"channel 1 over channel 2: {said(level, 'dB')}",), differs)
    return claim("Fig. 5", "The two channels feel different vibrations (by more than 1 dB of their mean magnitudes).", findings)


def _spectrum(bench: Bench, case: str, law: str, channel: str) -> tuple[np.ndarray, np.ndarray]:
    result = bench.result("carriage", case, "dense", law)
    return amplitude_spectrum(bench.series("carriage", case, "dense", law, f"acceleration_{channel}"), even_step(result["time"].values))


def _numbers(bench: Bench) -> Table:
    rows = []
    for words, case in CASES.items():
        for channel, of in CHANNELS.items():
            row = [f"{words}, {of}"]
            for law in LAWS:
                frequency, amplitude = _spectrum(bench, case, law, channel)
                # From 50 Hz: five of the window's shapes, below them is the motion of the carriage.
                heard = frequency >= 50
                strongest = frequency[heard][amplitude[:, heard].argmax(axis=1)] / 1e3
                level = 20 * np.log10(np.sqrt((amplitude**2).sum(axis=1) / 2 / 1.5) / GRAVITY)
                row += [
                    said(estimate(_mean_magnitude(bench, case, law, channel)), ""),
                    said(estimate(_peak(bench, case, law, channel)), ""),
                    said(estimate(level), ""),
                    f"{np.median(strongest):.3g} ({strongest.min():.3g} to {strongest.max():.3g})",
                ]
            rows.append(row)
    columns = ("mean |a| [m/s²]", "peak [m/s²]", "rms level [dB re g]", "strongest frequency [kHz], median (range of the starts)")
    return Table(
        "Accelerations of the four cases. Level and frequency are of 0.1 s at 200 kHz.",
        ["case", *(f"{LAW_WORDS[law]}: {c}" for law in LAWS for c in columns)],
        rows,
    )


def _time(bench: Bench, law: str, ax: Axes) -> None:
    time = bench.result("carriage", "1", "dense", law)["time"].values
    ax.plot(1e3 * time, bench.series("carriage", "1", "dense", law, "acceleration_top")[0], lw=0.6, color=colours[0])
    ax.margins(x=0)
    finish(ax, "time [ms]", "acceleration, channel 1 [m/s²]")


def _area(bench: Bench, law: str, ax: Axes) -> None:
    for (words, case), colour in zip(CASES.items(), colours):
        time = bench.result("carriage", case, "settled", law)["time"].values
        area = running_integral(np.abs(bench.series("carriage", case, "settled", law, "acceleration_top")), time).mean(axis=0)
        # Samples miss most impacts; the law of their sum is right, and its end is the integral over all steps.
        whole = np.nanmean(bench.values("carriage", case, "settled", law, "acceleration_area", "top"))
        ax.plot(time, area * whole / area[-1], color=colour, lw=1.6, label=words)
    ax.margins(x=0)
    ax.set_ylim(bottom=0)
    finish(ax, "time [s]", "∫|a| dt, channel 1 [m/s]")


def _spectra(bench: Bench, law: str, ax: Axes) -> None:
    top, low = -np.inf, np.inf
    for (channel, words), colour in zip(CHANNELS.items(), colours):
        frequency, amplitude = _spectrum(bench, "1", law, channel)
        level = 20 * np.log10(np.sqrt(np.mean(amplitude[:, 1:] ** 2, axis=0)) / GRAVITY)
        ax.plot(frequency[1:] / 1e3, level, lw=0.7, color=colour, label=words)
        top, low = max(top, float(level.max())), min(low, float(np.quantile(level, 0.02)))
    ax.set_xscale("log")
    ax.set_ylim(max(top - 110, low - 8), top + 8)
    ax.margins(x=0)
    finish(ax, "frequency [kHz]", "amplitude [dB re g]")
