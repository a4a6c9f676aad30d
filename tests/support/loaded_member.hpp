// Members with loads whose numbers are put into their inputs one after the other, and their runs without a scene.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <vector>

#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "tests/support/ensemble.hpp"
#include "tests/support/load_table.hpp"

namespace slideway::testing {

struct Loaded {
    Inputs in;
    std::vector<Load> loads;
    int numbers = 0;

    int number(double value) { return put_load_number(in, numbers, value); }
    void put(int (&places)[3], std::array<double, 3> const& values) {
        for (std::size_t i = 0; i < 3; ++i) places[i] = number(values[i]);
    }
    LoadList list() const { return {loads.data(), static_cast<int>(loads.size())}; }
};

inline RunOptions options(Loaded const& loaded, Mechanism mechanism, double seconds, double tolerance) {
    RunOptions o;
    o.parts.law = Law::conservative;
    o.parts.mechanism = mechanism;
    o.parts.loads = loaded.list();
    o.settings.rtol = o.settings.atol = tolerance;
    o.settings.end_time = seconds;
    return o;
}

inline EnsembleResult run(Loaded const& loaded, RunOptions const& o, Isa isa = best_isa()) {
    auto const r = run(isa, o, {complete_inputs(loaded.in, info(o.parts.mechanism))});
    EXPECT_EQ(r.records[0].status, Status::finished);
    return r;
}

/// A run has the same bits on every instruction set.
inline void expect_one_motion_on_all(RunOptions const& o, std::vector<Inputs> const& members) {
    auto const expected = run(Isa::scalar, o, members);
    for (Isa const isa : isas_beside_scalar()) {
        auto const r = run(isa, o, members);
        EXPECT_EQ(r.states, expected.states) << name_of(isa);
        EXPECT_EQ(r.quantities, expected.quantities) << name_of(isa);
    }
}

/// A slider in weightless flight within a joint that it does not reach.
inline Inputs afloat() {
    Inputs in;
    in.gravity = 0;
    in.clearance_y = in.clearance_z = 5e-3;
    return in;
}

inline constexpr Mechanism every_mechanism[] = {Mechanism::slider_crank, Mechanism::scotch_yoke, Mechanism::carriage, Mechanism::free_slider,
                                                Mechanism::planar_slider_crank};

}  // namespace slideway::testing
