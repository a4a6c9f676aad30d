// The walk over the rules between keys.
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/config/reader.hpp"

namespace slideway {
namespace {

/// "a", "b" or "c".
std::string listed(MethodSet methods) {
    std::vector<std::string> names;
    for (int i = 0; i < method_count; ++i) {
        auto const method = static_cast<Method>(i);
        if ((methods & set_of(method)) != 0) names.push_back(fmt::format("\"{}\"", name_of(method)));
    }
    if (names.empty()) return {};
    std::string const last = names.back();
    names.pop_back();
    return fmt::format("{} or {}", fmt::join(names, ", "), last);
}

/// A text of a rule with the scene's words in the place of their names.
std::string filled(std::string_view text, Scene const& scene) {
    Parts const& parts = scene.parts;
    std::vector<std::string_view> rigid;
    for (std::size_t i = 0; i < mechanisms().size(); ++i) {
        if (may_be_rigid(static_cast<Mechanism>(i))) rigid.push_back(mechanism_names()[i]);
    }
    LawInfo const& law = contact_info(parts);
    std::string const leaping = fmt::format(
        ": steps leap over mode switches of contact.law \"{}\" and miss how they separate neighbours, so that exponents come out wrong", law.name);
    MethodSet const methods = methods_of(parts), pairs = methods & method_sets::explicit_pairs;
    return fmt::format(fmt::runtime(text), fmt::arg("mechanism", info(parts.mechanism).name), fmt::arg("law", law.name), fmt::arg("words", law.words),
                       fmt::arg("study", name_of(scene.study)), fmt::arg("design", name_of(scene.design.kind)),
                       fmt::arg("method", name_of(scene.integrator.method)), fmt::arg("methods", listed(methods)), fmt::arg("pairs", listed(pairs)), fmt::arg("any_pair", listed(method_sets::explicit_pairs)),
                       fmt::arg("parameter", scene.chaos.parameter != nullptr ? scene.chaos.parameter->name : std::string_view()),
                       fmt::arg("rigid_mechanisms", fmt::format("{}", fmt::join(rigid, " or "))), fmt::arg("rest", why_no_period(parts)),
                       fmt::arg("leaping", leaping));
}

}  // namespace

void apply_rules(Reading& reading, Known known) {
    using enum KeyRule::What;
    Scene& scene = reading.scene;
    for (KeyRule const& rule : reading.rules) {
        if (rule.after != known) continue;
        Node const* const node = reading.given(rule.key);
        bool const may_hold = rule.what == cannot || rule.what == warns || (rule.what == needs) == (node == nullptr);
        if (!may_hold || !rule.when(reading)) continue;
        Problem const problem{filled(rule.why, scene), filled(rule.instead, scene)};
        switch (rule.what) {
            case excludes: refuse(*node, problem);
            case foreign: refuse_meaningless(node->where, node->name, scene.parts.mechanism);
            case cannot: refuse_study(reading.root, node, rule.key, problem);
            case needs: refuse_missing(*reading.given(rule.asking), rule.key, problem.reason, problem.advice);
            case idle: scene.warnings.push_back(fmt::format("{} has no effect {}", rule.key, problem.reason)); break;
            case warns: scene.warnings.push_back(fmt::format("{}; {}", problem.reason, problem.advice));
        }
    }
}

void apply_rules(Reading const& reading, Key const& varied, Node const& node) {
    for (KeyRule const& rule : reading.rules) {
        if (rule.after == Known::variation && varied.name.starts_with(rule.key) && rule.when(reading))
            refuse(node, {filled(rule.why, reading.scene), filled(rule.instead, reading.scene)});
    }
}

MethodSet methods_of(Parts const& parts) {
    MethodSet methods = 0;
    Scene scene;
    scene.parts = parts;
    Node const nothing;
    Reading const reading{nothing, scene};
    for (int i = 0; i < method_count; ++i) {
        scene.integrator.method = static_cast<Method>(i);
        auto const excludes = [&](KeyRule const& rule) { return rule.after == Known::method && rule.when(reading); };
        if (std::ranges::none_of(reading.rules, excludes)) methods |= set_of(scene.integrator.method);
    }
    return methods;
}

}  // namespace slideway
