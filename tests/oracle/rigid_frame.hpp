// What a state of the planar slider-crank says of inertia, loads and corners: M q'' = load + forces in the corners.
#pragma once

#include <array>

#include "numbers.hpp"
#include "planar.hpp"

namespace oracle::detail {

struct RigidFrame {
    using Row = Eigen::Matrix<Real, 1, 3>;
    Matrix3 mass = Matrix3::Zero();
    Vector3 load = Vector3::Zero();
    std::array<Real, 4> gap{}, normal_bias{}, tangent_bias{};
    std::array<Row, 4> normal{}, tangent{};  // of corners: gap' = normal q', slip = tangent q'
    Real energy = 0;
};

RigidFrame rigid_frame(Inputs const& in, PlanarState const& state);

}  // namespace oracle::detail
