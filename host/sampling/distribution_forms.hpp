// The distributions of [study.vary] in one table: reading, the resolved scene and `slideway list` all go by it.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "host/sampling/distribution.hpp"

namespace slideway {

struct DistributionArgument {
    std::string_view name;
    double Distribution::*member;  // nullptr: the list of values
    bool plain = false;            // a plain number; else in the key's unit
    bool optional = false;         // 0 where it is not given
};

struct DistributionForm {
    std::string_view name;  // of `dist`
    Distribution::Kind kind;
    std::span<DistributionArgument const> arguments;
    std::string_view meaning;

    bool has_levels() const;  // of a grid: those without have one level, or one for each value
};

/// In the order of `Distribution::Kind`.
std::span<DistributionForm const> distribution_forms();
DistributionForm const& form_of(Distribution::Kind kind);

/// "mean, sd[, low]"
std::string listed_arguments(DistributionForm const& form);

}  // namespace slideway
