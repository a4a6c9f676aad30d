#include "rigid_frame.hpp"

#include <cmath>

namespace oracle::detail {
namespace {

using Vector2 = Eigen::Matrix<Real, 2, 1>;

constexpr int along_signs[4] = {+1, +1, -1, -1}, up_signs[4] = {+1, -1, -1, +1};

Vector2 direction(Real angle) { return {std::cos(angle), std::sin(angle)}; }
Vector2 across(Vector2 const& v) { return {-v.y(), v.x()}; }

/// A point of the chain: p1 along the crank, p2 along the rod, q in the block's frame.
struct Place {
    Vector2 at = Vector2::Zero(), bias = Vector2::Zero();  // its acceleration is jacobian q'' + bias
    Eigen::Matrix<Real, 2, 3> jacobian;

    Place(PlanarState const& s, Real p1, Real p2, Vector2 const& q) {
        Vector2 const e = direction(s[2]);
        Vector2 const arms[3] = {p1 * direction(s[0]), p2 * direction(s[1]), q.x() * e + q.y() * across(e)};
        for (int i = 0; i < 3; ++i) {
            at += arms[i], bias -= s[3 + i] * s[3 + i] * arms[i];
            jacobian.col(i) = across(arms[i]);
        }
    }
};

}  // namespace

RigidFrame rigid_frame(Inputs const& in, PlanarState const& s) {
    RigidFrame f;
    Real const r = in.crank_length, l = in.rod_length, slope = in.inclination;
    Vector2 const none = Vector2::Zero(), gravity = -Real(in.gravity) * Vector2(std::sin(slope), std::cos(slope));
    Vector3 const q(s[3], s[4], s[5]);
    auto const add_body = [&](Real mass, Real inertia, int angle, Place const& centre) {
        f.mass += mass * centre.jacobian.transpose() * centre.jacobian;
        f.mass(angle, angle) += inertia;
        f.load += mass * centre.jacobian.transpose() * (gravity - centre.bias);
        f.energy += (mass * (centre.jacobian * q).squaredNorm() + inertia * q[angle] * q[angle]) / 2 - mass * gravity.dot(centre.at);
    };
    add_body(in.crank_mass, in.crank_inertia, 0, Place(s, r / 2, 0, none));
    add_body(in.rod_mass, in.rod_inertia, 1, Place(s, r, l / 2, none));
    add_body(in.slider_mass, in.slider_inertia_z, 2, Place(s, r, l, none));
    for (int i = 0; i < 4; ++i) {
        Real const a = Real(in.slider_length) / 2, b = Real(in.slider_height) / 2, up = up_signs[i];
        Place const corner(s, r, l, {along_signs[i] * a, up * b});
        f.gap[i] = b + in.clearance_y - up * corner.at.y();
        f.normal[i] = -up * corner.jacobian.row(1), f.normal_bias[i] = -up * corner.bias.y();
        f.tangent[i] = corner.jacobian.row(0), f.tangent_bias[i] = corner.bias.x();
    }
    return f;
}

}  // namespace oracle::detail
