// A contact law of one's own, outside the tree, under a slider that is thrown at its way and under a slider-crank.
#include <cmath>
#include <cstdio>

#include "kernels/integrate.hpp"
#include "kernels/laws/one_law.hpp"
#include "kernels/laws/point.hpp"
#include "kernels/laws/restitution.hpp"
#include "kernels/mechanisms/free_slider.hpp"
#include "kernels/mechanisms/slider_crank.hpp"
#include "kernels/models/mechanism_model.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A spring that dissipates in proportion to its force, at each apex: F = max(0, K δⁿ (1 + (3/2) α δ')), U = K δⁿ⁺¹/(n + 1).
/// Source: Hunt & Crossley, J. Appl. Mech. 42 (1975) 440.
struct HuntCrossley {
    static constexpr Key keys[] = {
        {"contact.dissipation", &Inputs::law_a, "s/m", Rule::not_negative, KeyGroup::law, "dissipation of an apex", 0}};
    static constexpr LawInfo info{.name = "hunt_crossley",
                                  .words = "a spring at each apex that dissipates in proportion to its force",
                                  .switches = false,
                                  .groups = groups_of(KeyGroup::elastic, KeyGroup::hertz),
                                  .keys = keys};

    template <class Damping, class Real>
    SLIDEWAY_FN static FaceForces<Real> forces(FaceMotion<Real> const& m, FaceContact<Real> const&,
                                               ContactParameters<Real> const& contact) {
        auto f = no_forces<Real>();
        Real const zero(0.0), slope = Real(1.5) * contact.of_law.a;
        auto const add = [&](Mask<Real> touching, ApexMotion<Real> const& apex, Real& normal, Real& elastic) {
            Real const load = point_load(select(touching, apex.depth, Real(1.0)), contact.point);  // both sides are evaluated
            normal = select(touching, clamped(load * fma(slope, apex.rate, Real(1.0))), zero);
            elastic = select(touching, load, zero);
            f.potential = fma(contact.point.potential_share * elastic, apex.depth, f.potential);
        };
        add(m.touching.a, m.apex.a, f.normal.a, f.elastic.a);
        add(m.touching.b, m.apex.b, f.normal.b, f.elastic.b);
        add(m.touching.c, m.apex.c, f.normal.c, f.elastic.c);
        add(m.touching.d, m.apex.d, f.normal.d, f.elastic.d);
        return f;
    }

    /// ∂F/∂δ and ∂F/∂δ' of its own apex, where it pushes: what the stiff method steps by.
    template <class Damping, class Real>
    SLIDEWAY_FN static FaceStiffness<Real> stiffness(FaceMotion<Real> const& m, FaceContact<Real> const&,
                                                     ContactParameters<Real> const& contact) {
        auto f = FaceStiffness<Real>::none();
        Real const zero(0.0), one(1.0), slope = Real(1.5) * contact.of_law.a;
        auto const add = [&](Mask<Real> touching, ApexMotion<Real> const& apex, Real& normal, Real& by_depth, Real& by_rate) {
            auto const elastic = point_slope(select(touching, apex.depth, one), contact.point);
            Real const factor = fma(slope, apex.rate, one);
            auto const pushing = touching & (factor > zero);
            normal = select(pushing, elastic.load * factor, zero);
            by_depth = select(pushing, elastic.slope * factor, zero);
            by_rate = select(pushing, elastic.load * slope, zero);
        };
        add(m.touching.a, m.apex.a, f.normal.a, f.by_depth.a.own, f.by_rate.a.own);
        add(m.touching.b, m.apex.b, f.normal.b, f.by_depth.b.own, f.by_rate.b.own);
        add(m.touching.c, m.apex.c, f.normal.c, f.by_depth.c.own, f.by_rate.c.own);
        add(m.touching.d, m.apex.d, f.normal.d, f.by_depth.d.own, f.by_rate.d.own);
        return f;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA

namespace {

using namespace slideway;

/// The standard slider-crank; what a scene would let follow stands here.
Inputs standard_inputs() {
    Inputs in;
    in.crank_mass = 4.875e-3;
    in.rod_mass = 0.1118;
    in.rod_inertia = in.rod_mass * in.rod_length * in.rod_length / 12;
    in.slider_mass = 0.1872;
    in.slider_inertia_x = 2.028e-5;
    in.slider_inertia_y = 3.9e-5;
    in.slider_inertia_z = 3.12e-5;
    in.thickness_y = in.way_width;
    in.thickness_z = in.way_depth;
    in.point_stiffness = 3.4e9;
    return in;
}

/// One member from its start to `end` [s].
template <class Mechanism, class Base> struct Run {
    MemberRecord record;
    double state[Base::size], quantities[quantity_columns];

    Run(Inputs const& in, double end) {
        using Laws = OneLaw<HuntCrossley, PointDamping>;
        using Model = MechanismModel<Mechanism, Base, Laws>;
        Block block;
        block.members = 1;
        block.inputs = &in;
        block.settings = {.rtol = 1e-10, .atol = 1e-10, .end_time = end};
        block.quantities = selections::of({Quantity::energy_residual, Quantity::crank_work, Quantity::damping_loss});
        block.records = &record;
        block.final_states = state;
        block.quantity_values = quantities;
        integrate<Model, double>(block, Model{Conditions<Laws>{{}, HuntCrossley::info.switches, Parts{}}});
    }
    double operator[](Quantity q) const { return quantities[quantity_column(q)]; }
};

/// Thrown flat at the way without weight, the slider meets it with four apices at once: with a = (3/2) α v0 it returns the e of
/// a (1 + e) = ln[(1 + a)/(1 − e a)] (docs/model.md 4).
bool returns_what_theory_says() {
    auto in = standard_inputs();
    in.gravity = 0;
    in.vy = -0.1;
    in.law_a = 2;
    Run<FreeSlider, FreeSliderBase> const thrown(in, 2e-3);
    double const e = thrown.state[2] / 0.1, a = 1.5 * in.law_a * 0.1;
    double const slope = restitution_slope(e);
    std::printf("thrown: returns e = %.6f, for which a = %.6f; a is %.6f\n", e, slope, a);
    return thrown.record.status == Status::finished && std::fabs(slope - a) < 1e-7;
}

bool balances_its_energy() {
    auto in = standard_inputs();
    in.z = 1e-5;
    in.roll = 1e-4;
    in.law_a = 0.5;
    Run<SliderCrank, SliderBase> const crank(in, 0.05);
    double const residual = crank[Quantity::energy_residual], lost = crank[Quantity::damping_loss];
    bool const balanced = std::fabs(residual) < 1e-9;
    std::printf("slider-crank: damping took %.1e J of the crank's %.1e J; energy residual %s 1e-9 J\n", lost,
                crank[Quantity::crank_work], balanced ? "below" : "above");
    return crank.record.status == Status::finished && lost > 1e-6 && balanced;
}

}  // namespace

int main() { return returns_what_theory_says() && balances_its_energy() ? 0 : 1; }
