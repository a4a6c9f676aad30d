// The period of what drives a mechanism: a revolution of its crank, or the carriage's way there and back; and what of it members may have.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "host/config/reader.hpp"
#include "kernels/members/drive_period.hpp"

namespace slideway {
namespace {

/// Low and high ends beyond which none of 1e15 draws lies.
std::pair<double, double> ends_of(Distribution const& d) {
    constexpr double deviations = 8, rare = 1e-15;
    switch (d.kind) {
        case Distribution::Kind::constant: return {d.mean, d.mean};
        case Distribution::Kind::normal: return {d.mean - deviations * d.sd, d.mean + deviations * d.sd};
        case Distribution::Kind::weibull: return {d.low + d.scale * std::pow(rare, 1 / d.shape), d.low + d.scale * std::pow(-std::log(rare), 1 / d.shape)};
        case Distribution::Kind::lognormal: {
            // Of ln(x - low): variance ln(1 + (sd/m)²) and mean ln m - variance/2, m = mean - low.
            double const m = d.mean - d.low, variance = std::log1p((d.sd / m) * (d.sd / m));
            double const median = m * std::exp(-variance / 2), spread = std::exp(deviations * std::sqrt(variance));
            return {d.low + median / spread, d.low + median * spread};
        }
        case Distribution::Kind::uniform:
        case Distribution::Kind::triangular:
        case Distribution::Kind::truncated_normal:
        case Distribution::Kind::values: break;
    }
    return {d.low, d.high};
}

/// Magnitudes that members may have of a key, in which they may differ: those of their own values, or of an end that they share.  None: one, the scene's.
std::optional<Range> magnitudes(Scene const& scene, Key const& key) {
    std::optional<Range> range;
    auto const take = [&](double low, double high) {
        double const least = low <= 0 && high >= 0 ? 0 : std::min(std::abs(low), std::abs(high)), most = std::max(std::abs(low), std::abs(high));
        range = range ? Range{std::min(range->low, least), std::max(range->high, most)} : Range{least, most};
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
                if (!broken_rule(key, value)) take(value, value);  // other members fail before they run
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

}  // namespace

double drive_period(Parts const& parts, Inputs const& inputs) { return drive_period(info(parts.mechanism), parts.drive, inputs); }

double turn_length(Scene const& scene) { return scene.goes_by_turns() ? 2 * std::numbers::pi : drive_period(scene.parts, scene.inputs); }

double first_time_at(double phase, Parts const& parts, Inputs const& inputs) { return first_time_at(phase, info(parts.mechanism), parts.drive, inputs); }

double steady_period(Parts parts, Inputs const& inputs) {
    parts.drive = {};
    return drive_period(parts, inputs);
}

std::string why_no_period(Parts const& parts) {
    if (parts.drive.by == DriveBy::profile) return "the drive's profile does not repeat";
    if (parts.drive.by == DriveBy::torque) return "no speed is given of a crank on a motor";
    if (parts.drive.by == DriveBy::nothing) return "nothing drives a free crank";
    if (info(parts.mechanism).drive != DriveKind::none) return "mechanism.crank_speed is 0";
    return std::string("nothing drives a ") + info(parts.mechanism).name;
}

PeriodRange drive_periods(Scene const& scene) {
    Inputs shortest = scene.inputs, longest = scene.inputs;
    PeriodRange range{0, 0, nullptr};
    /// @param at_least, at_most whose period has the key's least and largest magnitude
    auto const vary = [&](std::string_view name, Inputs& at_least, Inputs& at_most) {
        Key const& key = *find_key(name);
        auto const varied = magnitudes(scene, key);
        if (varied && range.varied == nullptr) range.varied = &key;
        double const own = std::abs(key.get(scene.inputs));
        key.set(at_least, varied ? varied->low : own);
        key.set(at_most, varied ? varied->high : own);
    };
    if (info(scene.parts.mechanism).drive == DriveKind::carriage) {
        vary("mechanism.carriage_speed", longest, shortest);
        vary("mechanism.stroke", shortest, longest);
        vary("mechanism.reversal_time", shortest, longest);
    } else if (std::isfinite(drive_period(scene.parts, Inputs{}))) {
        vary("mechanism.crank_speed", longest, shortest);
    }
    range.least = drive_period(scene.parts, shortest);
    range.most = drive_period(scene.parts, longest);
    return range;
}

double fastest_period(Scene const& scene) {
    if (scene.parts.drive.by == DriveBy::speed) {
        // What scatters by less has the steps of the scene's own member.
        constexpr double little = 0.8;
        double const own = drive_period(scene.parts, scene.inputs), least = drive_periods(scene).least;
        return scene.study == StudyKind::sweep || least < little * own ? least : own;
    }
    auto const largest = [&](std::string_view name) {
        Key const& key = *find_key(name);
        auto const varied = magnitudes(scene, key);
        return varied ? varied->high : std::abs(key.get(scene.inputs));
    };
    Inputs in = scene.inputs;
    if (scene.parts.drive.turns_freely()) {
        in.crank_speed = std::max(largest("mechanism.crank_speed"), largest("drive.no_load_speed"));
    } else {
        double const scale = largest("drive.scale");
        in.crank_speed *= scale, in.carriage_speed *= scale, in.stroke *= scale;
    }
    return steady_period(scene.parts, in);
}

double shortest_reversal(Scene const& scene) {
    auto const varied = magnitudes(scene, *find_key("mechanism.reversal_time"));
    // Members at 0 fail before they run.
    return varied && varied->low > 0 ? varied->low : scene.inputs.reversal_time;
}

}  // namespace slideway
