#include "oracle.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/special_functions/lambert_w.hpp>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace oracle {
namespace {

using slideway::Damping;
using slideway::Inputs;
using slideway::Law;
using slideway::Parts;

// 64 bits of mantissa: a penetration of 1e-10 m taken as the difference of two half widths keeps eleven digits.
using Real = long double;
using Vector3 = Eigen::Matrix<Real, 3, 1>;
using Vector4 = Eigen::Matrix<Real, 4, 1>;
using Matrix3 = Eigen::Matrix<Real, 3, 3>;
using Matrix4 = Eigen::Matrix<Real, 4, 4>;

Real const pi = 3.141592653589793238462643383279502884L;
Real const nan = std::numeric_limits<Real>::quiet_NaN();
Real const least_impact_speed = 1e-4;

Vector array_of(Vector3 const& v) {
    return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

// ---- Table 2: apices, faces, boundary lines ----------------------------------------------------------------------

struct Apex {
    int s1, s2, s3;  // along Y, Z, X
};
constexpr Apex apices[8] = {{+1, +1, +1}, {-1, +1, +1}, {-1, -1, +1}, {+1, -1, +1},
                            {+1, +1, -1}, {-1, +1, -1}, {-1, -1, -1}, {+1, -1, -1}};

enum class Run { along_x, across };
struct Edge {
    int p, q;  // numbers of the apices at its ends, 1..8
    Run run;
};
struct FaceOfWay {
    int axis;  // 1: Y, 2: Z
    int side;
    int corners[4];
    Edge edges[4];
};
constexpr FaceOfWay faces_of_way[face_count] = {
    {1, +1, {1, 4, 8, 5}, {{1, 4, Run::across}, {4, 8, Run::along_x}, {8, 5, Run::across}, {5, 1, Run::along_x}}},
    {1, -1, {2, 3, 7, 6}, {{2, 3, Run::across}, {3, 7, Run::along_x}, {7, 6, Run::across}, {6, 2, Run::along_x}}},
    {2, +1, {1, 2, 6, 5}, {{1, 2, Run::across}, {2, 6, Run::along_x}, {6, 5, Run::across}, {5, 1, Run::along_x}}},
    {2, -1, {4, 3, 7, 8}, {{4, 3, Run::across}, {3, 7, Run::along_x}, {7, 8, Run::across}, {8, 4, Run::along_x}}}};

// ---- Eq. 1-4: homogeneous matrices -------------------------------------------------------------------------------

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

/// Position in the frame that the pose is given in, from position in the body.
Matrix4 pose_of(Vector3 const& centre, Real roll, Real yaw, Real pitch) {
    return translation(centre) * rotation(2, pitch) * rotation(1, yaw) * rotation(0, roll);
}

/// Transpose of the rotation, which is exact, in place of a general inverse.
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

/// φ' ϑ' ψ' from ω of the body frame: ω is the sum of the three rates along their axes as the body sees them.
Vector3 euler_rates(Real roll, Real yaw, Vector3 const& angular_velocity) {
    Matrix3 const to_body_x = rotation(0, roll).topLeftCorner<3, 3>().transpose();
    Matrix3 const to_body_yx = to_body_x * rotation(1, yaw).topLeftCorner<3, 3>().transpose();
    Matrix3 axes;
    axes << Vector3::UnitX(), to_body_x * Vector3::UnitY(), to_body_yx * Vector3::UnitZ();
    return axes.fullPivLu().solve(angular_velocity);
}

// ---- the mechanism -----------------------------------------------------------------------------------------------

struct Kinematics {
    bool reached = true;
    Real angle = 0;  // θ of the crank
    Vector3 pin, pin_velocity, pin_acceleration;
    Vector3 centre, velocity;  // of the slider
    Real roll = 0, yaw = 0, pitch = 0;
    Vector3 angular_velocity;  // body frame
    Matrix4 pose, pose_rate;   // slider in the inertial frame
};

Kinematics kinematics_of(Inputs const& in, Real t, State const& state) {
    Kinematics k;
    Real const speed = in.crank_speed;
    k.angle = Real(in.start_angle) + speed * t;
    k.pin = Real(in.crank_length) * Vector3(std::cos(k.angle), std::sin(k.angle), 0);
    k.pin_velocity = speed * Vector3::UnitZ().cross(k.pin);
    k.pin_acceleration = -speed * speed * k.pin;

    Real const y = state[0], z = state[1], vy = state[2], vz = state[3];
    Real const above = y - k.pin.y();
    Real const reach = Real(in.rod_length) * in.rod_length - above * above - z * z;
    k.reached = reach > 0;
    if (!k.reached) return k;
    Real const along = std::sqrt(reach);
    k.centre = Vector3(k.pin.x() + along, y, z);
    // (B - A) · (v_B - v_A) = 0
    k.velocity = Vector3(k.pin_velocity.x() - (above * (vy - k.pin_velocity.y()) + z * vz) / along, vy, vz);

    k.roll = state[4], k.yaw = state[5], k.pitch = state[6];
    k.angular_velocity = Vector3(state[7], state[8], state[9]);
    k.pose = pose_of(k.centre, k.roll, k.yaw, k.pitch);
    k.pose_rate = Matrix4::Zero();
    k.pose_rate.topLeftCorner<3, 3>() = k.pose.topLeftCorner<3, 3>() * cross_matrix(k.angular_velocity);
    k.pose_rate.topRightCorner<3, 1>() = k.velocity;
    return k;
}

Matrix4 pose_of_way(Inputs const& in, Parts const& parts) {
    if (!parts.misaligned_way) return translation(Vector3(in.rod_length, 0, 0));
    return pose_of(Vector3(in.rod_length, in.way_offset_y, in.way_offset_z), in.way_roll, in.way_yaw, in.way_pitch);
}

// ---- the sixteen pairs, in way coordinates -----------------------------------------------------------------------

struct Pair {
    int side = 0;
    Vector3 normal;  // of the slider's face, outward for side +1
    Vector3 arm;     // ρ, from the slider's centre
    Real depth = 0;  // δ
    Real rate = 0;   // δ'
    Vector3 slip;    // v_t
    Real impact_speed = 0;
    Real elastic = 0, force = 0;
};
using PairTable = std::array<std::array<Pair, 8>, 3>;  // [axis 1 or 2][apex]

PairTable pairs_of(Inputs const& in, Kinematics const& k, Matrix4 const& way, Pairs const* impact_speeds) {
    Matrix4 const from_inertial = inverse_of(way);
    Matrix4 const slider = from_inertial * k.pose;
    Matrix4 const slider_rate = from_inertial * k.pose_rate;
    Matrix4 const into_slider = inverse_of(slider);
    Matrix3 const attitude = slider.topLeftCorner<3, 3>();
    Vector3 const centre = slider.topRightCorner<3, 1>();
    Vector3 const velocity = slider_rate.topRightCorner<3, 1>();
    Vector3 const angular_velocity = attitude * k.angular_velocity;
    Real const half_hole[3] = {0, Real(in.way_width) / 2 + in.clearance_y, Real(in.way_depth) / 2 + in.clearance_z};

    PairTable table;
    for (int i = 0; i < 8; ++i) {
        auto const [s1, s2, s3] = apices[i];
        // The contact segment of the way runs along with the slider.
        Vector4 const apex(centre.x() + s3 * Real(in.slider_length) / 2, s1 * Real(in.way_width) / 2,
                           s2 * Real(in.way_depth) / 2, 1);
        Vector4 const apex_rate(velocity.x(), 0, 0, 0);
        Vector4 const in_slider = into_slider * apex;
        // R = T⁻¹ P  ⇒  R' = T⁻¹ (P' - T' R)
        Vector4 const in_slider_rate = into_slider * (apex_rate - slider_rate * in_slider);
        for (int axis : {1, 2}) {
            Pair& pair = table[axis][i];
            pair.side = axis == 1 ? s1 : s2;
            pair.normal = attitude.col(axis);
            pair.arm = apex.head<3>() - centre;
            pair.depth = pair.side * in_slider[axis] - half_hole[axis];
            pair.rate = pair.side * in_slider_rate[axis];
            Vector3 const sliding = velocity + angular_velocity.cross(pair.arm);
            pair.slip = sliding - sliding.dot(pair.normal) * pair.normal;
            Real const remembered = impact_speeds ? (*impact_speeds)[(axis - 1) * 8 + i] : 0.0;
            pair.impact_speed = std::max(remembered, least_impact_speed);
        }
    }
    return table;
}

// ---- the laws ----------------------------------------------------------------------------------------------------

Real contact_modulus(Inputs const& in) {  // E*
    Real const nu1 = in.slider_poisson_ratio, nu2 = in.way_poisson_ratio;
    return 1 / ((1 - nu1 * nu1) / in.slider_young_modulus + (1 - nu2 * nu2) / in.way_young_modulus);
}

/// x = P/(π E* l), solved from δ̄ = x (1 - ln(x R_e/l²)) by the branch that vanishes with δ̄.
Real line_strain(Inputs const& in, Real length, Real approach) {
    Real const reduced = approach * in.edge_radius / (length * length);
    if (!(reduced <= 1)) return nan;
    if (reduced == 1) return approach;  // W₋₁(-1/e) = -1, where rounding could leave the domain
    return -approach / boost::math::lambert_wm1(-reduced / std::exp(Real(1)));
}

Real line_force(Inputs const& in, Real length, Real approach) {
    return pi * contact_modulus(in) * length * line_strain(in, length, approach);
}

Real line_energy(Inputs const& in, Real length, Real approach) {
    Real const x = line_strain(in, length, approach);
    return pi * contact_modulus(in) * length * x * x * (1 - 2 * std::log(x * in.edge_radius / (length * length))) / 4;
}

Real friction_value(Inputs const& in, Real speed) {
    Real const s = in.friction_static, d = in.friction_kinetic;
    Real const stick = in.friction_stick_speed, slip = in.friction_slip_speed;
    if (speed < stick) return s * std::sin(pi * speed / (2 * stick));
    if (speed > slip) return d;
    return (s + d) / 2 + (s - d) / 2 * std::cos(pi * (speed - stick) / (slip - stick));
}

/// a(1+e) - ln[(1+a)/(1-ea)] with q = -ln(1-ea), which keeps digits where a comes close to 1/e.
Real restitution_excess(Real e, Real q) {
    Real const a = -std::expm1(-q) / e;
    if (a > 0.01L) return a * (1 + e) - std::log1p(a) - q;
    // The logarithms' leading terms cancel: a²(1-e²)/2 - a³(1+e³)/3 + a⁴(1-e⁴)/4 - ...
    Real total = 0;
    for (int k = 12; k >= 2; --k) {
        Real const sign = k % 2 == 0 ? 1 : -1;
        Real const even = k % 2 == 0 ? -std::expm1(k * std::log(e)) : 1 + std::pow(e, k);
        total += sign * std::pow(a, k) * even / k;
    }
    return total;
}

Real slope_of_restitution(Real e) {
    if (e >= 1) return 0;
    Real const near_one = 3 * (1 - e * e) / (2 * (1 + e * e * e));  // root of the first two terms above
    Real low = -std::log1p(-e * std::min(near_one / 8, 1 / (2 * e))), high = (1 + e) / e;
    for (int i = 0; i < 120; ++i) {
        Real const middle = (low + high) / 2;
        (restitution_excess(e, middle) > 0 ? low : high) = middle;
    }
    return -std::expm1(-(low + high) / 2) / e;
}

/// The contacts of one face: adds each one's shares to its pairs and its potential to the sum.
class FaceLoads {
public:
    FaceLoads(Inputs const& in, Parts const& parts, FaceOfWay const& face, std::array<Pair, 8>& pairs)
        : in_(in), parts_(parts), face_(face), pairs_(pairs) {
        point_stiffness_ = Real(4) / 3 * contact_modulus(in) * std::sqrt(Real(in.apex_radius));
        Real const modulus = 2 * Real(in.slider_young_modulus) * in.way_young_modulus /
                             (Real(in.slider_young_modulus) + in.way_young_modulus);
        Real const width = face.axis == 1 ? in.way_depth : in.way_width;
        Real const thickness = face.axis == 1 ? in.thickness_y : in.thickness_z;
        surface_stiffness_ = modulus * in.slider_length * width / thickness;
        across_ = width;
        if (parts.damping == Damping::restitution) slope_ = slope_of_restitution(in.restitution);
    }

    /// Lists the contacts as section 4 counts them.
    void detect() {
        surface_ = std::all_of(std::begin(face_.corners), std::end(face_.corners), [&](int p) { return touches(p); });
        if (surface_) return;
        for (Edge const& edge : face_.edges)
            if (touches(edge.p) && touches(edge.q)) lines_.push_back(edge);
        for (int p : face_.corners) {
            bool const on_line =
                std::any_of(lines_.begin(), lines_.end(), [p](Edge const& e) { return e.p == p || e.q == p; });
            if (touches(p) && !on_line) points_.push_back(p);
        }
    }

    void load_by_paper() {
        if (surface_) {
            Real depth = 0, rate = 0;
            for (int p : face_.corners) depth += at(p).depth / 4, rate += at(p).rate / 4;
            Real const elastic = surface_stiffness_ * depth;
            Real const factor = damped(elastic, rate, in_.chi_surface, corner_list()) / elastic;
            for (int p : face_.corners) {
                Real const share = surface_stiffness_ * at(p).depth / 4;
                add(p, share, share * factor);
                potential_ += surface_stiffness_ * at(p).depth * at(p).depth / 8;
            }
        }
        for (Edge const& edge : lines_) {
            Real const depth = (at(edge.p).depth + at(edge.q).depth) / 2;
            Real const rate = (at(edge.p).rate + at(edge.q).rate) / 2;
            Real const elastic = line_force(in_, length(edge), depth);
            Real const force = damped(elastic, rate, in_.chi_line, {edge.p, edge.q});
            for (int p : {edge.p, edge.q}) add(p, elastic / 2, force / 2);
            potential_ += line_energy(in_, length(edge), depth);
        }
        for (int p : points_) load_point(p);
    }

    void load_by_conservative() {
        for (int p : face_.corners)
            if (touches(p)) load_point(p);
        for (Edge const& edge : face_.edges) {
            if (!touches(edge.p) || !touches(edge.q)) continue;
            Real const di = at(edge.p).depth, dj = at(edge.q).depth;
            Real const mean = 2 * di * dj / (di + dj);
            Real const slope_i = 2 * dj * dj / ((di + dj) * (di + dj)), slope_j = 2 * di * di / ((di + dj) * (di + dj));
            Real const rate = slope_i * at(edge.p).rate + slope_j * at(edge.q).rate;
            Real const elastic = line_force(in_, length(edge), mean);
            Real const force = damped(elastic, rate, in_.chi_line, {edge.p, edge.q});
            add(edge.p, elastic * slope_i, force * slope_i);
            add(edge.q, elastic * slope_j, force * slope_j);
            potential_ += line_energy(in_, length(edge), mean);
        }
        if (surface_) {
            Real reciprocals = 0;
            for (int p : face_.corners) reciprocals += 1 / at(p).depth;
            Real const mean = 4 / reciprocals;
            auto const slope = [&](int p) { return mean * mean / (4 * at(p).depth * at(p).depth); };
            Real rate = 0;
            for (int p : face_.corners) rate += slope(p) * at(p).rate;
            Real const elastic = surface_stiffness_ * mean;
            Real const force = damped(elastic, rate, in_.chi_surface, corner_list());
            for (int p : face_.corners) add(p, elastic * slope(p), force * slope(p));
            potential_ += surface_stiffness_ * mean * mean / 2;
        }
    }

    [[nodiscard]] int surfaces() const { return surface_ ? 1 : 0; }
    [[nodiscard]] int lines() const { return static_cast<int>(lines_.size()); }
    [[nodiscard]] int points() const { return static_cast<int>(points_.size()); }
    [[nodiscard]] Real potential() const { return potential_; }

private:
    [[nodiscard]] Pair& at(int p) const { return pairs_[p - 1]; }
    [[nodiscard]] bool touches(int p) const { return at(p).depth > 0; }
    [[nodiscard]] Real length(Edge const& edge) const {
        return edge.run == Run::along_x ? Real(in_.slider_length) : across_;
    }
    [[nodiscard]] std::vector<int> corner_list() const { return {std::begin(face_.corners), std::end(face_.corners)}; }

    void add(int p, Real elastic, Real force) const {
        at(p).elastic += elastic;
        at(p).force += force;
    }

    /// Line or surface with its dissipation; never pulls.
    [[nodiscard]] Real damped(Real elastic, Real rate, Real chi, std::vector<int> const& touching) const {
        Real factor = 1;
        if (parts_.damping == Damping::rate) factor += chi * rate;
        if (parts_.damping == Damping::restitution) {
            Real impact_speed = 0;
            for (int p : touching) impact_speed = std::max(impact_speed, at(p).impact_speed);
            factor += slope_ * rate / impact_speed;
        }
        return elastic * std::max(factor, Real(0));
    }

    void load_point(int p) {
        Real const depth = at(p).depth, n = in_.hertz_exponent;
        Real const elastic = point_stiffness_ * std::pow(depth, n);
        Real const force = parts_.damping == Damping::restitution
                               ? damped(elastic, at(p).rate, 0, {p})
                               : std::max(elastic + in_.eta * point_stiffness_ * depth * at(p).rate, Real(0));
        add(p, elastic, force);
        potential_ += point_stiffness_ * std::pow(depth, n + 1) / (n + 1);
    }

    Inputs const& in_;
    Parts const& parts_;
    FaceOfWay const& face_;
    std::array<Pair, 8>& pairs_;
    Real point_stiffness_ = 0, surface_stiffness_ = 0, across_ = 0, slope_ = 0;
    bool surface_ = false;
    std::vector<Edge> lines_;
    std::vector<int> points_;
    Real potential_ = 0;
};

// ---- the motion --------------------------------------------------------------------------------------------------

struct Motion {
    Vector3 slider_acceleration, pin_force;
};

/// Newton and Euler for rod and slider as free bodies joined at B.  Unknown: a_B, the force on the rod at A and at B.
/// Equations: momentum of the rod, momentum of the slider, moment about the rod's centre of mass in the two
/// directions across it (spherical ends and no spin leave none along it), and |AB| = L differentiated twice.
Motion solve_motion(Inputs const& in, Kinematics const& k, Vector3 const& gravity, Vector3 const& contact_force) {
    Real const mass = in.slider_mass, rod = in.rod_mass, fraction = in.rod_mass_center, length = in.rod_length;
    Vector3 const span = k.centre - k.pin;
    Vector3 const spread = k.velocity - k.pin_velocity;
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

    Eigen::Matrix<Real, 9, 1> const solution = matrix.fullPivLu().solve(right);
    return {solution.segment<3>(0), solution.segment<3>(3)};
}

Real kinetic_and_weight(Inputs const& in, Kinematics const& k, Vector3 const& gravity, Vector3 const& inertia) {
    Real const fraction = in.rod_mass_center, length = in.rod_length;
    Vector3 const rod_centre = (1 - fraction) * k.pin + fraction * k.centre;
    Vector3 const rod_velocity = (1 - fraction) * k.pin_velocity + fraction * k.velocity;
    Vector3 const rod_spin = (k.centre - k.pin).cross(k.velocity - k.pin_velocity) / (length * length);
    Real const kinetic = in.slider_mass * k.velocity.squaredNorm() + in.rod_mass * rod_velocity.squaredNorm() +
                         in.rod_inertia * rod_spin.squaredNorm() +
                         k.angular_velocity.dot(inertia.cwiseProduct(k.angular_velocity));
    return kinetic / 2 - in.slider_mass * gravity.dot(k.centre) - in.rod_mass * gravity.dot(rod_centre);
}

}  // namespace

// ---- the public face ---------------------------------------------------------------------------------------------

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
