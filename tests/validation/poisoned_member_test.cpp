// A member that fails, whatever it fails of and wherever it stands, fails alone: the others keep every bit.
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "host/config/keys.hpp"
#include "host/run/ensemble.hpp"
#include "kernels/laws/list.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::poisoned_member_test {
namespace {

constexpr std::size_t members = 400;  // several blocks
constexpr Selection selected = Selection{1} << static_cast<int>(Quantity::energy_residual) |
                               Selection{1} << static_cast<int>(Quantity::mode_time) |
                               Selection{1} << static_cast<int>(Quantity::peak_tilt);

struct Poison {
    char const* name;
    void (*put)(Inputs&);
    Status status;      // how the member ends then
    bool drawn = true;  // false: the draw slipped through unchecked, as a defect of the host would let it
};

Poison const poisons[] = {
    {"a velocity that is no number", [](Inputs& in) { in.vy = std::numeric_limits<double>::quiet_NaN(); },
     Status::invalid_inputs},
    {"a preload beyond what is elastic", [](Inputs& in) { in.clearance_y = -1e-3; }, Status::invalid_inputs},
    {"a state that is no number", [](Inputs& in) { in.z = std::numeric_limits<double>::quiet_NaN(); },
     Status::nonfinite, false},
    {"a mass that is infinite", [](Inputs& in) { in.slider_mass = std::numeric_limits<double>::infinity(); },
     Status::nonfinite, false},
    {"a start beyond the reach of the rod", [](Inputs& in) { in.y = 0.2; }, Status::geometry},
    {"an edge deeper in the way than its law knows",
     [](Inputs& in) { in.edge_radius = 1e6, in.y = -1.2e-4, in.pitch = 2e-3; }, Status::contact_domain},
    {"an angular velocity whose square is infinite", [](Inputs& in) { in.wx = 1e160; }, Status::nonfinite},
    {"a start that rings for more steps than it may", [](Inputs& in) { in.y = -1e-3; }, Status::max_steps},
};

struct Results {
    std::vector<MemberRecord> records = std::vector<MemberRecord>(members);
    std::vector<double> states = std::vector<double>(members * state_size);
    std::vector<double> quantities = std::vector<double>(members * quantity_columns);
    EnsembleTotals totals;
};

bool same_record(MemberRecord const& a, MemberRecord const& b) {
    return a.status == b.status && a.steps_accepted == b.steps_accepted && a.steps_rejected == b.steps_rejected &&
           a.rhs_evaluations == b.rhs_evaluations && a.jacobian_evaluations == b.jacobian_evaluations &&
           a.stiff_steps == b.stiff_steps && a.crossings == b.crossings &&
           std::memcmp(&a.time, &b.time, sizeof a.time) == 0;
}

/// Whether member i has the same bits in both.
bool same_member(Results const& a, Results const& b, std::size_t i) {
    auto const same_rows = [i](std::vector<double> const& x, std::vector<double> const& y, std::size_t width) {
        return std::memcmp(&x[i * width], &y[i * width], width * sizeof(double)) == 0;
    };
    return same_record(a.records[i], b.records[i]) && same_rows(a.states, b.states, state_size) &&
           same_rows(a.quantities, b.quantities, quantity_columns);
}

class PoisonedMember : public ::testing::Test {
protected:
    static constexpr std::size_t nobody = members;

    PoisonedMember() : kernel_(cpu_backend(isa_)->kernel({Law::conservative, Damping::rate, true, false}, false)) {
        // One in nine touches its way in the time that it has.
        for (std::size_t i = 0; i < members; i += 9) starts_[i].vy = -0.6;
    }

