#include "slider_frame.hpp"

#include <cmath>

#include "linear_solve.hpp"
#include "mechanism.hpp"
#include "offset_slider.hpp"
#include "pairs.hpp"
#include "poses.hpp"
#include "kernels/mechanisms/list.hpp"

namespace oracle::detail {

Vector6 SliderPlace::rates() const {
    Vector6 v;
    v << velocity, spin;
    return v;
}

void SliderPlace::set_rates(Vector6 const& v) { velocity = v.head<3>(), spin = v.tail<3>(); }

void SliderPlace::shift(Vector6 const& by) {
    centre += by.head<3>();
    Vector3 const half = by.tail<3>() / 2;
    attitude = (attitude * Eigen::Quaternion<Real>(1, half.x(), half.y(), half.z())).normalized();
}

SliderFrame::SliderFrame(Inputs const& in, Parts const& parts) : in_(in), parts_(parts) {
    Matrix4 const pose = pose_of_way(in, parts);
    way_ = pose.topLeftCorner<3, 3>(), way_centre_ = pose.topRightCorner<3, 1>();
    Real const slope = in.inclination;
    gravity_ = -Real(in.gravity) * Vector3(std::sin(slope), std::cos(slope), 0);
    inertia_ = Vector3(in.slider_inertia_x, in.slider_inertia_y, in.slider_inertia_z);
}

SliderPlace SliderFrame::start() const {
    using Turn = Eigen::AngleAxis<Real>;
    SliderPlace p;
    p.centre = Vector3(in_.x, in_.y, in_.z), p.velocity = Vector3(in_.vx, in_.vy, in_.vz);
    p.attitude = Turn(in_.pitch, Vector3::UnitZ()) * Turn(in_.yaw, Vector3::UnitY()) * Turn(in_.roll, Vector3::UnitX());
    p.spin = Vector3(in_.wx, in_.wy, in_.wz);
    Matrix3 const attitude = p.attitude.toRotationMatrix();
    Vector3 const arm = pin_of(in_, parts_, attitude), arm_velocity = (attitude * p.spin).cross(arm);
    auto const along = [&](AlongTheWay const& drive) { p.centre.x() = drive.x - arm.x(), p.velocity.x() = drive.vx - arm_velocity.x(); };
    if (parts_.mechanism == Mechanism::carriage) along(carriage_motion(in_, 0));
    if (parts_.mechanism == Mechanism::scotch_yoke) along(scotch_yoke_motion(in_, 0));
    if (parts_.mechanism == Mechanism::slider_crank) {
        State state{in_.y, in_.z, in_.vy, in_.vz, in_.roll, in_.yaw, in_.pitch, in_.wx, in_.wy, in_.wz};
        Kinematics const k = kinematics_of(in_, parts_, crank_motion(in_, parts_, 0, {}), state);
        p.centre = k.slider.centre, p.velocity = k.slider.velocity;
    }
    return p;
}

std::array<Real, 12> SliderFrame::state(SliderPlace const& p) {
    Matrix3 const a = p.attitude.toRotationMatrix();
    Real const roll = std::atan2(a(2, 1), a(2, 2)), yaw = -std::asin(a(2, 0)), pitch = std::atan2(a(1, 0), a(0, 0));
    return {p.centre.y(), p.centre.z(), p.velocity.y(), p.velocity.z(), roll,         yaw,
            pitch,        p.spin.x(),   p.spin.y(),     p.spin.z(),     p.centre.x(), p.velocity.x()};
}

void SliderFrame::move_to(SliderPlace const& place) {
    place_ = place;
    attitude_ = way_.transpose() * place.attitude.toRotationMatrix();
    centre_ = way_.transpose() * (place.centre - way_centre_);
    velocity_ = way_.transpose() * place.velocity;
    turn_ = attitude_ * place.spin;

    Real const mass = in_.slider_mass;
    Vector3 const centre = mass_centre_of(in_, parts_, place.attitude.toRotationMatrix());
    Jacobian const moves = jacobian(centre);
    Vector6 force = moves.transpose() * (mass * (gravity_ - pull(centre)));
    force.tail<3>() -= place.spin.cross(inertia_.cwiseProduct(place.spin));
    Matrix6 masses = mass * moves.transpose() * moves;
    masses.diagonal().tail<3>() += inertia_;
    energy_ = mass * (moves * place.rates()).squaredNorm() / 2 + place.spin.dot(inertia_.cwiseProduct(place.spin)) / 2 -
              mass * gravity_.dot(place.centre + centre);
    add_drive(force, masses);
}

SliderFrame::Jacobian SliderFrame::jacobian(Vector3 const& r) const {
    Jacobian j;
    j << Matrix3::Identity(), -cross_matrix(r) * place_.attitude.toRotationMatrix();
    return j;
}

Vector3 SliderFrame::pull(Vector3 const& r) const {
    Vector3 const spin = place_.attitude.toRotationMatrix() * place_.spin;
    return spin.cross(spin.cross(r));
}

/// The drive's force acts along a direction, in which it prescribes the acceleration.
void SliderFrame::add_drive(Vector6 const& slider_force, Matrix6 const& slider_masses) {
    Vector6 force = slider_force, direction = Vector6::Zero();
    Matrix6 masses = slider_masses;
    Real along = 0;
    Vector3 const arm = pin_of(in_, parts_, place_.attitude.toRotationMatrix());
    Jacobian const moves = jacobian(arm);
    auto const along_x = [&](Real acceleration) { direction = moves.row(0).transpose(), along = acceleration - pull(arm).x(); };
    switch (parts_.mechanism) {
        case Mechanism::carriage:
            along_x(carriage_motion(in_, place_.time).ax);
            break;
        case Mechanism::scotch_yoke:
            along_x(scotch_yoke_motion(in_, place_.time).ax);
            break;
        case Mechanism::slider_crank: {
            // The rod is two masses and their coupling (M6.2); |AB| = L is differentiated twice.
            Real const rod = in_.rod_mass, part = in_.rod_mass_center,
                       spread = Real(in_.rod_inertia) / (Real(in_.rod_length) * in_.rod_length);
            Real const at_slider = rod * part * part + spread, coupling = rod * part * (1 - part) - spread;
            Real const speed = in_.crank_speed, angle = Real(in_.start_angle) + speed * place_.time;
            Vector3 const pin = Real(in_.crank_length) * Vector3(std::cos(angle), std::sin(angle), 0);
            Vector3 const pin_velocity = speed * Vector3::UnitZ().cross(pin), pin_acceleration = -speed * speed * pin;
            masses += at_slider * moves.transpose() * moves;
            force += moves.transpose() * (rod * part * gravity_ - coupling * pin_acceleration - at_slider * pull(arm));
            Vector3 const span = place_.centre + arm - pin, relative = moves * place_.rates() - pin_velocity;
            direction = moves.transpose() * span;
            along = span.dot(pin_acceleration - pull(arm)) - relative.squaredNorm();
            break;
        }
        case Mechanism::slider_crank_motor:
        case Mechanism::scotch_yoke_motor:
            throw std::invalid_argument("oracle: a crank that turns freely has no rigid contacts");
        case Mechanism::free_slider:
        case Mechanism::planar_slider_crank:
            break;
    }
    mobility_ = solution(masses, Matrix6::Identity());
    free_ = mobility_ * force;
    if (direction.isZero(0)) return;
    Vector6 const yields = mobility_ * direction;
    Real const weight = direction.dot(yields);
    mobility_ -= yields * yields.transpose() / weight;
    free_ += yields * ((along - direction.dot(free_)) / weight);
}

SliderFrame::Apex3 SliderFrame::apex(int number) const {
    auto const [s1, s2, s3] = apices[number % 8];
    Vector3 const arm(s3 * Real(in_.slider_length) / 2, s1 * Real(in_.way_width) / 2 - centre_.y(),
                      s2 * Real(in_.way_depth) / 2 - centre_.z());
    return number < 8 ? Apex3{1, Real(s1), arm} : Apex3{2, Real(s2), arm};
}

Real SliderFrame::gap(int number) const {
    auto const [axis, side, arm] = apex(number);
    Real const half_hole =
        axis == 1 ? Real(in_.way_width) / 2 + in_.clearance_y : Real(in_.way_depth) / 2 + in_.clearance_z;
    return half_hole - side * attitude_.col(axis).dot(arm);
}

SliderPair SliderFrame::pair(int number) const {
    auto const [axis, side, arm] = apex(number);
    SliderPair p;
    p.gap = gap(number);
    Vector3 const normal = attitude_.col(axis), arm_rate(0, -velocity_.y(), -velocity_.z()),
                  slip = velocity_ + turn_.cross(arm);
    auto const row = [&](int i, Vector3 const& force, Vector3 const& torque) {
        p.rows.block<1, 3>(i, 0) = (way_ * force).transpose();
        p.rows.block<1, 3>(i, 3) = (attitude_.transpose() * torque).transpose();
    };
    // gap = constant − side normal · arm; the arm has no part along the way in the slider's motion.
    row(0, side * Vector3(0, normal.y(), normal.z()), side * arm.cross(normal));
    p.biases[0] = -side * (turn_.cross(turn_.cross(normal)).dot(arm) + 2 * turn_.cross(normal).dot(arm_rate));
    for (int i = 1; i <= 2; ++i) {
        Vector3 const along = attitude_.col(i == 1 ? 0 : 3 - axis);
        row(i, along, arm.cross(along));
        p.biases[i] = turn_.cross(along).dot(slip) + along.dot(turn_.cross(arm_rate));
    }
    return p;
}

}  // namespace oracle::detail
