#include "tests/parity/choice_fixture.hpp"

namespace slideway {
namespace {

TEST(SliderCrankChoice, CallsEachOfThePaperImpactCranks) {
    testing::expect_one_model_for_each(testing::impact_choices<PaperLaw>(Law::paper), 4);
}

}  // namespace
}  // namespace slideway
