#include "tests/models/models.hpp"

namespace slideway {

namespace scalar {
extern testing::ModelKernels const model_kernels;
}
namespace sse2 {
extern testing::ModelKernels const model_kernels;
}
namespace avx2 {
extern testing::ModelKernels const model_kernels;
}
namespace avx512 {
extern testing::ModelKernels const model_kernels;
}

namespace testing {

ModelKernels const& model_kernels(Isa isa) {
    switch (isa) {
        case Isa::sse2:
            return sse2::model_kernels;
        case Isa::avx2:
            return avx2::model_kernels;
        case Isa::avx512:
            return avx512::model_kernels;
        case Isa::scalar:
            break;
    }
    return scalar::model_kernels;
}

namespace {

template <class Inputs>
ModelResult run(void (*kernel)(BlockOf<Inputs>&), std::size_t columns, IntegratorSettings const& settings,
                std::vector<Inputs> const& members, std::vector<double> const& sample_times) {
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
    kernel(block);
    r.lane_steps_executed = block.lane_steps_executed;
    r.lane_steps_useful = block.lane_steps_useful;
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
