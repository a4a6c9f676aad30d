// How far the mean of a study may be off by an error of each of its members, as those tell that were looked at twice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace slideway {

/// Bound of the error of a mean, in the unit of what is averaged.
struct ErrorBound {
    std::size_t pairs = 0;
    double difference;  // mean of the pairs' differences; NaN of none
    double
        half_width;  // of its 95 % interval, by Student's t; 0 where all members are pairs and there is one; NaN of one pair of several
    double unseen;  // what members that are no pairs may add, though no pair has shown it
    double bound;   // x = max(|difference| + half of its 99 % interval, unseen); NaN where one of them is
    double
        p;  // of a mean difference as large if there were none: paired t-test (Student 1908); NaN of fewer than two pairs
};

/// Two bounds, of which the larger holds.  Where many members differ, the mean of n pairs drawn at random is off by Student's t.  Where none of n
/// pairs does, up to a share `unseen_share(n, members)` of the members may, by any amount: Student's t would tell nothing of them.  They come from
/// the same study, and their mean is taken to be off by no more than its `spread`.
/// @param differences of the pairs, those of members drawn at random  @param members of the study, >= pairs  @param spread their standard deviation, or what else they may be off by
/// @param grain of numbers that are its multiples, as counts are of 1; else 0.  A few of them that are alike by chance are not certain: p takes them to
/// scatter by their rounding, grain/√12, at least.
ErrorBound error_bound(std::span<double const> differences, std::uint64_t members, double spread, double grain = 0);

/// Largest share of the members that may have a property which none of n has that were drawn at random without putting back, at 95 %: the share
/// d = D/N whose D of N are missed with 5 %, Π (1 − D/(N − i)) over i < n, by (1 − D/(N − (n − 1)/2))^n.  About 3/n where n is far below N
/// (the rule of three: Hanley & Lippman-Hand, JAMA 249 (1983) 1743); 0 where all were drawn.
double unseen_share(std::size_t drawn, std::uint64_t members);

/// Adjusted p-values of several tests at once (Holm 1979): those below α keep the chance of any false alarm among all below α.
/// @param p may hold NaN, tests that were not made, which stay NaN and do not count
std::vector<double> holm_adjusted(std::span<double const> p);

}  // namespace slideway
