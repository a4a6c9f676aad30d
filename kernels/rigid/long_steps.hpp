#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/load_path.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The path (M13.14) in long steps beside it, a primal-dual interior-point method: some fifteen of them, whatever the pairs share.
template <class Real> class LongSteps : LoadPath<Real> {
    using Base = LoadPath<Real>;
    using Base::count_, Base::course_, Base::goal_, Base::local_, Base::rows_, Base::slack_;

public:
    using Base::Base;

    /// @param after the motion, changed in lanes that are solved, as the loads are  @return lanes that are not
    SLIDEWAY_NOINLINE Mask<Real> solve(Mask<Real> in, Twist<Real>& after) {
        begin(in);
        auto goes_on = in;
        Real length(1.0);
        for (int step = 0; step < most_steps; ++step) {
            Real const missed = this->measure(in, this->moved()), product = mean_product(in);
            this->note(goes_on, missed);
            goes_on = goes_on & (product > Real(least_product) * first_);
            if (none(goes_on)) break;
            if (step > 0) barrier_ = select(length > Real(0.9), Real(0.05), select(length > Real(0.5), Real(0.3), Real(0.8))) * product;
            length = advance(goes_on);
        }
        return this->take_nearest(this->polish(in, after), after);
    }

private:
    static constexpr int most_steps = 30;
    // ν falls to a twentieth of the mean after a long step, and by less after a short one.
    static constexpr double least_product = 1e-15;  // of Λ s at the start: below it rounding is all that moves

    SLIDEWAY_HD void begin(Mask<Real> in) {
        Real const size = goal_.size, part = size / this->number_of_pairs();
        this->push_equally(in, part);
        auto const after = this->moved();
        for (int k = 0; k < count_; ++k) slack_[k] = max(dot(rows_[k].pair.normal, after) - rows_[k].target, size);
        first_ = part * size;
        barrier_ = Real(0.3) * first_;
    }

    /// The mean of own Λ s, motion squared.
    SLIDEWAY_HD Real mean_product(Mask<Real> in) const {
        Real sum(0.0);
        for (int k = 0; k < count_; ++k) sum = sum + select(in & rows_[k].here, rows_[k].own * rows_[k].normal * slack_[k], Real(0.0));
        return sum / this->number_of_pairs();
    }

    SLIDEWAY_HD void linearise(int k) {
        Real const zero(0.0), one(1.0);
        auto const& row = rows_[k];
        auto const& c = course_[k];
        auto& l = local_[k];
        Real const inverse = one / select(row.here, slack_[k], one);
        l.k = select(row.here, row.normal * inverse, zero);
        Real const wanted = fms(barrier_ * row.per_own, inverse, row.normal);
        l.c_n = select(row.here, fnma(l.k, (c.rate - row.target) - slack_[k], wanted), zero);
        if (!this->friction_) return;
        Real const narrows = this->put_cone(k, c.v, slack_[k], row.normal, row.along, l);
        // The width follows s, which here is a number of its own: of dΛ it follows what is beyond the change that ν asks for.
        for (int i = 0; i < 2; ++i) {
            Real const by_width = row.along[i] * narrows, slips = fms(l.h[i], row.normal, by_width);
            l.c_t[i] = select(row.here, fnma(by_width, wanted / select(row.here, row.normal, one), slips - row.along[i]), zero);
        }
    }

    /// @return the share of a step of Newton's method that keeps Λ and s above zero, which is taken
    SLIDEWAY_HD Real advance(Mask<Real> in) {
        Real const zero(0.0), one(1.0);
        for (int k = 0; k < count_; ++k) linearise(k);
        this->factor(local_);
        this->step(local_);
        Real length = one;
        auto const keep_positive = [&](Mask<Real> here, Real value, Real by) {
            auto const falls = here & (by < zero);
            length = min(length, select(falls, Real(0.95) * value / select(falls, negated(by), one), one));
        };
        // What a step makes of s.
        auto const widening = [&](int k) { return course_[k].d_rate + ((course_[k].rate - rows_[k].target) - slack_[k]); };
        for (int k = 0; k < count_; ++k) {
            keep_positive(rows_[k].here, rows_[k].normal, Base::push(local_[k], course_[k]));
            keep_positive(rows_[k].here, slack_[k], widening(k));
        }
        for (int k = 0; k < count_; ++k) {
            slack_[k] = select(in & rows_[k].here, fma(length, widening(k), slack_[k]), slack_[k]);
            this->add_step(in, k, local_[k], length);
        }
        return length;
    }

    Real barrier_, first_;  // ν, and its start
};

}  // namespace slideway::inline SLIDEWAY_ISA
