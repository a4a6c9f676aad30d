// What the random cases of all mechanisms are made of: draws of plain numbers, parts and parameters.
#pragma once

#include <cmath>
#include <cstdint>
#include <kernels/inputs.hpp>
#include <random>

namespace oracle::detail {

class Dice {
public:
    explicit Dice(std::uint64_t seed) : bits_(seed) {}

    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53;
    }
    double scale(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
    double signed_scale(double low, double high) {
        double const size = scale(low, high);
        return chance(0.5) ? size : -size;
    }
    bool chance(double probability) { return uniform(0, 1) < probability; }
    int below(int count) { return static_cast<int>(bits_() % static_cast<std::uint64_t>(count)); }

private:
    std::mt19937_64 bits_;
};

/// Of a spatial mechanism: the 2 laws of model.md 4 x friction x way pose x 3 dampings.
slideway::Parts parts_number(int i, slideway::Mechanism mechanism);

void vary_mechanism(Dice& dice, slideway::Inputs& in);
void vary_contact(Dice& dice, slideway::Inputs& in);

/// Gives the case a law, the numbers that the law has of its own, and of the dampings one that it takes.
void set_law(Dice& dice, slideway::Law law, slideway::Parts& parts, slideway::Inputs& in);

/// Every parameter half of the time; else the paper's values but for those that a part brings along.  Completed.
slideway::Inputs any_inputs(Dice& dice, slideway::Parts const& parts);

}  // namespace oracle::detail
