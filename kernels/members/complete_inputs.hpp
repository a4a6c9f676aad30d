// The inputs of a member with what follows from others.
#pragma once

#include <cmath>

#include "kernels/inputs.hpp"

namespace slideway {

/// Fills what was left to follow from other inputs (masses, inertias, thicknesses, point stiffness; model.md 2): what is `follows`, not a number.
static inline Inputs complete_inputs(Inputs given) {
    // The paper's bodies (Tables 6 and 7): sections and block in steel.
    constexpr double steel_density = 7800;                        // [kg/m³]
    constexpr double crank_section = 0.005 * 0.0025;              // [m²]
    constexpr double rod_section = 0.0142 * 0.0071;               // [m²]
    constexpr double block_x = 0.04, block_y = 0.02, block_z = 0.03;  // [m]
    Inputs& in = given;
    auto const fill = [](double& input, double value) {
        if (std::isnan(input)) input = value;
    };
    fill(in.crank_mass, steel_density * crank_section * in.crank_length);
    fill(in.rod_mass, steel_density * rod_section * in.rod_length);
    fill(in.rod_inertia, in.rod_mass * in.rod_length * in.rod_length / 12);
    fill(in.crank_inertia, in.crank_mass * in.crank_length * in.crank_length / 12);
    fill(in.slider_mass, steel_density * block_x * block_y * block_z);
    fill(in.slider_inertia_x, in.slider_mass * (block_y * block_y + block_z * block_z) / 12);
    fill(in.slider_inertia_y, in.slider_mass * (block_x * block_x + block_z * block_z) / 12);
    fill(in.slider_inertia_z, in.slider_mass * (block_x * block_x + block_y * block_y) / 12);
    fill(in.thickness_y, in.way_width);
    fill(in.thickness_z, in.way_depth);
    double const nu1 = in.slider_poisson_ratio, nu2 = in.way_poisson_ratio;
    double const reduced = 1 / ((1 - nu1 * nu1) / in.slider_young_modulus + (1 - nu2 * nu2) / in.way_young_modulus);
    fill(in.point_stiffness, 4.0 / 3.0 * reduced * std::sqrt(in.apex_radius));
    return given;
}

}  // namespace slideway
