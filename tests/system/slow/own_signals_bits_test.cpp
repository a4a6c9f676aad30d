// Signals of a mechanism that the tree has too: the bits of its tables, and what is said where something is wrong.  Compiling it takes long.
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/system/own_module_fixture.hpp"

namespace slideway::testing::own_signals_bits_test {
namespace {

class OwnSignalsBits : public ProgramWithOwnModules {};

/// A yoke of the tree that tells again what the tables have.
constexpr char const* twin = R"(
    #include "kernels/mechanisms/scotch_yoke.hpp"
    namespace slideway::inline SLIDEWAY_ISA {
    struct SeenDrive : ScotchYokeDrive {
        static constexpr Key keys[] = {
            {"mechanism.gauge", &Inputs::mechanism_p, "1", Rule::positive, KeyGroup::mechanism, "factor of a gauge", 1}};
        static constexpr Signal signals[] = {
            {"push", "N", "sum of the normal forces", statistics_of(Statistic::maximum, Statistic::mean)},
            {"travel", "m", "way of the slider"},
        };
        static constexpr MechanismInfo info = [] {
            auto info = ScotchYokeDrive::info;
            info.name = "seen_yoke";
            info.has_exponents = false;  // not compiled for
            info.own_keys = keys;
            info.signals = signals;
            return info;
        }();
        template <class Real, class Report>
        SLIDEWAY_FN static void put_signals(Real, Real const*, SliderParameters<Real> const&, Report const& report, Real* values) {
            values[0] = report.contact.total_force();
            values[1] = report.x;
        }
    };
    using SeenYoke = SpatialSlider<SeenDrive>;
    }
    #define SLIDEWAY_MECHANISM SeenYoke
)";

constexpr char const* seen_scene = R"(
schema = 1
[modules]
search = ["own"]
[mechanism]
kind = "seen_yoke"
gauge = 2
[contact]
law = "conservative"
[friction]
[initial]
y = "-0.05 mm"
[study]
members = 8
duration = "50 ms"
samples = 11
quantities = ["energy_residual", "peak_normal_force", "mean_normal_force", "max_push", "mean_push", "max_travel", "final_travel", "push", "travel", "normal_force", "x"]
verify = 0
[study.vary]
"initial.vy" = { dist = "unif", low = -0.1, high = 0.1 }
)";

TEST_F(OwnSignalsBits, AreThoseOfTheTablesWhereTheyAreTheSame) {
    write("twin.hpp", twin);
    ASSERT_EQ(run({"compile", "twin.hpp", "-o", "own", "--isa", "scalar"}).code, 0);  // soonest compiled
    std::string without_gauge(seen_scene);
    without_gauge.erase(without_gauge.find("gauge = 2\n"), 10);
    write("s.toml", seen_scene);
    ASSERT_EQ(run_scene({}, "s.nc").code, 0);
    auto const file = results("s.nc");
    EXPECT_EQ(file.values("push"), file.values("normal_force"));
    EXPECT_EQ(file.values("travel"), file.values("x"));
    EXPECT_EQ(file.values("max_push"), file.values("peak_normal_force"));
    EXPECT_EQ(file.values("mean_push"), file.values("mean_normal_force"));
    EXPECT_GT(file.values("max_push").front(), 1);
    // It is the tree's yoke otherwise, whatever is asked for.
    std::vector<std::string> const same{"--force", "--set", R"(study.quantities=["energy_residual", "peak_normal_force"])"};
    auto in_tree = same;
    in_tree.emplace_back("mechanism.kind=scotch_yoke");
    ASSERT_EQ(run_scene(same, "own.nc").code, 0);
    write("s.toml", without_gauge);
    ASSERT_EQ(run_scene(in_tree, "tree.nc").code, 0);
    EXPECT_EQ(hash_of("own.nc"), hash_of("tree.nc"));
    // It alone has them, and what is wrong with a name is one line.
    expect_refusal(2, "\"max_push\" (there is no such quantity)", {"check", "s.toml", "--set", "mechanism.kind=scotch_yoke"});
    write("s.toml", seen_scene);
    expect_refusal(2, "it is a time series", {"check", "s.toml", "--set", "study.limits={push = { max = 1 }}"});
    expect_refusal(2, "max_travel", {"check", "s.toml", "--set", R"(study.quantities=["max_travels"])"});
    std::string const resolved = run({"check", "s.toml", "--resolved"}).out;
    EXPECT_NE(resolved.find("gauge = 2"), std::string::npos) << resolved;
    EXPECT_NE(resolved.find("\"max_travel\", \"final_travel\""), std::string::npos) << resolved;
    setenv("SLIDEWAY_MODULES", path("own").c_str(), 1);
    std::string const list = run({"list"}).out;
    unsetenv("SLIDEWAY_MODULES");
    EXPECT_NE(list.find("sum of the normal forces: time mean (seen_yoke)"), std::string::npos);
    EXPECT_NE(list.find("way of the slider (seen_yoke)"), std::string::npos);
}

TEST_F(OwnSignalsBits, WithoutTheFunctionThatTellsThemDoNotCompile) {
    std::string text(twin);
    text.replace(text.find("put_signals"), 11, "tell_signals");
    write("bad.hpp", text);
    Outcome const outcome = run({"compile", "bad.hpp", "-o", "bad", "--isa", "scalar"});
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find("there is no put_signals(t, state, parameters, report, values)"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace slideway::testing::own_signals_bits_test
