// Regular or chaotic, from the series itself: the 0–1 test.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace slideway {

inline constexpr std::size_t fewest_for_zero_one = 300;  // samples after thinning

struct ZeroOneOptions {
    std::size_t stride = 1;          // every stride-th sample is used
    std::size_t frequencies = 100;   // numbers of c
    std::size_t max_points = 5'000;  // after thinning: only the first so many; the cost grows with their square
};

struct ZeroOneTest {
    double k;                 // K, median of K_c: near 0 regular, near 1 chaotic (or noise); NaN where there is none
    std::vector<double> k_c;  // in the order of c
    std::size_t points;       // samples used
};

/// Gottwald and Melbourne, Proc. R. Soc. A 460 (2004) 603, in the form of SIAM J. Appl. Dyn. Syst. 8 (2009) 129: for a
/// number c the series φ drives p(n) = Σ φ(j) cos(jc), q(n) = Σ φ(j) sin(jc), j ≤ n, whose mean square displacement
/// M(n) = ⟨(p(j+n) - p(j))² + (q(j+n) - q(j))²⟩ over j ≤ N - N/10 is bounded for regular motion and grows with n for chaotic
/// motion; K_c is the correlation of M(n) with n, n = 1 … N/10.  The oscillation (Eφ)²(1 - cos nc)/(1 - cos c) that the
/// paper subtracts is that of the mean; here the mean is taken from φ first.  The c are spread evenly over (π/5, 4π/5) by multiples of
/// the golden ratio, so that no two runs differ and few c are near a resonance.
/// Of fewer than 300 samples K says nothing.  Of 60 sums of two sines, four to ten samples a period, K is above 0.8 in 55 % with
/// 139 samples, in 47 % with 150, in none with 200 (0.75 at most); above 0.2 in 48 % with 200, 18 % with 250, none with 300 (0.19 at
/// most) and 400 (0.12).  Single sines are below 0.2 from 139 on, r = 3.55 of the logistic map from 139 on; chaotic series are above
/// 0.95 from 50 on, so it is regular motion that needs the samples.
/// @return K = NaN for less than `fewest_for_zero_one` samples after thinning, numbers that are not finite, or a constant series.
ZeroOneTest zero_one_test(std::span<double const> series, ZeroOneOptions const& options = {});

/// Sampled densely, even a chaotic series looks regular: it is smooth over N/10 samples.  Four samples per average period,
/// the mean frequency at half of the highest one that the samples can tell, are what K is asked for.
/// @param period on average [samples].  @return ⌊period/4⌋, at least 1.
std::size_t zero_one_stride(double period);

}  // namespace slideway
