#include "planar.hpp"

#include <algorithm>
#include <cmath>

#include "laws.hpp"
#include "linear_solve.hpp"
#include "loads.hpp"
#include "mechanism.hpp"
#include "numbers.hpp"

namespace oracle {
namespace {

using namespace detail;

using Vector2 = Eigen::Matrix<Real, 2, 1>;
/// Columns θ1 θ2 ψ.
using Jacobian = Eigen::Matrix<Real, 2, 3>;

constexpr Real least_impact_speed = 1e-4;

struct Corner {
    int along, up;  // s3, s1
};
constexpr Corner corners[4] = {{+1, +1}, {+1, -1}, {-1, -1}, {-1, +1}};

Vector2 direction(Real angle) { return {std::cos(angle), std::sin(angle)}; }
Vector2 across(Vector2 const& v) { return {-v.y(), v.x()}; }

/// A point p = p1 e(θ1) + p2 e(θ2) + A(ψ) q of the chain: place, Jacobian J, and J' q' of its acceleration J q'' + J' q'.
struct Point {
    Vector2 place = Vector2::Zero(), centripetal = Vector2::Zero();
    Jacobian jacobian = Jacobian::Zero();
};

Point point_of(PlanarState const& s, Real p1, Real p2, Vector2 const& q) {
    Vector2 const turned = q.x() * direction(s[2]) + q.y() * across(direction(s[2]));
    Vector2 const arms[3] = {p1 * direction(s[0]), p2 * direction(s[1]), turned};
    Point point;
    for (int i = 0; i < 3; ++i) {
        point.place += arms[i];
        point.jacobian.col(i) = across(arms[i]);
        point.centripetal -= s[3 + i] * s[3 + i] * arms[i];
    }
    return point;
}

struct Body {
    Real mass, inertia;
    int angle;  // which of θ1 θ2 ψ is its own
    Point centre;
};

void count_modes(Corners const& depth, PlanarResult& result) {
    for (int up : {+1, -1}) {
        int touching = 0;
        for (int i = 0; i < 4; ++i) touching += corners[i].up == up && depth[i] > 0;
        result.surfaces += touching == 2;
        result.points += touching == 1;
    }
}

}  // namespace

PlanarState planar_start(Inputs const& in) {
    Real const crank = in.crank_length, rod = in.rod_length, angle = in.start_angle;
    Real const speed = std::isnan(in.profile_speed) ? Real(in.crank_speed) : Real(in.drive_scale) * in.profile_speed;
    Real const rod_angle = std::asin((in.y - crank * std::sin(angle)) / rod);
    Real const rod_speed = (in.vy - crank * std::cos(angle) * speed) / (rod * std::cos(rod_angle));
    return {angle, rod_angle, in.pitch, speed, rod_speed, in.wz};
}

PlanarMechanism::PlanarMechanism(Inputs const& in, Parts const& parts)
    : in_(in), parts_(parts), stiffness_(point_stiffness(in)) {
    if (parts.damping == Damping::restitution) slope_ = slope_of_restitution(in.restitution);
}

void PlanarMechanism::load_corner(int i, Real impact_speed, PlanarResult& result) const {
    Real const depth = result.depth[i], rate = result.rate[i], n = in_.hertz_exponent;
    if (!(depth > 0)) return;
    Real const elastic = stiffness_ * std::pow(depth, n);
    Real force = elastic + in_.eta * stiffness_ * depth * rate;
    if (parts_.damping == Damping::restitution)
        force = elastic * (1 + slope_ * rate / std::max(impact_speed, least_impact_speed));
    result.elastic[i] = elastic;
    result.force[i] = std::max(force, Real(0));
    result.power_damping += (result.force[i] - elastic) * rate;
    result.contact_potential += stiffness_ * std::pow(depth, n + 1) / (n + 1);
}

PlanarResult PlanarMechanism::at(PlanarState const& s, Corners const* impact_speeds, long double torque, long double time) const {
    Inputs const& in = in_;
    Real const crank = in.crank_length, rod = in.rod_length;
    Real const half_length = Real(in.slider_length) / 2, half_height = Real(in.slider_height) / 2;
    Vector3 const rates(s[3], s[4], s[5]);
    Vector2 const none = Vector2::Zero();
    Body const bodies[3] = {{in.crank_mass, in.crank_inertia, 0, point_of(s, crank / 2, 0, none)},
                            {in.rod_mass, in.rod_inertia, 1, point_of(s, crank, rod / 2, none)},
                            {in.slider_mass, in.slider_inertia_z, 2, point_of(s, crank, rod, none)}};
    Vector2 const gravity = -Real(in.gravity) * Vector2(std::sin(Real(in.inclination)), std::cos(Real(in.inclination)));

    Point const& hole = bodies[2].centre;
    Vector2 const speed_of_hole = hole.jacobian * rates;
    Matrix4 pose = Matrix4::Identity(), pose_rate = Matrix4::Zero();
    Real const cosine = std::cos(Real(s[2])), sine = std::sin(Real(s[2]));
    pose.topLeftCorner<2, 2>() << cosine, -sine, sine, cosine;
    pose_rate.topLeftCorner<2, 2>() << -sine * rates[2], -cosine * rates[2], cosine * rates[2], -sine * rates[2];
    pose.topRightCorner<2, 1>() = hole.place, pose_rate.topRightCorner<2, 1>() = speed_of_hole;
    auto const loads = load_sum(in, parts_, {s[0], time, hole.place.x(), speed_of_hole.x(), s[3]}, pose, pose_rate);
    Vector2 const ground = loads.ground.head<2>();

    PlanarResult result;
    // M q'' = Σ m Jᵀ (g - J' q') + Σ J_cornerᵀ f + the drive's torque on θ1.
    Matrix3 mass = Matrix3::Zero();
    Vector3 load = Vector3::Zero();
    for (Body const& body : bodies) {
        Jacobian const& j = body.centre.jacobian;
        mass += body.mass * j.transpose() * j;
        mass(body.angle, body.angle) += body.inertia;
        load += body.mass * j.transpose() * (gravity - ground - body.centre.centripetal);
        result.power_ground -= body.mass * ground.dot(j * rates);
        Real const own_rate = rates[body.angle];
        result.energy += (body.mass * (j * rates).squaredNorm() + body.inertia * own_rate * own_rate) / 2 -
                         body.mass * gravity.dot(body.centre.place);
    }
    for (int i = 0; i < 4; ++i) {
        auto const [along, up] = corners[i];
        Point const corner = point_of(s, crank, rod, {along * half_length, up * half_height});
        Vector2 const velocity = corner.jacobian * rates;
        result.depth[i] = up * corner.place.y() - (half_height + in.clearance_y);
        result.rate[i] = up * velocity.y();
        result.slip[i] = velocity.x();
        load_corner(i, impact_speeds ? (*impact_speeds)[i] : 0, result);
        Real const speed = std::abs(velocity.x());
        Real drag = 0;
        if (parts_.friction && speed > 0) drag = -friction_value(in, speed) * result.force[i] * velocity.x() / speed;
        load += corner.jacobian.transpose() * Vector2(drag, -up * result.force[i]);
        result.power_friction -= drag * velocity.x();
    }
    count_modes(result.depth, result);
    load += hole.jacobian.transpose() * loads.force.head<2>() + Vector3(loads.crank_torque, 0, loads.torque.z());
    result.power_load = loads.slider_power + loads.crank_torque * rates[0];
    result.loss_springs = loads.spring_loss;
    result.energy += loads.potential + result.contact_potential + Real(in.drive_inertia) * rates[0] * rates[0] / 2;
    mass(0, 0) += in.drive_inertia;
    bool const free = parts_.drive.turns_freely();
    Real const motor = torque + detail::motor_torque(in, parts_, {s[0], s[3], 0}, time);
    Real const given = free ? Real(0) : detail::crank_motion(in, parts_, time, {}).acceleration;

    // Unknown: q'' and the torque, which is given on a free crank and holds θ1'' as the drive has it on a driven one.
    Matrix system = Matrix::Zero(4, 4), right = Matrix::Zero(4, 1);
    system.topLeftCorner(3, 3) = mass;
    system(0, 3) = -1;
    system(3, free ? 3 : 0) = 1;
    right.topRows(3) = load;
    right(3, 0) = free ? motor : given;
    Matrix const solved = solution(system, right);
    Vector3 const accelerations = solved.topRows(3);
    for (int i = 0; i < 3; ++i) result.derivative[i] = rates[i], result.derivative[3 + i] = accelerations[i];
    result.drive_torque = free ? motor : solved(3, 0);
    result.power_drive = result.drive_torque * s[3];

    Point const& centre = bodies[2].centre;
    Vector2 const velocity = centre.jacobian * rates;
    Vector2 const acceleration = centre.jacobian * accelerations + centre.centripetal;
    result.x = centre.place.x(), result.y = centre.place.y();
    result.vx = velocity.x(), result.vy = velocity.y();
    result.ax = acceleration.x(), result.ay = acceleration.y();
    return result;
}

}  // namespace oracle
