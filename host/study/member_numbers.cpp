#include "host/study/member_numbers.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <span>

#include <fmt/format.h>

#include "host/base/numbers.hpp"
#include "host/config/descriptors.hpp"
#include "host/study/ensemble_plan.hpp"
#include "host/study/exponent_table.hpp"
#include "host/study/probe.hpp"
#include "kernels/members/start.hpp"

namespace slideway {
namespace {

constexpr double jacobian_work = 1.5;   // right-hand sides
constexpr char const* contact_names[] = {"surfaces at the end", "lines at the end", "points at the end"};
using EndContacts = std::array<double, std::size(contact_names)>;

/// The energy residual of a law that keeps energy is the integration's own error: nothing to compare.
std::vector<QuantityColumn> compared_columns(Scene const& scene) {
    std::vector<QuantityColumn> columns = columns_of(scene.parts.mechanism, scene.quantities);
    if (makes_energy(scene.parts)) return columns;
    std::string_view const residual = quantity_table[static_cast<int>(Quantity::energy_residual)].name;
    std::erase_if(columns, [&](QuantityColumn const& column) { return column.quantity == residual; });
    return columns;
}

MemberNumbers empty_numbers(Scene const& scene) {
    using Kind = MemberNumbers::Kind;
    MemberNumbers numbers;
    for (QuantityColumn const& column : compared_columns(scene)) numbers.columns.push_back({column.name(), column.unit});
    for (Limit const& limit : scene.limits) numbers.columns.push_back({"yield of " + limit.name(), "1", Kind::limit});
    int const exponents = shadow_plan(scene).count;
    for (int j = 1; j <= exponents; ++j) numbers.columns.push_back({fmt::format("lyapunov_exponent[{}]", j), "1/s", Kind::exponent});
    for (char const* name : contact_names) numbers.columns.push_back({name, "1", Kind::contacts});
    return numbers;
}

double is_met(Limit const& limit, double value) { return value >= limit.low && value <= limit.high ? 1 : 0; }

/// Surfaces, lines and points that touch in states; NaN where one cannot be evaluated.
/// @param inputs of the members, by value: they start where they ended  @param states [members][states of the mechanism]
std::vector<EndContacts> end_contacts(Scene const& scene, std::vector<Inputs> inputs, std::vector<double> const& times,
                                      std::span<double const> states) {
    MechanismInfo const& mechanism = info(scene.parts.mechanism);
    auto const width = static_cast<std::size_t>(mechanism.states);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        StateNumbers state{};
        std::copy_n(states.data() + i * width, width, state.begin());
        set_start(mechanism, state, inputs[i]);
    }
    std::vector<EndContacts> contacts;
    for (ProbeResult const& r : probe(best_isa(scene.parts), scene.parts, inputs, times)) {
        bool const known = r.status == Status::finished;
        contacts.push_back({known ? r.surfaces : nan, known ? r.lines : nan, known ? r.points : nan});
    }
    return contacts;
}

double work_of(double right_hand_sides, double jacobians) { return right_hand_sides + jacobian_work * jacobians; }

}  // namespace

std::vector<std::uint64_t> spread_over(std::uint64_t all, std::uint64_t count) {
    std::vector<std::uint64_t> members;
    double const distance = static_cast<double>(all) / static_cast<double>(count);
    for (std::uint64_t i = 0; i < count; ++i) members.push_back(static_cast<std::uint64_t>(static_cast<double>(i) * distance));
    return members;
}

std::vector<double> stored_work(ToleranceMembers const& members) {
    std::vector<double> work = members.column("rhs_evaluations");
    std::vector<double> const jacobians = members.column("jacobian_evaluations");
    for (std::size_t i = 0; i < work.size(); ++i) work[i] = work_of(work[i], jacobians[i]);
    return work;
}

MemberNumbers stored_numbers(ToleranceMembers const& members, Scene const& scene) {
    MemberNumbers numbers = empty_numbers(scene);
    numbers.work = stored_work(members);
    for (std::size_t row = 0; row < members.size(); ++row) numbers.finished.push_back(members.finished(row));
    auto next = numbers.columns.begin();
    auto const put = [&](std::vector<double> values) {
        for (std::size_t row = 0; row < values.size(); ++row) {
            if (!members.finished(row)) values[row] = nan;
        }
        (next++)->values = std::move(values);
    };
    for (QuantityColumn const& column : compared_columns(scene)) put(members.column(column.quantity, column.index));
    std::vector<QuantityColumn> const stored = columns_of(scene.parts.mechanism, scene.quantities);
    for (Limit const& limit : scene.limits) {
        QuantityColumn const* const column = column_of(stored, limit);
        std::vector<double> values = column != nullptr ? members.column(column->quantity, column->index) : std::vector<double>(members.size(), nan);
        for (double& value : values) value = is_met(limit, value);
        put(std::move(values));
    }
    for (int j = 0; j < shadow_plan(scene).count; ++j) put(members.column("lyapunov_exponent", static_cast<std::size_t>(j)));
    for (; next != numbers.columns.end(); ++next) next->values.assign(members.size(), nan);
    return numbers;
}

