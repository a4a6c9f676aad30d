#pragma once

#include <algorithm>

#include "kernels/linkage/linkage_bodies.hpp"
#include "kernels/linkage/linkage_parameters.hpp"
#include "kernels/linkage/linkage_plan.hpp"
#include "kernels/math/cholesky.hpp"
#include "kernels/mechanisms/crank_motion.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// How a linkage moves on from a state: forces from the leaves inwards, then the accelerations of its coordinates.
/// Mass matrix and forces are those of a tree; loops are closed by multipliers:
///   M u' = Jᵀλ − h,  J u' + b = 0   (docs/explanation/linkages.md)
template <class Plan, class Real> class LinkageMotion : public LinkageBodies<Plan, Real> {
    using Base = LinkageBodies<Plan, Real>;
    using typename Base::Body, typename Base::Vector;
    using Base::plan_, Base::p_, Base::rate_, Base::body_;
    static constexpr int n = Plan::most_coordinates, rows = 2 * std::max(Plan::most_loops, 1);

public:
    SLIDEWAY_FN LinkageMotion(Plan plan, LinkageParameters<Real> const& p, Real const* s, bool driven, GivenMotion<Real> const& crank)
        : Base(plan, p, s, driven, crank), first_(driven ? 1 : 0) {
        each_coordinate([&](int c) SLIDEWAY_INLINED { h_[c] = Real(0.0); });
    }

    /// Adds a torque along a coordinate that is an angle, or a force along one that is a displacement.
    SLIDEWAY_FN void turn(int coordinate, Real torque) { h_[coordinate] = h_[coordinate] - torque; }

    /// Inwards: M and h, and the factors of M.
    SLIDEWAY_FN void gather() {
        plan_.down(plan_->bodies, [&](int i) SLIDEWAY_INLINED { gather_body(plan_->body[i], i); });
        factor();
    }

    /// Closes the loops: rows of J, M⁻¹Jᵀ, and the factor of J M⁻¹ Jᵀ.  @return lanes where that is singular: at a dead centre of the loop
    SLIDEWAY_FN Mask<Real> close_loops() {
        loops_ = 0;
        plan_.up(plan_->closures, [&](int k) SLIDEWAY_INLINED {
            if (plan_->closure[k].has_clearance()) return;
            this->put_rows(k, jacobian_[2 * loops_], jacobian_[2 * loops_ + 1]);
            closed_[loops_++] = k;
        });
        auto singular = mask_of<Real>(false);
        each_row([&](int i) SLIDEWAY_INLINED {
            each_coordinate([&](int c) SLIDEWAY_INLINED { response_[i][c] = jacobian_[i][c]; });
            solve(response_[i]);
        });
        each_row([&](int i) SLIDEWAY_INLINED {
            plan_.up(i + 1, [&](int j) SLIDEWAY_INLINED {
                Real sum(0.0);
                each_free([&](int c) SLIDEWAY_INLINED { sum = fma(jacobian_[i][c], response_[j][c], sum); });
                loop_factors_.entry[i][j] = sum;
            });
        });
        // Accelerations grow with the third power of how near a dead centre is: nothing is right beside it.
        loop_factors_.factor(plan_, 2 * loops_, 1e-8, [&](int, Mask<Real> here) SLIDEWAY_INLINED { singular = singular | here; });
        return singular;
    }

    /// u' of all coordinates, 0 of a driven one; multipliers of the loops, where there are some.
    SLIDEWAY_FN void accelerate(Real* of) {
        each_coordinate([&](int c) SLIDEWAY_INLINED { of[c] = negated(h_[c]); });
        solve(of);
        if (first_ == 1) of[0] = Real(0.0);
        if (loops_ == 0) return;
        plan_.up(loops_, [&](int k) SLIDEWAY_INLINED {
            auto const gap = this->apart(closed_[k]);
            force_[2 * k] = negated(gap.acceleration.x), force_[2 * k + 1] = negated(gap.acceleration.y);
        });
        each_row([&](int i) SLIDEWAY_INLINED {
            each_free([&](int c) SLIDEWAY_INLINED { force_[i] = fnma(jacobian_[i][c], of[c], force_[i]); });
        });
        loop_factors_.solve(plan_, force_);
        add_responses(force_, of);
    }

    /// Torque that a drive needs for the acceleration that it gives coordinate 0 [N m].  @param of u' of the others
    SLIDEWAY_FN Real drive_torque(Real const* of) const {
        Real torque = h_[0];
        each_coordinate([&](int c) SLIDEWAY_INLINED {
            if (c > 0) torque = fma(m_[c][0], of[c], torque);
        });
        each_row([&](int i) SLIDEWAY_INLINED { torque = fnma(jacobian_[i][0], force_[i], torque); });
        return torque;
    }

    /// Moves places and rates onto the loops, in the metric of M: one step of Newton's method.
    SLIDEWAY_FN void project(Mask<Real> in, Real* s) {
        Real places[rows], rates[rows], shift[n], change[n];
        plan_.up(loops_, [&](int k) SLIDEWAY_INLINED {
            auto const gap = this->apart(closed_[k]);
            places[2 * k] = negated(gap.place.x), places[2 * k + 1] = negated(gap.place.y);
            rates[2 * k] = negated(gap.velocity.x), rates[2 * k + 1] = negated(gap.velocity.y);
        });
        each_coordinate([&](int c) SLIDEWAY_INLINED { shift[c] = change[c] = Real(0.0); });
        loop_factors_.solve(plan_, places);
        loop_factors_.solve(plan_, rates);
        add_responses(places, shift);
        add_responses(rates, change);
        each_free([&](int c) SLIDEWAY_INLINED {
            s[2 * c] = select(in, s[2 * c] + shift[c], s[2 * c]);
            s[2 * c + 1] = select(in, s[2 * c + 1] + change[c], s[2 * c + 1]);
        });
    }

private:
    template <class See> SLIDEWAY_FN void each_coordinate(See const& see) const { plan_.up(plan_->coordinates, see); }
    template <class See> SLIDEWAY_FN void each_free(See const& see) const {
        plan_.up(plan_->coordinates, [&](int c) SLIDEWAY_INLINED {
            if (c >= first_) see(c);
        });
    }
    /// Of the loops, two each.
    template <class See> SLIDEWAY_FN void each_row(See const& see) const { plan_.up(2 * loops_, see); }

    /// What a body asks of the coordinates of its joint, and hands on to the body below.
    SLIDEWAY_FN void gather_body(LinkageBody const& of, int index) {
        Body const& b = body_[index];
        Real const mass = p_.body[index].hung_mass;
        int const c = of.coordinate;
        Vector const turning = across(b.hung_moment);
        // The inertia of what is hung on it, as the drive turns it.
        auto const held = add(add(b.held, negated(b.spin * b.spin), b.hung_moment), b.spin_rate, turning);
        if (of.joint == TreeJoint::prismatic) {
            auto const inertia = add(held, mass, b.acceleration);
            h_[c] = h_[c] + dot(b.along, inertia);
            auto const lifted = mass * b.along;
            Real const twist = cross(b.hung_moment, b.along);
            put_row(of.parent, lifted, twist + cross(b.from_below, lifted), m_[c]);
            m_[c][c] = mass;
            if (of.parent == LinkageBody::ground) return;
            Body& below = body_[of.parent];
            auto const coriolis = (Real(2.0) * (b.spin * rate_[c])) * across(b.along);
            // Of one angle with it, the body below has the rest of `held` from E.
            auto const passed = add(b.held, mass, coriolis);
            below.held = below.held + passed;
            below.moment = below.moment + (b.moment + (cross(b.hung_moment, coriolis) + cross(b.from_below, passed)));
            below.hung_moment = add(below.hung_moment, mass, b.from_below) + b.hung_moment;
            Real const square = fma(mass, dot(b.from_below, b.from_below), Real(2.0) * dot(b.from_below, b.hung_moment));
            below.hung_inertia = below.hung_inertia + (b.hung_inertia + square);
            return;
        }
        Real const torque = cross(b.hung_moment, b.acceleration) + fma(b.hung_inertia, b.spin_rate, b.moment);
        if (of.joint == TreeJoint::floating) {
            auto const inertia = add(held, mass, b.acceleration);
            h_[c] = h_[c] + inertia.x;
            h_[c + 1] = h_[c + 1] + inertia.y;
            h_[c + 2] = h_[c + 2] + torque;
            for (int k = 0; k < 3; ++k) m_[c + k][0] = Real(0.0);
            m_[c][c] = m_[c + 1][c + 1] = mass;
            m_[c + 1][c] = Real(0.0);
            m_[c + 2][c + 2] = b.hung_inertia;
            m_[c + 2][c] = turning.x;
            m_[c + 2][c + 1] = turning.y;
            return;
        }
        h_[c] = h_[c] + torque;
        put_row(of.parent, turning, cross(b.from_below, turning), m_[c]);
        m_[c][c] = b.hung_inertia;
        if (of.parent == LinkageBody::ground) return;
        Body& below = body_[of.parent];
        below.held = below.held + held;
        below.moment = below.moment + cross(b.from_below, held);
    }

    /// A row of M: what stands below its body.
    SLIDEWAY_FN void put_row(int below, Vector const& force, Real torque, Real* row) const {
        row[0] = Real(0.0);  // of a driven coordinate that is no ancestor
        this->climb(below, force, torque, [row](int c, Real x) SLIDEWAY_INLINED { row[c] = x; });
    }

    /// Has a function see the free coordinates between one and the ground.
    template <class See> SLIDEWAY_FN void each_above(int coordinate, See const& see) const { plan_.coordinates_from(plan_->above[coordinate], first_, see); }

    /// M = LᵀΔL from the leaves; L below the diagonal, the reciprocals of Δ on it.  A driven coordinate is left out.
    SLIDEWAY_FN void factor() {
        plan_.down(plan_->coordinates, [&](int i) SLIDEWAY_INLINED {
            if (i < first_) return;
            Real const inverse = Real(1.0) / m_[i][i];
            m_[i][i] = inverse;
            each_above(i, [&](int k) SLIDEWAY_INLINED {
                Real const share = m_[i][k] * inverse;
                plan_.coordinates_from(k, first_, [&](int j) SLIDEWAY_INLINED { m_[k][j] = fnma(share, m_[i][j], m_[k][j]); });
                // A driven one keeps what its torque is made of.
                m_[i][k] = share;
            });
        });
    }

    /// x ← M⁻¹ x.
    SLIDEWAY_FN void solve(Real* x) const {
        plan_.down(plan_->coordinates, [&](int i) SLIDEWAY_INLINED {
            if (i < first_) return;
            each_above(i, [&](int k) SLIDEWAY_INLINED { x[k] = fnma(m_[i][k], x[i], x[k]); });
            x[i] = x[i] * m_[i][i];
        });
        each_free([&](int i) SLIDEWAY_INLINED {
            each_above(i, [&](int k) SLIDEWAY_INLINED { x[i] = fnma(m_[i][k], x[k], x[i]); });
        });
    }

    SLIDEWAY_FN void add_responses(Real const* forces, Real* of) const {
        each_row([&](int i) SLIDEWAY_INLINED {
            each_free([&](int c) SLIDEWAY_INLINED { of[c] = fma(forces[i], response_[i][c], of[c]); });
        });
    }

    int first_;  // of the free coordinates
    int loops_ = 0;
    int closed_[LinkagePlan::most_closures];
    Real h_[n];
    Real m_[n][n];
    Real jacobian_[rows][n], response_[rows][n], force_[rows];
    CholeskyFactors<rows, Real> loop_factors_;  // of J M⁻¹ Jᵀ
};

}  // namespace slideway::inline SLIDEWAY_ISA
