#include "loads.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
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

using Number = std::function<Real(int)>;
using Triple = std::function<Vector3(int const (&)[3])>;

/// Tension along the line to the anchor, or along X.
void add_spring(slideway::Load const& load, Number const& number, Triple const& vector, Vector3 const& place, Vector3 const& velocity, Vector3& force,
                LoadSum& sum) {
    Vector3 line = place - vector(load.anchor);
    if (load.along) line = Vector3(line.x(), 0, 0);
    // Along X a length has a sign.
    Vector3 const unit = load.along ? Vector3(Vector3::UnitX()) : Vector3(line.normalized());
    Real const beyond = unit.dot(line) - number(load.rest_length), k = number(load.stiffness), c = number(load.damping), preload = number(load.preload);
    Real const lengthening = unit.dot(velocity);
    force = -(preload + k * beyond + c * lengthening) * unit;
    sum.potential += k * beyond * beyond / 2 + preload * beyond;
    sum.spring_loss += c * lengthening * lengthening;
}

void add_stop(slideway::Load const& load, Number const& number, Vector3 const& place, Vector3 const& velocity, Vector3& force, LoadSum& sum) {
    Real const in = load.side * (place.x() - number(load.anchor[0])), speed = load.side * velocity.x(), k = number(load.stiffness);
    if (!(in > 0)) return;
    Real const held = k * in, viscous = held * number(load.dissipation) * speed + number(load.damping) * speed;
    Real const push = std::max(held + viscous, Real(0));
    force = Vector3(-load.side * push, 0, 0);
    sum.potential += held * in / 2;
    sum.spring_loss += push * speed - held * speed;
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

TableMotion way_depth(Inputs const& in, Parts const& parts, int face, Real x) {
    TableMotion sum;
    for (int i = 0; i < parts.loads.count; ++i) {
        slideway::Load const& load = parts.loads.loads[i];
        if (load.kind != slideway::LoadKind::way_profile || (load.faces / (1 << face)) % 2 == 0) continue;
        auto const number = [&](int index) { return Real(in.*slideway::load_inputs[index]); };
        TableMotion const of = table_motion(load.table, x);
        Real const scale = load.scale < 0 ? Real(1) : number(load.scale);
        sum.value += scale * of.value;
        sum.slope += scale * of.slope;
    }
    return sum;
}

Real way_place(Inputs const& in, Parts const& parts, Real x) {
    for (int i = 0; i < parts.loads.count; ++i) {
        slideway::Load const& load = parts.loads.loads[i];
        if (load.kind != slideway::LoadKind::way_ends) continue;
        if (load.from >= 0) x = std::max(x, Real(in.*slideway::load_inputs[load.from]));
        if (load.to >= 0) x = std::min(x, Real(in.*slideway::load_inputs[load.to]));
    }
    return x;
}

LoadSum load_sum(Inputs const& in, Parts const& parts, LoadPlace const& place, Matrix4 const& pose, Matrix4 const& pose_rate) {
    Number const number = [&](int index) { return index < 0 ? Real(0) : Real(in.*slideway::load_inputs[index]); };
    Triple const vector = [&](int const (&index)[3]) { return Vector3(number(index[0]), number(index[1]), number(index[2])); };
    Matrix3 const attitude = pose.topLeftCorner<3, 3>();
    LoadSum sum;
    for (int i = 0; i < parts.loads.count; ++i) {
        slideway::Load const& load = parts.loads.loads[i];
        using enum slideway::LoadKind;
        if (load.kind == way_profile || load.kind == way_ends || load.kind == film) continue;  // way_depth, way_place and film_loads have them
        Real factor = load.scale < 0 ? Real(1) : number(load.scale);
        if (load.over != slideway::LoadArgument::nothing) factor *= table_motion(load.table, argument_of(load.over, place)).value;
        if (load.kind == slideway::LoadKind::ground_motion) {
            sum.ground += factor * vector(load.force);
            continue;
        }
        Vector4 const point = (Vector4() << vector(load.point), 1).finished();
        Vector4 const at = pose * point, arm = at - pose.col(3), velocity = pose_rate * point;
        Vector3 force = factor * vector(load.force), torque = factor * vector(load.torque);
        if (load.kind == slideway::LoadKind::push) {
            if (load.turns_with_slider) force = attitude * force, torque = attitude * torque;
            // ω × of the slider is A' Aᵀ.
            Matrix3 const turning = pose_rate.topLeftCorner<3, 3>() * attitude.transpose();
            Vector3 const spin(turning(2, 1), turning(0, 2), turning(1, 0));
            sum.slider_power += force.dot(velocity.head<3>()) + torque.dot(spin);
            sum.crank_torque += factor * number(load.crank_torque);
        } else if (load.kind == slideway::LoadKind::spring) {
            add_spring(load, number, vector, at.head<3>(), velocity.head<3>(), force, sum);
        } else {
            add_stop(load, number, at.head<3>(), velocity.head<3>(), force, sum);
        }
        sum.force += force;
        sum.torque += torque + arm.head<3>().cross(force);
    }
    return sum;
}

}  // namespace oracle::detail
