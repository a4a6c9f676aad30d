#include "host/config/outputs.hpp"

#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/config/descriptors.hpp"
#include "host/study/probe.hpp"
#include "kernels/observers/signals.hpp"

namespace slideway::outputs_test {
namespace {

TEST(Outputs, OfTheTreeAreTheTables) {
    for (std::size_t m = 0; m < mechanisms().size(); ++m) {
        Outputs const& outputs = outputs_of(static_cast<Mechanism>(m));
        EXPECT_EQ(outputs.quantities.size(), std::size_t{quantity_count});
        EXPECT_EQ(outputs.series.size(), std::size_t{series_count});
        EXPECT_EQ(outputs.has_quantities, mechanisms()[m].quantities);
        EXPECT_EQ(outputs.columns, std::size_t{quantity_columns});
        for (std::size_t q = 0; q < outputs.quantities.size(); ++q)
            EXPECT_EQ(outputs.quantities[q].place, static_cast<std::size_t>(quantity_column(static_cast<Quantity>(q))));
    }
}

/// A Selection has a bit for each signal and quantity that kernels admit.
TEST(Outputs, OfSignalsFitIntoASelection) {
    EXPECT_EQ(most_signals + series_count, std::numeric_limits<Selection>::digits);
    EXPECT_EQ(most_signal_quantities + quantity_count, std::numeric_limits<Selection>::digits);
    constexpr std::array<Signal, 2> signals{{{"a", "1", "all"}, {"b", "1", "two", statistics_of(Statistic::at_end, Statistic::minimum)}}};
    std::string order;
    for_each_signal_quantity(signals, [&](SignalQuantity const& one) { order += fmt::format("{}{} ", one.signal, static_cast<int>(one.statistic)); });
    auto const word = [](int signal, Statistic statistic) { return fmt::format("{}{} ", signal, static_cast<int>(statistic)); };
    using enum Statistic;
    EXPECT_EQ(order, word(0, maximum) + word(0, minimum) + word(0, mean) + word(0, root_mean_square) + word(0, at_end) + word(1, minimum) + word(1, at_end));
    EXPECT_EQ(signal_quantity_count(signals), 7);
}

std::string objection(char const* name, char const* unit, std::span<Key const> keys = {}) {
    std::array<Signal, 2> const signals{{{name, unit, "of a test"}, {"travel", "m", "way", statistics_of(Statistic::maximum)}}};
    MechanismInfo mechanism = spatial_slider_info();
    mechanism.own_keys = keys;
    mechanism.signals = signals;
    return objection_to_signals(mechanism);
}

TEST(Outputs, OfSignalsHaveNamesThatResultsDoNotHave) {
    static constexpr Key keys[] = {{"mechanism.gauge", &Inputs::mechanism_p, "1", Rule::positive, KeyGroup::mechanism, "gauge", 1}};
    EXPECT_EQ(objection("push", "N m/s2"), "");
    EXPECT_NE(objection("Push", "N").find("its signal \"Push\" has no name"), std::string::npos);
    EXPECT_NE(objection("final_y", "N").find("no final_"), std::string::npos);
    EXPECT_NE(objection("push", "kgf").find("its signal push has the unit \"kgf\""), std::string::npos);
    for (auto const& [name, taken] : {std::pair{"normal_force", "mean_normal_force"}, {"y", "y"}, {"apex_force", "mean_apex_force"}, {"travel", "max_travel"},
                                      {"status", "status"}, {"mechanism_gauge", "mechanism_gauge"}, {"joint_clearance_y", "joint_clearance_y"}})
        EXPECT_EQ(objection(name, "N", keys), fmt::format("results have a {} already, which is of a signal too; give the signal another name", taken));
}

/// Behind them in a table of `probe`, and beside them in its JSON.
TEST(Outputs, OfSignalsHaveNamesThatProbedStatesDoNotHave) {
    for (std::size_t m = 0; m < mechanisms().size(); ++m) {
        StateTable table;
        table.mechanism = static_cast<Mechanism>(m);
        table.has_loads = true;
        for (auto const& [name, value] : result_columns(table, {})) EXPECT_NE(objection(name.c_str(), "N"), "") << name;
    }
    EXPECT_NE(objection("t", "s"), "");
}

}  // namespace
}  // namespace slideway::outputs_test
