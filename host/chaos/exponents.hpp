// Finite-time Lyapunov exponents from the logarithms of growth that an ensemble's shadows leave.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace slideway {

/// The exponents of one orbit.  Growth is ln(d after/d before) over a record of equal length; the exponents are its mean rate,
/// λ_j = Σ_i g_ij / Σ time (Benettin, Galgani, Giorgilli, Strelcyn, Meccanica 15 (1980) 9–30).
struct FiniteTimeExponents {
    std::vector<double> values;  // [k] in 1/time; NaN where no record is
    std::vector<double> errors;  // [k] standard errors by batch means; NaN for fewer than 4 records
};

/// @param growths [records][k], NaN from where the orbit ended before its time; what is behind a NaN does not count.
/// @param record length of a record [time]
/// The error comes from the spread of some √records batches of neighbouring records, at most 32: they are nearly independent where a
/// batch outlasts the memory of the orbit.
FiniteTimeExponents finite_time_exponents(std::span<double const> growths, std::size_t k, double record);

/// Running exponents: those after the first n records, for each n of `after` (ascending).  [after][k]
std::vector<double> exponent_history(std::span<double const> growths, std::size_t k, double record,
                                     std::span<std::size_t const> after);

/// Kaplan–Yorke dimension: j + (λ_1 + … + λ_j)/|λ_{j+1}|, j the most exponents whose sum is not negative (Kaplan & Yorke 1979).
/// 0 where all are negative.  Where the sum of all that are given is not negative, that bounds nothing: NaN.
/// @param exponents sorted, largest first
double kaplan_yorke_dimension(std::span<double const> exponents);

/// A mean with its confidence interval: mean ± half_width holds the true one in 95 % of the cases, by Student's t for
/// independent, nearly normal values; NaN for fewer than 2.
struct MeanInterval {
    std::size_t count = 0;  // numbers used, NaN left out
    double mean, half_width;
};
MeanInterval mean_interval(std::span<double const> values);

/// 97.5 % quantile of Student's t with n degrees of freedom.
double student_quantile(double degrees);

}  // namespace slideway
