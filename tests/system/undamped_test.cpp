// Sliders that bounce on contacts which take no energy, by the method of a scene that names none.
#include <cmath>

#include <fmt/format.h>

#include "tests/system/results.hpp"

namespace slideway::testing::undamped_test {
namespace {

constexpr char const* dropped = R"(
schema = 1
[mechanism]
kind = "free_slider"
slider_mass = 0.2
[joint]
clearance = "1 mm"
[contact]
law = "{}"
{}
[study]
kind = "ensemble"
members = 8
duration = "{} s"
verify = 0
samples = 0
quantities = ["energy_residual"]
[study.vary]
"initial.y" = {{ dist = "unif", low = "-0.1 mm", high = "0.1 mm" }}
)";

class Undamped : public ProgramWithResults {};

/// Some 3,000 impacts a minute, each of which may make 3e-7 of a fall through the clearance: those of dopri5 make 0.25 to 0.4 in all, in every member.
TEST_F(Undamped, SlidersKeepTheirEnergyForAMinute) {
    struct Case { char const *law, *keys; double duration; };
    for (auto const& [law, keys, duration] : {Case{"conservative", "eta = 0", 20}, Case{"kelvin_voigt", "", 60}, Case{"foundation", "", 60}, Case{"paper", "eta = 0", 60},
                                              Case{"foundation", "restitution = 1", 60}}) {
        write("s.toml", fmt::format(dropped, law, keys, duration));
        Outcome const outcome = run({"run", "s.toml", "--no-progress", "--force", "-o", "r.nc"});
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        double const bound = 1e-3 * duration / 60 * 0.2 * 9.81 * 1e-3;
        for (double const residual : results("r.nc").values("energy_residual")) EXPECT_LT(std::abs(residual), bound) << law << " " << keys;
    }
}

}  // namespace
}  // namespace slideway::testing::undamped_test
