#include "tests/parity/choice_fixture.hpp"

namespace slideway {
namespace {

TEST(SliderCrankChoice, CallsEachOfThePaperSteadyCranks) {
    testing::expect_one_model_for_each(testing::steady_choices<PaperLaw>(Law::paper), 8);
}

}  // namespace
}  // namespace slideway
