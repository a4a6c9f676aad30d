#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Time and what it has rounded off.  After 1e5 s the last bit of a time is 1.5e-11 s; impacts want steps below it.  Neighbour trajectories meet an
/// event at times that differ by less than any last bit.
template <class Real> class FineTime {
public:
    /// @param end time [s]  @param always whatever the end
    SLIDEWAY_HD FineTime(Real end, bool always) : end_(end), kept_(always ? mask_of<Real>(true) : Mask<Real>(end > Real(kept_from))) {}

    /// Least step that moves time [s].
    SLIDEWAY_HD Real resolution() const { return select(kept_, Real(kept_resolution), Real(resolution_of_double)) * end_; }

    /// t + step (Knuth's two-sum); what it rounds off waits for the next step.  A landing starts a new count.
    /// @param rest what t had rounded off before, and then what the sum has
    SLIDEWAY_HD Real after(Real t, Real step, Real& rest, Mask<Real> accepted, Mask<Real> landed) const {
        Real const whole = step + rest, sum = t + whole;
        Real const of_step = sum - t;
        Real const off = (t - (sum - of_step)) + (whole - of_step);
        rest = select(accepted & kept_, select(landed, Real(0.0), off), rest);
        return sum;
    }

private:
    static constexpr double kept_from = 100.0;  // [s]: up to there a double resolves 2e-13 s
    static constexpr double resolution_of_double = 8 * 2.220446049250313e-16, kept_resolution = 1e-19;

    Real end_;
    Mask<Real> kept_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
