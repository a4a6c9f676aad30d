// A way whose faces are not straight, worn, tapered or crowned, or that ends.
#pragma once

#include "kernels/conditions.hpp"
#include "kernels/joint/contact_memory.hpp"
#include "kernels/joint/way.hpp"
#include "kernels/loads/load_numbers.hpp"
#include "kernels/loads/table_value.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A number at both ends of the contact segment, of two opposite faces: on side s it is base + s·middle + s_x (skew + s·along).
template <class Real> struct EndNumbers {
    Real base, middle, along, skew;

    SLIDEWAY_FN static EndNumbers of(Real plus_front, Real plus_rear, Real minus_front, Real minus_rear) {
        Real const quarter(0.25);
        Real const plus = plus_front + plus_rear, minus = minus_front + minus_rear;
        Real const of_plus = plus_front - plus_rear, of_minus = minus_front - minus_rear;
        return {quarter * (plus + minus), quarter * (plus - minus), quarter * (of_plus - of_minus), quarter * (of_plus + of_minus)};
    }
    SLIDEWAY_FN EndNumbers times(Real factor) const { return {factor * base, factor * middle, factor * along, factor * skew}; }
    /// What forces on a face come to that are multiplied by it.
    SLIDEWAY_FN Real applied(Real side, Real front, Real rear) const {
        return fma(fma(side, middle, base), front + rear, fma(side, along, skew) * (front - rear));
    }
};

/// The part of the way that the slider is on, from `rear` behind its centre to `front` before it: as long as the slider, or to the way's ends.
template <class Real> struct ContactSegment {
    Real front, rear;              // [m]
    Real front_stays, rear_stays;  // 1 where it ends with the way, and does not run along with the slider

    /// @param x of the slider's centre along the way [m]
    SLIDEWAY_FN static ContactSegment of(LoadList const& list, Real const* numbers, Real x, Real half_length) {
        Real const zero(0.0), one(1.0);
        Load const* const ends = list.find(LoadKind::way_ends);
        if (ends == nullptr) return {half_length, half_length, zero, zero};
        Real const ahead = ends->to == Load::none ? half_length : numbers[ends->to] - x;
        Real const behind = ends->from == Load::none ? half_length : x - numbers[ends->from];
        return {min(ahead, half_length), min(behind, half_length), select(ahead < half_length, one, zero), select(behind < half_length, one, zero)};
    }
};

/// What makes the joint's apices move otherwise than those of a straight way without ends (model.md 18).
template <class Real> struct WayProfile {
    EndNumbers<Real> depth[2];  // how far the faces lie back [m]: of the Y faces, and of the Z faces
    EndNumbers<Real> rate[2];   // how fast that becomes more [m/s]
    EndNumbers<Real> push[2];   // what becomes of a normal force along the way, its gap's slope

    /// Of the faces' tables, h_f of both ends.
    SLIDEWAY_NOINLINE void put_tables(LoadList const& list, Real const* numbers, Real x, Real speed, ContactSegment<Real> const& segment) {
        Real const zero(0.0);
        Real lies[2][face_count], rises[2][face_count];
        for (int end = 0; end < 2; ++end) {
            for (int face = 0; face < face_count; ++face) lies[end][face] = rises[end][face] = zero;
            Real const at = end == 0 ? x + segment.front : x - segment.rear;
            for (int i = 0; i < list.count; ++i) {
                if (list.loads[i].kind == LoadKind::way_profile) add(list.loads[i], numbers, at, lies[end], rises[end]);
            }
        }
        auto const pair = [](Real const (&of)[2][face_count], int plus) {
            return EndNumbers<Real>::of(of[0][plus], of[1][plus], of[0][plus + 1], of[1][plus + 1]);
        };
        // An end that stays where the way ends stays in its place of the table.
        auto const moving = [&](Real const (&of)[2][face_count], int face, int end) { return of[end][face] * (Real(1.0) - (end == 0 ? segment.front_stays : segment.rear_stays)); };
        for (int axis = 0; axis < 2; ++axis) {
            int const plus = 2 * axis, minus = plus + 1;
            depth[axis] = pair(lies, plus);
            push[axis] = EndNumbers<Real>::of(moving(rises, plus, 0), moving(rises, plus, 1), moving(rises, minus, 0), moving(rises, minus, 1));
            rate[axis] = push[axis].times(speed);
        }
    }

    /// Of the segment's ends: its middle is before the slider's centre by `shift`, and what stays comes nearer to it.
    /// @param normal n_x of the face on side +1  @param turning (ω × n)_x
    SLIDEWAY_FN void put_ends(int axis, Real normal, Real turning, Real shift, Real speed, ContactSegment<Real> const& segment) {
        Real const half_normal = Real(0.5) * normal;
        Real const middle = half_normal * (segment.front_stays + segment.rear_stays), along = half_normal * (segment.front_stays - segment.rear_stays);
        depth[axis].middle = fnma(normal, shift, depth[axis].middle);
        rate[axis].middle = fma(middle, speed, fnma(turning, shift, rate[axis].middle));
        rate[axis].along = fma(along, speed, rate[axis].along);
        push[axis].middle = push[axis].middle + middle;
        push[axis].along = push[axis].along + along;
    }

private:
    SLIDEWAY_FN static void add(Load const& load, Real const* numbers, Real at, Real (&lies)[face_count], Real (&rises)[face_count]) {
        auto const table = table_point(load.table, at);
        Real depth = table.value, slope = table.slope;
        if (load.scale != Load::none) depth = numbers[load.scale] * depth, slope = numbers[load.scale] * slope;
        for (int face = 0; face < face_count; ++face) {
            if ((load.faces >> face & 1) == 0) continue;
            lies[face] = lies[face] + depth;
            rises[face] = rises[face] + slope;
        }
    }
};

