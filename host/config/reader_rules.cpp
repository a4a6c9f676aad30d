// The walk over the rules between keys.
#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/config/loads.hpp"
#include "host/config/drive.hpp"
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

std::string rigid_mechanisms() {
    std::vector<std::string_view> rigid;
    for (std::size_t i = 0; i < mechanisms().size(); ++i) {
        if (may_be_rigid(static_cast<Mechanism>(i)) && mechanisms()[i].driven_form == nullptr) rigid.push_back(mechanism_names()[i]);
    }
    return fmt::format("{}", fmt::join(rigid, " or "));
}

/// What texts of rules may say of a scene in braces.
constexpr struct {
    std::string_view name;
    std::string (*text)(Scene const& scene);
} words[] = {
    {"mechanism", [](Scene const& s) { return std::string(info(s.parts.mechanism).name); }},
    {"rigid_mechanisms", [](Scene const&) { return rigid_mechanisms(); }},
    {"law", [](Scene const& s) { return std::string(contact_info(s.parts).name); }},
    {"words", [](Scene const& s) { return std::string(contact_info(s.parts).words); }},
    {"study", [](Scene const& s) { return std::string(name_of(s.study)); }},
    {"design", [](Scene const& s) { return std::string(name_of(s.design.kind)); }},
    {"parameter", [](Scene const& s) { return std::string(s.chaos.parameter->name); }},
    {"drive", [](Scene const& s) { return std::string(drive_names[static_cast<int>(s.parts.drive.by)]); }},
    {"kind", [](Scene const& s) { return std::string(kind_of(s.parts.mechanism)); }},
    {"jumping_load", [](Scene const& s) { return std::string(jumping_load(s.loads.get())); }},
    {"rest", [](Scene const& s) { return why_no_period(s.parts); }},
    {"method", [](Scene const& s) { return std::string(name_of(s.integrator.method)); }},
    {"methods", [](Scene const& s) { return listed(methods_of(s.parts)); }},
    {"pairs", [](Scene const& s) { return listed(methods_of(s.parts) & method_sets::explicit_pairs); }},
    {"any_pair", [](Scene const&) { return listed(method_sets::explicit_pairs); }},
    {"leaping", [](Scene const& s) {
         return fmt::format(": steps leap over mode switches of contact.law \"{}\" and miss how they separate neighbours, so that exponents come out wrong",
                            contact_info(s.parts).name);
     }},
};

/// A text of a rule with the scene's words in the place of their names.
std::string filled(std::string_view text, Scene const& scene) {
    std::string filled;
    for (auto open = text.find('{'); open != text.npos; open = text.find('{')) {
        auto const close = text.find('}', open);
        auto const word = std::ranges::find(words, text.substr(open + 1, close - open - 1), [](auto const& one) { return one.name; });
        if (word == std::end(words)) throw std::logic_error(fmt::format("rules have no word for {}", text.substr(open)));
        filled.append(text.substr(0, open)).append(word->text(scene));
        text.remove_prefix(close + 1);
    }
    return filled.append(text);
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
        bool const whole = !rule.key.ends_with('.') && !rule.key.ends_with('_');  // a key, or how several begin
        bool const meant = whole ? varied.name == rule.key : varied.name.starts_with(rule.key);
        if (rule.after == Known::variation && meant && rule.when(reading))
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
