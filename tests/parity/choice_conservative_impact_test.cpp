#include "tests/parity/choice_fixture.hpp"

namespace slideway {
namespace {

TEST(SliderCrankChoice, CallsEachOfTheConservativeImpactCranks) {
    testing::expect_one_model_for_each(testing::impact_choices<ConservativeLaw>(Law::conservative), 4);
}

}  // namespace
}  // namespace slideway
