#include "tests/parity/choice_fixture.hpp"

namespace slideway {
namespace {

TEST(SliderCrankChoice, CallsEachOfTheConservativeSteadyCranks) {
    testing::expect_one_model_for_each(testing::steady_choices<ConservativeLaw>(Law::conservative), 8);
}

}  // namespace
}  // namespace slideway
