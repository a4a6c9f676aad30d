#pragma once

#include "kernels/real.hpp"
#include "kernels/steppers/explicit_pair.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Coefficients of the pair below.
struct Verner65Tableau {
    double c[9] = {0, 0.06, 1439.0 / 15000, 0.1439, 0.4973, 0.9725, 0.9995, 1, 1};
    double a[9][8] = {
        {},
        {0.06},
        {0.01923996296296296, 0.07669337037037037},
        {0.035975, 0, 0.107925},
        {1.318683415233148, 0, -5.042058063628562, 4.220674648395414},
        {-41.872591664327516, 0, 159.43256216313748, -122.11921356501003, 5.531743066200054},
        {-54.430156935316504, 0, 207.06725136501847, -158.6108137845899, 6.991816585950242, -0.018597231062203234},
        {-54.66374178728198, 0, 207.95280625538936, -159.2889574744995, 7.018743740796944, -0.018338785905045722,
         -0.0005119484997882099},
        {0.034389578683570357, 0, 0, 0.2582624555633503, 0.4209371189673537, 4.40539646966931, -176.48311902429866,
         172.36413340141507},
    };
    double b[9] = {0.034389578683570357, 0, 0, 0.2582624555633503, 0.4209371189673537, 4.40539646966931,
                   -176.48311902429866, 172.36413340141507, 0};
    // b minus the weights of the fifth order.
    double e[9] = {-0.014710097800254537, 0, 0, 0.033151232611697925, -0.04853110633560249, 3.5988172446704234,
                   -176.48311902429866, 172.97125289059287, -0.056861139440475692};
    // What θ²(1 − θ)² adds to the cubic through both ends, so that the extension has order 4, and order 5 in the middle of the step; of those
    // that have, the one with the least conditions of order 6 left there (SteppedNumbers makes it one of order 5 all over).
    double d[9] = {-1.9788620028905581, 0, 0, 2.747086340278509, 0.05156275535524002, -63.741746660090016,
                   2708.1176463495062, -2647.716151695034, 2.5204649128743832};
};

/// Explicit Runge–Kutta pair of order 6(5) with nine stages, the last of which is the first of the next step.  Source: Verner, "Strategies
/// for deriving new explicit Runge–Kutta pairs", Annals of Numerical Mathematics 1 (1994) 225–244, the pair that he calls most efficient.
/// Its continuous extension, of order 4 and without further stages, is ours.
struct Verner65 : ExplicitPair<Verner65Tableau, 9> {
    static constexpr int order = 6;
};

}  // namespace slideway::inline SLIDEWAY_ISA
