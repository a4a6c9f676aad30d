#include "oracle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "face_loads.hpp"
#include "laws.hpp"
#include "mechanism.hpp"
#include "pairs.hpp"
#include "poses.hpp"

namespace oracle {
namespace {

using namespace detail;

Vector array_of(Vector3 const& v) {
    return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

}  // namespace

Inputs completed(Inputs in) {
    auto const follow = [](double& value, double from_others) {
        if (std::isnan(value)) value = from_others;
    };
    double const density = 7800;
    follow(in.crank_mass, density * 5e-3 * 2.5e-3 * in.crank_length);
    follow(in.rod_mass, density * 14.2e-3 * 7.1e-3 * in.rod_length);
    follow(in.rod_inertia, in.rod_mass * in.rod_length * in.rod_length / 12);
    follow(in.slider_mass, density * 0.04 * 0.02 * 0.03);
    follow(in.slider_inertia_x, in.slider_mass * (0.02 * 0.02 + 0.03 * 0.03) / 12);
    follow(in.slider_inertia_y, in.slider_mass * (0.04 * 0.04 + 0.03 * 0.03) / 12);
    follow(in.slider_inertia_z, in.slider_mass * (0.04 * 0.04 + 0.02 * 0.02) / 12);
    follow(in.thickness_y, in.way_width);
    follow(in.thickness_z, in.way_depth);
    return in;
}

Result evaluate(Inputs const& in, Parts const& parts, double t, State const& state, Pairs const* impact_speeds) {
    Result result;
    Kinematics const k = kinematics_of(in, t, state);
    if (!k.reached) {
        result.geometry = true;
        result.derivative.fill(std::numeric_limits<double>::quiet_NaN());
        return result;
    }
    Matrix4 const way = pose_of_way(in, parts);
    PairTable pairs = pairs_of(in, k, way, impact_speeds);

    Real potential = 0;
    for (int f = 0; f < face_count; ++f) {
        FaceLoads loads(in, parts, faces_of_way[f], pairs[faces_of_way[f].axis]);
        loads.detect();
        if (parts.law == Law::paper)
            loads.load_by_paper();
        else
            loads.load_by_conservative();
        result.surfaces += loads.surfaces();
        result.lines += loads.lines();
        result.points += loads.points();
        result.faces[f] = loads.surfaces() ? FaceKind::surface
                          : loads.lines()  ? FaceKind::lines
                          : loads.points() ? FaceKind::points
                                           : FaceKind::none;
        potential += loads.potential();
    }
    result.contact_domain = std::isnan(potential);

    // Way coordinates.  The way has no end, so a normal force does not push along it; its torque is complete.
    Vector3 normal = Vector3::Zero(), friction = Vector3::Zero(), normal_torque = Vector3::Zero(),
            friction_torque = Vector3::Zero();
    Real friction_loss = 0, damping_loss = 0;
    for (int axis : {1, 2}) {
        for (Pair const& pair : pairs[axis]) {
            if (!(pair.depth > 0)) continue;
            Vector3 const push = pair.side * pair.force * pair.normal;
            normal += Vector3(0, push.y(), push.z());
            normal_torque += pair.arm.cross(push);
            damping_loss += (pair.force - pair.elastic) * pair.rate;
            Real const speed = pair.slip.norm();
            if (!parts.friction || speed == 0) continue;
            Vector3 const drag = -friction_value(in, speed) * pair.force / speed * pair.slip;
            friction += drag;
            friction_torque += pair.arm.cross(drag);
            friction_loss -= drag.dot(pair.slip);
        }
    }
    Matrix3 const turn_back = way.topLeftCorner<3, 3>();
    normal = turn_back * normal;
    normal_torque = turn_back * normal_torque;
    Vector3 const contact_force = normal + turn_back * friction;
    Vector3 const torque = normal_torque + turn_back * friction_torque;

    Real const beta = in.inclination;
    Vector3 const gravity = -Real(in.gravity) * Vector3(std::sin(beta), std::cos(beta), 0);
    Motion const motion = solve_motion(in, k, gravity, contact_force);
    Vector3 const inertia(in.slider_inertia_x, in.slider_inertia_y, in.slider_inertia_z);
    Vector3 const body_torque = k.pose.topLeftCorner<3, 3>().transpose() * torque;
    Vector3 const gyroscopic = k.angular_velocity.cross(inertia.cwiseProduct(k.angular_velocity));
    Vector3 const spin_up = (body_torque - gyroscopic).cwiseQuotient(inertia);
    Vector3 const angle_rates = euler_rates(k.roll, k.yaw, k.angular_velocity);

    result.derivative = {state[2], state[3]};
    for (int i = 0; i < 2; ++i) result.derivative[2 + i] = static_cast<double>(motion.slider_acceleration[1 + i]);
    for (int i = 0; i < 3; ++i) result.derivative[4 + i] = static_cast<double>(angle_rates[i]);
    for (int i = 0; i < 3; ++i) result.derivative[7 + i] = static_cast<double>(spin_up[i]);
    result.power_crank = static_cast<double>(motion.pin_force.dot(k.pin_velocity));
    result.power_friction = static_cast<double>(friction_loss);
    result.power_damping = static_cast<double>(damping_loss);
    for (int i = 0; i < 8; ++i) {
        Pair const &y = pairs[1][i], &z = pairs[2][i];
        result.pen_y[i] = static_cast<double>(y.depth), result.pen_z[i] = static_cast<double>(z.depth);
        result.rate_y[i] = static_cast<double>(y.rate), result.rate_z[i] = static_cast<double>(z.rate);
        result.fn_y[i] = static_cast<double>(y.force), result.fn_z[i] = static_cast<double>(z.force);
        result.elastic_y[i] = static_cast<double>(y.elastic), result.elastic_z[i] = static_cast<double>(z.elastic);
        result.slip_y[i] = static_cast<double>(y.slip.norm()), result.slip_z[i] = static_cast<double>(z.slip.norm());
    }
    result.contact_potential = static_cast<double>(potential);
    result.energy = static_cast<double>(kinetic_and_weight(in, k, gravity, inertia) + potential);
    Real const crank_torque = k.pin.cross(motion.pin_force).z();
    result.crank_torque = static_cast<double>(crank_torque);
    Vector3 const crank_weight = Real(in.crank_mass) * gravity;
    result.crank_torque_with_weight = static_cast<double>(crank_torque - (k.pin / 2).cross(crank_weight).z());
    result.x = static_cast<double>(k.centre.x());
    result.vx = static_cast<double>(k.velocity.x());
    result.acceleration = array_of(motion.slider_acceleration);
    Vector3 const span = k.centre - k.pin, spread = k.velocity - k.pin_velocity;
    result.rod_angular_velocity = array_of(span.cross(spread) / span.squaredNorm());
    result.pin_force = array_of(motion.pin_force);
    result.normal_force = array_of(normal);
    result.normal_torque = array_of(normal_torque);
    Real const rod_length = in.rod_length;
    result.ideal_x = static_cast<double>(k.pin.x() + std::sqrt(rod_length * rod_length - k.pin.y() * k.pin.y()));
    return result;
}

Pairs penetrations(Inputs const& in, Parts const& parts, double t, State const& state) {
    Pairs depths;
    depths.fill(std::numeric_limits<double>::quiet_NaN());
    Kinematics const k = kinematics_of(in, t, state);
    if (!k.reached) return depths;
    PairTable const pairs = pairs_of(in, k, pose_of_way(in, parts), nullptr);
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
