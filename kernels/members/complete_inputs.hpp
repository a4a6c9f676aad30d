// The inputs of a member with what follows from others: each rule once, with its words.
#pragma once

#include <cmath>
#include <string_view>

#include "kernels/inputs.hpp"
#include "kernels/mechanisms/mechanism_info.hpp"

namespace slideway {

/// The solid that a slider is taken for where its mass or inertia is not given.
enum class SliderSolid {
    block,   // slider_length × way_width × way_depth, as if the hole were filled (Qian et al. 2020, Table 6)
    hollow,  // four walls of a thickness t around the way's section: the clearance counts as none
    planar,  // slider_length × slider_height × slider_depth
};

static inline SliderSolid solid_of(MechanismInfo const& mechanism, Inputs const& in) {
    if (!mechanism.spatial) return SliderSolid::planar;
    return in.wall > 0 ? SliderSolid::hollow : SliderSolid::block;
}

/// How an input that was not given follows from others.
struct DerivedInput {
    double Inputs::*member;
    std::string_view words;          // of the last parts of keys
    double (*value)(Inputs const&);  // in SI, from inputs that are given or stand above it in the table; nullptr where it is left open (face_clearance)
    bool of_one_solid = false;       // it holds for `solid` alone
    SliderSolid solid = SliderSolid::block;
};

// Area of a hollow slider's section [m²], and twelve times the mean squares of Y and Z over it [m²]: those of the outer rectangle less those
// of the hole.
namespace hollow_section {
static inline double area(Inputs const& in) { return 2 * in.wall * (in.way_width + in.way_depth + 2 * in.wall); }
static inline double square_y(Inputs const& in) {
    double const y = in.way_width, z = in.way_depth, outer_y = y + 2 * in.wall, outer_z = z + 2 * in.wall;
    return (outer_y * outer_y * outer_y * outer_z - y * y * y * z) / area(in);
}
static inline double square_z(Inputs const& in) {
    double const y = in.way_width, z = in.way_depth, outer_y = y + 2 * in.wall, outer_z = z + 2 * in.wall;
    return (outer_z * outer_z * outer_z * outer_y - z * z * z * y) / area(in);
}
}  // namespace hollow_section

/// All that follows (model.md 2), in the order in which it is filled in: masses before inertias.  Rods and cranks are slender: J = m l²/12.
/// The order of the factors is part of the bits.
static constexpr DerivedInput derived_inputs[] = {
    {&Inputs::crank_mass, "density x crank_section x crank_length",
     [](Inputs const& in) { return in.density * in.crank_section * in.crank_length; }},
    {&Inputs::rod_mass, "density x rod_section x rod_length",
     [](Inputs const& in) { return in.density * in.rod_section * in.rod_length; }},
    {&Inputs::rod_inertia, "rod_mass x rod_length^2 / 12",
     [](Inputs const& in) { return in.rod_mass * in.rod_length * in.rod_length / 12; }},
    {&Inputs::crank_inertia, "crank_mass x crank_length^2 / 12",
     [](Inputs const& in) { return in.crank_mass * in.crank_length * in.crank_length / 12; }},

    {&Inputs::slider_mass, "density x slider_length x way_width x way_depth",
     [](Inputs const& in) { return in.density * in.slider_length * in.way_width * in.way_depth; }, true, SliderSolid::block},
    {&Inputs::slider_mass, "density x slider_length x 2 wall x (way_width + way_depth + 2 wall)",
     [](Inputs const& in) { return in.density * in.slider_length * hollow_section::area(in); }, true, SliderSolid::hollow},
    {&Inputs::slider_mass, "density x slider_length x slider_height x slider_depth",
     [](Inputs const& in) { return in.density * in.slider_length * in.slider_height * in.slider_depth; }, true, SliderSolid::planar},

    {&Inputs::slider_inertia_x, "slider_mass x (way_width^2 + way_depth^2) / 12",
     [](Inputs const& in) { return in.slider_mass * (in.way_width * in.way_width + in.way_depth * in.way_depth) / 12; }, true,
     SliderSolid::block},
    {&Inputs::slider_inertia_y, "slider_mass x (slider_length^2 + way_depth^2) / 12",
     [](Inputs const& in) { return in.slider_mass * (in.slider_length * in.slider_length + in.way_depth * in.way_depth) / 12; }, true,
     SliderSolid::block},
    {&Inputs::slider_inertia_z, "slider_mass x (slider_length^2 + way_width^2) / 12",
     [](Inputs const& in) { return in.slider_mass * (in.slider_length * in.slider_length + in.way_width * in.way_width) / 12; }, true,
     SliderSolid::block},
    {&Inputs::slider_inertia_x, "of slider_mass in walls of thickness wall around way_width x way_depth",
     [](Inputs const& in) { return in.slider_mass * (hollow_section::square_y(in) + hollow_section::square_z(in)) / 12; }, true,
     SliderSolid::hollow},
    {&Inputs::slider_inertia_y, "of slider_mass in walls of thickness wall around way_width x way_depth",
     [](Inputs const& in) { return in.slider_mass * (in.slider_length * in.slider_length + hollow_section::square_z(in)) / 12; }, true,
     SliderSolid::hollow},
    {&Inputs::slider_inertia_z, "of slider_mass in walls of thickness wall around way_width x way_depth",
     [](Inputs const& in) { return in.slider_mass * (in.slider_length * in.slider_length + hollow_section::square_y(in)) / 12; }, true,
     SliderSolid::hollow},
    {&Inputs::slider_inertia_z, "slider_mass x (slider_length^2 + slider_height^2) / 12",
     [](Inputs const& in) { return in.slider_mass * (in.slider_length * in.slider_length + in.slider_height * in.slider_height) / 12; }, true,
     SliderSolid::planar},

    {&Inputs::clearance_y_plus, "clearance_y", nullptr},
    {&Inputs::clearance_y_minus, "clearance_y", nullptr},
    {&Inputs::clearance_z_plus, "clearance_z", nullptr},
    {&Inputs::clearance_z_minus, "clearance_z", nullptr},
    {&Inputs::thickness_y, "way_width", [](Inputs const& in) { return in.way_width; }},
    {&Inputs::thickness_z, "way_depth", [](Inputs const& in) { return in.way_depth; }},
    {&Inputs::point_stiffness, "4/3 E* sqrt(apex_radius)",
     [](Inputs const& in) {
         double const nu1 = in.slider_poisson_ratio, nu2 = in.way_poisson_ratio;
         double const reduced = 1 / ((1 - nu1 * nu1) / in.slider_young_modulus + (1 - nu2 * nu2) / in.way_young_modulus);
         return 4.0 / 3.0 * reduced * std::sqrt(in.apex_radius);
     }},
};

/// The rule by which an input follows with a slider of this solid; nullptr where there is none.
static inline DerivedInput const* derivation_of(double Inputs::*member, SliderSolid solid) {
    for (DerivedInput const& rule : derived_inputs) {
        if (rule.member == member && (!rule.of_one_solid || rule.solid == solid)) return &rule;
    }
    return nullptr;
}

/// Fills what was left to follow from other inputs (masses, inertias, thicknesses, point stiffness; model.md 2): what is `follows`, not a number.
/// @param mechanism says which solid its slider is
static inline Inputs complete_inputs(Inputs given, MechanismInfo const& mechanism = spatial_slider_info()) {
    SliderSolid const solid = solid_of(mechanism, given);
    for (DerivedInput const& rule : derived_inputs) {
        if (rule.value == nullptr || (rule.of_one_solid && rule.solid != solid)) continue;
        if (std::isnan(given.*rule.member)) given.*rule.member = rule.value(given);
    }
    return given;
}

}  // namespace slideway
