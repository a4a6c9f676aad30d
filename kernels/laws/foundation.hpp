#pragma once

#include <utility>

#include "kernels/laws/contact.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/laws/law_info.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A bed of sixteen linear springs over each face (a Winkler foundation), at the Gauss–Lobatto nodes j of its rectangle: spring j of
/// stiffness w_j k, Σ w_j = 1, sees δ_j = Σ N_i(j) δ_i and pushes its apices by N_i(j) w_j k max(0, δ_j), times the damping factor of a
/// surface at δ_j'; U = Σ ½ w_j k max(0, δ_j)².  No mode: a face, an edge and a corner differ by how many springs push.  The corners are
/// nodes, so some apex touches wherever a spring does; an apex that does not touch has its share of the springs that do.  Source:
/// docs/model.md 4.
struct Foundation {
    static constexpr LawInfo info{.name = "foundation",
                                  .words = "a bed of linear springs over each face, no modes",
                                  .switches = false,
                                  .groups = groups_of(KeyGroup::elastic, KeyGroup::surfaces, KeyGroup::restitution)};

    template <class Damping, class Real>
    SLIDEWAY_FN static FaceForces<Real> forces(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                               ContactParameters<Real> const& contact) {
        auto f = no_forces<Real>();
        Real const zero(0.0), v0 = speed_of_impact<Damping>(m);
        each_spring(m, [&](Spring<Real> const& spring) {
            Real const load = face.surface_stiffness * Real(spring.weight) * spring.depth;
            Real const factor = Damping::surface_factor(spring.rate, v0, contact.damping);
            Real const elastic = select(spring.pushes, load, zero), damped = select(spring.pushes, load * factor, zero);
            add(elastic, spring.share, f.elastic);
            add(damped, spring.share, f.normal);
            f.potential = fma(Real(0.5) * elastic, spring.depth, f.potential);
        }, sixteen);
        return f;
    }

    /// ∂F_i/∂δ_l = Σ w_j k f_j N_i N_l and ∂F_i/∂δ_l' = Σ w_j k δ_j ∂f_j/∂δ_j' N_i N_l of the springs that push.
    template <class Damping, class Real>
    SLIDEWAY_FN static FaceStiffness<Real> stiffness(FaceMotion<Real> const& m, FaceContact<Real> const& face,
                                                     ContactParameters<Real> const& contact) {
        auto f = FaceStiffness<Real>::none();
        Real const zero(0.0), v0 = speed_of_impact<Damping>(m);
        each_spring(m, [&](Spring<Real> const& spring) {
            Real const stiffness = face.surface_stiffness * Real(spring.weight), load = stiffness * spring.depth;
            auto const damping = Damping::surface_slopes(spring.rate, v0, contact.damping);
            add(select(spring.pushes, load * damping.factor, zero), spring.share, f.normal);
            add_product(select(spring.pushes, stiffness * damping.factor, zero), spring.share, f.by_depth);
            if constexpr (Damping::couples) add_product(select(spring.pushes, load * damping.by_rate, zero), spring.share, f.by_rate);
        }, sixteen);
        return f;
    }

private:
    static constexpr std::make_integer_sequence<int, 16> sixteen{};

    template <class Real> struct Spring {
        Quad<double> share;  // N_i, bilinear in the node's place
        double weight;
        Real depth, rate;
        Mask<Real> pushes;
    };

    /// N_i of node `j`: (1 ± t)/2 of its places t = ±1, ±1/√5 along and across.
    static constexpr Quad<double> shares(int j) {
        constexpr double ends[] = {1, 0.72360679774997896, 0.27639320225002103, 0};
        double const front = ends[j / 4], rear = ends[3 - j / 4], plus = ends[j % 4], minus = ends[3 - j % 4];
        return {front * plus, front * minus, rear * minus, rear * plus};
    }
    /// w_j: 1/12 and 5/12 along and across, so that the sixteen come to one.
    static constexpr double weight(int j) {
        constexpr double weights[] = {1, 5, 5, 1};
        return weights[j / 4] * weights[j % 4] / 144;
    }

    template <class Real, class Visit, int... j>
    SLIDEWAY_FN static void each_spring(FaceMotion<Real> const& m, Visit const& visit, std::integer_sequence<int, j...>) {
        Mask<Real> const touched = (m.touching.a | m.touching.b) | (m.touching.c | m.touching.d);
        (visit(spring<j>(m.apex, touched)), ...);
    }
    template <int j, class Real> SLIDEWAY_FN static Spring<Real> spring(Quad<ApexMotion<Real>> const& apex, Mask<Real> touched) {
        constexpr auto n = shares(j);
        constexpr double w = weight(j);
        auto const here = [&](Real a, Real b, Real c, Real d) {
            return fma(Real(n.a), a, fma(Real(n.b), b, fma(Real(n.c), c, Real(n.d) * d)));
        };
        Real const depth = here(apex.a.depth, apex.b.depth, apex.c.depth, apex.d.depth);
        return {n, w, depth, here(apex.a.rate, apex.b.rate, apex.c.rate, apex.d.rate), Mask<Real>(touched & (depth > Real(0.0)))};
    }

    /// The largest v0 of the apices that touch: those that do not had theirs at an earlier impact.
    template <class Damping, class Real> SLIDEWAY_FN static Real speed_of_impact(FaceMotion<Real> const& m) {
        Real const zero(0.0);
        if constexpr (!Damping::remembers) return zero;  // and nobody asks
        auto const seen = [&](Mask<Real> touching, ApexMotion<Real> const& apex) { return select(touching, apex.impact_speed, zero); };
        return max(max(seen(m.touching.a, m.apex.a), seen(m.touching.b, m.apex.b)), max(seen(m.touching.c, m.apex.c), seen(m.touching.d, m.apex.d)));
    }

    template <class Real> SLIDEWAY_FN static void add(Real force, Quad<double> const& n, Quad<Real>& sum) {
        sum = {fma(Real(n.a), force, sum.a), fma(Real(n.b), force, sum.b), fma(Real(n.c), force, sum.c), fma(Real(n.d), force, sum.d)};
    }
    /// `slope` N_i N_l, row by row.
    template <class Real> SLIDEWAY_FN static void add_product(Real slope, Quad<double> const& n, Quad<ApexSlopes<Real>>& sum) {
        auto const add_row = [&](double own, double across, double along, double opposite, ApexSlopes<Real>& row) {
            row = {fma(Real(own * own), slope, row.own), fma(Real(own * across), slope, row.across), fma(Real(own * along), slope, row.along),
                   fma(Real(own * opposite), slope, row.opposite)};
        };
        add_row(n.a, n.b, n.d, n.c, sum.a);
        add_row(n.b, n.a, n.c, n.d, sum.b);
        add_row(n.c, n.d, n.b, n.a, sum.c);
        add_row(n.d, n.c, n.a, n.b, sum.d);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
