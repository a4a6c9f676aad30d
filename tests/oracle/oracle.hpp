// The independent oracle: the spatial mechanisms evaluated as the textbook writes them, in 80-bit arithmetic and
// without any of the kernels' shortcuts.  Poses are homogeneous 4 x 4 matrices (Qian et al. 2020, Eq. 1-4), every
// apex-face pair is transformed on its own, and the rod is a free body with unknown end forces.  It shares no code
// with kernels/, only the plain struct of inputs, so that agreement of the two means something.
#pragma once

#include <array>
#include <kernels/inputs.hpp>

namespace oracle {

/// y z [m], vy vz [m/s], roll yaw pitch [rad], ω in the slider's frame [rad/s]; of a free slider also x [m], vx [m/s],
/// of a crank that turns freely its angle [rad] and speed [rad/s], which nobody reads where a mechanism prescribes them.
using State = std::array<double, 12>;
/// One value per apex-face pair: Y faces P1..P8, then Z faces P1..P8.
using Pairs = std::array<double, 16>;
using Vector = std::array<double, 3>;

/// What a face carries.  A face is flat, so two apices across its diagonal never touch without a third.
enum class FaceKind { none, points, lines, surface };
/// Order of `Result::faces`: Y+ {1,4,8,5}, Y- {2,3,7,6}, Z+ {1,2,6,5}, Z- {4,3,7,8}.
enum Face { top, bottom, front, back, face_count };

struct Result {
    bool geometry = false;        // the rod does not reach: everything else is NaN or zero
    bool contact_domain = false;  // a line beyond δ̄ ≤ l²/R_e: its load, and what follows from it, is NaN

    State derivative{};
    double power_crank = 0;                          // F_A · v_A, or F_x vx of a driven slider [W]
    double power_load = 0;                           // of the scene's loads [W]
    double power_ground = 0;                         // of the ground's motion, the crank's own mass left aside [W]
    double loss_springs = 0;                         // of the dampers of springs and stops [W]
    double loss_film = 0;                            // of the oil film [W]
    double power_friction = 0;                       // loss, -Σ F_t · v_t [W]
    double power_damping = 0;                        // loss, Σ (F - F_elastic) δ' [W]
    std::array<double, 8> pen_y{}, pen_z{};          // δ [m], > 0 in contact
    std::array<double, 8> rate_y{}, rate_z{};        // δ' [m/s]
    std::array<double, 8> fn_y{}, fn_z{};            // normal force [N]
    std::array<double, 8> elastic_y{}, elastic_z{};  // its elastic part [N]
    std::array<double, 8> slip_y{}, slip_z{};        // |v_t| [m/s], of every pair, touching or not
    std::array<double, 8> ahead{};                   // of the slider's centre, along the way [m]: P1 … P8
    int surfaces = 0, lines = 0, points = 0;
    std::array<FaceKind, face_count> faces{};
    double energy = 0;                    // E of section 8 [J], potentials included
    double contact_potential = 0;         // U [J]
    double crank_torque = 0;              // (A x F_A)_z [N m], as in the golden tables; 0 without a crank
    double crank_torque_with_weight = 0;  // with the weight of the crank itself
    double x = 0, vx = 0;                 // slider's centre along X [m], [m/s]
    Vector acceleration{};                // of the slider's centre [m/s²]
    double acceleration_top = 0;    // along K's Y of the body point (0, w_a/2 + 10 mm, 0), without gravity [m/s²]
    double acceleration_front = 0;  // along K's Z of (0, 0, w_b/2 + 10 mm)
    Vector rod_angular_velocity{};  // no spin about the rod [rad/s]
    Vector pin_force{};             // F_A, on the rod at the crank pin [N]
    Vector rod_force{};             // on the slider at the rod's pin [N]
    Vector contact_force{};         // Σ of the joint, friction included, inertial frame [N]
    Vector film_force{};            // of the oil film, likewise [N]
    double film_load = 0;           // Σ of its forces' magnitudes [N]
    Vector normal_force{};          // Σ normal forces, without the way's X, inertial frame [N]
    Vector normal_torque{};         // their torque about the slider's centre, inertial frame [N m]
    double ideal_x = 0;             // of the mechanism without clearance [m]; NaN if it does not reach, or is free
};

/// Fills the inputs that follow from others (section 2): a slider of 40 x 20 x 30 mm, crank and rod of their sections.
slideway::Inputs completed(slideway::Inputs inputs);

/// Everything at one instant, of the mechanism that the parts name, a spatial one.  Parts rule: no friction, no way pose,
/// no χ where they say so, whatever the inputs hold.
/// @param impact_speeds v0 [m/s] per pair for Damping::restitution, its start value 1e-4 where null
/// @throws std::invalid_argument for a mechanism that is not spatial
Result evaluate(slideway::Inputs const& completed, slideway::Parts const& parts, double t, State const& state,
                Pairs const* impact_speeds = nullptr);

/// The sixteen δ [m] alone; NaN where the rod does not reach.
Pairs penetrations(slideway::Inputs const& completed, slideway::Parts const& parts, double t, State const& state);

/// How a mechanism prescribes the slider's motion along the way.
struct AlongTheWay {
    long double x = 0, vx = 0, ax = 0;  // [m], [m/s], [m/s²]
};
/// A carriage at constant speed whose direction is reversed along half a cosine (model.md 7).  @param t >= 0 [s]
AlongTheWay carriage_motion(slideway::Inputs const& inputs, long double t);
/// The pin of a crank in a slot across the way: x = r cos θ, θ = θ0 + ωt (model.md 12).  @param t [s]
AlongTheWay scotch_yoke_motion(slideway::Inputs const& inputs, long double t);

// Pieces of the laws, for tests of their own.
double friction_coefficient(slideway::Inputs const& inputs, double speed);
/// Total load P [N] of a line of length l [m] at approach δ̄ [m]; NaN beyond l²/R_e.
double line_load(slideway::Inputs const& inputs, double length, double approach);
/// Its potential V [J], ∂V/∂δ̄ = P.
double line_potential(slideway::Inputs const& inputs, double length, double approach);
/// a in the damping factor 1 + a h'/v0: the root in (0, 1/e) of a(1+e) = ln[(1+a)/(1-ea)]; 0 at e = 1.
double restitution_slope(double restitution);

}  // namespace oracle
