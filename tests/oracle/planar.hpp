// The oracle of planar_slider_crank (model.md 7): a block between two walls, moved by a crank and a rod in one plane.
// A dense mass matrix from the Jacobians of the bodies' centres, and plain sines where the kernels work clearance first.
#pragma once

#include <array>
#include <cstdint>
#include <kernels/inputs.hpp>
#include <vector>

namespace oracle {

/// θ1 θ2 ψ [rad], θ1' θ2' ψ' [rad/s]; all angles from X.
using PlanarState = std::array<long double, 6>;
/// C1(+,+) C2(+,-) C3(-,-) C4(-,+), signs along X of the block and along Y.
using Corners = std::array<long double, 4>;

struct PlanarResult {
    PlanarState derivative{};
    Corners depth{}, rate{};                            // δ [m], > 0 in contact; δ' [m/s]
    Corners elastic{}, force{};                         // [N], along Y
    Corners slip{};                                     // of the corner along X [m/s]
    int surfaces = 0, points = 0;                       // two adjacent corners are a surface
    long double x = 0, y = 0;                           // the block's centre [m]
    long double vx = 0, vy = 0;                         // [m/s]
    long double ax = 0, ay = 0;                         // [m/s²]
    long double energy = 0;                             // of all three bodies, crank included, and of the contacts [J]
    long double contact_potential = 0;                  // [J]
    long double drive_torque = 0;                       // what holds the crank's speed [N m]; 0 of a free crank
    long double power_drive = 0;                        // its power [W]
    long double power_load = 0;                         // of the scene's loads [W]
    long double power_ground = 0;                       // of the ground's motion [W]
    long double loss_springs = 0;                       // of the dampers of springs and stops [W]
    long double power_friction = 0, power_damping = 0;  // losses [W]
};

/// The state that the inputs start from: θ1 = start_angle, θ1' = crank_speed, θ2 and θ2' from y and vy, with the rod
/// pointing along +X.
PlanarState planar_start(slideway::Inputs const& inputs);

class PlanarMechanism {
public:
    PlanarMechanism(slideway::Inputs const& completed, slideway::Parts const& parts);

    /// Everything at one instant.  @param impact_speeds v0 [m/s] for Damping::restitution, its start value 1e-4 where
    /// null and never less.  @param torque on a free crank [N m], as a drive would exert it  @param time that loads are read at [s]
    [[nodiscard]] PlanarResult at(PlanarState const& state, Corners const* impact_speeds = nullptr,
                                  long double torque = 0, long double time = 0) const;

private:
    void load_corner(int i, long double impact_speed, PlanarResult& result) const;

    slideway::Inputs in_;
    slideway::Parts parts_;
    long double stiffness_ = 0, slope_ = 0;  // K [N/mⁿ]; a of the restitution
};

struct PlanarCase {
    slideway::Inputs inputs;  // completed; they hold the state as well
    slideway::Parts parts;
    Corners impact_speeds{};
};

/// Seeded cases: number i has parts i mod 12 of 3 dampings x friction x driven or free, and, in turn, no corner in
/// contact, one, two of a wall (every other time to the last bit alike), two opposite ones; 3e-8 to 3e-5 m deep, which
/// y and θ2 in double tell to nine digits.
std::vector<PlanarCase> make_planar_cases(std::uint64_t seed, int count);

}  // namespace oracle
