#include "mechanism.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "linear_solve.hpp"
#include "loads.hpp"
#include "offset_slider.hpp"
#include "poses.hpp"
#include "kernels/mechanisms/list.hpp"

namespace oracle::detail {

SliderMotion slider_motion(Vector3 const& centre, Vector3 const& velocity, State const& state) {
    SliderMotion m;
    m.centre = centre, m.velocity = velocity;
    m.roll = state[4], m.yaw = state[5], m.pitch = state[6];
    m.angular_velocity = Vector3(state[7], state[8], state[9]);
    m.pose = pose_of(m.centre, m.roll, m.yaw, m.pitch);
    m.pose_rate = Matrix4::Zero();
    m.pose_rate.topLeftCorner<3, 3>() = m.pose.topLeftCorner<3, 3>() * cross_matrix(m.angular_velocity);
    m.pose_rate.topRightCorner<3, 1>() = m.velocity;
    return m;
}

CrankMotion crank_motion(Inputs const& in, Parts const& parts, Real t, State const& state) {
    using enum slideway::DriveBy;
    switch (parts.drive.by) {
        case torque:
        case nothing: return {state[10], state[11], 0};
        case profile: {
            TableMotion const motion = table_motion(*parts.drive.table, t);
            Real const scale = in.drive_scale;
            return {in.start_angle + scale * motion.value, scale * motion.slope, scale * motion.bend};
        }
        case speed: break;
    }
    return {Real(in.start_angle) + Real(in.crank_speed) * t, in.crank_speed, 0};
}

Real motor_torque(Inputs const& in, Parts const& parts, CrankMotion const& crank, Real t) {
    if (parts.drive.by == slideway::DriveBy::speed || parts.drive.by == slideway::DriveBy::profile) return 0;
    Real torque = in.drive_torque;
    if (in.drive_no_load_speed != 0) torque *= 1 - (in.drive_torque < 0 ? -crank.speed : crank.speed) / Real(in.drive_no_load_speed);
    using enum slideway::LoadArgument;
    if (parts.drive.table != nullptr) {
        auto const over = parts.drive.over;
        torque *= table_motion(*parts.drive.table, over == crank_angle ? crank.angle : over == crank_speed ? crank.speed : t).value;
    }
    return torque - in.drive_viscous * crank.speed;
}

Kinematics kinematics_of(Inputs const& in, Parts const& parts, CrankMotion const& crank, State const& state) {
    Kinematics k;
    Real const speed = crank.speed;
    k.angle = crank.angle;
    k.pin = Real(in.crank_length) * Vector3(std::cos(k.angle), std::sin(k.angle), 0);
    k.pin_velocity = speed * Vector3::UnitZ().cross(k.pin);
    k.pin_acceleration = crank.acceleration * Vector3::UnitZ().cross(k.pin) - speed * speed * k.pin;

    Real const y = state[0], z = state[1], vy = state[2], vz = state[3];
    SliderMotion const turned = slider_motion(Vector3::Zero(), Vector3::Zero(), state);
    Matrix3 const attitude = turned.pose.topLeftCorner<3, 3>();
    Vector3 const arm = pin_of(in, parts, attitude), arm_velocity = (attitude * turned.angular_velocity).cross(arm);
    Real const above = y + arm.y() - k.pin.y(), aside = z + arm.z();
    Real const reach = Real(in.rod_length) * in.rod_length - above * above - aside * aside;
    k.reached = reach > 0;
    if (!k.reached) return k;
    Real const along = std::sqrt(reach);
    // (B - A) · (v_B - v_A) = 0
    Real const end_vy = vy + arm_velocity.y(), end_vz = vz + arm_velocity.z();
    Real const vx = k.pin_velocity.x() - (above * (end_vy - k.pin_velocity.y()) + aside * end_vz) / along;
    k.end = Vector3(k.pin.x() + along, y + arm.y(), aside);
    k.end_velocity = Vector3(vx, end_vy, end_vz);
    k.slider = slider_motion(k.end - arm, k.end_velocity - arm_velocity, state);
    return k;
}

namespace {

/// x where the way's offset and pose are those of the inputs.
Real station_of_way(Inputs const& in, Mechanism mechanism) {
    switch (mechanism) {
        case Mechanism::slider_crank:
        case Mechanism::slider_crank_motor:
            return in.rod_length;
        case Mechanism::carriage:
        case Mechanism::scotch_yoke:
        case Mechanism::scotch_yoke_motor:
        case Mechanism::free_slider:
            return 0;
        case Mechanism::planar_slider_crank:
            break;
    }
    throw std::invalid_argument("oracle: the planar mechanism has an oracle of its own");
}

}  // namespace

Matrix4 pose_of_way(Inputs const& in, Parts const& parts) {
    Real const station = station_of_way(in, parts.mechanism);
    if (!parts.misaligned_way) return translation(Vector3(station, 0, 0));
    return pose_of(Vector3(station, in.way_offset_y, in.way_offset_z), in.way_roll, in.way_yaw, in.way_pitch);
}

Motion solve_motion(Inputs const& in, Kinematics const& k, Vector3 const& gravity, Vector3 const& contact_force) {
    Real const mass = in.slider_mass, rod = in.rod_mass, fraction = in.rod_mass_center, length = in.rod_length;
    Vector3 const span = k.end - k.pin;
    Vector3 const spread = k.end_velocity - k.pin_velocity;
    Vector3 const across_1 = span.unitOrthogonal(), across_2 = span.cross(across_1).normalized();

    Eigen::Matrix<Real, 9, 9> matrix = Eigen::Matrix<Real, 9, 9>::Zero();
    Eigen::Matrix<Real, 9, 1> right = Eigen::Matrix<Real, 9, 1>::Zero();
    Matrix3 const one = Matrix3::Identity();
    // m_r [(1 - f) a_A + f a_B] = F_A + F_B + m_r g
    matrix.block<3, 3>(0, 0) = rod * fraction * one;
    matrix.block<3, 3>(0, 3) = -one;
    matrix.block<3, 3>(0, 6) = -one;
    right.segment<3>(0) = rod * gravity - rod * (1 - fraction) * k.pin_acceleration;
    // M a_B = F_c + M g - F_B
    matrix.block<3, 3>(3, 0) = mass * one;
    matrix.block<3, 3>(3, 6) = one;
    right.segment<3>(3) = contact_force + mass * gravity;
    // J d × (a_B - a_A)/L² = -f d × F_A + (1 - f) d × F_B, d = B - A
    Eigen::Matrix<Real, 2, 3> across;
    across << across_1.transpose(), across_2.transpose();
    Eigen::Matrix<Real, 2, 3> const turned = across * cross_matrix(span);
    Real const spin = Real(in.rod_inertia) / (length * length);
    matrix.block<2, 3>(6, 0) = spin * turned;
    matrix.block<2, 3>(6, 3) = fraction * turned;
    matrix.block<2, 3>(6, 6) = -(1 - fraction) * turned;
    right.segment<2>(6) = spin * turned * k.pin_acceleration;
    // d · (a_B - a_A) = -|d'|²
    matrix.block<1, 3>(8, 0) = span.transpose();
    right[8] = span.dot(k.pin_acceleration) - spread.squaredNorm();

    Eigen::Matrix<Real, 9, 1> const accelerations = solution(matrix, right);
    return {accelerations.segment<3>(0), accelerations.segment<3>(3), -accelerations.segment<3>(6)};
}

Real slider_energy(Inputs const& in, Parts const& parts, SliderMotion const& slider, Vector3 const& gravity) {
    Vector3 const inertia(in.slider_inertia_x, in.slider_inertia_y, in.slider_inertia_z);
    Matrix3 const attitude = slider.pose.topLeftCorner<3, 3>();
    Vector3 const arm = mass_centre_of(in, parts, attitude);
    Real const twice_kinetic = in.slider_mass * (slider.velocity + (attitude * slider.angular_velocity).cross(arm)).squaredNorm() +
                               slider.angular_velocity.dot(inertia.cwiseProduct(slider.angular_velocity));
    return twice_kinetic / 2 - in.slider_mass * gravity.dot(slider.centre + arm);
}

Real rod_energy(Inputs const& in, Kinematics const& k, Vector3 const& gravity) {
    Real const fraction = in.rod_mass_center, length = in.rod_length;
    Vector3 const centre = (1 - fraction) * k.pin + fraction * k.end;
    Vector3 const velocity = (1 - fraction) * k.pin_velocity + fraction * k.end_velocity;
    Vector3 const spin = (k.end - k.pin).cross(k.end_velocity - k.pin_velocity) / (length * length);
    return (in.rod_mass * velocity.squaredNorm() + in.rod_inertia * spin.squaredNorm()) / 2 -
           in.rod_mass * gravity.dot(centre);
}

}  // namespace oracle::detail
