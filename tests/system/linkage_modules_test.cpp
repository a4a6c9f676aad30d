// Linkages whose plan the compiler knew: the bits of the tables, found by scenes with the same bodies and joints, whatever their numbers.
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/planar_linkage.hpp"
#include "tests/system/own_module_fixture.hpp"

namespace slideway::testing::linkage_modules_test {
namespace {

/// A crank turns an arm by a slide on it, which an ideal pin closes; a bob hangs on a journal at the arm's end.
constexpr char const* scene = R"(
schema = 1
[mechanism]
kind = "linkage"
crank_speed = 20
[drive]
body = "crank"
[body.crank]
mass = 0.4
inertia = 3e-4
center_x = 0.02
[body.arm]
mass = 0.5
inertia = 2e-3
center_x = 0.1
angle = 0.4
[body.stone]
mass = 0.1
inertia = 1e-5
[body.bob]
mass = 0.1
inertia = 1e-4
center_x = 0.03
angle = -1.5
[link.shaft]
kind = "revolute"
first = "ground"
second = "crank"
[link.post]
kind = "revolute"
first = "ground"
first_x = -0.15
second = "arm"
[link.slide]
kind = "prismatic"
first = "arm"
second = "stone"
position = 0.18
[link.crank_pin]
kind = "revolute"
first = "stone"
second = "crank"
second_x = 0.06
[link.journal]
kind = "journal"
first = "bob"
second = "arm"
second_x = 0.3
clearance = 1e-4
radius = 0.01
[contact]
restitution = 0.8
[friction]
static = 0.1
kinetic = 0.05
[study]
members = 9
duration = "30 ms"
samples = 5
quantities = ["contact_onsets", "energy_residual", "friction_loss"]
verify = 0
[study.vary]
"link.journal.clearance" = { dist = "unif", low = 1e-4, high = 3e-4 }
"body.arm.mass" = { dist = "unif", low = 0.4, high = 0.6 }
)";

class LinkageModules : public ProgramWithOwnModules {
protected:
    LinkageModules() { write("s.toml", scene); }

    bool is_compiled(std::vector<std::string> const& more = {}) const {
        std::vector<std::string> words{"check", "s.toml"};
        words.insert(words.end(), more.begin(), more.end());
        Outcome const outcome = run(words);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome.out.find("compiled for these bodies and joints") != std::string::npos;
    }
};

TEST_F(LinkageModules, HaveTheBitsOfTheTables) {
    ASSERT_EQ(run_scene({}, "tables.nc").code, 0);
    EXPECT_FALSE(is_compiled());
    Outcome const outcome = run({"compile", "s.toml", "--isa", best()});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(is_compiled());
    ASSERT_EQ(run_scene({}, "compiled.nc").code, 0);
    EXPECT_EQ(hash_of("tables.nc"), hash_of("compiled.nc"));

    // Other numbers, the same bodies and joints; then a crank that turns by a torque, and a joint less: other plans.
    EXPECT_TRUE(is_compiled({"--set", "body.crank.mass=0.7", "--set", "friction.static=0.2"}));
    EXPECT_FALSE(is_compiled({"--set", "drive.kind=free"}));
    std::string text = scene;
    for (auto const& [from, to] : {std::pair{"[body.bob]", "[link.shaft]"}, {"[link.journal]", "[contact]"}}) text.erase(text.find(from), text.find(to) - text.find(from));
    text.erase(text.find("[study.vary]"));
    write("s.toml", text);
    EXPECT_FALSE(is_compiled());
}

/// A trial step of member 90 turns its slider beyond where angles have a sine: what follows must not depend on whether members beside it touch.
TEST_F(LinkageModules, NorTheTablesMixMembersOfAPack) {
    write("s.toml", planar_linkage() + R"(
[contact]
restitution = 0.4
[friction]
static = 0.1
kinetic = 0.05
[integrator]
rtol = 1e-8
atol = 1e-8
[study]
members = 512
duration = 0.03
verify = 0
quantities = ["energy_residual", "contact_onsets"]
[study.vary]
"link.way.clearance" = { dist = "unif", low = 0.5e-3, high = 1.5e-3 }
)");
    ASSERT_EQ(run_scene({"--members", "88..91"}, "four.nc").code, 0);
    ASSERT_EQ(run_scene({"--member", "90"}, "one.nc").code, 0);
    for (std::string const name : {"steps_accepted", "final_rod_angle", "energy_residual"})
        EXPECT_EQ(results("four.nc").values(name).at(2), results("one.nc").values(name).at(0)) << name;
}

TEST_F(LinkageModules, AreMadeOfLinkagesAlone) {
    write("s.toml", "schema = 1\n[mechanism]\nkind = \"scotch_yoke\"\n");
    Outcome const outcome = run({"compile", "s.toml"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("its mechanism is compiled already"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace slideway::testing::linkage_modules_test
