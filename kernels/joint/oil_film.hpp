// A film of lubricant between the slider's four faces and the way (model.md 14).
#pragma once

#include "kernels/joint/attitude.hpp"
#include "kernels/joint/face_pair.hpp"
#include "kernels/joint/joint_stiffness.hpp"
#include "kernels/joint/way.hpp"
#include "kernels/joint/wrench.hpp"
#include "kernels/loads/load_list.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The film of one face, as between parallel plates at its mean gap, in the frame of the faces.
template <class Real> struct FaceFilm {
    Vec3<Real> outward, lever;  // normal of the slider's face, and the face's middle from the slider's centre [m]
    Vec3<Real> slip;            // there, in the face [m/s]
    Real rate;                  // at which the mean gap closes [m/s]
    Real drag, damping;         // η A/h of the slip, η B³ (L − 0.63 B)/h³ of the rate [N s/m]
    Real steepening;            // 3/h, by which the damping grows as the gap closes; 0 at the least gap [1/m]
    Real most_pull;             // p_c A [N]

    template <Axis axis>
    SLIDEWAY_FN static FaceFilm of(Real side, Load const& film, Real const* numbers, JointMotion<Real> const& motion, JointGeometry<Real> const& g) {
        using Faces = FacePair<axis>;
        Real const zero(0.0), one(1.0), two(2.0);
        auto const n = Faces::normal(motion), v = Faces::arranged(motion.velocity), spin = Faces::arranged_axial(motion.spin);
        // Those of the middle are the means over the apices.
        auto const depths = Faces::depths(motion, g), rates = Faces::rates(cross(spin, n), v, motion, g);
        FaceFilm f;
        f.outward = side * n;
        f.lever = {zero, fms(side, Faces::half_main(g), Faces::main(motion)), negated(Faces::across(motion))};
        f.slip = v + cross(spin, f.lever);
        f.slip = f.slip - dot(f.slip, n) * n;
        f.rate = fma(side, rates.middle, rates.base);
        // In this order NaN stays.
        Real const least = numbers[film.least_gap], gap = max(least, negated(fma(side, depths.middle, depths.base))), per_gap = one / gap;
        Real const length = two * g.half_length, across = two * Faces::half_across(g), area = length * across;
        Real const longer = max(length, across), shorter = min(length, across), ratio = shorter * per_gap;
        Real const sheared = numbers[film.viscosity] * per_gap;
        f.drag = sheared * area;
        f.damping = numbers[film.viscosity] * (ratio * ratio * ratio) * fnma(Real(0.63), shorter, longer);
        f.steepening = select(gap > least, Real(3.0) * per_gap, zero);
        f.most_pull = film.cavitation_pressure == Load::none ? zero : numbers[film.cavitation_pressure] * area;
        return f;
    }

    /// On the slider, outward: it pulls no more than the film bears before it breaks.
    SLIDEWAY_FN Real push() const { return max(negated(most_pull), damping * rate); }
    /// ∂push/∂rate, and by the depth.
    SLIDEWAY_FN Real by_rate() const { return select(damping * rate >= negated(most_pull), damping, Real(0.0)); }
    SLIDEWAY_FN Real by_depth() const { return steepening * (by_rate() * rate); }
};

/// What the film of a scene does to the slider; nothing where there is none.
template <class Real> struct OilFilm {
    Wrench<Real> wrench;  // along the way's axes
    Real loss;            // what it takes [W]

    /// @param numbers of a member, Inputs::load_a …
    SLIDEWAY_NOINLINE static OilFilm of(LoadList const& list, Real const* numbers, JointMotion<Real> const& motion, JointGeometry<Real> const& g) {
        Real const zero(0.0);
        OilFilm sum{{{zero, zero, zero}, {zero, zero, zero}}, zero};
        Load const* const film = list.find(LoadKind::film);
        if (film == nullptr) return sum;
        for (double const side : {1.0, -1.0}) {
            sum.template add<Axis::y>(FaceFilm<Real>::template of<Axis::y>(Real(side), *film, numbers, motion, g));
            sum.template add<Axis::z>(FaceFilm<Real>::template of<Axis::z>(Real(side), *film, numbers, motion, g));
        }
        return sum;
    }

private:
    template <Axis axis> SLIDEWAY_FN void add(FaceFilm<Real> const& f) {
        using Faces = FacePair<axis>;
        Real const push = f.push();
        auto const whole = push * f.outward - f.drag * f.slip;
        // As of a contact, the push has no part along the way (Wrench).
        auto const force = Vec3<Real>{negated(f.drag) * f.slip.x, whole.y, whole.z};
        wrench.force = wrench.force + Faces::arranged(force);
        wrench.torque = wrench.torque + Faces::arranged_axial(cross(f.lever, whole));
        loss = loss + fma(push, f.rate, f.drag * dot(f.slip, f.slip));
    }
};

/// The film's part of the structural Jacobian of the joint: −Σ c g gᵀ over the faces' normals and the two directions in each face, gᵀ ν being the velocity of
/// the middle.  Left out is how the drag changes with the gap.
template <class Real> struct FilmStiffness {
    SLIDEWAY_NOINLINE static void add(Load const& film, Real const* numbers, JointFrame<Real> const& frame, JointGeometry<Real> const& g,
                                      JointStiffness<Real>& to) {
        for (double const side : {1.0, -1.0}) {
            add_face<Axis::y>(FaceFilm<Real>::template of<Axis::y>(Real(side), film, numbers, frame.motion, g), frame, to);
            add_face<Axis::z>(FaceFilm<Real>::template of<Axis::z>(Real(side), film, numbers, frame.motion, g), frame, to);
        }
    }

private:
    template <Axis axis> SLIDEWAY_FN static void add_face(FaceFilm<Real> const& f, JointFrame<Real> const& frame, JointStiffness<Real>& to) {
        Real const zero(0.0);
        auto const arm = to_slider(frame.motion.axes, FacePair<axis>::arranged(f.lever));
        Vec3<Real> const about_y{negated(arm.z), zero, arm.x}, about_z{arm.y, negated(arm.x), zero};  // arm × e_y, arm × e_z
        subtract(f.drag, frame.x, {zero, arm.z, negated(arm.y)}, to.by_rate);
        if constexpr (axis == Axis::y) {
            add_push(f, frame.y_normal, about_y, to);
            subtract(f.drag, frame.z, about_z, to.by_rate);
        } else {
            add_push(f, frame.z_normal, about_z, to);
            subtract(f.drag, frame.y, about_y, to.by_rate);
        }
    }
    SLIDEWAY_FN static void add_push(FaceFilm<Real> const& f, Translation<Real> const& push, Vec3<Real> const& turn, JointStiffness<Real>& to) {
        subtract(f.by_rate(), push, turn, to.by_rate);
        subtract(f.by_depth(), push, turn, to.by_place);
    }
    /// @param push, turn g
    SLIDEWAY_FN static void subtract(Real c, Translation<Real> const& push, Vec3<Real> const& turn, Real (&from)[5][5]) {
        Real const g[5] = {push.y, push.z, turn.x, turn.y, turn.z};
        for (int i = 0; i < 5; ++i) {
            Real const scaled = c * g[i];
            for (int j = 0; j < 5; ++j) from[i][j] = fnma(scaled, g[j], from[i][j]);
        }
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
