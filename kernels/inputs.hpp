// What a scene says about one member: plain numbers in SI units, one per key of the scene file.  Kernels derive
// their own parameters from it (mechanisms/slider_parameters.hpp, planar_parameters.hpp); the host reads, varies and stores it.
// Plain data outside the ISA namespace: every unit may share it.
#pragma once

#include <limits>

#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"

namespace slideway {

/// Marks an input that was not given and follows from others (`complete_inputs` in host/scene fills it).
inline constexpr double follows = std::numeric_limits<double>::quiet_NaN();

/// What moves the slider (docs/model.md 6, 7): the rows of mechanisms/list.hpp.
enum class Mechanism {
#define SLIDEWAY_NAME(name, Type, Base) name,
    SLIDEWAY_MECHANISMS(SLIDEWAY_NAME)
#undef SLIDEWAY_NAME
};

/// How contacts push (docs/model.md 4): the rows of laws/list.hpp.
enum class Law {
#define SLIDEWAY_NAME(name, Type) name,
    SLIDEWAY_LAWS(SLIDEWAY_NAME)
#undef SLIDEWAY_NAME
};
/// point: C of point contacts alone (χ = 0).  rate: C and χ.  restitution: replaces both.
enum class Damping { point, rate, restitution };

struct Parts {
    Law law = Law::paper;  // of the spatial mechanisms
    Damping damping = Damping::point;
    bool friction = false;        // absent [friction]: no friction code runs
    bool misaligned_way = false;  // only with a [way] table is the code for its pose in the kernel
    Mechanism mechanism = Mechanism::slider_crank;
    bool free_crank = false;  // of planar_slider_crank: no drive holds the crank's speed
    friend bool operator==(Parts const&, Parts const&) = default;
};

struct Inputs {
    // [mechanism]
    double crank_length = 0.05;              // r [m]
    double rod_length = 0.1422;              // L [m]
    double crank_speed = 3.141592653589793;  // ω [rad/s], constant; of a free crank at the start
    double start_angle = 0;                  // θ0 [rad]
    double gravity = 9.81;                   // g [m/s²]
    double inclination = 0;                  // β [rad], of the way
    double crank_mass = follows;             // m_c [kg]: steel, 5 × 2.5 mm × crank_length
    double rod_mass = follows;               // m_r [kg]: steel, 14.2 × 7.1 mm × rod_length
    double rod_mass_center = 0.5;            // f_r, fraction of the rod from the crank pin
    double rod_inertia = follows;            // J [kg m²], transverse about the centre of mass: m_r L²/12
    double slider_mass = follows;            // M [kg]: steel, 40 × 20 × 30 mm
    double slider_inertia_x = follows;       // I [kg m²] about the slider's axes: that block with mass M
    double slider_inertia_y = follows;
    double slider_inertia_z = follows;
    double crank_inertia = follows;  // J1 [kg m²], of the planar crank about its centre of mass: m_c r²/12
    double carriage_speed = 0.06;    // v [m/s]
    double stroke = 0.15;            // [m], of the carriage at constant speed
    double reversal_time = 0.02;     // t_r [s]
    // [joint]
    double slider_length = 0.04;   // L_k [m]
    double way_width = 0.02;       // w_a [m], along Y
    double way_depth = 0.03;       // w_b [m], along Z
    double thickness_y = follows;  // l_a [m]: way_width
    double thickness_z = follows;  // l_b [m]: way_depth
    double clearance_y = 1e-4;     // c_a [m], per side
    double clearance_z = 1e-4;     // c_b [m], per side
    double slider_height = 0.02;   // 2b [m], of the planar block between its walls
    // [way]
    double way_offset_y = 0;  // u_l [m]
    double way_offset_z = 0;
    double way_roll = 0;  // A_l [rad]
    double way_yaw = 0;
    double way_pitch = 0;
    // [contact]
    double slider_young_modulus = 2.07e11;  // E1 [Pa]
    double way_young_modulus = 2.07e11;     // E2 [Pa]
    double slider_poisson_ratio = 0.29;     // ν1
    double way_poisson_ratio = 0.29;        // ν2
    double edge_radius = 5e-4;              // R_e [m]
    double apex_radius = 5e-4;              // R_p [m]
    double point_stiffness = follows;       // K [N/mⁿ]: 4/3 E* √R_p
    double hertz_exponent = 1.5;            // n
    double eta = 0.01;                      // η, C = ηK numerically
    double chi_line = 0;                    // [s/m]
    double chi_surface = 0;                 // [s/m]
    double restitution = 1;                 // e in (0, 1]; used by Damping::restitution alone
    // What a contact law has of its own, under the keys that its LawInfo names; 0 where a law has fewer.
    double law_a = 0, law_b = 0, law_c = 0, law_d = 0;
    // [friction]
    double friction_static = 0.15;       // μs
    double friction_kinetic = 0.10;      // μd
    double friction_stick_speed = 1e-3;  // Vs [m/s]
    double friction_slip_speed = 1e-2;   // Vd [m/s]
    // [initial]
    double y = 0, z = 0;                  // [m] from the X axis of the inertial frame
    double vy = 0, vz = 0;                // [m/s]
    double roll = 0, yaw = 0, pitch = 0;  // φ ϑ ψ [rad]
    double wx = 0, wy = 0, wz = 0;        // ω in the slider's frame [rad/s]
    double x = 0, vx = 0;                 // [m], [m/s], of a slider that is free along the way
};

}  // namespace slideway
