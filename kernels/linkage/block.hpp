#pragma once

#include "kernels/laws/face.hpp"
#include "kernels/linkage/linkage_motion.hpp"
#include "kernels/linkage/linkage_parameters.hpp"
#include "kernels/linkage/linkage_report.hpp"
#include "kernels/mechanisms/planar_corners.hpp"
#include "kernels/mechanisms/planar_report.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Where a block is between its walls, in axes along and across them that turn with their body: along X, across Y, with a tilt, and the rates of that
/// as the walls' body sees them.
/// @tparam Motion LinkageMotion
template <class Motion> struct BlockPose {
    using Real = typename Motion::Real;
    LinkagePoint<Real> centre, middle;  // of the block, and of the walls
    Vec2<Real> along;                   // the walls
    Vec2<Real> place, velocity;
    Real tilt, spin;
    bool is_level;

    SLIDEWAY_FN BlockPose(Motion const& motion, int closure) {
        auto const& of = motion.plan()->closure[closure];
        auto const& numbers = motion.numbers().closure[closure];
        is_level = of.is_level;
        centre = motion.point(of.body[0], numbers.point[0], of.arm[0]);
        middle = motion.point(of.body[1], numbers.point[1], of.arm[1]);
        Real const turning = motion.spin(of.body[1]);
        along = motion.direction(of.body[1], numbers.along);
        auto const apart = centre.place - middle.place;
        place = to_walls(apart);
        velocity = to_walls(add(centre.velocity - middle.velocity, negated(turning), across(apart)));
        tilt = motion.angle(of.body[0]) - (motion.angle(of.body[1]) + numbers.direction);
        spin = motion.spin(of.body[0]) - turning;
    }
    SLIDEWAY_FN Vec2<Real> to_walls(Vec2<Real> const& v) const { return is_level ? v : Vec2<Real>{dot(along, v), cross(along, v)}; }
    SLIDEWAY_FN Vec2<Real> from_walls(Real x, Real y) const { return is_level ? Vec2<Real>{x, y} : add(x * along, y, normal()); }
    SLIDEWAY_FN Vec2<Real> normal() const { return across(along); }
    /// A force on the block at its centre, and at the same place the other way on the walls.
    SLIDEWAY_FN void push(Motion& motion, int closure, Vec2<Real> const& force) const {
        auto const& of = motion.plan()->closure[closure];
        motion.push(of.body[0], centre.arm, force);
        motion.push(of.body[1], middle.arm + (centre.place - middle.place), Real(-1.0) * force);
    }
};

/// A block of one body between two walls of another: corners as those of the planar slider-crank, with its point law (model.md 7).
template <class Motion> struct BlockInWalls {
    using Real = typename Motion::Real;
    int closure;
    BlockPose<Motion> pose;
    PlanarCorners<Real> corners;

    SLIDEWAY_FN BlockInWalls(Motion const& motion, int at)
        : closure(at), pose(motion, at), corners(pose.place.y, pose.velocity.y, pose.tilt, pose.spin, motion.numbers().closure[at]) {}

    /// Pushes both bodies.  @param v0 δ' of the corners' last touches, where those count  @param told what a report has of the contact; nullptr: nothing
    SLIDEWAY_FN void push(Motion& motion, Quad<Real> const& v0, bool remembers, bool has_friction, LinkageContact<Real>* told) const {
        auto const& of = motion.plan()->closure[closure];
        auto const& p = motion.numbers();
        auto const& numbers = p.closure[closure];
        auto const elastic = corners.loads(numbers.contact);
        auto const force = corners.damped(elastic, v0, numbers.contact, p.damping, remembers);
        auto total = corners.push_of_nothing();
        corners.add_normal(force, total);
        Real const loss = has_friction ? corners.add_friction(force, pose.velocity.x, p, total) : Real(0.0);
        pose.push(motion, closure, pose.from_walls(total.fx, total.fy));
        motion.twist(of.body[0], total.torque);
        motion.twist(of.body[1], negated(total.torque));
        if (told == nullptr) return;
        told->normal_force[of.pair / 4] = force;
        told->force[closure] = sum(force);
        told->friction_power = told->friction_power + loss;
        add_corners(*told, force, elastic, corners.depth, corners.rate, numbers.contact.potential_share);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
