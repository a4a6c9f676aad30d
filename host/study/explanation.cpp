#include "host/study/explanation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/base/numbers.hpp"
#include "host/config/descriptors.hpp"

namespace slideway {
namespace {

/// μ(V) (M5.2).
double friction_coefficient(double speed, Inputs const& in) {
    double const rise = in.friction_stick_speed, most = in.friction_static, least = in.friction_kinetic;
    if (speed < rise) return most * std::sin(std::numbers::pi * speed / (2 * rise));
    if (speed >= in.friction_slip_speed) return least;
    return (most + least) / 2 + (most - least) / 2 * std::cos(std::numbers::pi * (speed - rise) / (in.friction_slip_speed - rise));
}

/// The contacts of a face (M4.1).
void add_modes(std::vector<FaceMode>& modes, int face, std::array<bool, 4> const& touches) {
    auto const& apices = face_apices[face];
    if (std::ranges::count(touches, true) == 4) {
        modes.push_back({face, "surface", {std::begin(apices), std::end(apices)}});
        return;
    }
    for (std::size_t i = 0; i < 4; ++i) {
        std::size_t const next = (i + 1) % 4, last = (i + 3) % 4;
        if (touches[i] && touches[next]) modes.push_back({face, "line", {apices[i], apices[next]}});
        if (touches[i] && !touches[next] && !touches[last]) modes.push_back({face, "point", {apices[i]}});
    }
}

}  // namespace

std::string ApexPair::name() const { return fmt::format("P{} {}", apex + 1, face_names[face]); }

ApexPair const& Explanation::nearest() const { return *std::ranges::max_element(pairs, {}, &ApexPair::depth); }

Explanation explain(StateTable const& table, std::size_t row, ProbeResult const& result) {
    MechanismInfo const& mechanism = info(table.mechanism);
    if (!mechanism.spatial)
        throw SceneError(fmt::format("--explain follows the forces of sliders with eight apices, and a {} has corners; leave it out", mechanism.name));
    Inputs const& in = table.inputs[row];
    Parts const& parts = table.parts[row];
    bool const is_told = selects(mechanism.series, Series::face_force_y_plus) && !parts.rigid;
    auto const known = [&](double value) { return is_told ? value + 0.0 : nan; };  // no −0
    Explanation found{};
    for (int face = 0; face < 4; ++face) {
        bool const is_y = face < 2;
        std::array<bool, 4> touches{};
        for (std::size_t i = 0; i < 4; ++i) {
            int const apex = face_apices[face][i];
            auto const of = [&](double const(&y)[8], double const(&z)[8]) { return (is_y ? y : z)[apex]; };
            ApexPair pair{apex, face, of(result.penetration_y, result.penetration_z), known(of(result.approach_y, result.approach_z)),
                          known(of(result.normal_force_y, result.normal_force_z)), known(of(result.sliding_y, result.sliding_z)), known(0), 0};
            if (parts.friction) pair.coefficient = friction_coefficient(pair.sliding, in);
            pair.friction = pair.coefficient * pair.normal_force;
            touches[i] = pair.touches();
            found.pairs.push_back(pair);
        }
        if (is_told) add_modes(found.modes, face, touches);
    }
    auto const vector = [&](Series first, std::size_t i) { return known(result.forces[static_cast<std::size_t>(first) - first_force_series + i]); };
    for (std::size_t i = 0; i < 3; ++i) {
        found.friction[i] = vector(Series::friction_force_x, i);
        found.force[i] = vector(Series::contact_force_x, i);
        found.torque[i] = known(result.torque[i]);
    }
    found.length = in.slider_length, found.width = in.way_width, found.depth = in.way_depth;
    return found;
}

}  // namespace slideway
