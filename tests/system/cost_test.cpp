// What `check` says a study will cost, beside what it costs.
#include <nlohmann/json.hpp>

#include "tests/system/small_run.hpp"

namespace slideway::testing::cost_test {
namespace {

using Json = nlohmann::json;

class Cost : public SmallRun {};

/// Seconds hang on who else uses the machine; scripts/cost_table.sh compares them.
TEST_F(Cost, IsToldWithinAFactorOfThree) {
    for (std::vector<std::string> const& study : std::vector<std::vector<std::string>>{
             {"study.members=200", "study.duration=40 ms"},
             {"study.members=200", "study.duration=100 ms", "contact.law=conservative"},
             {"study.members=40", "study.duration=1 s"},
             {"study.members=100", "study.duration=20 ms", "integrator.method=bs32"},
             {"study.members=64", "study.duration=20 ms", "contact.restitution=0.5"}}) {
        std::vector<std::string> words{"check", "s.toml", "--json", "--set", "study.samples=0"};
        words.insert(words.end(), study.begin(), study.end());
        Outcome const told = run(words);
        ASSERT_EQ(told.code, 0) << told.err;
        words.front() = "run";
        words.insert(words.end(), {"--no-progress", "--force", "-o", "o.nc", "--set", "study.verify=0"});
        Outcome const done = run(words);
        ASSERT_EQ(done.code, 0) << done.err;
        Json const expected = Json::parse(told.out), found = Json::parse(done.out);
        double const steps = found["run"]["steps_accepted"].get<double>() + found["run"]["steps_rejected"].get<double>();
        EXPECT_LT(expected["steps"]["expected"].get<double>(), 3 * steps) << study.back();
        EXPECT_GT(expected["steps"]["expected"].get<double>(), steps / 3) << study.back();
    }
}

}  // namespace
}  // namespace slideway::testing::cost_test
