#include "host/study/prediction.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "host/study/ensemble_plan.hpp"
#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "kernels/members/stiffest_rate.hpp"
#include "tests/support/scene_fixture.hpp"

namespace slideway::prediction_test {
namespace {

Prediction prediction_of(std::string const& lines, int members = 1) {
    std::string const study = "\n[study]\nmembers = " + std::to_string(members) + "\nduration = 4\n";
    return predict(testing::scene_of("schema = 1\n" + lines + study), *cpu_backend(Isa::scalar), 4);
}

TEST(Prediction, RangeHoldsWhatRingingContactCosts) {
    // Runs of the standard scene, 4 s: 0.37e6 to 2.4e6 attempts of auto under the conservative law, 3.6e6 of dopri5.
    for (char const* method : {"auto", "dopri5", "bs32"}) {
        auto const p = prediction_of(std::string("[integrator]\nmethod = \"") + method + "\"\n");
        EXPECT_DOUBLE_EQ(p.least_steps, 4000) << method;
        EXPECT_GT(p.most_steps, 3.6e6) << method;
        EXPECT_LT(p.most_steps, 1e8) << method;
    }
    EXPECT_GT(prediction_of("[integrator]\nrtol = 1e-8\natol = 1e-8\n").most_steps, prediction_of("").most_steps);
    EXPECT_LT(prediction_of("[contact]\nyoung_modulus = 1e9\n").most_steps, 0.1 * prediction_of("").most_steps);
}

TEST(StiffestRate, OfThePlanarBlockIsThatOfTwoCornersInAnImpact) {
    Parts planar;
    planar.mechanism = Mechanism::planar_slider_crank;
    Inputs in;
    in.hertz_exponent = 1, in.point_stiffness = 2e6, in.slider_mass = 0.5, in.slider_inertia_z = 1e-3;
    in.slider_length = 0.04;
    in = complete_inputs(in);
    // Linear springs 2 K: as a whole √(4e6/0.5), rocking √(4e6 0.02²/1e-3) = √1.6e6, whatever the speed.
    EXPECT_DOUBLE_EQ(stiffest_rate(info(planar.mechanism), info(planar.law), in), std::sqrt(8e6));
    in.slider_length = 0.2;  // √(4e6 0.1²/1e-3) = √4e7
    EXPECT_DOUBLE_EQ(stiffest_rate(info(planar.mechanism), info(planar.law), in), std::sqrt(4e7));
    // 2 K δ^{n+1}/(n+1) = M v²/2 gives δ ∝ v^{2/(n+1)}: with n = 2 the stiffness grows as v^{2/3}.
    in.hertz_exponent = 2;
    double const before = stiffest_rate(info(planar.mechanism), info(planar.law), in);
    in.crank_speed *= 8;
    EXPECT_NEAR(stiffest_rate(info(planar.mechanism), info(planar.law), in) / before, 2, 1e-12);
}

TEST(StiffestRate, OfKelvinVoigtIsThatOfItsApices) {
    Parts parts;
    parts.law = Law::kelvin_voigt;
    Inputs in = complete_inputs(with_presets({}, parts.law));
    EXPECT_EQ(stiffest_rate(info(parts.mechanism), info(parts.law), in), stiffest_rate(info(Mechanism{}), info(Law{}), in));  // four apices of a quarter of the surface's stiffness
    in.slider_mass = 1e-3, in.slider_inertia_x = in.slider_inertia_y = in.slider_inertia_z = 1;
    in.law_a = 2.5e5;  // √(4 2.5e5/1e-3)
    EXPECT_DOUBLE_EQ(stiffest_rate(info(parts.mechanism), info(parts.law), in), std::sqrt(1e9));
}

TEST(Prediction, FixedStepsAreExact) {
    auto const p = prediction_of("[integrator]\nmethod = \"rk4\"\nstep = 1e-6\n", 3);
    EXPECT_EQ(p.least_steps, 12e6);
    EXPECT_EQ(p.most_steps, 12e6);
}

TEST(Prediction, NoMoreThreadsThanBlocks) {
    EXPECT_EQ(prediction_of("").busy_threads, 1);
    EXPECT_EQ(prediction_of("", 4096).busy_threads, 4);
}

TEST(Prediction, StatisticsDoNotGrowWithTheMembers) {
    auto const of = [](std::string const& store, std::uint64_t members) {
        return predict(testing::scene_of("schema = 1\n[study]\nduration = 4\nquantities = [\"peak_normal_force\", "
                                         "\"mode_time\"]\nstore = \"" +
                                         store + "\"\nmembers = " + std::to_string(members) + "\n"),
                       *cpu_backend(Isa::scalar), 4);
    };
    Prediction const million = of("statistics", 1'000'000), billion = of("statistics", 1'000'000'000);
    EXPECT_EQ(million.output_bytes, billion.output_bytes);
    EXPECT_EQ(million.memory(), billion.memory());
    // One generation of joined shards more, and a full one: a thousand times the members, and not five times the
    // shards.
    EXPECT_LT(billion.shard_bytes, 5 * million.shard_bytes);
    EXPECT_LT(billion.output_bytes, 1'000'000u);
    EXPECT_GT(of("members", 1'000'000).output_bytes, 100'000'000u);
}

TEST(Prediction, GoesByTheSizeOfBlocksThatIsAskedFor) {
    Scene const scene = testing::scene_of("schema = 1\n[study]\nduration = 4\nmembers = 10000\n");
    Prediction const small = predict(scene, *cpu_backend(Isa::scalar), 4, 10),
                     large = predict(scene, *cpu_backend(Isa::scalar), 4, 5000);
    EXPECT_EQ(small.largest_block, 10u);
    EXPECT_EQ(large.largest_block, 5000u);
    EXPECT_EQ(small.busy_threads, 4);
    EXPECT_EQ(large.busy_threads, 2);
    EXPECT_EQ(large.buffer_bytes, 2 * 500 * small.buffer_bytes / 4);
    EXPECT_LT(small.image_bytes, large.image_bytes / 10);
    // A thousand headers and two: the members' own bytes are the same.
    std::uint64_t const header = (small.shard_bytes - large.shard_bytes) / 998;
    EXPECT_EQ(small.shard_bytes - 1000 * header, large.shard_bytes - 2 * header);
    EXPECT_GT(header, 10'000u);
    EXPECT_LT(header, 100'000u);
}

TEST(Prediction, ContinuedSweepsMakeAShardOfEachColumnOfABlock) {
    auto const shards = [](std::string const& start) {
        Scene const scene = testing::scene_of(
            "schema = 1\n[mechanism]\ncrank_speed = 100\n[study]\nkind = \"sweep\"\nmembers = 50\nparameter = "
            "\"joint.clearance\"\nvalues = [1e-4, 2e-4, 3e-4, 4e-4]\ntransient_revolutions = 0\nrevolutions = 1\n"
            "exponents = 0\nstart = \"" +
            start + "\"\n");
        MemberSet const all({0, 200});
        return shard_bytes(scene, all, *cpu_backend(Isa::scalar), 1, 50) - payload_bytes(result_layout(scene, all));
    };
    // Of 200 members four blocks either way: 50 consecutive members, or 50 starts in four columns.
    EXPECT_NEAR(static_cast<double>(shards("continue")), static_cast<double>(shards("fresh")), 100);
}

}  // namespace
}  // namespace slideway::prediction_test
