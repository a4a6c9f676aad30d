// What logs of growth say: exponents of offsets between stops, their errors, dimension and mean over members.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace slideway {

/// Growth of offsets between stops: ln of it as the kernels record it, [intervals][count], every interval `length` long
/// (seconds; steps of a map).  A member that failed has NaN from some interval on; only what is before it counts.
struct GrowthLog {
    std::span<double const> values;
    std::size_t count = 1;   // offsets, >= 1
    double length = 1;       // > 0
    std::size_t period = 0;  // intervals of a period of the forcing; 0: there is none

    std::size_t intervals() const;  // before the first NaN
    double at(std::size_t interval, std::size_t offset) const { return values[interval * count + offset]; }
};

/// Means with the spread that their parts show.
struct Exponents {
    std::vector<double> value;  // [count], Σ growth / time: finite-time exponents [1/s]; NaN without intervals
    std::vector<double> standard_error;  // [count], by batch means; NaN with fewer than 4 intervals
    std::vector<double> half_width;      // [count], of the 95 % interval by Student's t; NaN with fewer than 8 batches
    std::vector<double> late;            // [count], of the second half alone; NaN with fewer than 2 intervals
};

/// λ_j = Σ_i g_ij / (n Δ).  Source: Benettin et al., Meccanica 15 (1980) 9–20 and 21–30.
/// Error by batch means: a = ⌊n/b⌋ batches of b = max(⌊√n⌋, ⌊n/16⌋) consecutive intervals,
/// s.e. = s(batch means)/√a; a remainder, at the
/// start, is left out of it.  Where the record has 8 periods of the forcing or more, batches are whole
/// periods.  Source: Flegal & Jones, Annals of Statistics 38 (2010) 1034–1070; at most some sixteen batches, for more of them
/// add little and must be longer than what growth remembers: Schmeiser, Operations Research 30 (1982) 556–568.  With a memory
/// of τ = 1 + 2 Σ ρ_k intervals (ρ_k the correlation at lag k) 95 % intervals hold the exponent in 93 to 96 % of records of 50 τ
/// and more, in 84 % of 13 τ (tests/validation/slow/coverage_test.cpp).
Exponents exponents_of(GrowthLog const& log);

/// Running exponents of an offset: those of the first n intervals, for each n of `after` (ascending).  NaN where there are fewer.
std::vector<double> running_exponents(GrowthLog const& log, std::size_t offset, std::span<std::size_t const> after);

/// Dimension by Kaplan and Yorke: k + (λ_1 + … + λ_k)/|λ_{k+1}| with the largest k whose sum is not negative.  Source: Frederickson,
/// Kaplan, Yorke & Yorke, J. Differ. Equations 49 (1983) 185–207.
/// @param exponents descending.  @return 0 if all are negative; their number if no sum is negative (of a part of the spectrum a
/// lower bound); NaN where one is NaN, or none is given.
double kaplan_yorke_dimension(std::span<double const> exponents);

/// Mean over members, and half the width of its interval of confidence by Student's t.
struct MeanOfMembers {
    std::size_t count = 0;  // members that are not NaN
    double mean;            // NaN of none
    double half_width;      // t_{count−1} s/√count; NaN of fewer than two
};
MeanOfMembers mean_of_members(std::span<double const> values, double confidence = 0.95);

}  // namespace slideway
