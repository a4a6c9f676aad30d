#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "host/config/reader.hpp"
#include "host/config/scene_text.hpp"
#include "host/config/values.hpp"
#include "host/sampling/distribution_forms.hpp"

namespace slideway {
namespace {

using Kind = Distribution::Kind;

DistributionForm const& read_form(Node const& node) {
    constexpr std::string_view example = "{ dist = \"unif\", low = 0, high = 1 }";
    if (!node.is_table()) refuse(node, {"not a distribution", fmt::format("write for example {}", example)});
    Node const* const dist = node.find("dist");
    if (dist == nullptr) {
        throw SceneError(fmt::format("{}: {} has no dist (how the key scatters); write for example {}", node.where,
                                     one_line(node.name), example));
    }
    std::vector<std::string_view> names;
    for (DistributionForm const& form : distribution_forms()) names.push_back(form.name);
    return distribution_forms()[read_choice(*dist, "distribution", names)];
}

void refuse_unknown_arguments(Node const& node, DistributionForm const& form) {
    for (Node const& child : node.children) {
        bool known = child.key == "dist" || (child.key == "levels" && form.has_levels());
        for (DistributionArgument const& argument : form.arguments) known = known || argument.name == child.key;
        if (!known) {
            refuse(child,
                   {fmt::format("no argument of \"{}\"", form.name), fmt::format("use {}", listed_arguments(form))});
        }
    }
}

/// A distribution and where its arguments stand, for what they must meet.
class Check {
public:
    Check(Node const& node, Key const& key, Distribution const& distribution)
        : node_(node), key_(key), d_(distribution) {}

    void run() const {
        switch (d_.kind) {
            case Kind::constant:
                return rule("value", d_.mean);
            case Kind::uniform:
                return ends();
            case Kind::triangular:
                ends();
                return within_ends("mode", d_.mode);
            case Kind::normal:
                // Without bounds some values may break the rule: their members fail alone.
                rule("mean", d_.mean);
                return positive("sd", d_.sd, key_.unit, "a standard deviation is positive");
            case Kind::truncated_normal:
                rule("low", d_.low);
                rule("high", d_.high);
                positive("sd", d_.sd, key_.unit, "a standard deviation is positive");
                ordered();
                return near_ends();
            case Kind::lognormal:
                lower_end();
                rule("mean", d_.mean);
                positive("sd", d_.sd, key_.unit, "a standard deviation is positive");
                if (!(d_.mean > d_.low)) {
                    refuse_argument("mean", d_.mean, key_.unit,
                                    {fmt::format("not above low, {}", with_unit(d_.low, key_.unit)),
                                     "use mean > low, above which all values lie"});
                }
                return;
            case Kind::weibull:
                lower_end();
                positive("scale", d_.scale, key_.unit, "a scale is positive");
                return positive("shape", d_.shape, "1", "a shape is positive");
            case Kind::values:
                return;  // each was read within the rule
        }
    }

private:
    [[noreturn]] void refuse_argument(std::string_view name, double value, std::string_view unit,
                                      Problem const& problem) const {
        refuse(*node_.find(name), with_unit(value, unit), problem);
    }
    void rule(std::string_view name, double value) const {
        if (auto const problem = broken_rule(key_, value)) refuse_argument(name, value, key_.unit, *problem);
    }
    void positive(std::string_view name, double value, std::string_view unit, std::string const& reason) const {
        if (!(value > 0)) refuse_argument(name, value, unit, {reason, "use a value > 0"});
    }
    void ordered() const {
        if (d_.low < d_.high) return;
        refuse_argument(
            "high", d_.high, key_.unit,
            {fmt::format("not above low, {}", with_unit(d_.low, key_.unit)), "use low < high, or dist = \"const\""});
    }
    void ends() const {
        rule("low", d_.low);
        rule("high", d_.high);
        ordered();
    }
    void within_ends(std::string_view name, double value) const {
        if (value >= d_.low && value <= d_.high) return;
        refuse_argument(name, value, key_.unit,
                        {fmt::format("outside low and high, {} and {}", with_unit(d_.low, key_.unit),
                                     with_unit(d_.high, key_.unit)),
                         fmt::format("use low <= {} <= high", name)});
    }
    void near_ends() const {
        // Beyond some 37 standard deviations the tail's probability is no longer a double.
        constexpr double farthest = 30;
        if (d_.low - d_.mean <= farthest * d_.sd && d_.mean - d_.high <= farthest * d_.sd) return;
        refuse_argument("mean", d_.mean, key_.unit,
                        {"it lies more than 30 sd outside low and high", "move the mean or the limits"});
    }
    /// Values lie above low, which itself may break the rule: a positive key may begin at 0.
    void lower_end() const {
        auto const problem = broken_rule(key_, std::nextafter(d_.low, std::numeric_limits<double>::infinity()));
        if (!problem) return;
        if (node_.find("low") != nullptr) refuse_argument("low", d_.low, key_.unit, *problem);
        throw SceneError(fmt::format("{}: {} has no low (its values would begin at 0: {}); add low = ..., {}",
                                     node_.where, one_line(node_.name), problem->reason, problem->advice));
    }

    Node const& node_;
    Key const& key_;
    Distribution const& d_;
};

}  // namespace

Distribution read_distribution(Node const& node, Key const& key) {
    DistributionForm const& form = read_form(node);
    refuse_unknown_arguments(node, form);
    Distribution distribution;
    distribution.kind = form.kind;
    for (DistributionArgument const& argument : form.arguments) {
        Node const* const child = node.find(argument.name);
        if (child == nullptr) {
            if (argument.optional) continue;
            throw SceneError(fmt::format("{}: {} has no {} (\"{}\" needs {}); add {} = ...", node.where,
                                         one_line(node.name), argument.name, form.name, listed_arguments(form),
                                         argument.name));
        }
        if (argument.member == nullptr) {
            distribution.list = read_list(*child, key, 10'000, "[1, 2]");
        } else {
            distribution.*argument.member = read_number(*child, argument.plain ? "1" : key.unit);
        }
    }
    Check(node, key, distribution).run();
    return distribution;
}

}  // namespace slideway
