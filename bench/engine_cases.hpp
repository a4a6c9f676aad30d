// What the benchmarks of the whole engine run: scenes, and members that scatter about them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "host/backend/backend.hpp"
#include "host/run/ensemble.hpp"

namespace slideway {

struct EngineCase {
    std::string name;
    Parts parts;
    double clearance, crank_speed, chi, end_time, rtol;
    Method method = Method::automatic;
    double pitch = 0;  // of the way [rad]
};
std::span<EngineCase const> engine_cases();
/// "0.05 s, rtol 1e-06, clearance 0.1 mm …"
std::string text_of(EngineCase const& c);

IntegratorSettings settings_of(EngineCase const& c);
/// Scattered starts with ±20 % in clearances, speed, friction and damping.
std::vector<Inputs> members_of(EngineCase const& c, std::size_t count);

struct EngineRun {
    EnsembleTotals totals;
    std::vector<double> states;  // [members][state_size], at the end
};

/// A case through the driver, in blocks as the backend wants them; no quantity is asked for.
EngineRun run_engine(EngineCase const& c, std::vector<Inputs> const& members, Backend const& backend, int threads);

/// Of one case on two machines, or twice on one.  Every NaN counts as the same one.
bool same_bits(EngineRun const& a, EngineRun const& b);

}  // namespace slideway
