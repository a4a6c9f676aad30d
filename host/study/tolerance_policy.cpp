#include "host/study/tolerance_policy.hpp"

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/config/descriptors.hpp"

namespace slideway {

bool is_random(DesignKind design) { return design != DesignKind::grid && design != DesignKind::table; }

std::string policy_of(DesignKind design) {
    std::string text(
        "Moments, quantiles and histograms are of the members that finished. Members that failed are counted by status "
        "and meet no limit. Members that did not run are left out.");
    if (design == DesignKind::saltelli) {
        text +=
            " Of this saltelli design, distributions and yields are of the members of A and B; rows with a member that "
            "failed or is missing are left out of the indices whole.";
    }
    return text;
}

std::string intervals_of(DesignKind design, bool complete) {
    if (!complete) {
        return "none: members have not run, and not at random: the slow ones are missing, and quick ones are too many "
               "among the others";
    }
    std::string const level = fmt::format("{:.0f} % intervals of independent draws", 100 * confidence_level);
    std::string const skewed = "; those of means hold less often where draws are few and skewed";
    if (!is_random(design)) return "none: the members are no random draws";
    if (design == DesignKind::mc) return level + skewed;
    return level + "; as a rule too wide, for the draws of this design are spread more evenly";
}

std::vector<QuantityColumn> report_columns(Selection quantities) {
    std::vector<QuantityColumn> columns;
    for (int q = 0; q < quantity_count; ++q) {
        if (!selects(quantities, static_cast<Quantity>(q))) continue;
        QuantityInfo const& info = quantity_table[q];
        QuantityColumn column;
        column.quantity = info.name;
        column.unit = info.unit;
        column.long_name = info.long_name;
        if (info.dimension == nullptr) {
            columns.push_back(column);
            continue;
        }
        column.dimension = info.dimension;
        for (std::string const& label : labels_of(info.dimension)) {
            column.label = label;
            columns.push_back(column);
            ++column.index;
        }
    }
    return columns;
}

Proportion yield_of(std::uint64_t met, std::uint64_t trials, bool random) {
    Proportion yield = proportion(met, trials, confidence_level);
    if (!random) yield.interval = Interval();
    return yield;
}

void refuse_limit(Limit const& limit, std::string const& path) {
    throw FileError(
        fmt::format("{}: has no {}, which study.limits names; add it to study.quantities", path, limit.name()));
}

}  // namespace slideway
