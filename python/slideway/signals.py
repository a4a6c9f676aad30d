"""Numbers of evenly sampled series: amplitude spectra and integrals."""

from __future__ import annotations

import numpy as np

from .errors import SlidewayError


def amplitude_spectrum(values: np.ndarray, step: float) -> tuple[np.ndarray, np.ndarray]:
    """One-sided amplitude spectrum with a Hann window.

    The mean is taken away; a sine of amplitude A whose frequency is one of the spectrum's shows A there.
    A_k = 2 |Σ w_n x_n exp(−2πikn/N)| / Σ w_n, w_n = (1 − cos(2πn/N))/2; at half the sampling rate half of it.

    Args:
        values: series along the last axis, any unit.
        step: spacing of the samples [s].

    Returns:
        Frequencies [Hz] from 0 to half the sampling rate, and amplitudes in the unit of the values.

    Raises:
        SlidewayError: fewer than 8 samples.

    >>> f, a = amplitude_spectrum(3 * np.sin(2 * np.pi * 50 * np.arange(1000) / 1000), 1e-3)
    >>> float(f[a.argmax()]), round(float(a.max()), 6)
    (50.0, 3.0)
    """
    count = values.shape[-1]
    if count < 8:
        raise SlidewayError(f"{count} samples make no spectrum; store more with study.samples")
    window = 0.5 * (1 - np.cos(2 * np.pi * np.arange(count) / count))
    fluctuation = values - values.mean(axis=-1, keepdims=True)
    amplitude = 2 * np.abs(np.fft.rfft(fluctuation * window, axis=-1)) / window.sum()
    amplitude[..., 0] /= 2
    if count % 2 == 0:
        amplitude[..., -1] /= 2
    return np.fft.rfftfreq(count, step), amplitude


def even_step(time: np.ndarray) -> float:
    """Spacing of sample times [s].

    Raises:
        SlidewayError: they are not evenly spaced.

    >>> even_step(np.array([0.0, 0.5, 1.0]))
    0.5
    """
    if time.ndim > 1:
        raise SlidewayError("the samples are at equal angles of the crank; a spectrum needs them evenly spaced in time, by study.duration and study.samples")
    if time.size < 2:
        raise SlidewayError(f"{time.size} samples have no spacing; store more with study.samples")
    step = float(time[-1] - time[0]) / (time.size - 1)
    if not np.allclose(np.diff(time), step, rtol=1e-6, atol=0):
        raise SlidewayError("the samples are not evenly spaced in time; a spectrum needs them so")
    return step


def running_integral(values: np.ndarray, time: np.ndarray) -> np.ndarray:
    """∫ values dt from the first sample on, by trapezoids, along the last axis.

    >>> running_integral(np.array([1.0, 1.0, 3.0]), np.array([0.0, 1.0, 2.0]))
    array([0., 1., 3.])
    """
    pieces = 0.5 * (values[..., 1:] + values[..., :-1]) * np.diff(time)
    return np.concatenate([np.zeros((*values.shape[:-1], 1)), np.cumsum(pieces, axis=-1)], axis=-1)