void add_end_contacts(MemberNumbers& numbers, ToleranceMembers const& members, Scene const& scene, std::vector<std::size_t> const& rows) {
    MechanismInfo const& has = info(scene.parts.mechanism);
    auto const width = static_cast<std::size_t>(has.states);
    std::vector<double> const ends = members.column("end_time");
    std::vector<Inputs> inputs;
    std::vector<double> times, states(rows.size() * width);
    for (std::size_t const row : rows) {
        inputs.push_back(member_inputs(scene, members.number(row)));
        times.push_back(ends[row]);
    }
    for (std::size_t k = 0; k < width; ++k) {
        std::vector<double> const values = members.column(fmt::format("final_{}", state_info(has, static_cast<int>(k)).name));
        for (std::size_t i = 0; i < rows.size(); ++i) states[i * width + k] = values[rows[i]];
    }
    std::vector<EndContacts> const contacts = end_contacts(scene, std::move(inputs), times, states);
    auto column = numbers.columns.end() - std::ssize(contact_names);
    for (std::size_t kind = 0; kind < std::size(contact_names); ++kind, ++column) {
        for (std::size_t i = 0; i < rows.size(); ++i) column->values[rows[i]] = members.finished(rows[i]) ? contacts[i][kind] : nan;
    }
}

namespace {

/// Puts what the members of a block came to into their places.
class FreshTaker {
public:
    FreshTaker(Scene const& scene, std::vector<std::uint64_t> const& members) : scene_(scene), exponents_(scene) {
        numbers_ = empty_numbers(scene);
        numbers_.work.assign(members.size(), nan);
        numbers_.steps.assign(members.size(), 0);
        numbers_.finished.assign(members.size(), 0);
        for (auto& column : numbers_.columns) column.values.assign(members.size(), nan);
        if (selects(scene.quantities, Quantity::energy_residual)) numbers_.energy_residual.assign(members.size(), nan);
        for (std::size_t i = 0; i < members.size(); ++i) places_[members[i]] = i;
        for (QuantityColumn const& column : compared_columns(scene)) quantities_.push_back(column.place);
        std::vector<QuantityColumn> const columns = columns_of(scene.parts.mechanism, scene.quantities);
        for (Limit const& limit : scene.limits) limited_.push_back(column_of(columns, limit)->place);
    }

    void take(BlockResult const& block) {
        std::vector<double> times;
        for (MemberRecord const& record : block.records) times.push_back(record.time);
        auto const offsets = static_cast<std::size_t>(shadow_plan(scene_).count);
        auto const contacts = end_contacts(scene_, {block.inputs.begin(), block.inputs.end()}, times, block.final_states);
        auto const residual = static_cast<std::size_t>(quantity_column(Quantity::energy_residual));
        for (std::size_t i = 0; i < block.members.size(); ++i) {
            std::size_t const place = places_.at(block.members[i]);
            MemberRecord const& record = block.records[i];
            double const* const quantities = &block.quantities[i * block.columns()];
            numbers_.work[place] = work_of(static_cast<double>(record.rhs_evaluations), static_cast<double>(record.jacobian_evaluations));
            numbers_.steps[place] = record.steps_accepted + record.steps_rejected;
            numbers_.finished[place] = record.status == Status::finished;
            if (record.status != Status::finished) continue;
            if (!numbers_.energy_residual.empty()) numbers_.energy_residual[place] = quantities[residual];
            auto next = numbers_.columns.begin();
            auto const put = [&](double value) { (next++)->values[place] = value; };
            for (std::size_t const q : quantities_) put(quantities[q]);
            for (std::size_t j = 0; j < limited_.size(); ++j) put(is_met(scene_.limits[j], quantities[limited_[j]]));
            std::vector<double> const exponents = exponents_.row(block, i);
            for (std::size_t j = 0; j < offsets; ++j) put(exponents[j]);
            for (double const count : contacts[i]) put(count);
        }
    }
    MemberNumbers numbers() { return std::move(numbers_); }

private:
    Scene const& scene_;
    ExponentTable const exponents_;
    MemberNumbers numbers_;
    std::map<std::uint64_t, std::size_t> places_;
    std::vector<std::size_t> quantities_, limited_;  // places in a member's row
};

}  // namespace

EnsembleTotals run_members(Scene const& scene, std::vector<std::uint64_t> const& members, FreshRun const& run, BlockSink const& sink) {
    EnsemblePlan const plan = ensemble_plan(scene, MemberSet::of(members), run.backend, run.threads);
    return run_ensemble(plan, run.backend.kernel(scene.parts, plan.request.shadows.count > 0), sink, run.stop, run.progress, run.weight);
}

MemberNumbers fresh_numbers(Scene const& scene, std::vector<std::uint64_t> const& members, FreshRun const& run, std::vector<std::uint64_t> const& most_steps) {
    FreshTaker taker(scene, members);
    BlockSink const take = [&](BlockResult const& block) { taker.take(block); };
    if (most_steps.empty()) {
        run_members(scene, members, run, take);
        return taker.numbers();
    }
    // One number of steps bounds a run: those that may take as many run together.
    std::map<std::uint64_t, std::vector<std::uint64_t>> by_bound;
    for (std::size_t i = 0; i < members.size(); ++i) by_bound[most_steps[i]].push_back(members[i]);
    for (auto const& [most, some] : by_bound) {
        Scene bounded = scene;
        bounded.integrator.max_steps = std::min(scene.integrator.max_steps, most);
        run_members(bounded, some, run, take);
    }
    return taker.numbers();
}

}  // namespace slideway
