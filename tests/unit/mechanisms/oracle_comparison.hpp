// The measure by which a kernel's numbers are held against the oracle's: group by group, as in model.md 11.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "host/backend/backend.hpp"
#include "kernels/block.hpp"
#include "kernels/joint/contact_report.hpp"
#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "tests/oracle/names.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/oracle/random_states.hpp"
#include "tests/support/starting_in.hpp"

namespace slideway::testing {

/// Each entry against the largest of its group in the reference.
class Comparison {
public:
    static constexpr double tolerance = 2e-8;

    explicit Comparison(std::string what) : what_(std::move(what)) {}

    template <class A, class B>
    void group(char const* name, A const& reference, B const& got, std::size_t n, double floor = 0) {
        double scale = floor;
        for (std::size_t i = 0; i < n; ++i) scale = std::max(scale, std::abs(static_cast<double>(reference[i])));
        if (scale == 0) scale = 1e-300;
        for (std::size_t i = 0; i < n; ++i) {
            EXPECT_LE(std::abs(static_cast<double>(reference[i]) - static_cast<double>(got[i])), tolerance * scale)
                << what_ << ": " << name << " " << i << " is " << got[i] << ", the oracle says " << reference[i];
        }
    }
    void value(char const* name, double reference, double got, double floor = 0) {
        group(name, &reference, &got, 1, floor);
    }

private:
    std::string what_;
};

inline double load_of(oracle::Result const& r) {
    double sum = r.film_load;
    for (int i = 0; i < 8; ++i) sum += r.fn_y[static_cast<std::size_t>(i)] + r.fn_z[static_cast<std::size_t>(i)];
    return sum;
}

template <std::size_t n>
std::array<double, 2 * n> joined(std::array<double, n> const& a, std::array<double, n> const& b) {
    std::array<double, 2 * n> all;
    std::copy(a.begin(), a.end(), all.begin());
    std::copy(b.begin(), b.end(), all.begin() + n);
    return all;
}

inline void compare(std::string const& what, oracle::Case const& c, oracle::Result const& r, double const* d,
                    double const* depths, double const* forces, double const* powers, double energy, double potential,
                    double torque) {
    Comparison compare(what);
    double const load = load_of(r);
    compare.group("position rates", r.derivative.data(), d, 2);
    compare.group("accelerations", r.derivative.data() + 2, d + 2, 2, load / c.inputs.slider_mass);
    if (oracle::states_of(c.parts.mechanism) > 10) {
        compare.value("velocity along the way, or of the crank", r.derivative[10], d[10]);
        // Near a dead centre the crank feels the difference of what pushes an offset slider and of what turning takes of that.
        double const difference = c.parts.offset_slider && c.parts.drive.turns_freely() ? 100 : 1;
        double const arm = (c.parts.drive.turns_freely() ? c.inputs.crank_length : 1) / difference;
        compare.value("acceleration along the way, or of the crank", r.derivative[11], d[11], (load / c.inputs.slider_mass + c.inputs.gravity) / arm);
    }
    compare.group("attitude rates", r.derivative.data() + 4, d + 4, 3);
    double const inertia = std::min({c.inputs.slider_inertia_x, c.inputs.slider_inertia_y, c.inputs.slider_inertia_z});
    // In flight the moments of an offset mass about its pin cancel but for their rounding.
    double const cancelled = c.parts.offset_slider ? 1e-7 * c.inputs.slider_mass * c.inputs.gravity : 0;
    compare.group("angular accelerations", r.derivative.data() + 7, d + 7, 3, (load + cancelled) * c.inputs.slider_length / inertia);
    compare.group("penetrations", joined(r.pen_y, r.pen_z), depths, 16);
    compare.group("forces", joined(r.fn_y, r.fn_z), forces, 16);
    double const reference_powers[] = {r.power_crank, r.power_friction, r.power_damping, r.power_load, r.power_ground, r.loss_springs, r.loss_film};
    // A rate of penetration is a small difference of velocities, each of which is rounded.
    double const speed = std::abs(r.vx) + std::hypot(c.state[2], c.state[3]) +
                         c.inputs.slider_length * std::hypot(c.state[7], c.state[8], c.state[9]);
    compare.group("powers", reference_powers, powers, 7, 1e-6 * load * speed);
    compare.value("energy", r.energy, energy);
    // A penetration is good to about 1e-18 m, whatever its size.
    compare.value("potential", r.contact_potential, potential, load * 1e-18 / Comparison::tolerance);
    // Under a bed, the small difference of loads each of which is rounded, with the penetrations.
    double const bed = 4e13 * c.inputs.slider_length * std::max(c.inputs.way_width, c.inputs.way_depth);  // [N/m], as random inputs have it
    double const rounded = c.parts.law == Law::foundation ? (1e-3 * load + 1e-18 * bed / Comparison::tolerance) * c.inputs.crank_length : 0;
    if (c.parts.mechanism == Mechanism::slider_crank) compare.value("crank torque", r.crank_torque, torque, rounded);
}

/// The forces face by face, their places and torque, and those of the pins.
inline void compare_forces(std::string const& what, oracle::Case const& c, oracle::Result const& r, double const* forces) {
    Comparison compare(what);
    Inputs const& in = c.inputs;
    auto const of = [&](Series first, int i) { return forces[static_cast<int>(first) - first_force_series + i]; };
    double const load = load_of(r), arm = in.slider_length + in.way_width + in.way_depth;
    double const speed = std::abs(r.vx) + std::hypot(c.state[2], c.state[3]) + in.slider_length * std::hypot(c.state[7], c.state[8], c.state[9]);
    double const sr = std::sin(c.state[4]), cr = std::cos(c.state[4]), sy = std::sin(c.state[5]), cy = std::cos(c.state[5]), sp = std::sin(c.state[6]),
                 cp = std::cos(c.state[6]);
    // Of Rz(ψ) Ry(ϑ) Rx(φ).
    double const axes[2][3] = {{cp * sy * sr - sp * cr, sp * sy * sr + cp * cr, cy * sr}, {cp * sy * cr + sp * sr, sp * sy * cr - cp * sr, cy * cr}};
    double normal[4] = {}, along[4] = {}, across[4] = {}, wear[4] = {}, got_along[4], got_across[4], torque[3] = {};
    for (int face = 0; face < face_count; ++face) {
        bool const is_y = face < 2;
        double const side = face % 2 == 0 ? 1 : -1, width = is_y ? in.way_depth : in.way_width, across_signs[] = {1, -1, -1, 1};
        for (int k = 0; k < 4; ++k) {
            auto const apex = static_cast<std::size_t>(face_apex(face, k));
            double const f = (is_y ? r.fn_y : r.fn_z)[apex];
            normal[face] += f;
            along[face] += f * r.ahead[apex];
            across[face] += f * across_signs[k] * 0.5 * width;
            wear[face] += f * (is_y ? r.slip_y : r.slip_z)[apex] / (in.slider_length * width);
        }
        double const f = of(Series::face_force_y_plus, face), x = of(Series::face_along_y_plus, face), other = of(Series::face_across_y_plus, face);
        got_along[face] = f * x, got_across[face] = f * other;
        double const outward = side * 0.5 * (is_y ? in.way_width : in.way_depth);
        double const place[] = {x, (is_y ? outward : other) - c.state[0], (is_y ? other : outward) - c.state[1]};
        for (int i = 0; i < 3; ++i) torque[i] += side * f * (place[(i + 1) % 3] * axes[is_y ? 0 : 1][(i + 2) % 3] - place[(i + 2) % 3] * axes[is_y ? 0 : 1][(i + 1) % 3]);
    }
    compare.group("forces of faces", normal, forces, 4);
    compare.group("moments along", along, got_along, 4, load * in.slider_length);
    compare.group("moments across", across, got_across, 4, load * (in.way_width + in.way_depth));
    compare.group("p v", wear, &forces[static_cast<int>(Series::face_pv_y_plus) - first_force_series], 4,
                  1e-6 * load * speed / (in.slider_length * std::min(in.way_width, in.way_depth)));
    if (!c.parts.misaligned_way) compare.group("torque of the normal forces", r.normal_torque, torque, 3, load * arm);
    oracle::Vector held = r.contact_force;
    for (std::size_t i = 0; i < 3; ++i) held[i] += r.film_force[i];
    compare.group("contact force", held, &forces[static_cast<int>(Series::contact_force_x) - first_force_series], 3, load);
    double friction = 0, got_friction = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        friction = std::hypot(friction, r.contact_force[i] - r.normal_force[i]);
        got_friction = std::hypot(got_friction, of(Series::friction_force_x, static_cast<int>(i)));
    }
    compare.value("friction", friction, got_friction, load);
    if (!selects(info(c.parts.mechanism).series, Series::rod_force_x)) return;
    double const weight = (in.slider_mass + in.rod_mass) * std::abs(in.gravity);
    compare.group("rod's force", r.rod_force, &forces[static_cast<int>(Series::rod_force_x) - first_force_series], 3, load + weight);
    compare.group("crank pin's force", r.pin_force, &forces[static_cast<int>(Series::crank_pin_force_x) - first_force_series], 3, load + weight);
}

