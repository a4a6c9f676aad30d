#include "host/study/check_sample.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "host/store/result_layout.hpp"

namespace slideway {
namespace {

/// A group for each value; none where there are too many of them.
std::vector<MemberGroup> by_value(std::string_view key, std::vector<double> const& values,
                                  ToleranceMembers const& members, std::size_t most) {
    std::map<double, MemberGroup> groups;
    for (std::size_t row = 0; row < values.size(); ++row) {
        if (!members.finished(row)) continue;
        auto& group = groups[values[row]];
        if (groups.size() > most) return {};  // before there are as many as members
        group.has.resize(values.size());
        group.has[row] = 1;
    }
    std::vector<MemberGroup> found;
    if (groups.size() < 2 || groups.size() > most) return found;
    for (auto& [value, group] : groups) {
        group.name = fmt::format("{} = {:.6g}", key, value);
        found.push_back(std::move(group));
    }
    return found;
}

SobolAxis scrambled_axis(std::uint64_t seed) {
    return {sobol_directions(1).front(), {seed, name_hash("verification")}, Stream::scramble};
}

}  // namespace

std::size_t MemberGroup::size() const { return static_cast<std::size_t>(std::ranges::count(has, 1)); }

std::vector<MemberGroup> member_groups(ToleranceMembers const& members, Scene const& scene) {
    std::vector<MemberGroup> groups{{"", std::vector<char>(members.size())}};
    for (std::size_t row = 0; row < members.size(); ++row) groups.front().has[row] = members.finished(row);
    auto const add = [&](Key const& key, std::size_t most) {
        std::vector<MemberGroup> found = by_value(key.name, members.column(variable_name(key.name)), members, most);
        std::ranges::move(found, std::back_inserter(groups));
    };
    if (scene.study == StudyKind::sweep) add(*scene.chaos.parameter, members.size());
    // Starts of a sweep come again in each column, and rows of a table may: they are no values that the study is about.
    std::size_t const most = std::min(most_values, groups.front().size() / 2);
    for (Variation const& variation : scene.variations) {
        bool const is_list = variation.column == Variation::no_column && variation.distribution.kind == Distribution::Kind::values;
        if (is_list || scene.design.kind == DesignKind::grid) add(*variation.key, most);
    }
    return groups;
}

CheckSample::CheckSample(std::vector<std::size_t> rows, std::vector<MemberGroup> const& groups,
                         std::vector<double> const& cost, std::uint64_t seed)
    : order_(std::move(rows)), axis_(scrambled_axis(seed)) {
    std::ranges::stable_sort(order_, [&](std::size_t a, std::size_t b) {
        for (MemberGroup const& group : groups) {
            if (group.has[a] != group.has[b]) return group.has[a] > group.has[b];
        }
        return cost[a] < cost[b];
    });
}

std::vector<std::size_t> CheckSample::next(std::size_t count) {
    std::vector<std::size_t> rows;
    for (std::size_t const wanted = std::min(count, left()); rows.size() < wanted;) {
        auto place = static_cast<std::size_t>(axis_(point_++) * static_cast<double>(order_.size()));
        while (!drawn_.insert(place).second) place = (place + 1) % order_.size();
        rows.push_back(order_[place]);
    }
    return rows;
}

}  // namespace slideway
