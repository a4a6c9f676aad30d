#pragma once

#include "kernels/math/exponential.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/load_path.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The path (M13.14), followed by the length of its arc in the motion and in τ = ln ν, so that it may turn back in ν: rates and slips are shifted so
/// that equal loads without friction are on it at the start, by shifts that vanish as ν does.  Points are predicted along the tangent and corrected across
/// it (Allgower & Georg 1990, Numerical Continuation Methods).
template <class Real> class ArcPath : LoadPath<Real> {
    using Base = LoadPath<Real>;
    using Base::count_, Base::course_, Base::goal_, Base::local_, Base::rows_, Base::slack_;

public:
    using Base::Base;

    /// As of LongSteps.  A turn solves one system for every lane: a lane whose point is on the path predicts the next one, the others' points are corrected,
    /// or go back to where their step began, for a shorter one.
    SLIDEWAY_NOINLINE Mask<Real> solve(Mask<Real> in, Twist<Real>& after) {
        begin(in);
        auto open = in;
        auto on_path = in;  // lanes whose point is on the path, to go on from; the others' is being corrected
        for (int turn = 0; turn < most_turns && any(in); ++turn) {
            auto const sound = look(in);
            auto const lost = in & ((!sound) | ((!on_path) & (corrections_ >= Real(most_corrections))));
            on_path = on_path & in & !lost;
            this->factor(local_);
            solve_for(wanted_, true);
            solve_for(along_tau_, false);
            go_back(lost);
            auto const corrects = in & (!on_path) & !lost;
            auto const arrives = correct(corrects);
            predict(on_path);
            lengthen(arrives);
            on_path = arrives;
            auto const due = arrives & (tau_ <= polished_ - Real(between_polishes));
            polished_ = select(due, tau_, polished_);
            if (any(due)) {
                this->note(due, this->measure(due, this->moved()));
                auto const solved = due & !this->polish(due, after);
                open = open & !solved;
            }
            in = in & open & !(tau_ <= Real(last)) & (length_ > Real(shortest));
            on_path = on_path & in;
        }
        return this->take_nearest(open, after);
    }

private:
    static constexpr int most_turns = 1000;
    static constexpr double most_corrections = 5, few = 2, many = 4;  // of a step; for a longer and a shorter next one
    static constexpr double near = 0.1;  // a correction, of s and of the width of the friction, after which a point is on the path
    static constexpr double first_length = 1.5, longest = 3, shortest = 1e-6;  // of a step, in units of the motion's scale and of τ
    static constexpr double between_polishes = 4, last = -60;                  // in τ

    /// A change of the loads, and what it makes of the motion.
    struct Change { Real load[3], rate, slip[2]; };

    SLIDEWAY_HD void begin(Mask<Real> in) {
        Real const zero(0.0), scale = this->largest_slip(goal_.size), part = scale / this->number_of_pairs();
        this->push_equally(in, part);
        this->measure(in, this->moved());
        for (int k = 0; k < count_; ++k) {
            auto const& c = course_[k];
            shift_[0][k] = scale - (c.rate - rows_[k].target);
            for (int j = 0; j < 2; ++j) shift_[1 + j][k] = this->friction_ ? negated(c.v[j]) : zero;
            ahead_[k] = {{zero, zero, zero}, zero, {zero, zero}};
        }
        first_ = part * scale;
        per_scale_ = Real(1.0) / scale;
        tau_ = polished_ = corrections_ = start_ = zero;
        ahead_tau_ = Real(-1.0);
        length_ = Real(first_length);
    }

    /// The loads that the motion of the moment asks for, and how they change with it.  @return lanes whose point may be one of the path's
    SLIDEWAY_HD Mask<Real> look(Mask<Real> in) {
        Real const zero(0.0), one(1.0), left = exp(tau_);
        auto const motion = this->moved();
        Real const missed = this->measure(in, motion);
        auto sound = mask_of<Real>(true);
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            auto const& c = course_[k];
            auto& l = local_[k];
            Real const s = fma(shift_[0][k], left, c.rate - row.target);
            sound = sound & ((s > zero) | !row.here);
            slack_[k] = select(row.here & (s > zero), s, one);
            Real const inverse = one / slack_[k], normal = select(row.here, first_ * left * row.per_own * inverse, zero);
            l.k = normal * inverse;
            wanted_[k].load[0] = normal;
            along_tau_[k].load[0] = normal * fnma(shift_[0][k] * left, inverse, one);
            if (!this->friction_) continue;
            Real v[2], along[2];
            for (int j = 0; j < 2; ++j) v[j] = fma(shift_[1 + j][k], left, c.v[j]);
            Real const width = slack_[k] / select(row.coefficient > zero, row.coefficient, one);
            Real const drag = row.coefficient * normal / sqrt(fma(v[0], v[0], fma(v[1], v[1], width * width)));
            for (int j = 0; j < 2; ++j) along[j] = negated(drag * v[j]);
            Real const narrows = this->put_cone(k, v, slack_[k], normal, along, l);
            widths_[k] = width;
            for (int i = 0; i < 2; ++i) {
                wanted_[k].load[1 + i] = along[i];
                Real const shifted = fma(l.K[i][0], shift_[1][k], l.K[i][1] * shift_[2][k]) * left;
                along_tau_[k].load[1 + i] = negated(fma(along[i], narrows, shifted));
            }
        }
        return sound & (missed == missed);
    }

    /// Changes that lead to loads, those which are asked for or those by a unit of τ, in whose place they come.
    SLIDEWAY_HD void solve_for(Change (&change)[pair_count], bool asked) {
        for (int k = 0; k < count_; ++k) {
            auto& l = local_[k];
            auto const& row = rows_[k];
            auto const& load = change[k].load;
            l.c_n = asked ? load[0] - row.normal : load[0];
            if (!this->friction_) continue;
            for (int i = 0; i < 2; ++i) l.c_t[i] = asked ? fnma(l.h[i], l.c_n, load[1 + i] - row.along[i]) : load[1 + i];
        }
        this->step(local_);
        for (int k = 0; k < count_; ++k) {
            auto const& c = course_[k];
            auto const here = rows_[k].here;
            Real const by = Base::push(local_[k], c), zero(0.0);
            change[k].load[0] = select(here, by, zero);
            change[k].rate = select(here, c.d_rate, zero);
            auto const holds = here & (rows_[k].coefficient > zero);
            for (int i = 0; i < 2; ++i) {
                change[k].load[1 + i] = this->friction_ ? select(holds, Base::drag(local_[k], c, by, i), zero) : zero;
                change[k].slip[i] = this->friction_ ? select(holds, c.d_slip[i], zero) : zero;
            }
        }
    }

    /// Of two changes, as motion.
    SLIDEWAY_HD Real product(Change const (&a)[pair_count], Change const (&b)[pair_count]) const {
        Real sum(0.0);
        for (int k = 0; k < count_; ++k) sum = fma(a[k].rate, b[k].rate, fma(a[k].slip[0], b[k].slip[0], fma(a[k].slip[1], b[k].slip[1], sum)));
        return sum * per_scale_ * per_scale_;
    }
    SLIDEWAY_HD void add(Mask<Real> in, Real share, Change const (&change)[pair_count]) {
        for (int k = 0; k < count_; ++k) {
            auto& row = rows_[k];
            row.normal = select(in, fma(share, change[k].load[0], row.normal), row.normal);
            for (int i = 0; i < 2; ++i) row.along[i] = select(in, fma(share, change[k].load[1 + i], row.along[i]), row.along[i]);
        }
    }

    /// Across the tangent, onto the path.  @return lanes whose point is on it
    SLIDEWAY_HD Mask<Real> correct(Mask<Real> in) {
        if (none(in)) return in;
        Real const by = negated(product(ahead_, wanted_)) / (product(ahead_, along_tau_) + ahead_tau_), left = exp(tau_);
        Real off = abs(by) + (by - by);
        for (int k = 0; k < count_; ++k) {
            auto const& row = rows_[k];
            auto const relative = [&](Mask<Real> counts, Real change, Real width) { off = max(off, select(counts, abs(change) / width, Real(0.0))); };
            relative(row.here, fma(by, fma(shift_[0][k], left, along_tau_[k].rate), wanted_[k].rate), slack_[k]);
            if (!this->friction_) continue;
            auto const holds = row.here & (row.coefficient > Real(0.0));
            for (int i = 0; i < 2; ++i) relative(holds, fma(by, fma(shift_[1 + i][k], left, along_tau_[k].slip[i]), wanted_[k].slip[i]), widths_[k]);
        }
        add(in, Real(1.0), wanted_);
        add(in, by, along_tau_);
        tau_ = select(in, tau_ + by, tau_);
        corrections_ = select(in, corrections_ + Real(1.0), corrections_);
        return in & (off <= Real(near));
    }

    /// Along the tangent, onwards.
    SLIDEWAY_HD void predict(Mask<Real> in) {
        if (none(in)) return;
        Real const one(1.0), size = one / sqrt(product(along_tau_, along_tau_) + one);
        auto const turns = product(ahead_, along_tau_) + ahead_tau_ < Real(0.0);
        Real const scale = select(turns, negated(size), size);
        add(in, one, wanted_);
        this->keep_loads(kept_, in);
        start_ = select(in, tau_, start_);
        for (int k = 0; k < count_; ++k) {
            auto& a = ahead_[k];
            auto const& b = along_tau_[k];
            for (int i = 0; i < 3; ++i) a.load[i] = select(in, scale * b.load[i], a.load[i]);
            a.rate = select(in, scale * b.rate, a.rate);
            for (int i = 0; i < 2; ++i) a.slip[i] = select(in, scale * b.slip[i], a.slip[i]);
        }
        ahead_tau_ = select(in, scale, ahead_tau_);
        set_off(in);
    }
    SLIDEWAY_HD void set_off(Mask<Real> in) {
        add(in, length_, ahead_);
        tau_ = select(in, fma(length_, ahead_tau_, start_), tau_);
        corrections_ = select(in, Real(0.0), corrections_);
    }
    /// Where corrections do not lead back to the path: a shorter step from where the last one began.
    SLIDEWAY_HD void go_back(Mask<Real> in) {
        if (none(in)) return;
        this->put_loads(in, kept_);
        length_ = select(in, Real(0.4) * length_, length_);
        set_off(in);
    }
    SLIDEWAY_HD void lengthen(Mask<Real> in) {
        Real const by = select(corrections_ <= Real(few), Real(1.7), select(corrections_ >= Real(many), Real(0.7), Real(1.0)));
        length_ = select(in, min(by * length_, Real(longest)), length_);
    }

    Real first_, per_scale_;             // ν at the start, 1/(scale of the motion)
    Real shift_[3][pair_count];          // of s and the slips, at the start
    Real tau_, start_, polished_;        // ln ν/ν₀: of the moment, where the step began, at the last polish
    Real length_, corrections_;          // of the step along the arc; how often it was corrected
    Real ahead_tau_;                     // the tangent
    Change ahead_[pair_count], along_tau_[pair_count];  // along the tangent by a unit of the arc, and of τ
    Change wanted_[pair_count];                          // the loads that the motion asks for, then what leads to them
    Real widths_[pair_count];                            // s/μ
    Real kept_[3][pair_count] = {};                      // loads where the step began
};

}  // namespace slideway::inline SLIDEWAY_ISA
