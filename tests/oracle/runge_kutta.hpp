// The classical method of order four.
#pragma once

#include <cstddef>

namespace oracle::detail {

/// @param rates of a state, which is an array of numbers
template <class State, class Real, class Rates> State runge_kutta(State const& start, Real h, Rates const& rates) {
    auto const moved = [&start](Real by, State const& slope) {
        State state = start;
        for (std::size_t i = 0; i < state.size(); ++i) state[i] += by * slope[i];
        return state;
    };
    State const k1 = rates(start), k2 = rates(moved(h / 2, k1)), k3 = rates(moved(h / 2, k2)), k4 = rates(moved(h, k3));
    State mean = k1;
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]) / 6;
    return moved(h, mean);
}

}  // namespace oracle::detail
