// Two packs abreast as each instruction set computes them.
#pragma once

#include <cstddef>
#include <vector>

#include "kernels/block.hpp"

namespace slideway {

inline constexpr std::size_t vocabulary_lanes = 16;  // a multiple of every number's
inline constexpr int vocabulary_results = 32;

/// Three operands of every operation of kernels/real.hpp; results [vocabulary_results][vocabulary_lanes], truth values as 0 and 1.
struct VocabularyCase {
    double const *a, *b, *c;  // [vocabulary_lanes]
    double* results;
};

/// Relief valves with their first 4 events as transient and the next 16 recorded.
inline constexpr std::size_t recorded_twin_events = 16;
struct TwinValves {
    std::vector<double> inflows;
    IntegratorSettings settings;
    // results
    std::vector<MemberRecord> records;
    std::vector<double> states, lifts;  // [member][3], [member][recorded_twin_events]
};

/// Each instruction set's namespace has one `twin_kernel`.
struct TwinKernel {
    void (*vocabulary)(VocabularyCase const& c, bool twin);
    /// any and all of the mask whose lanes are true in `bits`, as `any + 2 all`; and the bits that come back.
    int (*truth)(unsigned bits, unsigned& returned);
    int twin_lanes;
    void (*valves)(TwinValves& c, bool twin);
};

}  // namespace slideway
