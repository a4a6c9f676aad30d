#include "offset_slider.hpp"

#include <Eigen/Geometry>

#include "linear_solve.hpp"
#include "poses.hpp"

namespace oracle::detail {
namespace {

/// Rows of momentum and of moment about G, of the slider: columns 0 to 2 are u'', 3 to 5 ω' along the axes of the ground.
struct SliderRows {
    Vector3 spin, pin, centre;  // ω; P and G from u
    Matrix3 inertia;            // about G, along the axes of the ground
    Real mass;

    SliderRows(Inputs const& in, Parts const& parts, SliderMotion const& slider) : mass(in.slider_mass) {
        Matrix3 const attitude = slider.pose.topLeftCorner<3, 3>();
        spin = attitude * slider.angular_velocity;
        pin = pin_of(in, parts, attitude);
        centre = mass_centre_of(in, parts, attitude);
        Vector3 const own(in.slider_inertia_x, in.slider_inertia_y, in.slider_inertia_z);
        inertia = attitude * own.asDiagonal() * attitude.transpose();
    }
    /// Acceleration of a point at r is u'' − r × ω' + this.
    [[nodiscard]] Vector3 pull(Vector3 const& r) const { return spin.cross(spin.cross(r)); }

    void put(Matrix& matrix, Matrix& right, Vector3 const& gravity, Vector3 const& force, Vector3 const& torque) const {
        matrix.block(0, 0, 3, 3) = mass * Matrix3::Identity();
        matrix.block(0, 3, 3, 3) = -mass * cross_matrix(centre);
        right.block(0, 0, 3, 1) = force + mass * gravity - mass * pull(centre);
        matrix.block(3, 3, 3, 3) = inertia;
        right.block(3, 0, 3, 1) = torque - centre.cross(force) - spin.cross(inertia * spin);
    }
};

Matrix nothing(int rows, int columns) { return Matrix::Zero(rows, columns); }

}  // namespace

Vector3 pin_of(Inputs const& in, Parts const& parts, Matrix3 const& attitude) {
    if (!parts.offset_slider) return Vector3::Zero();
    return attitude * Vector3(in.pin_x, in.pin_y, in.pin_z);
}
Vector3 mass_centre_of(Inputs const& in, Parts const& parts, Matrix3 const& attitude) {
    if (!parts.offset_slider) return Vector3::Zero();
    return attitude * Vector3(in.mass_center_x, in.mass_center_y, in.mass_center_z);
}

Motion solve_offset_motion(Inputs const& in, Kinematics const& k, Vector3 const& gravity, Vector3 const& force, Vector3 const& torque) {
    Parts parts;
    parts.offset_slider = true;
    SliderRows const slider(in, parts, k.slider);
    Real const rod = in.rod_mass, fraction = in.rod_mass_center, length = in.rod_length;
    Vector3 const span = k.end - k.pin, spread = k.end_velocity - k.pin_velocity;
    Vector3 const across_1 = span.unitOrthogonal(), across_2 = span.cross(across_1).normalized();
    Matrix matrix = nothing(12, 12), right = nothing(12, 1);
    Matrix3 const one = Matrix3::Identity(), turned = -cross_matrix(slider.pin);
    Vector3 const pull = slider.pull(slider.pin);
    slider.put(matrix, right, gravity, force, torque);
    // The slider has −F_P, at P.
    matrix.block(0, 9, 3, 3) = one;
    matrix.block(3, 9, 3, 3) = cross_matrix(slider.pin - slider.centre);
    // m_r [(1 - f) a_A + f a_P] = F_A + F_P + m_r g
    matrix.block(6, 0, 3, 3) = rod * fraction * one;
    matrix.block(6, 3, 3, 3) = rod * fraction * turned;
    matrix.block(6, 6, 3, 3) = matrix.block(6, 9, 3, 3) = -one;
    right.block(6, 0, 3, 1) = rod * gravity - rod * (1 - fraction) * k.pin_acceleration - rod * fraction * pull;
    // J d × (a_P - a_A)/L² = -f d × F_A + (1 - f) d × F_P, d = P - A
    Eigen::Matrix<Real, 2, 3> across;
    across << across_1.transpose(), across_2.transpose();
    Eigen::Matrix<Real, 2, 3> const moment = across * cross_matrix(span);
    Real const spin = Real(in.rod_inertia) / (length * length);
    matrix.block(9, 0, 2, 3) = spin * moment;
    matrix.block(9, 3, 2, 3) = spin * moment * turned;
    matrix.block(9, 6, 2, 3) = fraction * moment;
    matrix.block(9, 9, 2, 3) = -(1 - fraction) * moment;
    right.block(9, 0, 2, 1) = spin * moment * (k.pin_acceleration - pull);
    // d · (a_P - a_A) = -|d'|²
    matrix.block(11, 0, 1, 3) = span.transpose();
    matrix.block(11, 3, 1, 3) = span.transpose() * turned;
    right(11, 0) = span.dot(k.pin_acceleration - pull) - spread.squaredNorm();

    Matrix const a = solution(matrix, right);
    Matrix3 const attitude = k.slider.pose.topLeftCorner<3, 3>();
    return {a.block(0, 0, 3, 1), a.block(6, 0, 3, 1), -a.block(9, 0, 3, 1), attitude.transpose() * Vector3(a.block(3, 0, 3, 1))};
}

Motion solve_guided_motion(Inputs const& in, Parts const& parts, SliderMotion const& moves, Vector3 const& gravity, Vector3 const& force, Vector3 const& torque,
                           std::optional<Real> ax) {
    SliderRows const slider(in, parts, moves);
    int const size = ax ? 7 : 6;
    Matrix matrix = nothing(size, size), right = nothing(size, 1);
    slider.put(matrix, right, gravity, force, torque);
    if (ax) {
        // The push (R, 0, 0) at P.
        matrix(0, 6) = -1;
        matrix.block(3, 6, 3, 1) = -(slider.pin - slider.centre).cross(Vector3::UnitX());
        matrix(6, 0) = 1;
        matrix.block(6, 3, 1, 3) = -cross_matrix(slider.pin).row(0);
        right(6, 0) = *ax - slider.pull(slider.pin).x();
    }
    Matrix const a = solution(matrix, right);
    Matrix3 const attitude = moves.pose.topLeftCorner<3, 3>();
    return {a.block(0, 0, 3, 1), Vector3(ax ? a(6, 0) : Real(0), 0, 0), Vector3::Zero(), attitude.transpose() * Vector3(a.block(3, 0, 3, 1))};
}

}  // namespace oracle::detail
