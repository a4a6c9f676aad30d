// Functions in cubic pieces, of which loads are read.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "kernels/loads/table_value.hpp"
#include "tests/support/load_table.hpp"

namespace slideway::table_value_test {
namespace {

using testing::Pieces;

double cubic(double x) { return 2 + x * (3 + x * (-1 + 0.5 * x)); }
double slope(double x) { return 3 + x * (-2 + 1.5 * x); }

/// The cubic above, cut at places of very different distances.
std::vector<PieceTable::Piece> cut_cubic() {
    std::vector<PieceTable::Piece> pieces;
    for (double const x : {-1.0, -0.999, -0.5, 0.0, 1e-6, 0.3, 1.7}) pieces.push_back({x, cubic(x), slope(x), -1 + 1.5 * x, 0.5});
    return pieces;
}

TEST(TablePoint, IsOneCubicWhateverItsPieces) {
    for (int const cells : {1, 7, 100}) {
        Pieces const pieces(cut_cubic(), 2, false, cells);
        for (int i = 0; i <= 3000; ++i) {
            double const x = -1 + i * 1e-3;
            auto const point = table_point(pieces.table(), x);
            ASSERT_NEAR(point.value, cubic(x), 1e-14) << x << " of " << cells;
            ASSERT_NEAR(point.slope, slope(x), 2e-14) << x << " of " << cells;
        }
    }
}

TEST(TablePoint, StaysAtItsEndsOrRepeats) {
    Pieces const once(cut_cubic(), 2);
    for (double const far : {2.1, 1e9}) {
        EXPECT_NEAR(table_point(once.table(), far).value, cubic(2), 1e-14);
        EXPECT_EQ(table_point(once.table(), far).slope, 0);
    }
    EXPECT_EQ(table_point(once.table(), -5.0).value, cubic(-1));
    Pieces const ever(cut_cubic(), 2, true);
    for (int const turns : {-4, -1, 1, 1000}) {
        for (double const x : {-1.0, -0.2, 0.3, 1.9999}) EXPECT_NEAR(table_point(ever.table(), x + 3 * turns).value, cubic(x), 1e-11) << turns;
    }
}

TEST(TablePoint, OfAPlaceWithoutAPhaseIsWithinTheTable) {
    Pieces const ever(cut_cubic(), 2, true);
    for (double const far : {1e30, -1e30, 1.7e308, -1.7e308}) EXPECT_LE(std::abs(table_point(ever.table(), far).value), cubic(2)) << far;
}

TEST(TablePoint, OfNoNumberIsNone) {
    Pieces const pieces(cut_cubic(), 2);
    for (double const none : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        EXPECT_TRUE(std::isnan(table_point(pieces.table(), none).value));
    }
}

TEST(TableValue, HasASlopeAlongItsArgument) {
    Pieces const pieces(cut_cubic(), 2);
    auto const at = table_value(pieces.table(), Tangent<double>(0.7, 4.0));
    EXPECT_NEAR(at.value, cubic(0.7), 1e-14);
    EXPECT_NEAR(at.slope, 4 * slope(0.7), 1e-13);
}

}  // namespace
}  // namespace slideway::table_value_test
