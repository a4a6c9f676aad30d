#include "tests/models/models.hpp"

#include <algorithm>

#include "tests/models/by_isa.hpp"

namespace slideway {

SLIDEWAY_BY_ISA(testing::ModelKernels const, model_kernels)

namespace testing {

ModelKernels const& model_kernels(Isa isa) { return *model_kernels_by_isa(isa); }

namespace {

/// The following with what it leaves to be completed, and room for its results.
template <class Inputs> Following completed(Following f, std::size_t members, ModelResult& r) {
    constexpr std::size_t size = Inputs::size;
    if (f.clocks.size() == 1) f.clocks.resize(members, f.clocks[0]);
    auto const shadows = static_cast<std::size_t>(f.shadows);
    if (f.directions.empty()) {
        f.directions.assign(members * shadows * size, 0);
        for (std::size_t i = 0; i < members * shadows; ++i) f.directions[i * size + i % shadows % size] = 1;
    }
    r.sections.assign(members * f.stops.sections() * size, follows);
    r.growth.assign(members * f.stops.growths() * shadows, follows);
    return f;
}

ShadowPlan plan_of(Following const& f) { return {f.shadows, f.d0, f.lower, f.upper, f.directions.data()}; }

template <class Inputs>
ModelResult run(void (*kernel)(BlockOf<Inputs>&), std::size_t columns, IntegratorSettings const& settings,
                std::vector<Inputs> const& members, std::vector<double> const& sample_times,
                Following const* following = nullptr) {
    constexpr std::size_t size = Inputs::size;
    std::size_t const n = members.size();
    ModelResult r;
    r.records.resize(n);
    r.states.assign(n * size, follows);
    r.quantities.assign(n * columns, follows);
    r.series.assign(n * size * sample_times.size(), -1);
    BlockOf<Inputs> block;
    block.inputs = members.data();
    block.members = n;
    block.settings = settings;
    block.sample_times = sample_times.data();
    block.samples = sample_times.size();
    block.quantities = columns > 0 ? 1 : 0;
    block.series = (Selection(1) << size) - 1;
    block.records = r.records.data();
    block.final_states = r.states.data();
    block.quantity_values = r.quantities.data();
    block.series_values = r.series.data();
    Following f;
    if (following != nullptr) {
        f = completed<Inputs>(*following, n, r);
        block.order = f.order.empty() ? nullptr : f.order.data();
        block.clocks = f.clocks.empty() ? nullptr : f.clocks.data();
        block.stops = f.stops;
        block.shadows = plan_of(f);
        block.growth_values = r.growth.data();
    }
    // Rows of time and state.
    std::vector<double> rows(r.sections.size() / size * (1 + size), follows);
    if (following != nullptr) block.section_values = rows.data();
    kernel(block);
    for (std::size_t i = 0; i < rows.size() / (1 + size); ++i) {
        r.section_times.push_back(rows[i * (1 + size)]);
        std::copy_n(&rows[i * (1 + size) + 1], size, &r.sections[i * size]);
    }
    r.lane_steps_executed = block.lane_steps_executed;
    r.lane_steps_useful = block.lane_steps_useful;
    return r;
}

template <class Inputs>
ModelResult run(void (*kernel)(MapBlockOf<Inputs>&), std::vector<Inputs> const& members, Following const& following) {
    constexpr std::size_t size = Inputs::size;
    ModelResult r;
    Following const f = completed<Inputs>(following, members.size(), r);
    r.states.assign(members.size() * size, follows);
    MapBlockOf<Inputs> block;
    block.inputs = members.data();
    block.members = members.size();
    block.first_stop = static_cast<std::uint64_t>(following.clocks.at(0).first_stop);
    block.period = static_cast<std::uint64_t>(following.clocks.at(0).period);
    block.stops = f.stops;
    block.shadows = plan_of(f);
    block.final_states = r.states.data();
    block.section_values = r.sections.data();
    block.growth_values = r.growth.data();
    kernel(block);
    return r;
}

}  // namespace

ModelResult run(Isa isa, IntegratorSettings const& settings, std::vector<BallInputs> const& members,
                std::vector<double> const& sample_times) {
    return run(model_kernels(isa).ball, 4 * recorded_ball_events, settings, members, sample_times);
}

ModelResult run(Isa isa, IntegratorSettings const& settings, std::vector<OscillatorInputs> const& members,
                std::vector<double> const& sample_times) {
    return run(model_kernels(isa).oscillator, 0, settings, members, sample_times);
}

ModelResult run(Isa isa, IntegratorSettings const& settings, std::vector<TrackerInputs> const& members,
                std::vector<double> const& sample_times) {
    return run(model_kernels(isa).tracker, 0, settings, members, sample_times);
}

ModelResult run(Isa isa, IntegratorSettings const& settings, std::vector<ValveInputs> const& members,
                std::vector<double> const& sample_times) {
    return run(model_kernels(isa).valve, recorded_valve_events, settings, members, sample_times);
}

ModelResult run(Isa isa, IntegratorSettings const& settings, std::vector<LorenzInputs> const& members,
                Following const& f) {
    return run(model_kernels(isa).lorenz, 0, settings, members, {}, &f);
}

ModelResult run(Isa isa, IntegratorSettings const& settings, std::vector<TableBallInputs> const& members,
                Following const& f) {
    return run(model_kernels(isa).table_ball, 0, settings, members, {}, &f);
}

ModelResult run(Isa isa, IntegratorSettings const& settings, std::vector<RigidBallInputs> const& members,
                Following const& f) {
    return run(model_kernels(isa).rigid_ball, 0, settings, members, {}, &f);
}

ModelResult run(Isa isa, std::vector<LogisticInputs> const& members, Following const& f) {
    return run(model_kernels(isa).logistic, members, f);
}

ModelResult run(Isa isa, std::vector<HenonInputs> const& members, Following const& f) {
    return run(model_kernels(isa).henon, members, f);
}

double mean_growth(ModelResult const& result, Following const& f, std::size_t member, int shadow, std::size_t first) {
    std::size_t const intervals = f.stops.growths(), shadows = static_cast<std::size_t>(f.shadows);
    double sum = 0;
    for (std::size_t i = first; i < intervals; ++i) {
        sum += result.growth[(member * intervals + i) * shadows + static_cast<std::size_t>(shadow)];
    }
    return sum / static_cast<double>(intervals - first);
}

std::vector<BallEvent> ball_events(ModelResult const& result, std::size_t member) {
    std::vector<BallEvent> events;
    for (std::size_t i = 0; i < recorded_ball_events; ++i) {
        double const* row = &result.quantities[4 * (member * recorded_ball_events + i)];
        if (row[0] >= 0) events.push_back({static_cast<BallEvent::Kind>(row[0]), row[1], row[2], row[3]});
    }
    return events;
}

IntegratorSettings equal_steps(Method method, double length, double end_time) {
    IntegratorSettings s;
    s.method = method;
    s.end_time = end_time;
    s.rtol = s.atol = s.stiff_tolerance = 1e30;
    s.max_step = s.stiff_max_step = s.fixed_step = length;
    return s;
}

}  // namespace testing
}  // namespace slideway
