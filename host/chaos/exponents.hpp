// What logs of growth say: exponents of offsets between stops, their errors, dimension and mean over members.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>
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

/// The values of a log with the offset that grew most first: in a finite record that need not be the first.
std::vector<double> largest_first(std::span<double const> values, std::size_t count);

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

// What records of growth allow to say of an exponent's sign, of one member and of many.

/// `power_of_time`: the interval alone excludes 0, but nothing grew (or shrank) by more than a power of time does.
enum class ExponentSign { undecided, power_of_time, above_zero, below_zero };
inline constexpr char const* words_of(ExponentSign sign) {
    constexpr char const* words[] = {"undecided", "no growth beyond a power of time", "above zero", "below zero"};
    return words[static_cast<int>(sign)];
}

/// ln of what t³ grows by while t doubles: the second half of a record may grow (or shrink) by as much without an exponent.
inline constexpr double most_growth_of_a_power = 3 * std::numbers::ln2;

/// Offsets that grow like a power of time, t^k, have the finite-time rate k ln(T/t₀)/T: in every record above zero by far more than it
/// scatters, though λ = 0.  From T/2 to T they grow by k ln 2 at most whatever T, less after a transient t₀; exponential growth is λT/2.
/// So a sign needs a rate whose interval excludes 0, and a second half that grew, less its own interval, by more than t³.  Regular
/// motion has k = 1 (sliders that fly, rest or glide) or 2 (flat elastic bounces, whose 2 ln 2 is passed by 1 % through rounding and
/// curvature).
/// It costs power: half as long a record has an interval √2 times as wide.  In a thousand made-up records of 512 intervals each of t
/// and t² with swings, transients, noise and random walks a sign is said in at most 1.3 % (in up to all by intervals alone).  λT = 10
/// has one in all where λT scatters by 0.5, in 42 % by 2.3; 20 in 99 % by 2.3, in 33 % by 6.8; 50 in 99 % by 6.8
/// (tests/unit/chaos/exponent_sign_test.cpp).  Weighed besides: the growth of the second half less that of the second quarter needs no
/// bound, but sees 53 % of the last; a line against a logarithm takes random walks for a sign in 16 %.
/// @param rate, half_width [1/s], of its 95 % interval.  @param late, late_half_width ln of the growth from T/2 to T.
/// @return undecided where an argument is NaN.
ExponentSign exponent_sign(double rate, double half_width, double late, double late_half_width);

/// A member's exponent, as its file has it.
struct ExponentRecord {
    double rate, half_width;  // [1/s], of the whole record; half_width with the rounding of offsets
    double late;              // [1/s], of the second half
    double time;              // T [s]

    double late_growth() const { return 0.5 * late * time; }
    double late_half_width() const { return half_width * time / std::numbers::sqrt2; }  // of T/2: √2 half_width T/2
};
ExponentSign sign_of(ExponentRecord const& record);

/// An exponent over members.
struct ExponentOfMembers {
    /// [1/s].  Its half-width is Student's, or what the mean and that of the second halves differ by if that is more: growth by a
    /// constant factor, of the transient of d0, is so in the interval; and the rounding of offsets, which does not average out.
    /// Where growth is no more than a power of time the interval reaches to 0, as both kinds of growth are possible.
    MeanOfMembers mean;
    MeanOfMembers late;  // [1/s], of the second halves, Student's with rounding
    ExponentSign sign;   // of the mean; of a single member its own
    /// Members by their own sign; `power_of_time` are undecided too.
    std::uint64_t above = 0, below = 0, undecided = 0, power_of_time = 0;
};

/// Where all members swing together their scatter does not show it, but their own intervals do: the half-width of the mean growth of the
/// second halves is that of Student, or the mean of the members' own over √n if that is more.
/// @param resolution [1/s], rounding of the offsets.
ExponentOfMembers exponent_of_members(std::span<ExponentRecord const> records, double resolution);

}  // namespace slideway
