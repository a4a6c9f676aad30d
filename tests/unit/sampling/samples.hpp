// Variations and samples for the tests of designs.
#pragma once

#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "host/config/keys.hpp"
#include "host/sampling/design.hpp"

namespace slideway::testing {

inline Distribution unit_uniform() { return {Distribution::Kind::uniform, 0, 0, 0, 1}; }

/// The first n keys, all of one distribution.
inline std::vector<Variation> variations_of(std::size_t n, Distribution const& distribution) {
    std::vector<Variation> variations;
    for (std::size_t i = 0; i < n; ++i) variations.push_back({&keys()[i], distribution, 1});
    return variations;
}

inline Design design_of(DesignKind kind) {
    Design design;
    design.kind = kind;
    return design;
}

/// A design of its kind for d variations; about `members` of them.
struct Planned {
    Design design;
    std::uint64_t members;
};
inline Planned planned(DesignKind kind, std::size_t d, std::uint64_t members) {
    Planned plan{design_of(kind), members};
    if (kind == DesignKind::saltelli) {
        plan.design.base = members / (d + 2);
        plan.members = plan.design.base * (d + 2);
    }
    if (kind == DesignKind::grid) {
        plan.design.levels.assign(d, 2);
        plan.members = std::uint64_t(1) << d;
    }
    return plan;
}

using Columns = std::vector<std::vector<double>>;

/// [variations][members]
inline Columns columns_of(Sampler const& sampler, std::size_t variations, std::uint64_t members) {
    Columns columns(variations);
    std::vector<double> values(variations);
    for (std::uint64_t member = 0; member < members; ++member) {
        sampler.draw(member, values);
        for (std::size_t i = 0; i < variations; ++i) columns[i].push_back(values[i]);
    }
    return columns;
}

inline Columns columns_of(Design const& design, std::vector<Variation> const& variations, std::uint64_t members,
                          std::uint64_t seed = 1) {
    return columns_of(Sampler(design, variations, seed, members), variations.size(), members);
}

inline double mean_of(std::span<double const> x) {
    return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

/// Pearson's r.
inline double correlation_of(std::span<double const> x, std::span<double const> y) {
    double const mx = mean_of(x), my = mean_of(y);
    double xy = 0, xx = 0, yy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xy += (x[i] - mx) * (y[i] - my);
        xx += (x[i] - mx) * (x[i] - mx);
        yy += (y[i] - my) * (y[i] - my);
    }
    return xy / std::sqrt(xx * yy);
}

inline double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

}  // namespace slideway::testing
