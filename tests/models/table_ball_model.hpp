#pragma once

#include "kernels/math/trigonometry.hpp"
#include "kernels/steppers/contact_watch.hpp"
#include "kernels/steppers/cubic_roots.hpp"
#include "tests/models/models.hpp"
#include "tests/models/plain_model.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Speed of the ball's last impact.
template <class Real> struct TableBallMemory {
    static constexpr int speeds = 1;
    Real speed;
};
template <class Real> SLIDEWAY_FN void start_memory(TableBallMemory<Real>& memory) { memory.speed = Real(0.0); }

/// What an impact needs of a state.
template <class Real> struct TableBallContact { Real gap = Real(0.0), rate = Real(0.0), restitution = Real(0.0); };
template <class Real> struct TableBallReport { TableBallContact<Real> contact; };

/// Ends steps where the ball meets the table, and throws it back there.
template <class Real> class TableBallWatch {
public:
    static constexpr double tolerance(Watching) { return 1e-12; }  // of a ball without shadows
    using Contact = TableBallContact<Real>;
    using Memory = TableBallMemory<Real>;

    SLIDEWAY_HD void keep(Mask<Real> in, Contact const& c) { keep(in, c.gap, c.rate); }
    SLIDEWAY_HD void begin(Mask<Real> fresh, Contact const& c, Memory&, Watching) { keep(fresh, c.gap, c.rate); }

    SLIDEWAY_HD Real earliest(Mask<Real> candidates, Contact const& end, Real step, Real located, Watching) const {
        Real const beyond = Real(0.5) * located;  // aims below the table, so that the ball is there for certain
        Real const reached = select(end.gap < negated(located), end.gap, max(end.gap, Real(0.0)));
        Real const v0 = gap_ + beyond, s0 = step * rate_, v1 = reached + beyond, s1 = step * end.rate;
        auto const crossing = candidates & may_cross(v0, s0, v1, s1);
        if (none(crossing)) return Real(1.0);
        auto const zeros = cubic_zeros(crossing, v0, s0, v1, s1, Direction::falling);
        Real const first = min(zeros.at[0].theta, min(zeros.at[1].theta, zeros.at[2].theta));
        return select(zeros.any, min(first, Real(0.999)), Real(1.0));
    }

    SLIDEWAY_HD static Real start_depth(int) { return Real(1.0); }  // what an impact leaves behind lasts until the next

    SLIDEWAY_HD Mask<Real> update(Mask<Real> accepted, Contact const& end, Memory& memory, Real* y, Watching, Real = Real(0.0), Real* = nullptr) {
        auto const touched = accepted & (end.gap < Real(0.0)) & (end.rate < Real(0.0));
        Real const speed = abs(end.rate);
        memory.speed = select(touched, speed, memory.speed);
        y[0] = select(touched, Real(0.0), y[0]);
        y[1] = select(touched, end.restitution * speed, y[1]);
        keep(accepted, y[0], y[1]);
        return touched;
    }

private:
    SLIDEWAY_HD void keep(Mask<Real> in, Real gap, Real rate) {
        gap_ = select(in, gap, gap_);
        rate_ = select(in, rate, rate_);
    }

    Real gap_, rate_;  // at the start of the step
};

template <class Real> struct TableBallObserver : EventRecorder<Real, 0, 0> {
    template <class Report> SLIDEWAY_FN void switch_over(Mask<Real>, Report const&, bool) {}
};

/// Its impacts are found as touches of the joint are, not as events: shadows know these alone.
struct TableBallModel : PlainModel<2> {
    using Inputs = testing::TableBallInputs;
    static constexpr bool has_contacts = true;
    template <class Real> struct Parameters { Real gravity, amplitude, frequency, phase, restitution, thrust; };
    template <class Real> using Report = TableBallReport<Real>;
    template <class Real> using Memory = TableBallMemory<Real>;
    template <class Real> using Watch = TableBallWatch<Real>;
    template <class Real> using Observer = TableBallObserver<Real>;

    template <bool Full, class Real>
    SLIDEWAY_FN static Faults<Real> derivative(Real t, Real const* s, Parameters<Real> const& p,
                                               Memory<Real> const& memory, Real* rates, Report<Real>* report) {
        rates[0] = s[1];
        rates[1] = fma(p.thrust, memory.speed, fms(p.amplitude, sincos(fma(p.frequency, t, p.phase)).cos, p.gravity));
        if constexpr (Full) report->contact = {s[0], s[1], p.restitution};
        return Faults<Real>::none();
    }

    SLIDEWAY_HD static Watching watching(bool, bool) { return Watching::touches; }
    SLIDEWAY_HD static bool switches() { return false; }
    template <class Real> SLIDEWAY_FN static Real touch_scale(Parameters<Real> const&) { return Real(1.0); }
    template <class Real> SLIDEWAY_FN static Real touch_rounding(Parameters<Real> const&) { return Real(0.0); }
    template <class Real> SLIDEWAY_FN static Real touch_speed(Parameters<Real> const&) { return Real(1e4); }  // closed forms are of the state alone
    template <class Real> SLIDEWAY_HD static Real remembered(Real speed) { return speed; }

    static Parameters<double> parameters(Inputs const& in) {
        return {in.gravity, in.amplitude, in.frequency, in.phase, in.restitution, in.thrust};
    }
    static void initial_state(Inputs const& in, double* s) { s[0] = in.height, s[1] = in.speed; }
};

}  // namespace slideway::inline SLIDEWAY_ISA
