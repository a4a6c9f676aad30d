#include "host/config/outputs.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "host/config/descriptors.hpp"
#include "host/config/keys.hpp"
#include "host/config/linkages.hpp"
#include "host/config/units.hpp"

namespace slideway {
namespace {

/// What every result or table of `probe` may have, beside keys, quantities and series.
constexpr char const* of_results[] = {
    "member", "member_label", "sample", "status", "time", "end_time", "steps_accepted", "steps_rejected", "rhs_evaluations",
    "jacobian_evaluations", "stiff_steps", "t", "power_crank", "power_friction", "power_damping", "power_load", "power_ground", "loss_springs", "loss_film", "energy", "contact_potential"};

/// What results call a key that varies.
std::string parameter_name(Key const& key) {
    std::string name(key.name);
    std::ranges::replace(name, '.', '_');
    return name;
}

Outputs outputs_of(MechanismInfo const& mechanism) {
    Outputs all;
    auto const add = [&](QuantityInfo const& quantity) {
        all.quantities.push_back({quantity, all.columns, Selection{1} << all.quantities.size()});
        all.columns += static_cast<std::size_t>(quantity.columns);
    };
    std::ranges::for_each(quantity_table, add);
    if (mechanism.own_series.empty()) all.series.assign(std::begin(series_table), std::end(series_table));
    else all.series.assign(mechanism.own_series.begin(), mechanism.own_series.end());
    all.has_quantities = mechanism.quantities;
    for (QuantityInfo const& one : mechanism.own_quantities) {
        all.has_quantities |= Selection{1} << all.quantities.size();
        add(one);
    }
    // Kernels have room for as many loads as there may be.
    if (!mechanism.own_series.empty()) all.columns = quantity_columns + LinkagePlan::most_loads;
    all.has_series = mechanism.series;
    auto const text = [&](std::string words) { return all.texts.emplace_back(std::move(words)).c_str(); };
    for (Signal const& signal : mechanism.signals) {
        all.has_series |= Selection{1} << all.series.size();
        all.series.push_back({signal.name, signal.unit, signal.meaning});
    }
    for_each_signal_quantity(mechanism.signals, [&](SignalQuantity const& one) {
        Signal const& signal = mechanism.signals[static_cast<std::size_t>(one.signal)];
        SignalStatistic const& statistic = *std::ranges::find(signal_statistics, one.statistic, &SignalStatistic::statistic);
        all.has_quantities |= Selection{1} << all.quantities.size();
        add({text(std::string(statistic.prefix) + signal.name), one.statistic, Keeper::signals, signal.unit, 1, nullptr,
             text(fmt::format("{}: {}", signal.meaning, statistic.words))});
    });
    return all;
}

/// Kernels have them in the places of a slider's apices.
void add_joints(Outputs& all, Linkage const& linkage) {
    for (Quantity const of : {Quantity::peak_apex_force, Quantity::mean_apex_force}) {
        for (std::size_t k = 0; k < linkage.closures.size(); ++k) {
            if (!linkage.plan.closure[k].has_clearance()) continue;
            std::string const joint = linkage.closures[k].substr(linkage.closures[k].find('.') + 1);
            auto const text = [&](std::string words) { return all.texts.emplace_back(std::move(words)).c_str(); };
            OutputQuantity quantity = all.quantities[static_cast<std::size_t>(of)];
            quantity.name = text(name_of_joint_quantity(of, joint));
            quantity.long_name = text(fmt::format("{} in {}", of == Quantity::peak_apex_force ? "largest normal force" : "time mean of the normal force", joint));
            quantity.columns = 1, quantity.dimension = nullptr;
            quantity.place += k;
            all.has_quantities |= Selection{1} << all.quantities.size();
            all.quantities.push_back(quantity);
        }
    }
}

}  // namespace

Selection kept_for(Outputs const& outputs, Selection quantities) {
    Selection kept = 0;
    for (OutputQuantity const& quantity : selected(outputs.quantities, quantities)) kept |= quantity.kept_with;
    return kept;
}

std::string name_of_joint_quantity(Quantity of_apices, std::string_view joint) {
    return fmt::format("{}_force_{}", of_apices == Quantity::peak_apex_force ? "peak" : "mean", joint);
}

Outputs const& outputs_of(Mechanism mechanism) {
    static OfAllKnown<std::deque<Outputs>> all([] {
        std::deque<Outputs> made;
        for (MechanismInfo const& one : mechanisms()) made.push_back(outputs_of(one));
        return made;
    });
    if (!is_linkage(mechanism)) return all()[static_cast<std::size_t>(mechanism)];
    static std::mutex access;
    static std::map<Mechanism, Outputs> of_linkages;
    std::lock_guard const lock(access);
    auto const [at, is_new] = of_linkages.try_emplace(mechanism);
    if (is_new) {
        at->second = outputs_of(info(mechanism));
        if (Linkage const* const linkage = linkage_of(mechanism)) add_joints(at->second, *linkage);
    }
    return at->second;
}

std::string objection_to_signals(MechanismInfo const& mechanism) {
    for (Signal const& signal : mechanism.signals) {
        if (signal.name == nullptr) return "one of its signals has no name";
        if (signal.unit == nullptr || signal.meaning == nullptr) return fmt::format("its signal {} has no {}", signal.name, signal.unit == nullptr ? "unit" : "meaning");
        std::string_view const name = signal.name;
        if (!is_module_name(name) || name.starts_with("final_") || name.starts_with("d_"))
            return fmt::format("its signal \"{}\" has no name of at most 60 small letters, digits and '_', a letter first, and no final_ or d_", name);
        if (!is_plain_si(signal.unit)) return fmt::format("its signal {} has the unit \"{}\", which is none of SI without a prefix", signal.name, signal.unit);
    }
    std::vector<std::string> names(std::begin(of_results), std::end(of_results));
    for (Key const& key : mechanism.own_keys) names.push_back(parameter_name(key));
    for (Key const& key : keys()) names.push_back(parameter_name(key));
    for (FormerName const& former : former_names) names.emplace_back(former.then);
    Outputs const all = outputs_of(mechanism);
    auto const take = [&](std::string_view name) {
        bool const is_free = std::ranges::count(names, name) == 0;
        names.emplace_back(name);
        return is_free ? std::string() : fmt::format("results have a {} already, which is of a signal too; give the signal another name", name);
    };
    std::string why;
    for (QuantityInfo const& quantity : all.quantities) why += why.empty() ? take(quantity.name) : "";
    for (SeriesInfo const& series : all.series) why += why.empty() ? take(series.name) : "";
    return why;
}

}  // namespace slideway
