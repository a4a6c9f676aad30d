#include "kernels/steppers/bogacki_shampine.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/steppers/logistic.hpp"

namespace slideway::bogacki_shampine_test {
namespace {

TEST(BogackiShampine, SatisfiesEveryOrderConditionUpToThree) {
    BogackiShampine const w;
    double sum[2][4] = {};  // of b and e: Σ w, Σ w c, Σ w c², Σ w A c
    for (int i = 0; i < 4; ++i) {
        double row = 0, ac = 0;
        for (int j = 0; j < i; ++j) row += w.a[i][j], ac += w.a[i][j] * w.c[j];
        EXPECT_NEAR(row, w.c[i], 1e-15) << i;
        double const tree[4] = {1, w.c[i], w.c[i] * w.c[i], ac};
        for (int k = 0; k < 4; ++k) sum[0][k] += w.b[i] * tree[k], sum[1][k] += w.e[i] * tree[k];
    }
    double const want[4] = {1, 1.0 / 2, 1.0 / 3, 1.0 / 6};
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(sum[0][k], want[k], 1e-15) << k;
    // The embedded method has order 2 and no more, else there would be no estimate.
    EXPECT_NEAR(sum[1][0], 0, 1e-16);
    EXPECT_NEAR(sum[1][1], 0, 1e-16);
    EXPECT_GT(std::abs(sum[1][2]) + std::abs(sum[1][3]), 0.01);
    for (int j = 0; j < 3; ++j) EXPECT_EQ(w.a[3][j], w.b[j]) << "the last stage is the first of the next step";
}

double order(auto const& error) { return std::log2(error(0.02) / error(0.01)); }

TEST(BogackiShampine, HasOrderThreeOnAnOscillator) { EXPECT_NEAR(order(testing::oscillator_error<BogackiShampine>), 3, 0.1); }

TEST(BogackiShampine, EstimatesTheErrorOfItsOrderTwoCompanion) {
    // A local error of order 2 falls with h³.
    EXPECT_NEAR(order([](double h) {
                    testing::Logistic<BogackiShampine> o;
                    o.step(h);
                    return o.estimate(h);
                }),
                3, 0.1);
}

TEST(BogackiShampine, DenseOutputHasOrderThreeInsideTheStepAndMeetsBothEnds) {
    for (double const theta : {0.2, 0.5, 0.9})
        EXPECT_NEAR(order([theta](double h) { return testing::inner_oscillator_error<BogackiShampine>(h, theta); }), 4, 0.2) << theta;
    testing::Oscillator<BogackiShampine> o;
    o.step(0.3);
    testing::expect_dense_meets_ends<BogackiShampine>(o, 0.3, 1e-16);
}

}  // namespace
}  // namespace slideway::bogacki_shampine_test
