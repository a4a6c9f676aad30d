#include "oil_film.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "pairs.hpp"

namespace oracle::detail {
namespace {

struct Lubricant { Real viscosity, thinnest, tension; };

/// A face as a plate over the way's: what it does to the slider, in way coordinates.
void add_plate(Lubricant const& film, FaceOfWay const& face, std::array<Pair, 8> const& pairs, Real along, Real across, FilmLoads& sum) {
    // The four corners' means are those of the plate's middle.
    Vector3 middle = Vector3::Zero(), sliding = Vector3::Zero(), normal = Vector3::Zero();
    Real gap = 0, opening = 0;
    for (int const corner : face.corners) {
        Pair const& pair = pairs[corner - 1];
        gap -= pair.depth / 4, opening -= pair.rate / 4;
        middle += pair.arm / 4, sliding += pair.slip / 4;
        normal = face.side * pair.normal;
    }
    Real const thickness = std::max(gap, film.thinnest), area = along * across;
    Real const length = std::max(along, across), breadth = std::min(along, across);
    Real const squeeze = -film.viscosity * length * std::pow(breadth, 3) * (1 - 0.63L * breadth / length) * opening / std::pow(thickness, 3);
    Real const pressing = std::max(squeeze, -film.tension * area);
    Vector3 const shear = -film.viscosity * area / thickness * sliding, push = pressing * normal;
    sum.force += shear + Vector3(0, push.y(), push.z());  // the way has no end to be pushed at
    sum.torque += middle.cross(shear + push);
    sum.load += std::abs(pressing) + shear.norm();
    sum.loss -= pressing * opening + shear.dot(sliding);
}

}  // namespace

FilmLoads film_loads(Inputs const& in, Parts const& parts, SliderMotion const& slider) {
    FilmLoads sum;
    auto const* const begin = parts.loads.loads;
    auto const* const found = std::find_if(begin, begin + parts.loads.count, [](slideway::Load const& load) { return load.kind == slideway::LoadKind::film; });
    if (found == begin + parts.loads.count) return sum;
    auto const number = [&](int place) { return place < 0 ? Real(0) : Real(in.*slideway::load_inputs[place]); };
    Lubricant const film{number(found->viscosity), number(found->least_gap), number(found->cavitation_pressure)};
    Matrix4 const way = pose_of_way(in, parts);
    PairTable const pairs = pairs_of(in, parts, slider, way, nullptr);
    for (FaceOfWay const& face : faces_of_way)
        add_plate(film, face, pairs[face.axis], in.slider_length, face.axis == 1 ? in.way_depth : in.way_width, sum);
    Matrix3 const turn_back = way.topLeftCorner<3, 3>();
    sum.force = turn_back * sum.force;
    sum.torque = turn_back * sum.torque;
    return sum;
}

}  // namespace oracle::detail
