#pragma once

#include <type_traits>

#include "kernels/inputs.hpp"
#include "kernels/mechanisms/faults.hpp"
#include "kernels/mechanisms/slider_loads.hpp"
#include "kernels/mechanisms/slider_parameters.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/joint_pairs.hpp"
#include "kernels/rigid/rigid_joint.hpp"
#include "kernels/rigid/rigid_memory.hpp"
#include "kernels/rigid/rigid_scales.hpp"
#include "kernels/rigid/rigid_slider_report.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What a scene chooses of rigid contacts.
struct RigidConditions {
    bool friction = false, misaligned_way = false, offset_slider = false;
    LoadList loads;
    DrivePlan drive;
    double slip_units = 1;          // slip scales
    bool integrands_alone = false;  // reports tell what is integrated, and nothing else

    template <class Real> SLIDEWAY_FN RigidJoint<Real> joint(JointPairs<Real> const& at, RigidSliderParameters<Real> const& p) const {
        return {at, p, friction, Real(slip_units) * p.slip_scale};
    }
};

/// What of a slider with rigid contacts depends on what guides it along the way, behind pointers.
template <class Real> struct GuideFunctions {
    using Parameters = RigidSliderParameters<Real>;
    using Derivative = Faults<Real>(Real, Real const*, Parameters const&, RigidJointMemory<Real> const&, RigidConditions const&, Real*, RigidSliderReport<Real>*);

    RigidSliderParameters<double> (*parameters)(Inputs);
    StateFunctions<SliderParameters<double>> state;
    bool is_free;  // nothing drives the slider, and it has no speed that slips are to be seen against
    Derivative* lean;  // none of numbers with slopes: those are of what the contacts report
    Derivative* full;
    JointPairs<Real> (*place)(Real, Real const*, Parameters const&, RigidConditions const&);
    Real (*along)(Real, Real const*, Axes<Real> const&, Parameters const&, RigidConditions const&);
};

/// What loads do, whatever guides the slider.
template <bool with_powers, class Real>
SLIDEWAY_NOINLINE SliderLoads<Real> told_loads(LoadList const& list, Real t, GivenMotion<Real> const& crank, Vec3<Real> const& place,
                                               Vec3<Real> const& velocity, Real const* s, SliderParameters<Real> const& p) {
    return SliderLoads<Real>::template of<with_powers>(list, t, crank, place, velocity, SliderTurning<Real>::of(s), p);
}

