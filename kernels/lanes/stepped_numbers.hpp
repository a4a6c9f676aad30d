#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What an explicit pair makes of a few numbers in one step, and what they are inside of it: by the pair's own continuous extension of order 4,
/// or, where the slope in the middle of the step has been evaluated, by one of order 5.  The extension of order 4 must be right to order 5 in
/// the middle: what its error is of order 5, it is then by θ²(1 − θ)²(θ − ½) times a number, and the slope in the middle tells the number.
template <class Pair, int count, class Real> struct SteppedNumbers {
    static constexpr int stages = Pair::stages;
    Real start[count], end[count];
    Real k[stages][count];  // slopes at the stages, the first and the last at both ends

    /// For a step that was made anew.
    SLIDEWAY_FN void forget_middle() { knows_middle_ = false; }

    /// Takes the slope in the middle, once for a step, in the lanes of the mask.
    SLIDEWAY_FN void set_middle(Mask<Real> lanes, int i, Real step, Real slope) {
        // Of the cubic through both ends the slope in the middle is 1½ times the change less a quarter of the ends' slopes; θ²(1 − θ)² bends it
        // by nothing there, and θ²(1 − θ)²(θ − ½) has the slope 1/16.
        Real const change = end[i] - start[i];
        Real const cubic = fms(Real(1.5), change, Real(0.25) * (step * (k[0][i] + k[stages - 1][i])));
        lack_[i] = select(lanes, Real(16.0) * fms(step, slope, cubic), Real(0.0));
        knows_middle_ = true;
    }

    /// One number at fraction θ of the step.
    SLIDEWAY_FN Real at(int i, Real step, Real theta) const {
        Real const both = theta * (Real(1.0) - theta);
        Real const bump = both * both * (theta - Real(0.5));
        return fma(bump, knows_middle_ ? lack_[i] : Real(0.0), Pair::dense(k, i, start[i], end[i], step, theta));
    }

private:
    Real lack_[count];  // of the extension of order 4, 0 in lanes where nobody knows it
    bool knows_middle_ = false;
};

}  // namespace slideway::inline SLIDEWAY_ISA
