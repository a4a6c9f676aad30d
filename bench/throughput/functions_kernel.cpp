// Compiled once per instruction set.
#include "bench/throughput/functions_kernel.hpp"

#include <cstring>
#include <iterator>

#include "kernels/all_laws.hpp"
#include "kernels/isa_real.hpp"
#include "kernels/lane_copy.hpp"
#include "kernels/laws/list.hpp"
#include "kernels/laws/one_law.hpp"
#include "kernels/math/exponential.hpp"
#include "kernels/math/lambert_w.hpp"
#include "kernels/math/logarithm.hpp"
#include "kernels/math/trigonometry.hpp"
#include "kernels/mechanisms/slider_crank.hpp"

namespace slideway::inline SLIDEWAY_ISA {
namespace {

using Real = IsaReal;

// ---- functions ----

struct Sine {
    static Real of(Real x) { return sincos(x).sin; }
};
struct Exponential {
    static Real of(Real x) { return exp(x); }
};
struct Logarithm {
    static Real of(Real x) { return log_positive(x); }
};
struct Power {
    static Real of(Real x) { return power(x, Real(1.3)); }
};
struct LambertW {
    static Real of(Real x) { return minus_lambert_wm1_exp(x).value(); }
};

template <class Function> void evaluate(double const* arguments, double* values, std::size_t count) {
    for (std::size_t i = 0; i < count; i += lanes<Real>) {
        Real x(0.0);
        std::memcpy(&x, arguments + i, sizeof x);
        Real const y = Function::of(x);
        std::memcpy(values + i, &y, sizeof y);
        asm volatile("" ::: "memory");  // or the compiler makes packs of scalar code
    }
}

// ---- laws ----

/// One face with the depths given in every lane, and with rates that no law takes for zero.
FaceMotion<Real> face_of(double const depths[4]) {
    FaceMotion<Real> m;
    Real const none(0.0);
    m.apex = {{Real(depths[0]), Real(1e-3), none}, {Real(depths[1]), Real(-1e-3), none}, {Real(depths[2]), Real(2e-3), none},
              {Real(depths[3]), Real(-2e-3), none}};
    m.touching = {Mask<Real>(m.apex.a.depth > none), Mask<Real>(m.apex.b.depth > none), Mask<Real>(m.apex.c.depth > none),
                  Mask<Real>(m.apex.d.depth > none)};
    return m;
}

template <class Law> double evaluate_law(Inputs const& member, double const depths[4], std::size_t calls) {
    using Normals = FaceNormals<Real>(FaceMotion<Real> const&, FaceContact<Real> const&, ContactParameters<Real> const&);
    // As the joint calls it: nothing of the law is known there.
    Normals* volatile const normals = &OneLaw<Law, PointDamping>::template normals<Real>;
    SliderParameters<Real> parameters;
    for (int lane = 0; lane < lanes<Real>; ++lane) load_lane(parameters, lane, SliderCrank::parameters(member));
    auto const& contact = parameters.joint.contact;
    FaceContact<Real> const face{contact.surface_stiffness_y, contact.across_y_face, contact.along, contact.area_y};
    auto motion = face_of(depths);
    Real total(0.0);
    for (std::size_t call = 0; call < calls; ++call) {
        auto const f = normals(motion, face, contact);
        total = total + sum(f.normal);
    }
    double totals[lanes<Real>];
    std::memcpy(totals, &total, sizeof total);
    return totals[0];
}

}  // namespace

TimedList<TimedFunction> timed_functions() {
    static constexpr TimedFunction all[] = {{"sincos", -3, 3, &evaluate<Sine>},
                                            {"exp", -20, 20, &evaluate<Exponential>},
                                            {"log", 1e-12, 1, &evaluate<Logarithm>},
                                            {"power", 1e-9, 1e-3, &evaluate<Power>},
                                            {"lambert_w", 2, 40, &evaluate<LambertW>}};
    return {all, std::size(all)};
}

TimedList<TimedLaw> timed_laws() {
#define SLIDEWAY_TIMED(name, Type) {#name, &evaluate_law<Type>},
    static constexpr TimedLaw all[] = {SLIDEWAY_LAWS(SLIDEWAY_TIMED)};
#undef SLIDEWAY_TIMED
    return {all, std::size(all)};
}

}  // namespace slideway::inline SLIDEWAY_ISA
