// A card whose kernels contract a·b + c: close to the processor before trajectories part, and of its distributions after.
#include "kernels/laws/list.hpp"
#include "tests/cuda/card.hpp"
#include "tests/cuda/closeness.hpp"

namespace slideway::card_closeness_test {
namespace {

using testing::OwnedBlock;

class CardCloseness : public testing::Card {};

TEST_F(CardCloseness, BeforeTrajectoriesPart) {
    for (Law const law : {Law::paper, Law::conservative}) {
        OwnedBlock here(testing::touching_block(law)), there(here.plan());
        run_on_processor(here);
        run(there);
        testing::expect_close(here, there);
    }
}

TEST_F(CardCloseness, InDistributionAfter) {
    for (Law const law : {Law::paper, Law::conservative}) {
        OwnedBlock here(testing::parted_block(law)), there(here.plan());
        run_on_processor(here);
        run(there);
        testing::expect_one_distribution(here, there, !has_bits_of_the_processor());
    }
}

}  // namespace
}  // namespace slideway::card_closeness_test
