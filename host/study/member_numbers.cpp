#include "host/study/member_numbers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <span>

#include <fmt/format.h>

#include "host/base/numbers.hpp"
#include "host/config/descriptors.hpp"
#include "host/run/ensemble.hpp"
#include "host/study/ensemble_plan.hpp"
#include "host/study/exponent_table.hpp"
#include "host/study/orbit_schedule.hpp"
#include "host/study/probe.hpp"
#include "kernels/members/start.hpp"

namespace slideway {
namespace {

constexpr double jacobian_work = 1.5;  // right-hand sides
constexpr char const* contact_names[] = {"surfaces at the end", "lines at the end", "points at the end"};
using EndContacts = std::array<double, std::size(contact_names)>;

/// The energy residual of a law that keeps energy is the integration's own error: nothing to compare.
std::vector<QuantityColumn> compared_columns(Scene const& scene) {
    std::vector<QuantityColumn> columns = columns_of(scene.quantities);
    if (makes_energy(scene.parts)) return columns;
    std::string_view const residual = info(Quantity::energy_residual).name;
    std::erase_if(columns, [&](QuantityColumn const& column) { return column.quantity == residual; });
    return columns;
}

MemberNumbers empty_numbers(Scene const& scene) {
    MemberNumbers numbers;
    for (QuantityColumn const& column : compared_columns(scene)) numbers.columns.push_back({column.name(), column.unit, false, {}});
    int const exponents = shadow_plan(scene).count;
    for (int j = 1; j <= exponents; ++j) numbers.columns.push_back({fmt::format("lyapunov_exponent[{}]", j), "1/s", true, {}});
    for (char const* name : contact_names) numbers.columns.push_back({name, "1", false, {}});
    return numbers;
}

/// Surfaces, lines and points that touch in states; NaN where one cannot be evaluated.
/// @param inputs of the members, by value: they start where they ended  @param states [members][states of the mechanism]
std::vector<EndContacts> end_contacts(Scene const& scene, std::vector<Inputs> inputs, std::vector<double> times,
                                      std::span<double const> states) {
    Mechanism const mechanism = scene.parts.mechanism;
    auto const width = static_cast<std::size_t>(info(mechanism).states);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        StateNumbers state{};
        std::copy_n(states.data() + i * width, width, state.begin());
        set_start(info(mechanism), state, inputs[i]);
        times[i] = time_of_start(info(mechanism), times[i]);
    }
    std::vector<EndContacts> contacts;
    for (ProbeResult const& r : probe(best_isa(), scene.parts, inputs, times)) {
        bool const known = r.status == Status::finished;
        contacts.push_back({known ? r.surfaces : nan, known ? r.lines : nan, known ? r.points : nan});
    }
    return contacts;
}

double work_of(double right_hand_sides, double jacobians) { return right_hand_sides + jacobian_work * jacobians; }

}  // namespace

std::size_t MemberNumbers::finished() const {
    auto const& ends = columns.back().values;
    return static_cast<std::size_t>(std::count_if(ends.begin(), ends.end(), [](double x) { return !std::isnan(x); }));
}

double MemberNumbers::total_work() const { return std::accumulate(work.begin(), work.end(), 0.0); }

WholeColumn whole_of(std::vector<double> const& values) {
    Summary const summary = summarise(values);
    double cubes = 0;
    for (double const x : values) {
        if (!std::isnan(x)) cubes += std::pow((x - summary.mean) / summary.sd, 3);
    }
    return {summary, cubes / static_cast<double>(summary.count)};
}

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

MemberNumbers stored_numbers(ToleranceMembers const& members, Scene const& scene, std::vector<std::uint64_t> const& rows,
                             std::vector<double> const& work, std::vector<WholeColumn>& whole) {
    MemberNumbers numbers = empty_numbers(scene);
    for (std::size_t const row : rows) numbers.work.push_back(work[row]);
    auto next = numbers.columns.begin();
    auto const put = [&](std::vector<double> values) {
        for (std::size_t row = 0; row < values.size(); ++row) {
            if (!members.finished(row)) values[row] = nan;
        }
        for (std::size_t const row : rows) next->values.push_back(values[row]);
        whole.push_back(whole_of(values));
        ++next;
    };
    for (QuantityColumn const& column : compared_columns(scene)) put(members.column(column.quantity, column.index));
    for (int j = 0; j < shadow_plan(scene).count; ++j) put(members.column("lyapunov_exponent", static_cast<std::size_t>(j)));

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
    for (std::size_t kind = 0; kind < std::size(contact_names); ++kind, ++next) {
        for (std::size_t i = 0; i < rows.size(); ++i) next->values.push_back(members.finished(rows[i]) ? contacts[i][kind] : nan);
    }
    return numbers;
}

MemberNumbers fresh_numbers(Scene const& scene, std::vector<std::uint64_t> const& members, Backend const& backend, int threads,
                            StopRequest const* stop, Progress* progress, double weight) {
    MemberNumbers numbers = empty_numbers(scene);
    numbers.work.assign(members.size(), nan);
    for (auto& column : numbers.columns) column.values.assign(members.size(), nan);
    std::map<std::uint64_t, std::size_t> places;
    for (std::size_t i = 0; i < members.size(); ++i) places[members[i]] = i;

    ExponentTable const exponents(scene);
    auto const offsets = static_cast<std::size_t>(shadow_plan(scene).count);
    std::vector<std::size_t> quantities;
    for (QuantityColumn const& column : compared_columns(scene)) quantities.push_back(column.place);
    bool const audited = selects(scene.quantities, Quantity::energy_residual);
    auto const residual = static_cast<std::size_t>(quantity_column(Quantity::energy_residual));
    if (audited) numbers.energy_residual.assign(members.size(), nan);
    auto const take = [&](BlockResult const& block) {
        std::vector<double> times;
        for (MemberRecord const& record : block.records) times.push_back(record.time);
        StudyValues const of_exponents = exponents.values(block);
        auto const contacts = end_contacts(scene, {block.inputs.begin(), block.inputs.end()}, times, block.final_states);
        for (std::size_t i = 0; i < block.members.size(); ++i) {
            std::size_t const place = places.at(block.members[i]);
            MemberRecord const& record = block.records[i];
            numbers.work[place] =
                work_of(static_cast<double>(record.rhs_evaluations), static_cast<double>(record.jacobian_evaluations));
            if (record.status != Status::finished) continue;
            if (audited) numbers.energy_residual[place] = block.quantities[i * quantity_columns + residual];
            auto next = numbers.columns.begin();
            auto const put = [&](double value) { (next++)->values[place] = value; };
            for (std::size_t const q : quantities) put(block.quantities[i * quantity_columns + q]);
            for (std::size_t j = 0; j < offsets; ++j) put(of_exponents[0][i * offsets + j]);
            for (double const count : contacts[i]) put(count);
        }
    };
    EnsemblePlan const plan = ensemble_plan(scene, MemberSet::of(members), backend, threads);
    StopRequest const nobody;
    BlockKernel const kernel = backend.kernel(scene.parts, plan.request.shadows.count > 0);
    run_ensemble(plan, kernel, take, stop != nullptr ? *stop : nobody, progress, weight);
    return numbers;
}

}  // namespace slideway
