// Why a number cannot be used: the words behind `defect`, in the parts that the reader needs for its positions.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "host/config/keys.hpp"

namespace slideway {

/// `reason` goes into the parentheses of a message, `advice` after the semicolon.
struct Problem {
    std::string reason;
    std::string advice;
};

/// What a number may be; the words of a refusal come from the limits.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_included = true;
};

/// The problem of one value with its key's rule; NaN and infinity break every rule.
std::optional<Problem> broken_rule(Key const& key, double value);

/// What `defect` found: the key to blame, and another one whose value it clashes with (nullptr if none).
struct Defect {
    Key const* key;
    Key const* other;
    double value;
    Problem problem;
};
std::optional<Defect> find_defect(Inputs const& inputs, Parts const& parts);

/// "0.05 m"; a plain number for the unit "1".
std::string with_unit(double value, std::string_view unit);

}  // namespace slideway