/// @tparam Guide what moves the slider along the way (kernels/mechanisms/spatial_slider.hpp)
template <class Guide> struct RigidGuide {
    static_assert(std::is_same_v<typename Guide::Base::template Parameters<double>, SliderParameters<double>>,
                  "rigid contacts know the numbers of a slider alone, and this guide's base has more");

    /// Of a member; what a law needs of its restitution is not worked out.
    SLIDEWAY_FN static RigidSliderParameters<double> parameters(Inputs in) {
        RigidSliderParameters<double> p;
        p.restitution = in.restitution;
        in.restitution = 1;
        static_cast<SliderParameters<double>&>(p) = Guide::Base::parameters(in);
        p.slip_scale = Guide::Base::speed_along(p);
        p.pace = Guide::Base::pace(p);
        return p;
    }

    template <class Real> static JointPairs<Real> place(Real t, Real const* s, RigidSliderParameters<Real> const& p, RigidConditions const& block) {
        auto faults = Faults<Real>::none();
        Pin<Real> const pin(s, p, is_offset(block));
        typename Guide::template At<Real> guide(t, pin.state, p, block.drive, faults);
        auto const loads = loads_of<false>(guide, pin, t, s, p, block);
        return pairs_of(guide, loads, pin, s, p, block);
    }

    template <bool Full, class Real>
    static Faults<Real> derivative(Real t, Real const* s, RigidSliderParameters<Real> const& p, RigidJointMemory<Real> const& memory,
                                   RigidConditions const& block, Real* rates, RigidSliderReport<Real>* report) {
        auto faults = Faults<Real>::none();
        Pin<Real> const pin(s, p, is_offset(block));
        typename Guide::template At<Real> guide(t, pin.state, p, block.drive, faults);
        auto const loads = loads_of<Full>(guide, pin, t, s, p, block);
        auto at = pairs_of(guide, loads, pin, s, p, block);
        RigidJointContact<Real>* contact = nullptr;
        if constexpr (Full) contact = &report->contact;
        auto on = block.joint(at, p).forces(memory, contact, block.integrands_alone);
        if (block.loads.count > 0) {
            on.force = on.force + loads.force;
            on.torque = on.torque + from_slider(at.motion.axes, loads.torque);
        }
        PointMotion<Real> centre{{at.x, s[0], s[1]}, at.velocity.linear, {}};
        typename OffsetSlider<Real>::Answer answer;
        bool const moved = may_be_offset && pin.is_offset();
        if constexpr (may_be_offset) {
            if (moved) {
                answer = pin.offset.answer(guide, on.force, to_slider(at.motion.axes, on.torque), at.turning, p);
                centre.acceleration = answer.hole;
                at.turning.put_rates(answer.spin_up, rates);
            }
        }
        if (!moved) {
            centre.acceleration = guide.accelerations(on.force, p);
            at.turning.put_rates(on.torque, at.motion.axes, p.inertia, p.inverse_inertia, rates);
        }
        rates[0] = s[2];
        rates[1] = s[3];
        rates[2] = centre.acceleration.y;
        rates[3] = centre.acceleration.z;
        guide.put_rates(centre.acceleration, rates);
        rates[9] = select(on.jammed, Real(not_a_number), rates[9]);
        if constexpr (Full) {
            if constexpr (may_be_offset) {
                if (moved) pin.offset.tell(guide, centre, answer, at.turning, p, false, *report);
            }
            if (!moved) guide.tell(centre, at.turning, on.force, p, false, *report);
            loads.tell(block.drive, *report);
        }
        faults.contact_domain = on.jammed;
        faults.geometry = faults.geometry | ((memory.begun == Real(0.0)) & (on.deepest > Real(1e-6) * p.length_scale_y));
        return faults;
    }

    template <class Real> using Pin = PinState<Real, Guide::Base::size>;
    static constexpr bool may_be_offset = has_group(Guide::info.keys, KeyGroup::body);
    SLIDEWAY_FN static bool is_offset(RigidConditions const& block) { return may_be_offset && block.offset_slider; }

    /// @param loads on the slider; the crank has its own
    template <class Real>
    SLIDEWAY_FN static JointPairs<Real> pairs_of(typename Guide::template At<Real>& guide, SliderLoads<Real> const& loads, Pin<Real> const& pin,
                                                 Real const* s, RigidSliderParameters<Real> const& p, RigidConditions const& block) {
        Real x = guide.x, vx = guide.vx;
        pin.leave_pin(x, vx);
        JointPairs<Real> at(guide.centre(p), x, vx, s, p, block.misaligned_way);
        if (pin.is_offset()) at.move(pin.offset);
        if (block.loads.count > 0) at.take_up(loads);
        return at;
    }

    /// What loads do to a slider where it is, nothing without them; its crank takes up what they do to it.
    template <bool with_powers, class Real>
    SLIDEWAY_FN static SliderLoads<Real> loads_of(typename Guide::template At<Real>& guide, Pin<Real> const& pin, Real t, Real const* s,
                                                  RigidSliderParameters<Real> const& p, RigidConditions const& block) {
        if (block.loads.count == 0) return SliderLoads<Real>::none();
        Vec3<Real> place{guide.x, s[0], s[1]}, velocity{guide.vx, s[2], s[3]};
        pin.leave_pin(place.x, velocity.x);
        auto const loads = told_loads<with_powers>(block.loads, t, crank_of<Guide>(t, s, p, block.drive), place, velocity, s, p);
        if constexpr (requires { guide.turn(loads.turning()); }) guide.turn(loads.turning());
        return loads;
    }

    template <class Real>
    static Real along(Real t, Real const* s, Axes<Real> const& lies, RigidSliderParameters<Real> const& p, RigidConditions const& block) {
        return along_way<Guide>(t, s, lies, p, block.drive, is_offset(block));
    }

    template <class Real> static constexpr typename GuideFunctions<Real>::Derivative* lean() {
        if constexpr (is_tangent<Real>) return nullptr;
        else return &derivative<false, Real>;
    }
    template <class Real>
    static constexpr GuideFunctions<Real> functions{&parameters, StateFunctions<SliderParameters<double>>::of<typename Guide::Base>(), is_free_along<Guide>, lean<Real>(), &derivative<true, Real>, &place<Real>, &along<Real>};
};

}  // namespace slideway::inline SLIDEWAY_ISA
