// The methods by name, and which of them `auto` is.
#include "kernels/laws/list.hpp"
#include "kernels/methods.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <string_view>

#include "tests/support/ensemble.hpp"

namespace slideway::kernels_methods_test {
namespace {

TEST(Methods, AreNamedInTheirOrder) {
    EXPECT_STREQ(name_of(Method::automatic), "auto");
    EXPECT_STREQ(name_of(Method::dopri5), "dopri5");
    EXPECT_STREQ(name_of(Method::dop853), "dop853");
    EXPECT_STREQ(name_of(Method::bs32), "bs32");
    EXPECT_STREQ(name_of(Method::ros34pw2), "ros34pw2");
    EXPECT_STREQ(name_of(Method::rk4), "rk4");
    EXPECT_STREQ(name_of(Method::verner65), "verner65");
    EXPECT_STREQ(name_of(Method::moreau_jean), "moreau_jean");
    EXPECT_EQ(method_count, 8);
    for (auto const& info : method_table) EXPECT_GT(std::string_view(info.description).size(), 20u) << info.name;
    EXPECT_EQ(IntegratorSettings{}.method, Method::automatic);
}

testing::EnsembleResult flight(Method method, double tolerance, Law law, bool located = false) {
    // Two milliseconds in free flight.
    testing::RunOptions o;
    o.parts = {law, Damping::point, true, false};
    o.settings.method = method;
    o.settings.rtol = o.settings.atol = tolerance;
    o.settings.end_time = 2e-3;
    o.settings.locate_modes = located;
    return testing::run(best_isa(), o, testing::scattered_starts(9));
}

bool same(testing::EnsembleResult const& a, testing::EnsembleResult const& b) {
    return std::memcmp(a.states.data(), b.states.data(), a.states.size() * sizeof(a.states[0])) == 0 &&
           a.records[0].steps_accepted == b.records[0].steps_accepted;
}

TEST(Methods, AutoIsThePairThatItsToleranceAsksFor) {
    auto const is = [](Law law, double tolerance, Method method, bool located = false) {
        return same(flight(Method::automatic, tolerance, law, located), flight(method, tolerance, law, located));
    };
    for (double const tolerance : {1e-4, 1e-5}) EXPECT_TRUE(is(Law::paper, tolerance, Method::bs32)) << tolerance;
    for (double const tolerance : {9e-6, 1e-9}) EXPECT_TRUE(is(Law::paper, tolerance, Method::dopri5)) << tolerance;
    // Where its steps end at changes of the contacts.
    for (double const tolerance : {1e-3, 1e-5, 1e-9}) EXPECT_TRUE(is(Law::conservative, tolerance, Method::dopri5)) << tolerance;
    EXPECT_FALSE(is(Law::conservative, 1e-9, Method::bs32));
    // Or at them.
    EXPECT_TRUE(is(Law::paper, 1e-4, Method::dopri5, true));
    EXPECT_TRUE(is(Law::kelvin_voigt, 1e-4, Method::dopri5));
}

}  // namespace
}  // namespace slideway::kernels_methods_test
