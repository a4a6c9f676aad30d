// Members of very many revolutions: the time of a step is far below the last bit of the end time.
#include <cmath>

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "tests/system/process.hpp"

namespace slideway::testing::long_run_test {
namespace {

using Json = nlohmann::json;

class LongRun : public Program {
protected:
    /// One member; the values of its quantities, or how it failed.
    Json told(std::string const& scene, std::vector<std::string> const& keys) const {
        std::vector<std::string> words{"run", fmt::format("{}/{}", SLIDEWAY_SCENES, scene), "--no-progress", "--json", "--force", "-o", "r.nc", "--max-failures", "100%",
                                       "--isa", "scalar"};
        for (std::string const key : {"study.members=1", "study.samples_per_revolution=0", "study.quantities=[\"energy_residual\", \"drive_work\"]"})
            words.insert(words.end(), {"--set", key});
        for (std::string const& key : keys) words.insert(words.end(), {"--set", key});
        Outcome const outcome = run(words);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return Json::parse(outcome.out);
    }
};

/// Impacts at the start want steps of 1e-10 s, whatever the run's length: 1e5 revolutions at π rad/s end at 2e5 s, whose last bit is 3e-11 s.
TEST_F(LongRun, TakesItsFirstStepsWhateverItsEnd) {
    for (std::string const scene : {"slider_crank_0.1mm.toml", "scotch_yoke.toml", "carriage_1.toml"}) {
        Json const run = told(scene, {"study.revolutions=1e5", "integrator.max_step=1e3", "integrator.max_steps=3000"});
        EXPECT_EQ(run["statuses"], Json({{"max_steps", 1}})) << scene;
    }
}

/// What the audit finds beyond the work done stays the same share of it from 100 to 10,000 revolutions: nothing is lost with t's last bits.
TEST_F(LongRun, BalancesItsEnergyAsAShortOneDoes) {
    for (double const revolutions : {1e2, 1e4}) {
        Json const run = told("scotch_yoke.toml", {fmt::format("study.revolutions={}", revolutions)});
        EXPECT_EQ(run["statuses"], Json({{"finished", 1}}));
        double const residual = run["quantities"][0]["mean"], work = run["quantities"][1]["mean"];
        EXPECT_GT(work, 0.03 * revolutions);
        EXPECT_LT(std::abs(residual), 1e-8 * work + 1e-7) << revolutions;
    }
}

/// The crank's angle has 53 bits: after 4e7 revolutions its last one moves the pin by more than a millionth of the clearance.
TEST_F(LongRun, IsRefusedWhereTheDriveHasNoPlace) {
    std::string const scene = fmt::format("{}/scotch_yoke.toml", SLIDEWAY_SCENES);
    for (std::string const command : {"check", "run"}) {
        expect_refusal(2, "the last bit of a number of double precision moves the drive", {command, scene, "--set", "study.revolutions=4e7"});
    }
}

}  // namespace
}  // namespace slideway::testing::long_run_test
