// Spectrum of a series, and the period that it has on average.
#pragma once

#include <span>
#include <vector>

namespace slideway {

enum class Taper { none, hann };

/// One-sided power spectral density.
struct PowerSpectrum {
    std::vector<double> frequency;  // [1/unit of spacing], equally spaced from 0 to 1/(2·spacing)
    std::vector<double> density;    // [unit of the series² · unit of spacing]
};

/// Periodogram |Σ wₙ (xₙ - x̄) e^(-2πi f n)|² · 2·spacing/Σ wₙ² (Welch 1967 with one segment); the densities at zero and
/// at half the sampling rate are not doubled.  Times the distance of frequencies they sum to Σ(w(x - x̄))²/Σw², without
/// taper to the variance.  The mean is the one weighted with w, so that the density at zero is zero.  The series is
/// padded with zeros to a power of two: any length will do, and the spectrum is interpolated, not changed.
/// @param series equally spaced, any unit.  @param spacing of samples, > 0.
/// @return empty for less than four samples, numbers that are not finite, or a spacing that is not positive.
PowerSpectrum power_spectrum(std::span<double const> series, double spacing, Taper taper = Taper::hann);

/// Reciprocal of the mean frequency: Σ P(f)/Σ f P(f) (Rosenstein, Collins and De Luca 1993).  Without taper the side lobes
/// of a line fall off with 1/f² only and their share in Σ f P never ends; with Hann's it is as 1/f⁶.
/// @return in units of spacing; NaN where there is no spectrum, and for a series that is constant to rounding.
double average_period(std::span<double const> series, double spacing, Taper taper = Taper::hann);

}  // namespace slideway
