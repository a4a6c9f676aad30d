// Sensitivity of an output to each of its inputs, from a radial design.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "host/statistics/summary.hpp"

namespace slideway {

/// Output at the rows of A, of B, and of A with column i from B: [rows][inputs + 2] as A, B, AB_1 … AB_d.
struct RadialValues {
    std::size_t inputs = 0;  // d
    std::span<double const> values;
    std::size_t rows() const { return values.size() / (inputs + 2); }
};

struct BootstrapSettings {
    std::size_t replicates = 500;
    double level = 0.95;
    std::uint64_t seed = 1;
    int threads = 1;  // at most; results do not depend on them
};

struct SobolIndices {
    std::size_t rows = 0;                     // used
    std::size_t missing = 0;                  // rows with a NaN, left out whole
    double variance;                          // of the output over A and B, with 2·rows as divisor [unit²]
    std::vector<Estimate> first, total;  // [inputs]
    Estimate first_sum;                  // of the first-order indices; 1 without interactions
};

/// Sobol's indices of first order S_i = V(E(f|x_i))/V and total T_i = E(V(f|x_~i))/V by
///   S_i = 1/N Σ f_B (f_AB_i - f_A) / V,   T_i = 1/(2N) Σ (f_A - f_AB_i)² / V,
/// with f less its mean over A and B, and V its variance there.
/// Source: Saltelli et al. (2010), Variance based sensitivity analysis of model output, Comput. Phys. Commun. 181,
/// table 2 (b) and (f); (f) is Jansen (1999), ibid. 117.
///
/// Intervals are percentiles of bootstrap replicates (Efron and Tibshirani 1993, 13.3) that draw rows with replacement,
/// expanded for few rows (Hesterberg 2015, What teachers should know about the bootstrap, Am. Statistician 69, 3.3.2): the
/// tail is Φ(-t √(n/(n-1))), t Student's of n - 1.  Of independent rows of Ishigami's function 95 % ones hold the index in
/// 92.8 to 96 % of studies of 256 rows or more, of 64 rows in 91.8 to 95 % (tests/validation/slow/coverage_test.cpp).  Of more
/// than 2^16 rows, 2^16 groups of neighbouring rows are drawn instead; estimates are functions of sums over
/// rows, so groups are as good.  Draws are Philox words keyed by seed and counted by replicate: results depend on
/// neither the threads nor their number.
///
/// @return dimensionless indices; NaN where V is 0 or an infinite output is involved, intervals NaN with fewer than two
/// rows. Estimates of small indices can be negative, of large ones above 1.
SobolIndices sobol_indices(RadialValues const& design, BootstrapSettings const& bootstrap = {});

}  // namespace slideway
