#pragma once

#include <type_traits>

#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/stiffness.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// How `method = "auto"` changes members between the explicit pair and the stiff method (integrators.md).
template <class Model, class Real> struct MethodChoice {
    static constexpr bool has_forces_in_impacts = Model::has_patterns && Model::has_linearisation && !IsRigid<Model>;

    /// Between stints of the explicit pair: who is better off with the stiff method.  @param touching lanes in contact
    SLIDEWAY_HD static void look_for_stiffness(Pack<Model, Real>& pack, Mask<Real> touching) {
        auto& c = pack.state.course;
        auto may_change = touching;
        Real const looks = max(c.stiffness + look_at(pack, touching, may_change), Real(0.0));
        auto const change = pack.busy & may_change & (looks >= Real(Limits::enough));
        c.stiff = select(change, Real(1.0), c.stiff);
        c.stiffness = select(change, Real(0.0), looks);
    }

    /// Lanes whose stiff step brought an apex into contact at speed.  The stiff method would swallow the impact's energy without a
    /// sign: `auto` leaves impacts to the explicit pair.  What counts is how fast the apex approached its face: a slider that glides along
    /// one, with a corner that rattles on it at next to no speed, has no impacts.
    SLIDEWAY_HD static Mask<Real> find_impacts(Pack<Model, Real> const& pack, Attempt<Model, Real> const& to, Mask<Real> accepted)
        requires has_forces_in_impacts
    {
        auto const& s = pack.state;
        // At either end: a slider lifted from rest meets the other face within one long step.
        Real const squared_speed = max(Model::squared_speed(s.course.y, s.constants.scale),
                                       Model::squared_speed(to.end, s.constants.scale));
        auto const moves = squared_speed > Real(Stiffness::creep_below * Stiffness::creep_below);
        if (none(accepted & moves)) return mask_of<Real>(false);
        auto const& p = s.constants.parameters;
        Real const speed = pack.model.approach_speed(s.course.t, s.course.y, to.step, to.end, p);
        return accepted & moves & (speed > Real(Stiffness::impact_above));
    }
    /// Rigid contacts end their steps at impacts, and other models have none.
    SLIDEWAY_HD static Mask<Real> find_impacts(Pack<Model, Real> const&, Attempt<Model, Real> const&, Mask<Real>) { return mask_of<Real>(false); }

    /// Lanes that leave the stiff method: where contact is lost or an impact begins, or steps stay far below what that method is for.
    /// @param stepper that made the step  @param max_step of the explicit pair [s]
    template <class Stepper>
    SLIDEWAY_HD static Mask<Real> leave_stiffness(Pack<Model, Real>& pack, Stepper const& stepper, Real step,
                                                  Mask<Real> accepted, Mask<Real> impact, double max_step) {
        auto& c = pack.state.course;
        Real const rate = sqrt(max(stepper.rate_squared(), Real(0.0)));
        auto const calm = step * rate < Real(Limits::calm_below);
        c.stiffness = select(accepted, select(calm, c.stiffness + Real(1.0), Real(0.0)), c.stiffness);
        auto const free = stepper.touching() < Real(0.5);
        Mask<Real> const leaving = pack.busy & (free | impact | (c.stiffness >= Real(Limits::calm_steps)));
        if (none(leaving)) return leaving;
        c.stiffness = select(leaving, Real(0.0), c.stiffness);
        c.stiff = select(leaving, Real(0.0), c.stiff);
        Real const explicit_step = min(Real(1.0) / max(rate, Real(1e-9)), Real(max_step));
        c.h = select(leaving, min(c.h, explicit_step), c.h);
        return leaving;
    }

private:
    using Limits = std::conditional_t<IsRigid<Model>, SlipStiffness, Stiffness>;

    /// What a look adds to those that found a member stiff.  @param creeping who may change over, of those that touch
    SLIDEWAY_HD static Real look_at(Pack<Model, Real>& pack, Mask<Real> touching, Mask<Real>& creeping)
        requires(!IsRigid<Model>)
    {
        auto& c = pack.state.course;
        auto const& s = pack.state;
        Real rate_squared(0.0);
        if (any(touching)) {
            typename Model::template Linearisation<Real> matrix;
            pack.model.linearise(c.t, c.y, s.constants.parameters, s.contacts.memory, matrix);
            rate_squared = select(touching, matrix.rate_squared(), rate_squared);
            c.jacobians = c.jacobians + count<Real>(touching);
            Real const little =
                Real(Stiffness::creep_below * Stiffness::creep_below) * Model::energy_scale(s.constants.parameters);
            creeping = creeping & (matrix.vibration_energy(c.y) < little);
        }
        c.rate_squared =
            select(pack.busy, max(rate_squared, Real(Stiffness::memory) * c.rate_squared), c.rate_squared);
        Real const squared_step = c.h * c.h;
        auto const held_up = squared_step * rate_squared > Real(Stiffness::held_up_above * Stiffness::held_up_above);
        auto const lasting =
            touching & (squared_step * c.rate_squared > Real(Stiffness::lasting_above * Stiffness::lasting_above));
        return select(held_up, Real(1.0), select(lasting, Real(Stiffness::lasting_share), Real(-1.0)));
    }
    SLIDEWAY_HD static Real look_at(Pack<Model, Real>& pack, Mask<Real> touching, Mask<Real>&)
        requires IsRigid<Model>
    {
        auto const& s = pack.state;
        Real rate(0.0);
        if (any(touching)) rate = select(touching, pack.model.slip_rate(s.course.t, s.course.y, s.constants.parameters, s.contacts.memory), rate);
        return select(s.course.h * rate > Real(SlipStiffness::held_up_above), Real(1.0), Real(-1.0));
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
