#include "loads.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

namespace oracle::detail {
namespace {

Real argument_of(slideway::LoadArgument over, LoadPlace const& place) {
    using enum slideway::LoadArgument;
    switch (over) {
        case crank_angle: return place.crank_angle;
        case time: return place.time;
        case x: return place.x;
        case vx: return place.vx;
        case crank_speed: return place.crank_speed;
        case nothing: break;
    }
    throw std::logic_error("oracle: a load over nothing has no argument");
}

}  // namespace

/// The piece that a place lies in, found by looking at all of them.
TableMotion table_motion(slideway::PieceTable const& table, Real at) {
    Real times = 0;
    if (table.repeats) {
        Real const period = Real(table.high) - table.low;
        times = std::floor((at - table.low) / period);
        at -= period * times;
    }
    bool const outside = at < table.low || at > table.high;
    if (at < table.low) at = table.low;
    if (at > table.high) at = table.high;
    auto const* piece = table.pieces;
    for (int i = 0; i < table.count; ++i) {
        if (table.pieces[i].from <= at) piece = &table.pieces[i];
    }
    Real const u = at - piece->from, cubic[] = {piece->value, piece->slope, piece->square, piece->cube, piece->fourth};
    TableMotion motion;
    for (int i = 0; i < 5; ++i) {
        motion.value += cubic[i] * std::pow(u, i);
        if (i > 0 && !outside) motion.slope += i * cubic[i] * std::pow(u, i - 1);
        if (i > 1 && !outside) motion.bend += i * (i - 1) * cubic[i] * std::pow(u, i - 2);
    }
    motion.value += times * table.advance;
    return motion;
}

LoadSum load_sum(Inputs const& in, Parts const& parts, LoadPlace const& place, Matrix4 const& pose, Matrix4 const& pose_rate) {
    auto const number = [&](int index) { return index < 0 ? Real(0) : Real(in.*slideway::load_inputs[index]); };
    auto const vector = [&](int const (&index)[3]) { return Vector3(number(index[0]), number(index[1]), number(index[2])); };
    Matrix3 const attitude = pose.topLeftCorner<3, 3>();
    LoadSum sum;
    for (int i = 0; i < parts.loads.count; ++i) {
        slideway::Load const& load = parts.loads.loads[i];
        Real factor = load.scale < 0 ? Real(1) : number(load.scale);
        if (load.over != slideway::LoadArgument::nothing) factor *= table_motion(load.table, argument_of(load.over, place)).value;
        Vector3 force = factor * vector(load.force), torque = factor * vector(load.torque);
        if (load.turns_with_slider) force = attitude * force, torque = attitude * torque;
        Vector4 const point = (Vector4() << vector(load.point), 1).finished();
        Vector4 const arm = pose * point - pose.col(3), velocity = pose_rate * point;
        // ω × of the slider is A' Aᵀ.
        Matrix3 const turning = pose_rate.topLeftCorner<3, 3>() * attitude.transpose();
        Vector3 const spin(turning(2, 1), turning(0, 2), turning(1, 0));
        sum.force += force;
        sum.torque += torque + arm.head<3>().cross(force);
        sum.slider_power += force.dot(velocity.head<3>()) + torque.dot(spin);
        sum.crank_torque += factor * number(load.crank_torque);
    }
    return sum;
}

}  // namespace oracle::detail
