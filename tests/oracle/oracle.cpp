#include "oracle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "joint_loads.hpp"
#include "laws.hpp"
#include "loads.hpp"
#include "mechanism.hpp"
#include "oil_film.hpp"
#include "offset_slider.hpp"
#include "pairs.hpp"
#include "poses.hpp"
#include "kernels/mechanisms/list.hpp"

namespace oracle {
namespace {

using namespace detail;

Vector array_of(Vector3 const& v) {
    return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

/// Where the mechanism has the slider, and what moves it.
struct Placed {
    bool reached = true;  // by the rod; nothing else holds where it is not
    Kinematics crank;     // of a slider-crank
    AlongTheWay drive;    // of a carriage or a scotch yoke
    SliderMotion slider;
};

Placed placed(Inputs const& in, Parts const& parts, CrankMotion const& turning, Real t, State const& state) {
    auto const along = [&](AlongTheWay const& drive) {
        // What the drive moves is the pin.
        SliderMotion const turned = slider_motion(Vector3::Zero(), Vector3::Zero(), state);
        Matrix3 const attitude = turned.pose.topLeftCorner<3, 3>();
        Vector3 const arm = pin_of(in, parts, attitude), arm_velocity = (attitude * turned.angular_velocity).cross(arm);
        Vector3 const centre(drive.x - arm.x(), state[0], state[1]), velocity(drive.vx - arm_velocity.x(), state[2], state[3]);
        return Placed{true, {}, drive, slider_motion(centre, velocity, state)};
    };
    switch (parts.mechanism) {
        case Mechanism::slider_crank:
        case Mechanism::slider_crank_motor: {
            Kinematics const crank = kinematics_of(in, parts, turning, state);
            return {crank.reached, crank, {}, crank.slider};
        }
        case Mechanism::carriage: {
            if (parts.drive.by != slideway::DriveBy::profile) return along(carriage_motion(in, t));
            TableMotion const motion = table_motion(*parts.drive.table, t);
            Real const scale = in.drive_scale;
            return along({scale * motion.value, scale * motion.slope, scale * motion.bend});
        }
        case Mechanism::scotch_yoke:
        case Mechanism::scotch_yoke_motor: {
            Real const radius = in.crank_length, cosine = radius * std::cos(turning.angle), sine = radius * std::sin(turning.angle);
            return along({cosine, -sine * turning.speed, -cosine * turning.speed * turning.speed - sine * turning.acceleration});
        }
        case Mechanism::free_slider:
            return along({state[10], state[11], 0});
        case Mechanism::planar_slider_crank:
            break;
    }
    throw std::invalid_argument("oracle: the planar mechanism has an oracle of its own");
}

/// What the ground's acceleration does to the rod [W].
Real rod_ground_power(Inputs const& in, Kinematics const& k, Vector3 const& ground) {
    Real const share = in.rod_mass_center;
    return -in.rod_mass * ground.dot((1 - share) * k.pin_velocity + share * k.end_velocity);
}

/// A crank that turns freely: J θ'' = T + (r/2 × m_c g) + T_load − (torque that it gives away).
struct Turning {
    Inputs const& in;
    Parts const& parts;
    Vector3 const& gravity;
    Real motor, load;

    [[nodiscard]] bool has_crank() const { return parts.mechanism == Mechanism::slider_crank_motor || parts.mechanism == Mechanism::slider_crank; }
    [[nodiscard]] Real crank_mass() const { return has_crank() ? Real(in.crank_mass) : 0; }
    [[nodiscard]] Real inertia() const {
        Real const arm = Real(in.crank_length) / 2;
        return in.drive_inertia + (has_crank() ? in.crank_inertia + crank_mass() * arm * arm : 0);
    }
    /// What is given away is linear in θ'': over the difference that θ'' itself makes, or that would be lost in forces that are large.
    template <class Given> Real acceleration(Given const& given, Vector3 const& pin) const {
        Real const others = motor + load + (pin / 2).cross(crank_mass() * gravity).z(), at_rest = given(0);
        Real found = 0;
        for (int i = 0; i < 2; ++i) {
            Real const unit = 1 + std::abs(found), per_unit = (given(unit) - at_rest) / unit;
            found = (others - at_rest) / (inertia() + per_unit);
        }
        return found;
    }
};

void report_crank(Inputs const& in, Kinematics const& k, Motion const& motion, Vector3 const& gravity, Result& result) {
    result.power_crank = static_cast<double>(motion.pin_force.dot(k.pin_velocity));
    Real const torque = k.pin.cross(motion.pin_force).z();
    result.crank_torque = static_cast<double>(torque);
    Vector3 const crank_weight = Real(in.crank_mass) * gravity;
    result.crank_torque_with_weight = static_cast<double>(torque - (k.pin / 2).cross(crank_weight).z());
    Vector3 const span = k.end - k.pin, spread = k.end_velocity - k.pin_velocity;
    result.rod_angular_velocity = array_of(span.cross(spread) / span.squaredNorm());
    result.pin_force = array_of(motion.pin_force);
    result.rod_force = array_of(motion.rod_force);
    Real const rod_length = in.rod_length;
    result.ideal_x = static_cast<double>(k.pin.x() + std::sqrt(rod_length * rod_length - k.pin.y() * k.pin.y()));
}

void report_joint(JointLoads const& joint, Result& result) {
    result.contact_domain = std::isnan(joint.potential);
    result.surfaces = joint.surfaces, result.lines = joint.lines, result.points = joint.points;
    result.faces = joint.faces;
    result.power_friction = static_cast<double>(joint.friction_loss);
    result.power_damping = static_cast<double>(joint.damping_loss);
    for (int i = 0; i < 8; ++i) {
        Pair const &y = joint.pairs[1][i], &z = joint.pairs[2][i];
        result.pen_y[i] = static_cast<double>(y.depth), result.pen_z[i] = static_cast<double>(z.depth);
        result.rate_y[i] = static_cast<double>(y.rate), result.rate_z[i] = static_cast<double>(z.rate);
        result.fn_y[i] = static_cast<double>(y.force), result.fn_z[i] = static_cast<double>(z.force);
        result.elastic_y[i] = static_cast<double>(y.elastic), result.elastic_z[i] = static_cast<double>(z.elastic);
        result.ahead[i] = static_cast<double>(y.arm.x());
        result.slip_y[i] = static_cast<double>(y.slip.norm()), result.slip_z[i] = static_cast<double>(z.slip.norm());
    }
    result.contact_potential = static_cast<double>(joint.potential);
    result.contact_force = array_of(joint.force);
    result.normal_force = array_of(joint.normal);
    result.normal_torque = array_of(joint.normal_torque);
}

}  // namespace

Inputs completed(Inputs in) {
    auto const follow = [](double& value, double from_others) {
        if (std::isnan(value)) value = from_others;
    };
    follow(in.crank_mass, in.crank_section * in.crank_length * in.density);
    follow(in.rod_mass, in.rod_section * in.rod_length * in.density);
    follow(in.rod_inertia, in.rod_mass * in.rod_length * in.rod_length / 12);
    double const x = in.slider_length, y = in.way_width, z = in.way_depth;
    follow(in.slider_mass, x * y * z * in.density);
    follow(in.slider_inertia_x, in.slider_mass * (y * y + z * z) / 12);
    follow(in.slider_inertia_y, in.slider_mass * (x * x + z * z) / 12);
    follow(in.slider_inertia_z, in.slider_mass * (x * x + y * y) / 12);
    follow(in.crank_inertia, in.crank_mass * in.crank_length * in.crank_length / 12);
    follow(in.point_stiffness, static_cast<double>(point_stiffness(in)));
    follow(in.thickness_y, in.way_width);
    follow(in.thickness_z, in.way_depth);
    return in;
}

Result evaluate(Inputs const& in, Parts const& parts, double t, State const& state, Pairs const* impact_speeds) {
    CrankMotion turning = crank_motion(in, parts, t, state);
    auto [reached, crank, drive, slider] = placed(in, parts, turning, t, state);
    if (!reached) {
        Result nothing;
        nothing.geometry = true;
        nothing.derivative.fill(std::numeric_limits<double>::quiet_NaN());
        return nothing;
    }
    JointLoads const joint = joint_loads(in, parts, slider, impact_speeds);
    LoadPlace const place{turning.angle, t, slider.centre.x(), slider.velocity.x(), turning.speed};
    LoadSum const loads = load_sum(in, parts, place, slider.pose, slider.pose_rate);
    FilmLoads const film = film_loads(in, parts, slider);
    Vector3 const force = joint.force + loads.force + film.force;

    Real const beta = in.inclination;
    Real const gamma = in.cross_inclination;
    Vector3 const gravity = -Real(in.gravity) * Vector3(std::sin(beta), std::cos(beta) * std::cos(gamma), std::cos(beta) * std::sin(gamma));
    // What a mass feels on ground that is accelerated.
    Vector3 const felt = gravity - loads.ground;
    Vector3 acceleration;
    Matrix3 const attitude = slider.pose.topLeftCorner<3, 3>();
    Vector3 const& spin = slider.angular_velocity;
    Vector3 const inertia(in.slider_inertia_x, in.slider_inertia_y, in.slider_inertia_z);
    Vector3 const torque = joint.torque + loads.torque + film.torque, gyroscopic = spin.cross(inertia.cwiseProduct(spin));
    Vector3 spin_up = (attitude.transpose() * torque - gyroscopic).cwiseQuotient(inertia);
    auto const on_rod = [&](Kinematics const& k) { return parts.offset_slider ? solve_offset_motion(in, k, felt, force, torque) : solve_motion(in, k, felt, force); };
    auto const guided = [&](std::optional<Real> ax) {
        if (parts.offset_slider) return solve_guided_motion(in, parts, slider, felt, force, torque, ax);
        Vector3 const all = force / in.slider_mass + felt;
        if (!ax) return Motion{all, Vector3::Zero(), Vector3::Zero()};
        // The drive gives what the joint and the weight leave of M x''.
        return Motion{Vector3(*ax, all.y(), all.z()), Vector3(in.slider_mass * (*ax - all.x()), 0, 0), Vector3::Zero()};
    };
    auto const take = [&](Motion const& motion) {
        acceleration = motion.slider_acceleration;
        if (parts.offset_slider) spin_up = motion.spin_up;
        return motion;
    };
    Real energy = slider_energy(in, parts, slider, gravity) + joint.potential + loads.potential;
    Vector3 const mass_centre_velocity = slider.velocity + (attitude * spin).cross(mass_centre_of(in, parts, attitude));
    Real ground_power = -in.slider_mass * loads.ground.dot(mass_centre_velocity);
    Result result;
    Turning const free{in, parts, felt, motor_torque(in, parts, turning, t), loads.crank_torque};
    switch (parts.mechanism) {
        case Mechanism::slider_crank_motor: {
            turning.acceleration = free.acceleration([&](Real by) {
                auto const k = kinematics_of(in, parts, {turning.angle, turning.speed, by}, state);
                return k.pin.cross(on_rod(k).pin_force).z();
            }, crank.pin);
            crank = kinematics_of(in, parts, turning, state);
            Motion const motion = take(on_rod(crank));
            energy += rod_energy(in, crank, gravity);
            report_crank(in, crank, motion, felt, result);
            ground_power += rod_ground_power(in, crank, loads.ground);
            break;
        }
        case Mechanism::scotch_yoke_motor: {
            auto const push = [&](Real by) { return guided(placed(in, parts, {turning.angle, turning.speed, by}, t, state).drive.ax).pin_force.x(); };
            Real const lever = -Real(in.crank_length) * std::sin(turning.angle);
            turning.acceleration = free.acceleration([&](Real by) { return push(by) * lever; }, Vector3::Zero());
            drive = placed(in, parts, turning, t, state).drive;
            take(guided(drive.ax));
            result.ideal_x = static_cast<double>(drive.x);
            break;
        }
        case Mechanism::slider_crank: {
            Motion const motion = take(on_rod(crank));
            energy += rod_energy(in, crank, gravity);
            report_crank(in, crank, motion, felt, result);
            ground_power += rod_ground_power(in, crank, loads.ground);
            if (parts.drive.by != slideway::DriveBy::profile) break;
            // What accelerates the crank itself.
            result.power_crank += static_cast<double>(free.inertia() * turning.acceleration * turning.speed);
            result.crank_torque_with_weight += static_cast<double>(free.inertia() * turning.acceleration);
            energy += free.inertia() * turning.speed * turning.speed / 2;
            break;
        }
        case Mechanism::carriage:
        case Mechanism::scotch_yoke: {
            result.power_crank = static_cast<double>(take(guided(drive.ax)).pin_force.x() * drive.vx);
            result.ideal_x = static_cast<double>(drive.x);
            break;
        }
        case Mechanism::free_slider:
            take(guided({}));
            result.derivative[10] = state[11];
            result.derivative[11] = static_cast<double>(acceleration.x());
            result.ideal_x = std::numeric_limits<double>::quiet_NaN();
            break;
        case Mechanism::planar_slider_crank:  // has no place here, see placed()
            break;
    }
    Real const of_crank = loads.crank_torque * turning.speed;
    result.power_load = static_cast<double>(loads.slider_power + of_crank);
    result.loss_springs = static_cast<double>(loads.spring_loss);
    result.loss_film = static_cast<double>(film.loss);
    if (parts.drive.turns_freely()) {
        result.derivative[10] = state[11];
        result.derivative[11] = static_cast<double>(turning.acceleration);
        result.power_crank = static_cast<double>(free.motor * turning.speed);
        energy += free.inertia() * turning.speed * turning.speed / 2;
        if (free.has_crank()) {
            energy -= free.crank_mass() * gravity.dot(crank.pin) / 2;
            ground_power -= free.crank_mass() * loads.ground.dot(crank.pin_velocity) / 2;
        }
        result.crank_torque_with_weight = static_cast<double>(free.motor);
    } else {
        result.power_crank -= static_cast<double>(of_crank);
    }
    result.power_ground = static_cast<double>(ground_power);
    result.energy = static_cast<double>(energy);

    Vector3 const angle_rates = euler_rates(slider.roll, slider.yaw, spin);
    for (int i = 0; i < 2; ++i) result.derivative[i] = state[2 + i];
    for (int i = 0; i < 2; ++i) result.derivative[2 + i] = static_cast<double>(acceleration[1 + i]);
    for (int i = 0; i < 3; ++i) result.derivative[4 + i] = static_cast<double>(angle_rates[i]);
    for (int i = 0; i < 3; ++i) result.derivative[7 + i] = static_cast<double>(spin_up[i]);

    auto const sensor = [&](int axis, Real half_way) {
        Vector3 const place = (half_way + 0.01L) * Vector3::Unit(axis);
        Vector3 const about_centre = spin_up.cross(place) + spin.cross(spin.cross(place));
        return static_cast<double>(attitude.col(axis).dot(acceleration + attitude * about_centre));
    };
    result.acceleration = array_of(acceleration);
    result.acceleration_top = sensor(1, Real(in.way_width) / 2);
    result.acceleration_front = sensor(2, Real(in.way_depth) / 2);
    result.x = static_cast<double>(slider.centre.x());
    result.vx = static_cast<double>(slider.velocity.x());
    report_joint(joint, result);
    result.film_force = array_of(film.force);
    result.film_load = static_cast<double>(film.load);
    return result;
}

Pairs penetrations(Inputs const& in, Parts const& parts, double t, State const& state) {
    Pairs depths;
    depths.fill(std::numeric_limits<double>::quiet_NaN());
    Placed const now = placed(in, parts, crank_motion(in, parts, t, state), t, state);
    if (!now.reached) return depths;
    PairTable const pairs = pairs_of(in, parts, now.slider, pose_of_way(in, parts), nullptr);
    for (int axis : {1, 2})
        for (int i = 0; i < 8; ++i) depths[(axis - 1) * 8 + i] = static_cast<double>(pairs[axis][i].depth);
    return depths;
}

double friction_coefficient(Inputs const& inputs, double speed) {
    return static_cast<double>(friction_value(inputs, speed));
}
double line_load(Inputs const& inputs, double length, double approach) {
    return static_cast<double>(line_force(inputs, length, approach));
}
double line_potential(Inputs const& inputs, double length, double approach) {
    return static_cast<double>(line_energy(inputs, length, approach));
}
double restitution_slope(double restitution) { return static_cast<double>(slope_of_restitution(restitution)); }

}  // namespace oracle
