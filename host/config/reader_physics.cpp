#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/config/reader.hpp"

namespace slideway {
namespace {

/// Of a slider at rest velocities are small: atol alone holds its ringing. At the size of rtol an explicit pair at its limit of stability puts as
/// much energy into it as damping takes, and it never comes to rest (docs/integrators.md).
constexpr double atol_per_rtol = 0.1;

void check_rivals(std::vector<GivenKey> const& given) {
    for (std::size_t i = 0; i < given.size(); ++i) {
        for (std::size_t j = i + 1; j < given.size(); ++j) {
            // An option may refine what the file says in general: the later one takes effect.
            bool const both_in_file = given[i].node->order == 0 && given[j].node->order == 0;
            if (both_in_file && given[i].key->overlaps(*given[j].key)) {
                refuse(*given[j].node,
                       {fmt::format("{} in line {} sets it too", given[i].key->name, given[i].node->line),
                        "remove one of the two"});
            }
        }
    }
}

/// Whether contacts are rigid, which not every mechanism has.
bool read_rigid(Node const& root, Mechanism mechanism) {
    Node const* const law = root.find_path("contact.law");
    if (law == nullptr || law->type != Node::Type::text || law->text != rigid_contact.name) return false;
    if (may_be_rigid(mechanism)) return true;
    std::vector<std::string_view> may;
    for (std::size_t i = 0; i < mechanisms().size(); ++i) {
        if (may_be_rigid(static_cast<Mechanism>(i))) may.push_back(mechanism_names()[i]);
    }
    refuse(*law, {fmt::format("the contacts of a {} give way", info(mechanism).name),
                  fmt::format("use another law, or mechanism.kind = {}", fmt::join(may, " or "))});
}

/// Whether contact.restitution has to say how much contacts take.
bool needs_restitution(Parts const& parts) { return parts.rigid || (info(parts.mechanism).spatial && info(parts.law).needs_restitution); }

/// Which mechanism, and that nothing is given that does not count for it.
void read_mechanism(Node const& root, Parts& parts) {
    if (Node const* const kind = root.find_path("mechanism.kind")) read_text_value(*kind);
    parts.rigid = read_rigid(root, parts.mechanism);
    for (auto const& [key, node] : given_keys(root)) {
        if (!counts_for(*key, parts.mechanism)) refuse_meaningless(node->where, node->name, parts.mechanism);
    }
    auto const refuse_given = [&](std::string_view name) {
        Node const* const node = root.find_path(name);
        if (node != nullptr) refuse_meaningless(node->where, node->name, parts.mechanism);
    };
    if (!info(parts.mechanism).free_crank) refuse_given("mechanism.crank");
    read_given(root, "mechanism.crank", parts.free_crank);
    if (info(parts.mechanism).spatial) return;
    refuse_given("way");
    Node const* const law = root.find_path("contact.law");
    if (law == nullptr || parts.rigid) return;
    if (!may_be_rigid(parts.mechanism)) refuse_given("contact.law");
    refuse(*law, {fmt::format("the corners of a {} have one law", info(parts.mechanism).name), fmt::format("remove it, or use \"{}\"", rigid_contact.name)});
}

/// Methods that kernels have for such a mechanism with such contacts.
MethodSet methods_of(Parts const& parts) {
    using enum Method;
    if (parts.rigid) return set_of(automatic) | set_of(dopri5) | set_of(verner65) | set_of(moreau_jean);
    MethodSet methods = method_sets::all & ~set_of(moreau_jean);
    if (!info(parts.mechanism).spatial) methods &= ~set_of(ros34pw2);
    if (parts.damping == Damping::restitution) methods &= ~set_of(rk4);
    return methods;
}

/// "a", "b" or "c".
std::string listed(MethodSet methods) {
    std::vector<std::string> names;
    for (int i = 0; i < method_count; ++i) {
        auto const method = static_cast<Method>(i);
        if ((methods & set_of(method)) != 0) names.push_back(fmt::format("\"{}\"", name_of(method)));
    }
    std::string const last = names.back();
    names.pop_back();
    return fmt::format("{} or {}", fmt::join(names, ", "), last);
}

/// Why they have not `method`.
Problem lacking(Method method, Parts const& parts) {
    std::string const others = "use method " + listed(methods_of(parts));
    if (method == Method::moreau_jean)
        return {"time stepping is of rigid contacts", fmt::format("use contact.law = \"{}\", or method = \"auto\"", rigid_contact.name)};
    if (method == Method::rk4) return {"contact.restitution wants the speed at each touch, where the method's steps do not end", others};
    if (method == Method::ros34pw2)
        return {fmt::format("the method has no Jacobian of a {}{}", info(parts.mechanism).name, parts.rigid ? " with rigid contacts" : ""), others};
    return {"rigid contacts end steps so often that a method of another order gains nothing", others};
}

/// Modes are what a law switches between; the other parts have none, or no steps that could end there.
void check_located_modes(Node const& node, Scene const& scene) {
    if (scene.parts.rigid) refuse(node, {"rigid contacts end steps at their touches already", "remove it"});
    if (!info(scene.parts.mechanism).spatial) {
        refuse(node, {fmt::format("nothing switches in a {}", info(scene.parts.mechanism).name), "remove it"});
    }
    if (!info(scene.parts.law).switches) {
        refuse(node, {fmt::format("contact.law \"{}\" has no modes to switch between", info(scene.parts.law).name), "remove it"});
    }
    if (scene.parts.damping == Damping::restitution) {
        refuse(node, {"contact.restitution ends steps at its touches already", "remove one of the two"});
    }
    if (scene.integrator.method == Method::ros34pw2 || has_fixed_step(scene.integrator.method)) {
        refuse(node, {fmt::format("{} cannot end its steps there", name_of(scene.integrator.method)),
                      "use method " + listed(method_sets::explicit_pairs)});
    }
}

void read_located_modes(Node const& root, Scene& scene) {
    IntegratorSettings& settings = scene.integrator;
    Node const* const node = root.find_path("integrator.locate_modes");
    bool const switches = makes_energy(scene.parts) && scene.parts.damping != Damping::restitution;
    bool const orbits = !runs_to_end(scene.study), neighbours = scene.chaos.exponents > 0;
    bool const can = has_effect(setting("integrator.locate_modes"), settings.method, scene.parts);
    // Long orbits under the law that switches take half the steps so, and neighbours need it.
    bool const always = settings.method == Method::verner65 && !neighbours;
    if (node == nullptr) settings.locate_modes = switches && (orbits || always) && can;
    if (node != nullptr && switches && always && !settings.locate_modes) {
        refuse(*node, {"verner65 ends its steps at contacts in any case", "remove it, or use method \"dopri5\""});
    }
    if (node != nullptr && settings.locate_modes) check_located_modes(*node, scene);
    if (!switches || !neighbours || settings.locate_modes) return;
    // In trials exponents came out up to half as large again.
    scene.warnings.push_back(
        fmt::format("{}: steps leap over mode switches of contact.law \"{}\" and miss how they separate neighbours, "
                    "so that exponents come out wrong; {}",
                    can ? std::string("integrator.locate_modes is false")
                        : fmt::format("integrator.method is {}", name_of(settings.method)),
                    info(scene.parts.law).name,
                    can ? "leave it out" : "use method " + listed(method_sets::explicit_pairs)));
}

/// Impulses want bodies that do not give way, and neighbours that pass through the same impacts.
void check_time_stepping(Node const& root, Scene& scene) {
    Node const& method = *root.find_path("integrator.method");
    std::string const others = "use method " + listed(methods_of(scene.parts) & method_sets::explicit_pairs);
    if (scene.chaos.exponents > 0 && !runs_to_end(scene.study)) {
        refuse(method, {"time stepping takes no neighbours along, which exponents are of", others});
    }
    if (scene.chaos.section.on == SectionSurface::On::impacts) {
        refuse(method, {"time stepping knows impulses of whole steps, and no impacts", others});
    }
    Node const* const holding = root.find_path("friction.static");
    if (!scene.parts.friction || holding == nullptr || scene.inputs.friction_static == scene.inputs.friction_kinetic) return;
    scene.warnings.push_back("friction.static has no effect with method moreau_jean, whose contacts stick up to friction.kinetic");
}

void warn_of_idle_integrator_keys(Node const& table, Scene& scene) {
    for (Node const& node : table.children) {
        if (has_effect(setting(node.name), scene.integrator.method, scene.parts)) continue;
        // Said to be off where it cannot be on, it is as it was asked for.
        if (node.key == "locate_modes") continue;
        scene.warnings.push_back(
            !has_effect(setting(node.name), scene.integrator.method, Parts{}) ? fmt::format("{} has no effect with method {}", node.name, name_of(scene.integrator.method))
            : scene.parts.rigid ? fmt::format("{} has no effect on rigid contacts", node.name)
                                : fmt::format("{} has no effect on a {}", node.name, info(scene.parts.mechanism).name));
    }
}

}  // namespace

std::vector<GivenKey> given_keys(Node const& root) {
    std::vector<GivenKey> given;
    for (Node const& table : root.children) {
        for (Node const& node : table.children) {
            if (Key const* const key = find_key(node.name)) given.push_back({key, &node});
        }
    }
    std::stable_sort(given.begin(), given.end(),
                     [](GivenKey const& a, GivenKey const& b) { return a.node->order < b.node->order; });
    return given;
}

void read_physics(Node const& root, Scene& scene) {
    read_mechanism(root, scene.parts);
    Node const* const law = root.find_path("contact.law");
    if (law != nullptr) read_text_value(*law);
    else if (info(scene.parts.mechanism).spatial) scene.parts.law = default_law;
    scene.inputs = with_presets(scene.inputs, scene.parts);
    auto const given = given_keys(root);
    bool restitution = false;
    for (auto const& [key, node] : given) {
        if (!counts_for(*key, scene.parts)) {
            // An option may choose another law than the file, which has the keys of its own.
            bool const of_another = law != nullptr && law->order > 0 && node->order == 0;
            if (!of_another) refuse_strange(*node, scene.parts);
            scene.warnings.push_back(fmt::format("{}: {} has no effect, for contact.law \"{}\" does not know it",
                                                 node->where, node->name, contact_info(scene.parts).name));
            continue;
        }
        key->set(scene.inputs, read_number(*node, *key));
        restitution = restitution || key->member == &Inputs::restitution;
    }
    check_rivals(given);
    for (std::string_view const name : rates_of_damping) {
        Node const* const node = restitution ? root.find_path(name) : nullptr;
        if (node != nullptr) refuse(*node, {"contact.restitution replaces it", "remove one of the two"});
    }
    if (restitution || needs_restitution(scene.parts)) {
        scene.parts.damping = Damping::restitution;
    } else if (scene.inputs.chi_line != 0 || scene.inputs.chi_surface != 0) {
        scene.parts.damping = Damping::rate;
    }
    scene.parts.misaligned_way = root.find("way") != nullptr;
    scene.parts.friction = root.find("friction") != nullptr;
    if (Node const* const enabled = root.find_path("friction.enabled")) scene.parts.friction = read_boolean(*enabled);
}

void check_restitution(Node const& root, Scene const& scene) {
    constexpr std::string_view name = "contact.restitution";
    bool const varied = std::ranges::any_of(scene.variations, [&](Variation const& one) { return one.key->name == name; }) ||
                        (scene.chaos.parameter != nullptr && scene.chaos.parameter->name == name);
    if (!needs_restitution(scene.parts) || varied || root.find_path(name) != nullptr) return;
    std::string const what = scene.parts.rigid ? std::string("rigid contacts need") : fmt::format("{} needs", info(scene.parts.law).name);
    refuse(*root.find_path("contact.law"), {what + " contact.restitution", "give it, from 0 to 1"});
}

void tell_of_contacts(Node const& root, Scene& scene) {
    if (scene.parts.rigid || !info(scene.parts.mechanism).spatial) return;
    LawInfo const& law = info(scene.parts.law);
    if (root.find_path("contact.law") == nullptr) {
        scene.warnings.push_back(fmt::format("contact.law is not given and is \"{}\": {}; name it", law.name, law.words));
    }
    bool const has_rates = has_group(law.groups, KeyGroup::surfaces), has_others = has_group(law.groups, KeyGroup::point_damping);
    if (scene.parts.damping != Damping::point || !has_rates || has_others || root.find_path("contact.chi_surface") != nullptr) return;
    scene.warnings.push_back(fmt::format("neither contact.restitution nor contact.chi_surface is given: contacts of \"{}\" then take no energy, and what "
                                       "touches rings for ever; give one of the two", law.name));
}

void warn_of_idle_sources(Node const& root, Scene& scene) {
    auto const warn = [&](Key const& key) {
        if (!is_idle_source(key, scene.parts, given_or_varied(scene))) return;
        scene.warnings.push_back(fmt::format("{} has no effect, for all masses and inertias that would follow from it are given", key.name));
    };
    for (auto const& [key, node] : given_keys(root)) warn(*key);
    for (Variation const& variation : scene.variations) warn(*variation.key);
    if (scene.chaos.parameter != nullptr) warn(*scene.chaos.parameter);
}

/// Whether nothing takes energy from the impacts of any member, so that what one errs by is never forgotten, and nothing drives it either: contact never
/// lasts.  Of the numbers of a law those damp that may be zero and are not.
bool bounces_for_ever(Scene const& scene) {
    Parts const& parts = scene.parts;
    if (info(parts.mechanism).drive != DriveKind::none || parts.rigid) return false;
    // What one brings oneself may damp without a key.
    if (module_of(parts.law) != nullptr || module_of(parts.mechanism) != nullptr) return false;
    if (parts.damping == Damping::restitution) {
        auto const varies = [](Variation const& variation) { return variation.key->name == "contact.restitution"; };
        return scene.inputs.restitution == 1 && std::ranges::none_of(scene.variations, varies);
    }
    Inputs const with_varied = given_or_varied(scene);
    LawInfo const& law = info(parts.law);
    auto const damps = [&](Key const& key) { return key.rule != Rule::positive && key.get(with_varied) != 0; };
    bool const of_points = has_group(law.groups, KeyGroup::point_damping) && with_varied.eta != 0;
    return parts.damping == Damping::point && !of_points && std::ranges::none_of(law.keys, damps);
}

void read_integrator(Node const& root, Scene& scene) {
    IntegratorSettings& settings = scene.integrator;
    read_bound(root, "integrator", scene);
    Node const* const step = root.find_path("integrator.step");
    if (has_fixed_step(settings.method) && step == nullptr) {
        refuse(*root.find_path("integrator.method"), {"the method has no step control", "give integrator.step"});
    }
    // The errors of dopri5's bounces have one sign: they would add up (docs/integrators.md).
    if (settings.method == Method::automatic && bounces_for_ever(scene)) {
        settings.method = Method::verner65;
        scene.warnings.push_back("nothing takes energy from what bounces here, and errors of impacts are never forgotten: integrator.method \"auto\" is \"verner65\"");
    }
    if ((set_of(settings.method) & methods_of(scene.parts)) == 0) {
        refuse(*root.find_path("integrator.method"), lacking(settings.method, scene.parts));
    }
    if (settings.method == Method::moreau_jean) check_time_stepping(root, scene);
    read_located_modes(root, scene);
    auto const is_given = [&](std::string_view name) { return root.find_path(name) != nullptr; };
    if (!is_given("integrator.atol")) settings.atol = atol_per_rtol * settings.rtol;
    // A sweep goes by its fastest drive, a free crank by the speed that it starts with.
    Parts driven = scene.parts;
    driven.free_crank = false;
    double const period =
        scene.study == StudyKind::sweep ? drive_periods(scene).least : drive_period(driven, scene.inputs);
    // A step may not leap over an impact: between two of them the slider flies for milliseconds.
    constexpr double longest_step = 1e-3;
    double max_step = std::min(longest_step, period / 2000);
    // That finds its touches inside a step, by the depths and rates at its ends.
    bool const finds_touches = settings.method == Method::verner65 && info(scene.parts.mechanism).spatial && scene.chaos.exponents == 0;
    if (finds_touches) max_step = std::min(longest_step, period / 200);
    // Rigid contacts are found inside a step by its ends' depths and rates, and nothing happens fast between them.
    if (scene.parts.rigid) max_step = std::min(50 * longest_step, period / 50);
    // Nor over a carriage's reversal, which accelerates it for a small part of its period.
    bool const reverses = info(scene.parts.mechanism).drive == DriveKind::carriage;
    double const reversal = reverses ? shortest_reversal(scene) / 20 : max_step;
    max_step = std::min(max_step, reversal);
    if (!is_given("integrator.max_step")) settings.max_step = max_step;
    // The stiff method runs in lasting contact alone, where nothing is to be leapt over.
    double const stiff_step = reverses ? std::min(10 * settings.max_step, reversal) : 10 * settings.max_step;
    if (!is_given("integrator.stiff_max_step")) settings.stiff_max_step = stiff_step;
    if (Node const* const table = root.find("integrator")) warn_of_idle_integrator_keys(*table, scene);
}

}  // namespace slideway
