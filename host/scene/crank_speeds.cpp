#include <algorithm>
#include <cmath>
#include <utility>

#include "host/scene/reader.hpp"

namespace slideway {
namespace {

/// Low and high ends beyond which none of 1e15 draws lies.
std::pair<double, double> ends_of(Distribution const& d) {
    constexpr double deviations = 8, rare = 1e-15;
    switch (d.kind) {
        case Distribution::Kind::constant:
            return {d.mean, d.mean};
        case Distribution::Kind::normal:
            return {d.mean - deviations * d.sd, d.mean + deviations * d.sd};
        case Distribution::Kind::lognormal: {
            // Of ln(x - low): variance ln(1 + (sd/m)²) and mean ln m - variance/2, m = mean - low.
            double const m = d.mean - d.low, variance = std::log1p((d.sd / m) * (d.sd / m));
            double const median = m * std::exp(-variance / 2), spread = std::exp(deviations * std::sqrt(variance));
            return {d.low + median / spread, d.low + median * spread};
        }
        case Distribution::Kind::weibull:
            return {d.low + d.scale * std::pow(rare, 1 / d.shape),
                    d.low + d.scale * std::pow(-std::log(rare), 1 / d.shape)};
        default:
            return {d.low, d.high};
    }
}

}  // namespace

SpeedRange crank_speeds(Scene const& scene) {
    Key const& key = *find_key("mechanism.crank_speed");
    SpeedRange range{std::abs(scene.inputs.crank_speed), std::abs(scene.inputs.crank_speed), false};
    auto const take = [&](double low, double high) {
        if (!range.several) range.least = range.most = std::abs(low);
        range.several = true;
        double const least = low <= 0 && high >= 0 ? 0 : std::min(std::abs(low), std::abs(high));
        range.least = std::min(range.least, least);
        range.most = std::max({range.most, std::abs(low), std::abs(high)});
    };
    auto const take_each = [&](std::vector<double> const& values) {
        for (double const value : values) take(value, value);
    };
    for (Variation const& variation : scene.variations) {
        if (variation.key != &key) continue;
        if (variation.column != Variation::no_column) {
            MemberTable const& table = *scene.design.table;
            for (std::size_t row = 0; row < std::min<std::size_t>(table.rows(), scene.members); ++row) {
                double const value = table.values[row * table.columns + variation.column];
                if (std::isfinite(value)) take(value, value);  // other members fail before they run
            }
        } else if (variation.distribution.kind == Distribution::Kind::values) {
            take_each(variation.distribution.list);
        } else {
            auto const [low, high] = ends_of(variation.distribution);
            take(low, high);
        }
    }
    if (scene.chaos.parameter == &key) take_each(scene.chaos.values);
    return range;
}

}  // namespace slideway
