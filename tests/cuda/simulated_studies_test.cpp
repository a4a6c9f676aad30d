// Every kind of study on a card: the processor's bits, whatever the blocks and workers.
#include "tests/cuda/simulated_run.hpp"
#include "tests/system/orbits.hpp"

namespace slideway::testing::simulated_studies_test {
namespace {

namespace orbits = ::slideway::testing::orbits;

/// Members that fail among others: z0 beyond the rod's reach, and starts too deep for their steps.
std::string const with_failures = R"(
schema = 1
[contact]
law = "conservative"
[friction]
[way]
yaw = 1e-5
[integrator]
max_steps = 300
[study]
members = 40
duration = "6 ms"
samples = 5
quantities = ["energy_residual", "drive_work", "mode_time", "peak_normal_force", "y"]
[study.vary]
"initial.z" = { dist = "values", values = [0, 2e-5, 0.2] }
"initial.vy" = { dist = "unif", low = -0.05, high = 0.05 }
)";

std::string const tolerance = R"(
schema = 1
[contact]
restitution = 0.8
[study]
kind = "tolerance"
design = "sobol"
members = 64
duration = "3 ms"
quantities = ["peak_normal_force", "drive_work"]
[study.vary]
"joint.clearance" = { dist = "unif", low = "0.05 mm", high = "0.2 mm" }
"initial.vy" = { dist = "norm", mean = 0, sd = 0.02 }
[study.limits]
"peak_normal_force" = { max = "1 kN" }
)";

struct Study {
    char const* name;
    std::string scene;
    std::vector<std::string> options;
    friend void PrintTo(Study const& study, std::ostream* out) { *out << study.name; }
};

class Studies : public SimulatedRun, public ::testing::WithParamInterface<Study> {};

TEST_P(Studies, HaveTheProcessorsBits) {
    auto const& [name, scene, options] = GetParam();
    write("s.toml", scene);
    std::string const expected = processor_hash("s.toml", options);
    for (std::vector<std::string> blocks : {std::vector<std::string>{"--threads", "1"},
                                            {"--threads", "3", "--block-members", "3"},
                                            {"--threads", "2", "--block-members", "1000"}}) {
        Setting const delay("DELAY", "300");
        blocks.insert(blocks.end(), options.begin(), options.end());
        Outcome const outcome = run_scene("s.toml", "card.nc", blocks);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        EXPECT_EQ(hash_of("card.nc"), expected) << blocks[1];
        EXPECT_EQ(results("card.nc").attribute("backend"), "cuda");
        EXPECT_EQ(results("card.nc").attribute("isa"), "sm_90");
    }
}

INSTANTIATE_TEST_SUITE_P(Of, Studies,
                         ::testing::Values(Study{"members_that_fail", with_failures, {"--max-failures", "100%"}},
                                           Study{"statistics", tolerance, {"--set", "study.store=statistics"}},
                                           Study{"restitution", tolerance, {}}, Study{"ensemble", orbits::ensemble, {}},
                                           Study{"lyapunov", orbits::lyapunov, {}},
                                           Study{"sections_of_the_crank", orbits::by_phase, {}},
                                           Study{"sections_of_a_state", orbits::by_state, {}},
                                           Study{"sections_of_a_gap", orbits::by_gap, {}},
                                           Study{"sweep", orbits::sweep, {}},
                                           Study{"continued_sweep", orbits::sweep, {"--set", orbits::continued_key}}),
                         [](auto const& info) { return std::string(info.param.name); });

TEST_F(SimulatedRun, OfAMemberReplaysWithTheBitsOfItsEnsemble) {
    write("s.toml", with_failures);
    Outcome const outcome = run_scene("s.toml", "all.nc", {"--max-failures", "100%"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    // The summary says how: with the processor, whose bits they are.
    EXPECT_NE(outcome.out.find("slideway run s.toml --backend cpu --member "), std::string::npos) << outcome.out;
    ASSERT_EQ(run_scene("s.toml", "one.nc", {"--backend", "cpu", "--member", "7", "--max-failures", "100%"}).code, 0);
    EXPECT_EQ(results("one.nc").values("final_y")[0], results("all.nc").values("final_y")[7]);
    EXPECT_EQ(results("one.nc").values("steps_accepted")[0], results("all.nc").values("steps_accepted")[7]);
}

}  // namespace
}  // namespace slideway::testing::simulated_studies_test
