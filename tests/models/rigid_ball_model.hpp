#pragma once

#include "kernels/math/trigonometry.hpp"
#include "kernels/rigid/rigid_scales.hpp"
#include "kernels/rigid/rigid_watch.hpp"
#include "tests/models/models.hpp"
#include "tests/models/plain_model.hpp"
#include "tests/models/table_ball_model.hpp"

namespace slideway::inline SLIDEWAY_ISA {

template <class Real> struct RigidBallMemory {
    static constexpr int speeds = 0;
    Real begun, held, jammed;  // 1 after the start, 1 on the table, never
};
template <class Real> SLIDEWAY_FN void start_memory(RigidBallMemory<Real>& memory) {
    memory.begun = memory.held = memory.jammed = Real(0.0);
}

/// Of the four pairs that a quad has the first alone is the ball's.
template <class Real> struct RigidBallContact {
    Quad<Real> watched[1], rate[1];
    Real pressure[2], grip[2];
};
template <class Real> struct RigidBallReport { RigidBallContact<Real> contact; };

/// The ball of TableBallInputs without thrust, by the interface of rigid contacts: impacts in `settle`, and rest on the table where bounces end.
struct RigidBallModel : PlainModel<2> {
    using Inputs = testing::RigidBallInputs;
    static constexpr bool has_contacts = true;
    static constexpr bool is_rigid = true;
    template <class Real> struct Parameters { Real gravity, amplitude, frequency, phase, restitution; };
    template <class Real> using Report = RigidBallReport<Real>;
    template <class Real> using Memory = RigidBallMemory<Real>;
    template <class Real> using Watch = RigidWatch<Real>;
    template <class Real> using Observer = TableBallObserver<Real>;

    template <bool Full, class Real>
    SLIDEWAY_FN static Faults<Real> derivative(Real t, Real const* s, Parameters<Real> const& p,
                                               Memory<Real> const& memory, Real* rates, Report<Real>* report) {
        Real const zero(0.0), one(1.0), far(-1.0);
        auto const held = memory.held > zero;
        Real const pressing = pressing_at(t, p);
        rates[0] = s[1];
        rates[1] = select(held, zero, negated(pressing));
        if constexpr (Full) {
            report->contact.watched[0] = {select(held, far, negated(s[0])), far, far, far};
            report->contact.rate[0] = {negated(s[1]), zero, zero, zero};
            report->contact.pressure[0] = select(held, pressing / p.gravity, one);
            report->contact.pressure[1] = report->contact.grip[0] = report->contact.grip[1] = one;
        }
        return Faults<Real>::none();
    }

    template <class Real>
    SLIDEWAY_FN static Mask<Real> settle(Mask<Real> in, Real t, Real, Real* s, Parameters<Real> const& p,
                                         Memory<Real>& memory, RigidBallContact<Real> const& contact) {
        Real const zero(0.0), one(1.0);
        Mask<Real> const fresh = in & (memory.begun == zero);
        memory.begun = select(in, one, memory.begun);
        Mask<Real> const meets = in & (contact.watched[0].a > Real(-depth)) & ((contact.rate[0].a > zero) | fresh);
        Mask<Real> const opens = in & (contact.pressure[0] < zero), held = in & (memory.held > zero) & !opens;
        Real const speed = select(meets, negated(p.restitution) * min(s[1], zero), s[1]);
        Real const braking = pressing_at(t, p) * (one - p.restitution);
        Mask<Real> const rests = held | (meets & (braking > zero) & (speed + speed <= Real(chatter_time) * braking));
        memory.held = select(meets | opens | held, count<Real>(rests), memory.held);
        s[0] = select(meets | held, zero, s[0]);
        s[1] = select(rests, zero, speed);
        return meets | opens | held;
    }

    static constexpr double depth = 1e-13;
    template <class Real> SLIDEWAY_FN static Real located(Parameters<Real> const&, Real) { return Real(depth); }
    SLIDEWAY_HD static Watching watching(bool, bool) { return Watching::touches; }
    SLIDEWAY_HD static bool switches() { return false; }

    static Parameters<double> parameters(Inputs const& in) {
        return {in.gravity, in.amplitude, in.frequency, in.phase, in.restitution};
    }
    static void initial_state(Inputs const& in, double* s) { s[0] = in.height, s[1] = in.speed; }

private:
    /// Acceleration of the table against a ball that falls.
    template <class Real> SLIDEWAY_FN static Real pressing_at(Real t, Parameters<Real> const& p) {
        return fnma(p.amplitude, sincos(fma(p.frequency, t, p.phase)).cos, p.gravity);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