    Results run(std::size_t position, Poison const* poison) const {
        EnsemblePlan plan;
        plan.members = MemberSet({0, members});
        plan.blocks.bounds.lanes = static_cast<std::size_t>(lanes_of(isa_));
        plan.threads = plan.workers = 2;
        plan.request.integrator.end_time = 2e-4;
        plan.request.integrator.max_steps = 300;
        plan.request.quantities = selected;
        plan.source = [&](std::uint64_t member, Inputs& inputs) {
            inputs = starts_[member];
            if (member != position) return true;  // the others were drawn often enough
            poison->put(inputs);
            return !poison->drawn || !defect(inputs);
        };
        Results results;
        results.totals = run_ensemble(
            plan, kernel_,
            [&](BlockResult const& block) {
                for (std::size_t i = 0; i < block.members.size(); ++i) {
                    std::size_t const m = block.members[i];
                    results.records[m] = block.records[i];
                    std::copy_n(&block.final_states[i * state_size], state_size, &results.states[m * state_size]);
                    std::copy_n(&block.quantities[i * quantity_columns], quantity_columns,
                                &results.quantities[m * quantity_columns]);
                }
            },
            StopRequest());
        return results;
    }

    Isa const isa_ = best_isa();
    BlockKernel const kernel_;
    std::vector<Inputs> starts_ = testing::scattered_starts(members);
};

TEST_F(PoisonedMember, FailsAloneAtEveryPlace) {
    Results const healthy = run(nobody, nullptr);
    ASSERT_EQ(healthy.totals.ended[static_cast<std::size_t>(Status::finished)], members);
    int touched = 0;
    for (std::size_t i = 0; i < members; ++i) {
        double const free_time =
            healthy.quantities[i * quantity_columns + static_cast<std::size_t>(quantity_column(Quantity::mode_time))];
        touched += free_time < 0.999 * 2e-4;
    }
    EXPECT_GT(touched, 20);
    EXPECT_LT(touched, static_cast<int>(members / 2));

    for (std::size_t position = 0; position < members; ++position) {
        Poison const& poison = poisons[position % std::size(poisons)];
        Results const results = run(position, &poison);
        ASSERT_EQ(results.records[position].status, poison.status)
            << poison.name << " at " << position << ": " << static_cast<int>(results.records[position].status);
        ASSERT_EQ(results.totals.ended[static_cast<std::size_t>(Status::finished)], members - 1);
        ASSERT_EQ(results.totals.failed(), 1u);
        for (std::size_t i = 0; i < members; ++i) {
            if (i == position) continue;
            ASSERT_TRUE(same_member(results, healthy, i)) << poison.name << " at " << position << " changed " << i;
        }
    }
}

TEST_F(PoisonedMember, OfEveryKindFailsAloneInEveryIsa) {
    for (Isa const isa : all_isas()) {
        if (!is_supported(isa)) continue;
        testing::RunOptions options;
        options.parts = {Law::paper, Damping::point, true, false};
        options.settings.end_time = 2e-4;
        options.settings.max_steps = 300;
        std::vector<Inputs> const starts(starts_.begin(), starts_.begin() + 40);
        auto const healthy = testing::run(isa, options, starts);
        for (Poison const& poison : poisons) {
            if (poison.status == Status::invalid_inputs) continue;  // those never reach a kernel
            auto poisoned = starts;
            poison.put(poisoned[17]);
            auto const results = testing::run(isa, options, poisoned);
            EXPECT_EQ(results.records[17].status, poison.status) << poison.name << ' ' << name_of(isa);
            for (std::size_t i = 0; i < starts.size(); ++i) {
                if (i == 17) continue;
                EXPECT_TRUE(same_record(results.records[i], healthy.records[i])) << poison.name;
                EXPECT_EQ(std::memcmp(&results.states[i], &healthy.states[i], sizeof healthy.states[i]), 0)
                    << poison.name;
                EXPECT_EQ(std::memcmp(&results.quantities[i], &healthy.quantities[i], sizeof healthy.quantities[i]), 0)
                    << poison.name;
            }
        }
    }
}

}  // namespace
}  // namespace slideway::poisoned_member_test
