#include <nlohmann/json.hpp>

#include "tests/system/process.hpp"

namespace slideway::testing::members_test {
namespace {

using Json = nlohmann::json;

class MembersOfAResult : public Program {
protected:
    MembersOfAResult() {
        write("s.toml",
              "schema = 1\n[contact]\nlaw = \"paper\"\n[study]\nmembers = 12\nduration = \"1 ms\"\n[study.vary]\n\"joint.clearance\" = { dist = \"unif\", low = 5e-5, high = 1e-4 }\n");
    }
    Json json(std::vector<std::string> const& arguments) const {
        Outcome const outcome = run(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return Json::parse(outcome.out);
    }
};

TEST_F(MembersOfAResult, AreARowEach) {
    Json const totals = json({"run", "s.toml", "-o", "s.nc", "--json", "--quiet"});
    Json const all = json({"info", "s.nc", "--members", "--json"})["members"];
    ASSERT_EQ(all.size(), 12u);
    std::uint64_t accepted = 0, rejected = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(all[i]["member"], i);
        EXPECT_EQ(all[i]["status"], "finished");
        EXPECT_EQ(all[i]["end_time"], 1e-3);
        accepted += all[i]["steps_accepted"].get<std::uint64_t>();
        rejected += all[i]["steps_rejected"].get<std::uint64_t>();
    }
    EXPECT_EQ(accepted, totals["run"]["steps_accepted"]);
    EXPECT_EQ(rejected, totals["run"]["steps_rejected"]);
    EXPECT_FALSE(json({"info", "s.nc", "--json"}).contains("members"));
    // Of the text the last lines, behind a heading.
    std::string const brief = run({"info", "s.nc"}).out, table = run({"info", "s.nc", "--members"}).out;
    EXPECT_TRUE(table.starts_with(brief));
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n') - std::count(brief.begin(), brief.end(), '\n'), 1 + 1 + 12);
    EXPECT_EQ(run({"info", "--members", "s.nc"}).out, table) << "the file may stand behind";
}

TEST_F(MembersOfAResult, AreThoseOfARange) {
    ASSERT_EQ(run({"run", "s.toml", "-o", "s.nc", "--members", "4..9", "--quiet"}).code, 0);
    Json const some = json({"info", "s.nc", "--members", "3..5", "--json"})["members"];
    ASSERT_EQ(some.size(), 2u) << "by their numbers, not their places in the file";
    EXPECT_EQ(some[0]["member"], 4);
    EXPECT_EQ(some[1]["member"], 5);
    expect_refusal(2, "s.nc: has none of the members 0 to 3; it has 4 to 9", {"info", "s.nc", "--members", "0..3"});
    expect_refusal(2, "--members 5..3: give the first and the last", {"info", "s.nc", "--members", "5..3"});
}

TEST_F(MembersOfAResult, AreNotInOneOfStatistics) {
    ASSERT_EQ(run({"run", "s.toml", "-o", "s.nc", "--set", "study.store=statistics", "study.quantities=[\"peak_tilt\"]", "--quiet"}).code, 0);
    expect_refusal(2, "leave out --members", {"info", "s.nc", "--members"});
}

}  // namespace
}  // namespace slideway::testing::members_test
