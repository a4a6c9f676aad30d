// What a block's conditions take from a law that is known with its damping, whatever parts they are made with.
#include <gtest/gtest.h>

#include "kernels/conditions.hpp"
#include "kernels/laws/conservative.hpp"
#include "kernels/laws/damping.hpp"
#include "kernels/laws/one_law.hpp"

namespace slideway::conditions_test {
namespace {

template <class Damping_> bool remembers(Parts const& parts) {
    return Conditions<OneLaw<ConservativeLaw, Damping_>>({}, ConservativeLaw::info.switches, parts).remembers;
}

TEST(Conditions, RememberImpactsForADampingByRestitutionWhateverTheParts) {
    EXPECT_TRUE(remembers<RestitutionDamping>(Parts{}));
    EXPECT_FALSE(remembers<PointDamping>(Parts{}));
    EXPECT_FALSE(remembers<RateDamping>(Parts{}));
}

TEST(Conditions, RememberImpactsWhereThePartsSayItAndTheLawIsBehindPointers) {
    Parts parts;
    EXPECT_FALSE((Conditions<LawFunctions<double>>({}, false, parts).remembers));
    parts.damping = Damping::restitution;
    EXPECT_TRUE((Conditions<LawFunctions<double>>({}, false, parts).remembers));
}

}  // namespace
}  // namespace slideway::conditions_test
