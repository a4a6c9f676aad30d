#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/commands/commands.hpp"
#include "host/commands/text.hpp"
#include "host/config/descriptors.hpp"
#include "host/config/key_reference.hpp"
#include "host/config/linkages.hpp"
#include "host/config/outputs.hpp"
#include "host/config/settings.hpp"
#include "host/sampling/distribution.hpp"

namespace slideway::cli {
namespace {

/// One line, but for a terminal: there it goes on below the column of explanations.
template <class... Values> void print_row(fmt::format_string<Values...> format, Values&&... values) {
    print_text(33, format, std::forward<Values>(values)...);
}

/// " (slider_crank, carriage)": the mechanisms that have something, where not all do.
template <class Has> std::string owners_text(Has has) {
    std::vector<std::string_view> names;
    for (MechanismInfo const& mechanism : mechanisms()) {
        if (mechanism.driven_form == nullptr && has(mechanism)) names.emplace_back(mechanism.name);
    }
    return names.size() == mechanism_kinds().size() ? std::string() : fmt::format(" ({})", fmt::join(names, ", "));
}

/// Where one of a module comes from.
std::string module_text(OwnModule const* module) {
    return module == nullptr ? std::string() : fmt::format(" (module in {}, source {}, {})", module->folder.string(), module->source, module->described->compiler);
}

/// Calls the function with what a mechanism has behind the table, and whose it is.
template <class Entry, class Print> void for_each_own(std::vector<Entry> Outputs::*of, int in_table, Print const& print) {
    auto const all = mechanisms();
    for (std::size_t m = 0; m < all.size(); ++m) {
        std::vector<Entry> const& entries = outputs_of(static_cast<Mechanism>(m)).*of;
        for (auto i = static_cast<std::size_t>(in_table); i < entries.size(); ++i) print(entries[i], fmt::format(" ({})", all[m].name));
    }
}

/// Their states, and what else comes with every time series.
void print_mechanisms() {
    print_out("mechanisms (mechanism.kind), with the numbers of their state\n");
    auto const all = mechanisms();
    for (MechanismInfo const& mechanism : all) {
        if (mechanism.driven_form != nullptr) continue;
        std::vector<std::string_view> states, beside;
        Selection left = mechanism.always;
        for (int i = 0; i < mechanism.states; ++i) {
            states.emplace_back(state_info(mechanism, i).name);
            left &= ~selection_of(mechanism.state[i]);
        }
        for (int s = 0; s < series_count; ++s) {
            if (selects(left, static_cast<Series>(s))) beside.emplace_back(series_table[s].name);
        }
        print_row("  {:<30} {}{}", mechanism.name, mechanism.meaning, module_text(module_of(static_cast<Mechanism>(&mechanism - all.data()))));
        print_row("  {:<30} {}{}", "", fmt::join(states, ", "), beside.empty() ? "" : fmt::format("; series have {} too", fmt::join(beside, ", ")));
    }
    print_row("  {:<30} {}", linkage_kind, linkage_info(any_linkage).meaning);
    print_row("  {:<30} {}", "", "as many as these have: angles, displacements, places of what floats");
}

/// In the order of a scene's tables, each with its unit, domain and default, and who knows it where not all do.
void print_keys() {
    for (Setting const& key : known_keys()) {
        print_row("  {:<30} {:<8} {}", key.name, key.unit, described(key));
    }
}

/// Of `Damping`.
constexpr std::string_view damping_names[] = {"point", "rate", "restitution"};
constexpr std::string_view damping_meanings[] = {
    "contact.eta: point contacts alone",
    "contact.chi_line, contact.chi_surface: lines and surfaces too",
    "contact.restitution: replaces both",
};
static_assert(std::size(damping_names) == damping_count && std::size(damping_meanings) == damping_count);

/// Of `study_kind_names`.
constexpr std::string_view study_meanings[] = {
    "every member to the end time, summary statistics",
    "the largest Lyapunov exponents of every member, and how they converged",
    "states at a phase of the drive, or where a state or a gap crosses a level",
    "sections and exponents, column by column, as one key changes",
    "how quantities scatter with what varies, what drives them, which limits they meet",
};
static_assert(std::size(study_meanings) == std::size(study_kind_names));

/// Their words, and below these their dampings and what they have of their own.
void print_laws() {
    std::string const rigid = owners_text([](MechanismInfo const& one) { return may_be_rigid(static_cast<Mechanism>(&one - mechanisms().data())); });
    for (LawInfo const& law : contact_laws()) {
        Parts parts;
        choose_contact(parts, law.name);
        std::string const owners = !parts.rigid ? std::string() : rigid.empty() ? " (every mechanism)" : rigid;
        print_row("  {:<30} {}{}{}", law.name, law.words, module_text(contact_module(parts)), owners);
        std::vector<std::string_view> dampings;
        for (int i = 0; i < damping_count; ++i) {
            auto const damping = static_cast<Damping>(i);
            bool const has = damping == Damping::point ? has_group(law.groups, KeyGroup::point_damping) : law.has(damping);
            if (has) dampings.push_back(damping_names[i]);
        }
        print_row("  {:<30} damping: {}{}", "", dampings.empty() ? "its own alone" : fmt::format("{}", fmt::join(dampings, ", ")),
                  needs_restitution(parts) ? ", which it needs" : "");
        for (Key const& key : law.keys) print_row("  {:<30} {} [{}]: {}", "", key.name, key.unit, key.meaning);
    }
}

/// Of `design_names`.
constexpr std::string_view design_meanings[] = {
    "every member draws by itself, random numbers of its seed, number and key",
    "Latin hypercube: of each key, one member in each of as many equally likely parts",
    "points of a scrambled Sobol sequence, best in powers of two",
    "study.base rows of Sobol points for sensitivity indices of each key",
    "every combination of levels of each key (study.levels, or levels = k in study.vary)",
    "the rows of a CSV file (study.table)",
};
static_assert(std::size(design_meanings) == std::size(design_names));

/// What there is behind --backend cuda.
std::string card_text() {
    try {
        return backend_text(*cuda_backend());
    } catch (DeviceError const& error) {
        return error.what();
    }
}

std::string state_of(Isa isa) {
    if (!is_built(isa)) return "not in this build";
    if (!is_supported(isa)) return "not on this machine";
    std::string const state = isa == best_isa() ? "what auto means on this machine" : "supported";
    return compiled_isa(isa) == Isa::scalar_libm ? state + "; the C library's fused multiply-add: slow" : state;
}

void print_outputs() {
    print_out("\nquantities (study.quantities): one value, or one row of values, per member\n");
    auto const print_quantity = [](QuantityInfo const& quantity, std::string const& owners) {
        print_row("  {:<30} {:<8} {}{}{}", quantity.name, quantity.unit, quantity.long_name,
                   quantity.dimension ? fmt::format(" (per {})", quantity.dimension) : "", owners);
    };
    auto const print_series = [](SeriesInfo const& series, std::string const& owners) {
        print_row("  {:<30} {:<8} {}{}", series.name, series.unit, series.long_name, owners);
    };
    for (QuantityInfo const& quantity : quantity_table) {
        Selection const bit = Selection{1} << (&quantity - quantity_table);
        print_quantity(quantity, owners_text([bit](MechanismInfo const& one) { return (one.quantities & bit) != 0; }));
    }
    for_each_own(&Outputs::quantities, quantity_count, print_quantity);
    print_text(2, "\nseries (study.quantities): values at the sample times; those above come with every time series");
    for (SeriesInfo const& series : series_table) {
        Selection const bit = Selection{1} << (&series - series_table);
        print_series(series, owners_text([bit](MechanismInfo const& one) { return (one.series & bit) != 0; }));
    }
    for_each_own(&Outputs::series, series_count, print_series);
}

}  // namespace

int execute(ListArguments const& arguments) {
    // The page is of what everybody has.
    if (!arguments.markdown) {
        for (ModuleKind const kind : {ModuleKind::law, ModuleKind::mechanism}) open_modules(kind, {}, [](std::string const& why) { tell("slideway: {}\n", why); });
    }
    if (arguments.keys && !arguments.json) {
        print_keys();
        return exit_code::done;
    }
    if (arguments.json || arguments.schema || arguments.markdown) {
        print_out("{}", arguments.json ? keys_json() : arguments.schema ? scene_schema() : keys_markdown());
        return exit_code::done;
    }
    print_mechanisms();
    print_text(2, "\ncontact laws (contact.law){}", owners_text([](MechanismInfo const& one) { return one.spatial; }));
    print_laws();
    print_out("\ndamping\n");
    for (int i = 0; i < damping_count; ++i) print_row("  {:<30} {}", damping_names[i], damping_meanings[i]);
    print_out("\nintegrators (integrator.method)\n");
    for (MethodInfo const& method : method_table) print_row("  {:<30} {}", method.name, method.description);
    print_out("\nstudies (study.kind)\n");
    for (std::size_t i = 0; i < std::size(study_kind_names); ++i) print_row("  {:<30} {}", study_kind_names[i], study_meanings[i]);
    print_out("\ndistributions (dist in study.vary); arguments in [] may be left out\n");
    for (DistributionForm const& form : distribution_forms()) {
        print_row("  {:<10} {:<19} {}", form.name, listed_arguments(form), form.meaning);
    }
    print_out("\ndesigns (study.design): how members are spread over what varies\n");
    for (std::size_t i = 0; i < std::size(design_names); ++i) {
        print_row("  {:<30} {}", design_names[i], design_meanings[i]);
    }
    print_outputs();
    print_out("\nkeys of a scene, with their unit, domain and default\n");
    print_keys();
    print_out("\nbackends (--backend)\n");
    print_row("  {:<30} this machine's processor, with one of its instruction sets", "cpu");
    print_row("  {:<30} {}", "cuda", card_text());
    print_out("\ninstruction sets (--isa)\n");
    for (Isa const isa : all_isas()) {
        print_row("  {:<30} {}, {}", name_of(isa), counted(static_cast<std::uint64_t>(lanes_of(isa)), "lane"), state_of(isa));
    }
    return exit_code::done;
}

}  // namespace slideway::cli
