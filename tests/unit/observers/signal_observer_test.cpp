// Quantities of a mechanism's signals against sums by hand.
#include "kernels/observers/signal_observer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "kernels/mechanisms/mechanism_info.hpp"
#include "kernels/observers/slider_observer.hpp"

namespace slideway::signal_observer_test {
namespace {

struct Seen {
    static constexpr Signal signals[] = {{"a", "1", "has all statistics"}, {"b", "1", "has one", statistics_of(Statistic::mean)}};
    static constexpr MechanismInfo info = [] {
        auto info = spatial_slider_info();
        info.signals = signals;
        return info;
    }();
};
using Plain = SliderObserver<double>;
using Observer = SignalObserver<double, Plain, OwnSignals<Seen>>;
enum Column { max_a, min_a, mean_a, rms_a, final_a, mean_b };

constexpr Selection bit(int column) { return Selection{1} << (quantity_count + column); }

Observer::Report report(double a, double b) {
    Observer::Report r{};
    r.signal[0] = a, r.signal[1] = b;
    return r;
}

TEST(SignalObserver, SumsUpWhatStepsAccept) {
    constexpr double state[10] = {};
    Observer watched{};
    watched.start(true, report(2, 10), state, false);
    auto const step = [&](bool accepted, double h, std::array<double, 3> const& means, double a) {
        std::array<double, Observer::integrals> all{};
        std::copy(means.begin(), means.end(), all.begin() + Plain::integrals);
        watched.accept(accepted, h, all.data(), report(a, 0), state, false);
    };
    step(true, 0.5, {-1, 4, 20}, -3);
    step(false, 7, {100, 100, 100}, 1000);
    step(true, 1.5, {2, 6, 4}, 1);
    std::array<double, Observer::columns> row;
    row.fill(-1);
    constexpr Selection asked = bit(max_a) | bit(min_a) | bit(mean_a) | bit(rms_a) | bit(mean_b);
    watched.finish(0, 2, asked, row.data());
    double const* const own = &row[Plain::columns];
    EXPECT_EQ(own[max_a], 2);
    EXPECT_EQ(own[min_a], -3);
    EXPECT_EQ(own[mean_a], 1.25);
    EXPECT_EQ(own[rms_a], std::sqrt(5.5));
    EXPECT_EQ(own[mean_b], 8);
    EXPECT_EQ(own[final_a], -1) << "it is not asked for";
    watched.finish(0, 2, bit(final_a), row.data());
    EXPECT_EQ(own[final_a], 1);
    EXPECT_EQ(row[0], -1) << "nor is what the table has";
    // The next member of the lane.
    watched.start(true, report(-5, 0), state, false);
    watched.finish(0, 0, asked, row.data());
    EXPECT_EQ(own[max_a], -5);
    EXPECT_EQ(own[mean_a], 0);
}

TEST(SignalObserver, IntegratesWhatIsAskedForAtTheStages) {
    std::array<double, Observer::integrals> values{};
    ASSERT_EQ(Observer::integrals, Plain::integrals + 3);
    Observer::integrands(report(-3, 7), values.data());
    double const* const own = &values[Plain::integrals];
    EXPECT_EQ((std::array{own[0], own[1], own[2]}), (std::array<double, 3>{-3, 9, 7}));
    for (int column = max_a; column <= mean_b; ++column) {
        bool const integral = column == mean_a || column == rms_a || column == mean_b;
        EXPECT_EQ(Observer::needs_stages(bit(column)), integral) << column;
        EXPECT_EQ(Observer::integrates_more(bit(column)), integral) << column;
    }
    EXPECT_TRUE(Observer::needs_stages(selection_of(Quantity::mean_normal_force)));
}

TEST(SignalObserver, HasSeriesBehindThoseOfTheTable) {
    Observer::Report r = report(3, 4);
    r.x = 5;
    EXPECT_EQ(r.series_value(series_count), 3);
    EXPECT_EQ(r.series_value(series_count + 1), 4);
    EXPECT_EQ(r.series_value(static_cast<int>(Series::x)), 5);
}

}  // namespace
}  // namespace slideway::signal_observer_test