/// Pose and motion of the slider where the way may have a profile, or end.
template <class Real> struct ProfiledMotion : JointMotion<Real> {
    Real half_length;          // of the contact segment [m]
    Real shift;                // of its middle from the slider's centre, along the way [m]
    bool is_profiled;          // of the whole block
    WayProfile<Real> profile;  // if so
    Mask<Real> has_left;       // the slider is on the way no more

    /// Of the segment's middle from the slider's centre.
    SLIDEWAY_FN Vec3<Real> middle() const { return {shift, Real(0.0), Real(0.0)}; }
    /// The force along the way [N] of normal forces on a face.
    SLIDEWAY_FN Real push(int axis, Real side, Real front, Real rear) const {
        return is_profiled ? profile.push[axis].applied(side, front, rear) : Real(0.0);
    }
};

/// Half the distance between the apices of both ends, the slider's velocity in the middle between them, and what a force there has of torque about the
/// slider's centre.  Of a way without ends the middle is that centre.
template <class Real> SLIDEWAY_FN Real segment_half(JointMotion<Real> const&, Real half_length) { return half_length; }
template <class Real> SLIDEWAY_FN Real segment_half(ProfiledMotion<Real> const& motion, Real) { return motion.half_length; }
template <class Real> SLIDEWAY_FN Vec3<Real> velocity_of_middle(JointMotion<Real> const&, Vec3<Real> const& velocity, Vec3<Real> const&) { return velocity; }
template <class Real>
SLIDEWAY_FN Vec3<Real> velocity_of_middle(ProfiledMotion<Real> const& motion, Vec3<Real> const& velocity, Vec3<Real> const& spin) {
    return motion.is_profiled ? velocity + cross(spin, motion.middle()) : velocity;
}
template <class Real> SLIDEWAY_FN void add_torque_of_middle(JointMotion<Real> const&, Vec3<Real> const&, Vec3<Real>&) {}
template <class Real> SLIDEWAY_FN void add_torque_of_middle(ProfiledMotion<Real> const& motion, Vec3<Real> const& force, Vec3<Real>& torque) {
    if (motion.is_profiled) torque = torque + cross(motion.middle(), force);
}

/// What the joint sees of a slider's centre.
template <class Real, class Laws, class Parameters>
SLIDEWAY_FN ProfiledMotion<Real> motion_on_way(Conditions<Laws> const& block, Axes<Real> const& slider, Vec3<Real> const& position, Vec3<Real> const& velocity,
                                               Vec3<Real> const& spin, Parameters const& p) {
    auto const& way = p.joint.way;
    Real const zero(0.0), half(0.5);
    ProfiledMotion<Real> motion;
    static_cast<JointMotion<Real>&>(motion) = joint_motion(block.misaligned_way, slider, position, velocity, spin, way);
    motion.half_length = p.joint.geometry.half_length;
    motion.shift = zero;
    motion.has_left = mask_of<Real>(false);
    motion.is_profiled = block.way_profile;
    if (!motion.is_profiled) [[likely]] return motion;
    Real const x = block.misaligned_way ? dot(way.x, position - way.offset) + way.station : position.x, speed = motion.velocity.x;
    auto const segment = ContactSegment<Real>::of(block.loads, p.load, x, motion.half_length);
    Real const length = segment.front + segment.rear;
    motion.has_left = length <= zero;
    motion.y = select(motion.has_left, Real(not_a_number), motion.y);  // and so is what follows from it
    motion.half_length = half * max(length, zero);
    motion.shift = half * (segment.front - segment.rear);
    motion.profile.put_tables(block.loads, p.load, x, speed, segment);
    auto const& axes = motion.axes;
    motion.profile.put_ends(0, axes.y.x, cross(motion.spin, axes.y).x, motion.shift, speed, segment);
    motion.profile.put_ends(1, axes.z.x, cross(motion.spin, axes.z).x, motion.shift, speed, segment);
    return motion;
}

}  // namespace slideway::inline SLIDEWAY_ISA
