#pragma once

#include "kernels/linkage/linkage_parameters.hpp"
#include "kernels/linkage/linkage_plans.hpp"
#include "kernels/math/trigonometry.hpp"
#include "kernels/math/vec2.hpp"
#include "kernels/mechanisms/crank_motion.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A point of a body: where it is from the body's origin and from the ground's, how fast it moves, and how it accelerates if no free coordinate does, less
/// gravity's acceleration.
template <class Real> struct LinkagePoint { Vec2<Real> arm, place, velocity, acceleration; };

/// The bodies of a linkage in a state, from the ground outwards, and what acts on them (docs/explanation/linkages.md).
/// Place and rate of coordinate i are numbers 2i and 2i + 1 of the state.
/// @tparam Plan PlanTable or a PlanConstant
template <class Plan, class Number> class LinkageBodies {
public:
    using Real = Number;
    using Vector = Vec2<Real>;

    /// @param crank angle, speed and acceleration of coordinate 0, where a drive gives them (`driven`)
    SLIDEWAY_FN LinkageBodies(Plan plan, LinkageParameters<Real> const& p, Real const* s, bool driven, GivenMotion<Real> const& crank)
        : plan_(plan), p_(p) {
        plan.up(plan->coordinates, [&](int i) SLIDEWAY_INLINED {
            place_[i] = s[2 * i];
            rate_[i] = s[2 * i + 1];
        });
        if (driven) place_[0] = crank.place, rate_[0] = crank.velocity;
        plan.up(plan->bodies, [&](int i) SLIDEWAY_INLINED { carry(plan->body[i], i, driven && i == 0 ? crank.acceleration : Real(0.0)); });
    }

    SLIDEWAY_FN Plan plan() const { return plan_; }
    SLIDEWAY_FN LinkageParameters<Real> const& numbers() const { return p_; }

    SLIDEWAY_FN LinkagePoint<Real> point(int body, Vector const& local, Arm at = Arm::any) const {
        if (body == LinkageBody::ground) return {local, local, {Real(0.0), Real(0.0)}, {negated(p_.gravity.x), negated(p_.gravity.y)}};
        Body const& b = body_[body];
        if (at == Arm::none) return {{Real(0.0), Real(0.0)}, b.place, b.velocity, b.acceleration};
        auto const arm = along_ground(b.turn, local, at), aside = across(arm);
        return {arm, b.place + arm, add(b.velocity, b.spin, aside), add(add(b.acceleration, negated(b.spin * b.spin), arm), b.spin_rate, aside)};
    }
    SLIDEWAY_FN Real spin(int body) const { return body == LinkageBody::ground ? Real(0.0) : body_[body].spin; }
    /// A direction in a body's axes, along the ground's.
    SLIDEWAY_FN Vector direction(int body, Vector const& local) const { return body == LinkageBody::ground ? local : turned(body_[body].turn, local); }
    /// Against the ground [rad].
    SLIDEWAY_FN Real angle(int body) const { return body == LinkageBody::ground ? Real(0.0) : body_[body].angle; }
    SLIDEWAY_FN Real place(int coordinate) const { return place_[coordinate]; }
    SLIDEWAY_FN Real rate(int coordinate) const { return rate_[coordinate]; }

    /// Adds a force at an arm from a body's origin.
    SLIDEWAY_FN void push(int body, Vector const& arm, Vector const& force) {
        if (body == LinkageBody::ground) return;
        Body& b = body_[body];
        b.held = b.held - force;
        b.moment = b.moment - cross(arm, force);
    }
    /// Adds a torque on a body.
    SLIDEWAY_FN void twist(int body, Real torque) {
        if (body != LinkageBody::ground) body_[body].moment = body_[body].moment - torque;
    }
    /// Where nothing touches at a closure adds nothing, or NaN in a lane whose depth is, as a force does there: such a lane does not go on, whatever its
    /// neighbours touch.
    SLIDEWAY_FN void require(int closure, Real depth) {
        auto const& of = plan_->closure[closure];
        twist(of.body[0] == LinkageBody::ground ? of.body[1] : of.body[0], depth - depth);
    }
    /// The two points of a closure, the first one's less the second one's.
    SLIDEWAY_FN LinkagePoint<Real> apart(int closure) const {
        auto const& of = plan_->closure[closure];
        auto const& numbers = p_.closure[closure];
        auto const a = point(of.body[0], numbers.point[0], of.arm[0]), b = point(of.body[1], numbers.point[1], of.arm[1]);
        return {a.arm - b.arm, a.place - b.place, a.velocity - b.velocity, a.acceleration - b.acceleration};
    }

    /// Rows of a pin or a journal: what its gap along X and along Y changes by with each coordinate.
    SLIDEWAY_FN void put_rows(int closure, Real* along_x, Real* along_y) const {
        plan_.up(plan_->coordinates, [&](int c) SLIDEWAY_INLINED { along_x[c] = along_y[c] = Real(0.0); });
        add_rows(closure, 0, Real(1.0), along_x, along_y);
        add_rows(closure, 1, Real(-1.0), along_x, along_y);
    }
    /// Adds what the motion of a body's point along a direction changes by with each coordinate.
    SLIDEWAY_FN void add_row(int body, Vector const& arm, Vector const& direction, Real* row) const {
        climb(body, direction, cross(arm, direction), [row](int c, Real x) SLIDEWAY_INLINED { row[c] = row[c] + x; });
    }
    /// Adds the coordinates that turn a body, times a sign.
    SLIDEWAY_FN void add_turn(int body, Real sign, Real* row) const {
        climb(body, {Real(0.0), Real(0.0)}, sign, [row](int c, Real x) SLIDEWAY_INLINED { row[c] = row[c] + x; });
    }

    /// Kinetic energy, and that of the weight [J].
    SLIDEWAY_FN Real energy() const {
        Real const half(0.5);
        Real sum(0.0);
        plan_.up(plan_->bodies, [&](int i) SLIDEWAY_INLINED {
            auto const& numbers = p_.body[i];
            auto const center = point(i, numbers.center);
            Real const speeds = fma(numbers.mass, dot(center.velocity, center.velocity), numbers.inertia * (body_[i].spin * body_[i].spin));
            sum = sum + fnma(numbers.mass, dot(p_.gravity, center.place), half * speeds);
        });
        if (plan_->is_driven) sum = fma(half * p_.flywheel, rate_[0] * rate_[0], sum);
        return sum;
    }

protected:
    struct Body {
        SinCos<Real> turn;
        Real angle, spin, spin_rate;
        Vector place, velocity, acceleration;  // of its origin, the latter as if no free coordinate accelerated, and less gravity's
        Vector from_below;                     // D, from the origin of the body below
        Vector along;                          // U of a prismatic joint
        Vector held;                           // P: what holds its origin where it is
        Real moment;                           // τ, about that
        Vector hung_moment;                    // E
        Real hung_inertia;                     // Î
    };

    /// Has a function see the generalised force, on each coordinate from a body towards the ground, of a force through its origin and a torque.
    template <class See> SLIDEWAY_FN void climb(int body, Vector const& force, Real torque, See const& see) const {
        plan_.bodies_from(body, [&](int i) SLIDEWAY_INLINED {
            LinkageBody const& at = plan_->body[i];
            int const c = at.coordinate;
            if (at.joint == TreeJoint::floating) {  // on the ground: the last
                see(c, force.x);
                see(c + 1, force.y);
                see(c + 2, torque);
                return;
            }
            if (at.joint == TreeJoint::prismatic) {
                see(c, dot(body_[i].along, force));
            } else {
                see(c, torque);
                torque = Real(0.0);  // angles are absolute: those above turn nothing below
            }
            torque = torque + cross(body_[i].from_below, force);
        });
    }

private:
    /// What stands along a body's axes, along the ground's.
    SLIDEWAY_FN static Vector along_ground(SinCos<Real> const& turn, Vector const& of, Arm arm) {
        if (arm == Arm::none) return {Real(0.0), Real(0.0)};
        if (arm == Arm::along_x) return {turn.cos * of.x, turn.sin * of.x};
        return turned(turn, of);
    }

    /// Adds the share of a closure's first or second body, times a sign.
    SLIDEWAY_FN void add_rows(int closure, int side, Real sign, Real* along_x, Real* along_y) const {
        int const body = plan_->closure[closure].body[side];
        auto lever = point(body, p_.closure[closure].point[side], plan_->closure[closure].arm[side]).arm;
        plan_.bodies_from(body, [&](int i) SLIDEWAY_INLINED {
            LinkageBody const& at = plan_->body[i];
            int c = at.coordinate;
            if (at.joint == TreeJoint::prismatic) {
                along_x[c] = fma(sign, body_[i].along.x, along_x[c]);
                along_y[c] = fma(sign, body_[i].along.y, along_y[c]);
            } else {
                if (at.joint == TreeJoint::floating) {
                    along_x[c] = along_x[c] + sign;
                    along_y[c + 1] = along_y[c + 1] + sign;
                    c = c + 2;
                }
                along_x[c] = fnma(sign, lever.y, along_x[c]);
                along_y[c] = fma(sign, lever.x, along_y[c]);
                lever = {Real(0.0), Real(0.0)};  // angles are absolute: what hangs here turns nothing that stands below
            }
            lever = lever + body_[i].from_below;
        });
    }
    /// From the body below to one.
    SLIDEWAY_FN void carry(LinkageBody const& of, int index, Real spin_rate) {
        Real const zero(0.0);
        auto const& numbers = p_.body[index];
        Body& b = body_[index];
        int const c = of.coordinate;
        bool const slides = of.joint == TreeJoint::prismatic, floats = of.joint == TreeJoint::floating, stands = of.parent == LinkageBody::ground;
        Vector const weight{negated(p_.gravity.x), negated(p_.gravity.y)};
        b.spin_rate = spin_rate;
        if (floats) {
            b.from_below = b.place = {place_[c], place_[c + 1]};
            b.velocity = {rate_[c], rate_[c + 1]};
            b.acceleration = weight;
        } else {
            auto const arm = slides ? add(numbers.at, place_[c], numbers.along) : numbers.at;
            if (stands) {
                b.from_below = b.place = arm;
                b.velocity = {zero, zero};
                b.acceleration = weight;
                if (slides) b.along = numbers.along;
            } else {
                Body const& below = body_[of.parent];
                b.from_below = along_ground(below.turn, arm, slides ? Arm::any : of.arm);
                b.place = below.place + b.from_below;
                auto const aside = across(b.from_below);
                b.velocity = add(below.velocity, below.spin, aside);
                b.acceleration = add(add(below.acceleration, negated(below.spin * below.spin), b.from_below), below.spin_rate, aside);
                if (slides) {
                    b.along = turned(below.turn, numbers.along);
                    b.acceleration = add(b.acceleration, Real(2.0) * (below.spin * rate_[c]), across(b.along));
                }
            }
            if (slides) b.velocity = add(b.velocity, rate_[c], b.along);
        }
        if (slides) {
            b.angle = stands ? zero : body_[of.parent].angle;
            b.spin = stands ? zero : body_[of.parent].spin;
            b.spin_rate = stands ? zero : body_[of.parent].spin_rate;
            b.turn = stands ? SinCos<Real>{zero, Real(1.0), zero} : body_[of.parent].turn;
        } else {
            int const own = floats ? c + 2 : c;
            b.angle = place_[own];
            b.spin = rate_[own];
            b.turn = of.is_point ? SinCos<Real>{zero, Real(1.0), zero} : sincos(b.angle);
        }
        b.hung_moment = along_ground(b.turn, numbers.hung_moment, slides || floats ? Arm::any : of.moment);
        b.hung_inertia = numbers.hung_inertia;
        b.held = {zero, zero};
        b.moment = zero;
    }

protected:
    [[no_unique_address]] Plan const plan_;
    LinkageParameters<Real> const& p_;
    Real place_[Plan::most_coordinates], rate_[Plan::most_coordinates];
    Body body_[LinkagePlan::most_bodies];
};

}  // namespace slideway::inline SLIDEWAY_ISA
