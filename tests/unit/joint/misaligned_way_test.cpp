// Corners of the state space that random states do not reach, seen through the probe.
#include <gtest/gtest.h>

#include <cmath>

#include "host/backend/backend.hpp"
#include "kernels/laws/list.hpp"
#include "tests/oracle/oracle.hpp"

namespace slideway::misaligned_way_test {
namespace {

TEST(MisalignedWay, GivesThePenetrationsOfASliderUpsideDown) {
    // n − 1 is near −2 there: the form for small tilts would take it for 0.
    for (double const roll : {1.5, 1.7, 3.0, -2.5}) {
        Inputs in;
        in.roll = roll;
        in.pitch = 0.01;
        in.y = 1e-4;
        in.way_roll = 0.02;
        in.way_yaw = -0.01;
        in = oracle::completed(in);
        Parts const parts{Law::conservative, Damping::point, false, true};
        oracle::State const state{in.y, in.z, in.vy, in.vz, in.roll, in.yaw, in.pitch, in.wx, in.wy, in.wz};
        auto const expected = oracle::penetrations(in, parts, 0.0, state);
        for (Isa const isa : all_isas()) {
            if (!is_supported(isa)) continue;
            double const t = 0;
            ProbeResult got;
            find_instance(isa, parts).probe({&in, &t, 1, &got});
            for (std::size_t i = 0; i < 8; ++i) {
                EXPECT_NEAR(got.penetration_y[i], expected[i], 1e-15) << "roll " << roll << " apex " << i;
                EXPECT_NEAR(got.penetration_z[i], expected[8 + i], 1e-15) << "roll " << roll << " apex " << i;
            }
        }
    }
}

}  // namespace
}  // namespace slideway::misaligned_way_test
