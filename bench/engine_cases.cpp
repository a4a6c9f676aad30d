#include "bench/engine_cases.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "bench/spread.hpp"
#include "host/config/keys.hpp"
#include "kernels/laws/list.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway {
namespace {

constexpr double pi = 3.141592653589793;

}  // namespace

std::span<EngineCase const> engine_cases() {
    static std::vector<EngineCase> const cases = {
        {"standard scene, paper", {Law::paper, Damping::point, true, false}, 1e-4, pi, 0, 0.05, 1e-6},
        {"standard scene, conservative", {Law::conservative, Damping::point, true, false}, 1e-4, pi, 0, 0.05, 1e-6},
        {"rattling, conservative", {Law::conservative, Damping::rate, true, false}, 5e-4, 47, 10, 0.05, 1e-5},
        {"rattling by the clocks of impacts", {Law::conservative, Damping::rate, true, false}, 5e-4, 47, 10, 0.05, 1e-5, Method::verner65},
        {"settling, conservative", {Law::conservative, Damping::rate, true, false}, 1e-4, pi, 10, 0.4, 1e-4},
        {"crank turn, conservative", {Law::conservative, Damping::rate, true, false}, 1e-4, pi, 10, 2, 1e-3},
        {"pitched way, conservative", {Law::conservative, Damping::point, true, true}, 1e-4, pi, 0, 0.05, 1e-6, Method::automatic, 6e-5},
        {"bed without damping", {Law::foundation, Damping::point, true, false}, 1e-4, pi, 0, 0.05, 1e-6},
        {"creep, conservative", {Law::conservative, Damping::rate, true, false}, 1e-4, 0.01, 10, 1, 1e-6},
    };
    return cases;
}

std::string text_of(EngineCase const& c) {
    return fmt::format("{} s, rtol {:.0e}, clearance {} mm, {:.3g} rad/s, χ = {}, pitch of the way {} mrad", c.end_time, c.rtol,
                       1e3 * c.clearance, c.crank_speed, c.chi, 1e3 * c.pitch);
}

IntegratorSettings settings_of(EngineCase const& c) {
    IntegratorSettings settings;
    settings.end_time = c.end_time;
    settings.rtol = settings.atol = c.rtol;
    settings.method = c.method;
    return settings;
}

std::vector<Inputs> members_of(EngineCase const& c, std::size_t count) {
    auto members = testing::scattered_starts(count, c.clearance, c.crank_speed);
    for (std::size_t i = 0; i < members.size(); ++i) {
        members[i] = with_presets(members[i], c.parts.law);
        members[i].way_pitch = c.pitch;
        bench::spread_inputs(members[i], c.chi, [&](double irrational) {
            double const x = static_cast<double>(i + 1) * irrational;
            return 0.8 + 0.4 * (x - std::floor(x));
        });
    }
    return members;
}

EngineRun run_engine(EngineCase const& c, std::vector<Inputs> const& members, Backend const& backend, int threads) {
    EnsemblePlan plan;
    plan.members = MemberSet(MemberRange{0, members.size()});
    plan.threads = plan.workers = backend.workers(threads);
    plan.request.integrator = settings_of(c);
    plan.blocks.bounds = backend.bounds({c.parts, false, block_bytes(plan.request, 1), plan.threads, 0});
    plan.source = [&](std::uint64_t i, Inputs& in) {
        in = members[i];
        return true;
    };
    EngineRun run;
    run.states.resize(members.size() * state_size);
    StopRequest const stop;
    run.totals = run_ensemble(
        plan, backend.kernel(c.parts, false),
        [&](BlockResult const& block) {
            std::ranges::copy(block.final_states,
                              run.states.begin() + static_cast<std::ptrdiff_t>(block.members.front() * state_size));
        },
        stop);
    return run;
}

bool same_bits(EngineRun const& a, EngineRun const& b) {
    return std::ranges::equal(a.states, b.states, [](double x, double y) {
        return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y) || (std::isnan(x) && std::isnan(y));
    });
}

}  // namespace slideway