/// Probes the state of a spatial mechanism and compares all that the probe tells.
/// @return false, with nothing compared, where the state has no equations
inline bool compare_probe(Isa isa, oracle::Case const& c, std::string const& what) {
    // The probe's impact speeds are their start value.
    auto const r = oracle::evaluate(c.inputs, c.parts, c.t, c.state);
    if (r.geometry || r.contact_domain) return false;
    Inputs in = testing::starting_in(c.inputs, c.state);
    if (c.parts.drive.turns_freely()) in.start_angle = c.state[10], in.crank_speed = c.state[11];
    ProbeResult p;
    find_instance(isa, c.parts).probe({&in, &c.t, 1, &p});
    std::vector<double> depths(p.penetration_y, p.penetration_y + 8), forces(p.normal_force_y, p.normal_force_y + 8);
    depths.insert(depths.end(), p.penetration_z, p.penetration_z + 8);
    forces.insert(forces.end(), p.normal_force_z, p.normal_force_z + 8);
    double const powers[] = {p.power_crank, p.power_friction, p.power_damping, p.power_load, p.power_ground, p.loss_springs, p.loss_film};
    EXPECT_EQ(p.status, Status::finished) << what;
    EXPECT_EQ(p.surfaces, r.surfaces) << what;
    EXPECT_EQ(p.lines, r.lines) << what;
    EXPECT_EQ(p.points, r.points) << what;
    compare(what, c, r, p.derivative, depths.data(), forces.data(), powers, p.energy, p.contact_potential,
            p.crank_torque);
    compare_forces(what, c, r, p.forces);
    return true;
}

}  // namespace slideway::testing
