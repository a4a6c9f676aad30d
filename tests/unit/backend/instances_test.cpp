// Which combinations of parts there are kernels for.
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "kernels/mechanisms/list.hpp"
#include "kernels/rigid/rigid_info.hpp"
#include "tests/support/varied_blocks.hpp"

namespace slideway::instances_test {
namespace {

TEST(Instances, AreThereForEveryDampingThatALawHas) {
    for (Isa const isa : testing::supported_isas()) {
        int refused = 0;
        for (std::size_t i = 0; i < mechanisms().size(); ++i) {
            if (!mechanisms()[i].spatial) continue;
            for (Law const law : testing::every_law()) {
                for (Damping const damping : {Damping::point, Damping::rate, Damping::restitution}) {
                    Parts const parts{law, damping, true, false, static_cast<Mechanism>(i)};
                    SCOPED_TRACE(testing::name_of(parts));
                    if (info(law).has(damping)) {
                        EXPECT_NE(find_instance(isa, parts).kernels, nullptr);
                    } else {
                        EXPECT_THROW(find_instance(isa, parts), std::invalid_argument);
                        ++refused;
                    }
                }
            }
        }
        EXPECT_GT(refused, 0);
    }
}

TEST(Instances, OfRigidContactsHaveShadowsWhereThereAreExponents) {
    for (std::size_t i = 0; i < mechanisms().size(); ++i) {
        auto const mechanism = static_cast<Mechanism>(i);
        SCOPED_TRACE(mechanisms()[i].name);
        ASSERT_TRUE(may_be_rigid(mechanism));
        Parts const parts{.damping = Damping::restitution, .mechanism = mechanism, .rigid = true};
        for (Isa const isa : testing::supported_isas()) {
            EXPECT_NE(find_instance(isa, parts).kernels->run, nullptr);
            if (mechanisms()[i].has_exponents && mechanisms()[i].driven_form == nullptr) {
                EXPECT_NE(find_instance(isa, parts, true).kernels->run_shadowed, nullptr);
            }
        }
    }
}

TEST(Instances, OfCornersKnowEveryDampingOfPoints) {
    for (Damping const damping : {Damping::point, Damping::restitution}) {
        Parts const parts{.damping = damping, .mechanism = Mechanism::planar_slider_crank};
        EXPECT_NE(find_instance(best_isa(), parts).kernels, nullptr);
    }
}

}  // namespace
}  // namespace slideway::instances_test
