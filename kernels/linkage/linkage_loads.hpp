#pragma once

#include "kernels/linkage/block.hpp"
#include "kernels/linkage/linkage_motion.hpp"
#include "kernels/linkage/linkage_parameters.hpp"
#include "kernels/linkage/linkage_report.hpp"
#include "kernels/loads/element_pull.hpp"
#include "kernels/loads/load_list.hpp"
#include "kernels/loads/load_numbers.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Numbers of a member's loads, points and forces in the axes that the kernels give a body.  @param p with its bodies
SLIDEWAY_HD inline void put_linkage_loads(LoadList const& list, Inputs const& in, LinkageParameters<double>& p) {
    for (int i = 0; i < list.count; ++i) {
        Load const& load = list.loads[i];
        auto const number = [&](int place, double otherwise = 0) { return place == Load::none ? otherwise : in.*load_inputs[place]; };
        auto const turn = [&](int body) { return body == LinkageBody::ground ? 0 : p.body[body].turn; };
        auto const local = [&](int body, int const(&places)[3]) -> Vec2<double> {
            Vec2<double> const at{number(places[0]), number(places[1])};
            return body == LinkageBody::ground ? at : detail::turned(at - p.body[body].origin, turn(body));
        };
        auto& own = p.load[i];
        own.point[0] = local(load.body[0], load.point);
        own.point[1] = local(load.body[1], load.anchor);
        own.force = {number(load.force[0]), number(load.force[1])};
        if (load.turns_with_slider) own.force = detail::turned(own.force, turn(load.body[0]));
        own.torque = number(load.crank_torque);
        own.scale = number(load.scale, 1);
        own.rest = number(load.turns ? load.angle : load.kind == LoadKind::stop ? load.anchor[0] : load.rest_length);
        if (load.turns) own.rest -= turn(load.body[0]) - turn(load.body[1]);
        own.stiffness = number(load.turns ? load.angular_stiffness : load.stiffness);
        own.damping = number(load.turns ? load.angular_damping : load.damping);
        own.preload = number(load.turns ? load.angular_preload : load.preload);
        own.dissipation = number(load.turns ? load.angular_dissipation : load.dissipation);
    }
}

/// What acts on a linkage beside weight, drive and joints: each load on one body, and the other way on another one or the ground, so that its virtual work is
/// that of how they move against one another.  (docs/explanation/linkages.md)
/// @tparam Motion LinkageMotion
template <class Motion> class LinkageLoads {
public:
    using Real = typename Motion::Real;

    SLIDEWAY_FN LinkageLoads(Motion& motion, LinkageReport<Real>* told) : motion_(motion), p_(motion.numbers()), told_(told) {}

    SLIDEWAY_NOINLINE void push(LoadList const& list, LoadArguments<Real> const& arguments) const {
        for (int i = 0; i < list.count; ++i) {
            Load const& load = list.loads[i];
            if (load.kind == LoadKind::push) push(load, i, arguments);
            else if (load.turns || load.coordinate != Load::none || load.closure != Load::none) hold(load, i);
            else stretch(load, i);
        }
    }

private:
    using Vector = Vec2<Real>;

    /// Force and torque, which the other body takes up at the same place.
    SLIDEWAY_FN void push(Load const& load, int i, LoadArguments<Real> const& arguments) const {
        auto const& numbers = p_.load[i];
        Real factor = numbers.scale;
        if (load.over != LoadArgument::nothing) factor = factor * table_value(load.table, arguments.of(load.over));
        auto force = factor * numbers.force;
        if (load.turns_with_slider) force = motion_.direction(load.body[0], force);
        Real const torque = factor * numbers.torque;
        auto const at = motion_.point(load.body[0], numbers.point[0]), other = motion_.point(load.body[1], {Real(0.0), Real(0.0)});
        auto const arm = at.place - other.place;
        motion_.push(load.body[0], at.arm, force);
        motion_.twist(load.body[0], torque);
        motion_.push(load.body[1], arm, Real(-1.0) * force);
        motion_.twist(load.body[1], negated(torque));
        if (told_ == nullptr) return;
        Real const spin = motion_.spin(load.body[1]);
        Real const power = fma(torque, motion_.spin(load.body[0]) - spin, dot(force, at.velocity - add(other.velocity, spin, across(arm))));
        told_->load_power = told_->load_power + power;
        told_->load[i] = {Real(0.0), power, power};
    }

    /// A spring between two points.
    SLIDEWAY_FN void stretch(Load const& load, int i) const {
        auto const& numbers = p_.load[i];
        auto const at = motion_.point(load.body[0], numbers.point[0]), anchor = motion_.point(load.body[1], numbers.point[1]);
        auto const span = at.place - anchor.place;
        Real const length = sqrt(max(dot(span, span), Real(1e-30)));  // where its ends meet it has no direction
        auto const along = (Real(1.0) / length) * span;
        Real const rate = dot(along, at.velocity - anchor.velocity);
        auto const pull = ElementPull<Real>::of_spring(length - numbers.rest, rate, numbers.stiffness, numbers.damping, numbers.preload);
        motion_.push(load.body[0], at.arm, negated(pull.force) * along);
        motion_.push(load.body[1], anchor.arm, pull.force * along);
        tell(i, pull, rate);
    }

    /// A spring or stop along a joint, or between the angles of two bodies.
    SLIDEWAY_FN void hold(Load const& load, int i) const {
        if (load.turns) {
            Real const angle = motion_.angle(load.body[0]) - motion_.angle(load.body[1]), spin = motion_.spin(load.body[0]) - motion_.spin(load.body[1]);
            Real const torque = pull(load, i, angle, spin);
            motion_.twist(load.body[0], negated(torque));
            motion_.twist(load.body[1], torque);
        } else if (load.coordinate != Load::none) {
            motion_.turn(load.coordinate, negated(pull(load, i, motion_.place(load.coordinate), motion_.rate(load.coordinate))));
        } else {
            BlockPose<Motion> const pose(motion_, load.closure);
            pose.push(motion_, load.closure, negated(pull(load, i, pose.place.x, pose.velocity.x)) * pose.along);
        }
    }

    /// Against displacement or angle.
    SLIDEWAY_FN Real pull(Load const& load, int i, Real place, Real rate) const {
        auto const& numbers = p_.load[i];
        if (load.kind == LoadKind::spring) {
            auto const pull = ElementPull<Real>::of_spring(place - numbers.rest, rate, numbers.stiffness, numbers.damping, numbers.preload);
            tell(i, pull, rate);
            return pull.force;
        }
        Real const side(load.side);
        auto const pull = ElementPull<Real>::of_stop(side * (place - numbers.rest), side * rate, numbers.stiffness, numbers.damping, numbers.dissipation);
        tell(i, pull, side * rate);
        return side * pull.force;
    }

    SLIDEWAY_FN void tell(int i, ElementPull<Real> const& pull, Real rate) const {
        if (told_ == nullptr) return;
        told_->spring_potential = told_->spring_potential + pull.potential;
        told_->spring_loss = told_->spring_loss + pull.loss;
        told_->load[i] = {pull.force, pull.potential, negated(pull.force * rate)};
    }

    Motion& motion_;
    LinkageParameters<Real> const& p_;
    LinkageReport<Real>* told_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
