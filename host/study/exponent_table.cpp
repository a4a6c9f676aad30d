#include "host/study/exponent_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "host/base/numbers.hpp"
#include "host/config/descriptors.hpp"

namespace slideway {
namespace {

/// Exponents are 0 where they are but rounding: an orbit at rest would have any dimension else.
double dimension(std::vector<double> exponents, double resolution) {
    for (double& exponent : exponents) {
        if (std::abs(exponent) < resolution) exponent = 0;
    }
    return kaplan_yorke_dimension(exponents);
}

}  // namespace

ExponentTable::ExponentTable(Scene const& scene)
    : parts_(scene.parts),
      schedule_(orbit_schedule(scene)),
      exponents_(static_cast<std::size_t>(shadow_plan(scene).count)),
      d0_(scene.chaos.d0) {
    if (exponents_ == 0) return;
    ResultColumn exponent{"exponent", "1", "number of the exponent, the largest first", {"exponent"}};
    for (std::size_t j = 1; j <= exponents_; ++j) exponent.values.push_back(static_cast<double>(j));
    columns_.push_back(std::move(exponent));
    add_exponents();
    add_health();
    add_history(scene.chaos.history);
}

void ExponentTable::add(std::string name, std::string unit, std::string meaning, std::vector<std::string> const& along, Row row) {
    std::size_t width = 1;
    std::vector<std::string> dimensions{"member"};
    for (std::string const& axis : along) {
        dimensions.push_back(axis);
        width *= std::ranges::find(columns_, axis, &ResultColumn::name)->values.size();
    }
    auto const source = [from = width_, width](EndedMember const& of_member, ResultColumn::Numbers& out) {
        auto const numbers = of_member.study.subspan(from, width);
        out.insert(out.end(), numbers.begin(), numbers.end());
    };
    columns_.push_back({std::move(name), std::move(unit), std::move(meaning), std::move(dimensions), "", source});
    width_ += width;
    rows_.push_back(std::move(row));
}

void ExponentTable::add_exponents() {
    std::vector<std::string> const along{"exponent"};
    using Numbers = std::vector<double>;
    add("lyapunov_exponent", "s-1", "finite-time Lyapunov exponents, the largest first", along, [](Member const& m) { return m.exponents.value; });
    add("lyapunov_exponent_error", "s-1", "standard error of the exponent, by batch means", along, [](Member const& m) { return m.exponents.standard_error; });
    add("lyapunov_exponent_half_width", "s-1",
         "half the width of the exponent's 95 % interval, by Student's t of at least 8 batches, resolution included", along,
        [](Member const& m) {
            Numbers widths = m.exponents.half_width;
            for (double& width : widths) width += m.resolution;
            return widths;
        });
    add("lyapunov_exponent_late", "s-1", "exponent of the second half of the record alone", along, [](Member const& m) { return m.exponents.late; });
    if (schedule_.by_turns) {
        add("lyapunov_exponent_per_turn", "1", "growth of offsets in a turn of the crank, ln", along, [](Member const& m) {
            Numbers values = m.exponents.value;
            for (double& value : values) value *= m.turn;
            return values;
        });
    }
    add("lyapunov_time", "s", "time over which the exponents are taken, after the transient", {},
        [](Member const& m) { return Numbers{m.log.length * static_cast<double>(m.log.intervals())}; });
    if (exponents_ < 2) return;
    add("kaplan_yorke_dimension", "1",
         "Kaplan-Yorke dimension of the map over a period of the drive, one less than the flow's; a lower bound where it is the number of exponents", {},
        [](Member const& m) { return Numbers{dimension(m.exponents.value, m.resolution)}; });
}

void ExponentTable::add_health() {
    using Numbers = std::vector<double>;
    add("lyapunov_resolution", "s-1", "least exponent that is more than the rounding of resting offsets", {},
        [](Member const& m) { return Numbers{m.resolution}; });
    add("rescalings", "1", "times that offsets were rescaled while the exponents were taken", {},
        [every = static_cast<double>(schedule_.stops.growth_every)](Member const& m) { return Numbers{every * static_cast<double>(m.log.intervals())}; });
    add("lost_offsets", "1", "times that an offset had shrunk into rounding: then exponents are upper bounds", {},
        [](Member const& m) { return Numbers{static_cast<double>(m.record.lost_offsets)}; });
    add("grown_offsets", "1", "times that an offset had grown to the size of the joint: then exponents are too small", {},
        [](Member const& m) { return Numbers{static_cast<double>(m.record.grown_offsets)}; });
}

void ExponentTable::add_history(std::size_t points) {
    std::size_t const records = schedule_.stops.growths(), count = std::min(records, points);
    if (count == 0) return;
    ResultColumn history{"history", "1", "rescalings after the transient", {"history"}};
    std::vector<std::size_t> after;
    for (std::size_t i = 1; i <= count; ++i) {
        after.push_back(i * records / count);
        history.values.push_back(static_cast<double>(after.back() * schedule_.stops.growth_every));
    }
    columns_.push_back(std::move(history));
    add("lyapunov_history", "s-1", "running exponents after so many rescalings", {"history", "exponent"}, [after](Member const& m) {
        std::vector<double> row(after.size() * m.log.count);
        for (std::size_t j = 0; j < m.log.count; ++j) {
            auto const of_offset = running_exponents(m.log, j, after);
            for (std::size_t i = 0; i < after.size(); ++i) row[i * m.log.count + j] = of_offset[i];
        }
        return row;
    });
}

ExponentTable::Member ExponentTable::member(BlockResult const& block, std::size_t i) const {
    Inputs const& inputs = block.inputs[i];
    double spacing = schedule_.timing(inputs).period, turn = drive_period(parts_, inputs);
    std::size_t const per_member = schedule_.stops.growths() * exponents_;
    std::vector<double> growths = largest_first(block.growths.subspan(i * per_member, per_member), exponents_);
    GrowthLog log{growths, exponents_, spacing * static_cast<double>(schedule_.stops.growth_every)};
    if (schedule_.by_turns) {
        // What lies between two angles counts as long as any other: as their mean.
        MemberRecord const& record = block.records[i];
        StopPlan const& stops = schedule_.stops;
        double const turned = spacing * static_cast<double>(stops.count - 1 - stops.growth_from()), pace = turned > 0 ? (record.time - record.growth_from) / turned : nan;
        turn = 2 * std::numbers::pi * pace, spacing *= pace, log.length *= pace;
    }
    double const per_turn = turn / log.length;
    // Records that do not divide a turn have no period of its own.
    bool const divides = std::abs(per_turn - std::round(per_turn)) < 1e-6 * per_turn && per_turn >= 0.5;
    if (divides && per_turn < 1e9) log.period = static_cast<std::size_t>(std::round(per_turn));
    return {std::move(growths), log, exponents_of(log), least_distance / (d0_ * spacing), turn, block.records[i]};
}

std::vector<double> ExponentTable::row(BlockResult const& block, std::size_t place) const {
    std::vector<double> numbers;
    if (exponents_ == 0) return numbers;
    Member const of_member = member(block, place);
    for (Row const& row : rows_) {
        std::vector<double> const some = row(of_member);
        numbers.insert(numbers.end(), some.begin(), some.end());
    }
    return numbers;
}

}  // namespace slideway
