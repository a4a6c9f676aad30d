#include "poses.hpp"

#include <cmath>

#include "linear_solve.hpp"

namespace oracle::detail {

Matrix4 translation(Vector3 const& u) {
    Matrix4 matrix = Matrix4::Identity();
    matrix.topRightCorner<3, 1>() = u;
    return matrix;
}

Matrix4 rotation(int axis, Real angle) {
    int const next = (axis + 1) % 3, last = (axis + 2) % 3;
    Matrix4 matrix = Matrix4::Identity();
    matrix(next, next) = matrix(last, last) = std::cos(angle);
    matrix(last, next) = std::sin(angle);
    matrix(next, last) = -std::sin(angle);
    return matrix;
}

Matrix4 pose_of(Vector3 const& centre, Real roll, Real yaw, Real pitch) {
    return translation(centre) * rotation(2, pitch) * rotation(1, yaw) * rotation(0, roll);
}

Matrix4 inverse_of(Matrix4 const& pose) {
    Matrix4 inverse = Matrix4::Identity();
    inverse.topLeftCorner<3, 3>() = pose.topLeftCorner<3, 3>().transpose();
    inverse.topRightCorner<3, 1>() = -pose.topLeftCorner<3, 3>().transpose() * pose.topRightCorner<3, 1>();
    return inverse;
}

Matrix3 cross_matrix(Vector3 const& w) {
    Matrix3 matrix;
    matrix << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
    return matrix;
}

Vector3 euler_rates(Real roll, Real yaw, Vector3 const& angular_velocity) {
    Matrix3 const to_body_x = rotation(0, roll).topLeftCorner<3, 3>().transpose();
    Matrix3 const to_body_yx = to_body_x * rotation(1, yaw).topLeftCorner<3, 3>().transpose();
    Matrix3 axes;
    axes << Vector3::UnitX(), to_body_x * Vector3::UnitY(), to_body_yx * Vector3::UnitZ();
    return solution(axes, angular_velocity);
}

}  // namespace oracle::detail
