#include "face_loads.hpp"

#include <algorithm>
#include <cmath>

#include "bed.hpp"
#include "kernels/laws/list.hpp"
#include "laws.hpp"

namespace oracle::detail {

FaceLoads::FaceLoads(Inputs const& in, Parts const& parts, FaceOfWay const& face, std::array<Pair, 8>& pairs)
    : in_(in), parts_(parts), face_(face), pairs_(pairs) {
    point_stiffness_ = point_stiffness(in);
    Real const modulus = 2 * Real(in.slider_young_modulus) * in.way_young_modulus /
                         (Real(in.slider_young_modulus) + in.way_young_modulus);
    Real const width = face.axis == 1 ? in.way_depth : in.way_width;
    Real const thickness = face.axis == 1 ? in.thickness_y : in.thickness_z;
    surface_stiffness_ = modulus * in.slider_length * width / thickness;
    across_ = width;
    if (parts.damping == Damping::restitution) slope_ = slope_of_restitution(in.restitution);
}

void FaceLoads::detect() {
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

void FaceLoads::load() {
    switch (parts_.law) {
        case Law::paper:
            return load_by_paper();
        case Law::conservative:
            return load_by_conservative();
        case Law::kelvin_voigt:
            return load_by_kelvin_voigt();
        case Law::foundation:
            return load_by_foundation();
    }
}

void FaceLoads::load_by_paper() {
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

void FaceLoads::load_by_conservative() {
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

void FaceLoads::load_by_kelvin_voigt() {
    // Four apices of the stiffness that follows are the surface.
    Real const stiffness = std::isnan(in_.law_a) ? surface_stiffness_ / 4 : Real(in_.law_a), damping = in_.law_b;
    for (int p : face_.corners) {
        if (!touches(p)) continue;
        Real const depth = at(p).depth, elastic = stiffness * depth;
        add(p, elastic, std::max(elastic + damping * at(p).rate, Real(0)));
        potential_ += stiffness * depth * depth / 2;
    }
}

void FaceLoads::load_by_foundation() {
    Real impact_speed = 0;
    std::vector<BedPlace> square;
    for (int p : face_.corners) {
        Apex const& apex = apices[p - 1];
        square.push_back({Real(apex.s3), Real(face_.axis == 1 ? apex.s2 : apex.s1), at(p).depth, at(p).rate});
        if (touches(p)) impact_speed = std::max(impact_speed, at(p).impact_speed);
    }
    if (impact_speed == 0) return;
    Real slope = parts_.damping == Damping::rate ? Real(in_.chi_surface) : 0;
    if (parts_.damping == Damping::restitution) slope = slope_ / impact_speed;
    Real const stiffness = std::isnan(in_.law_a) ? surface_stiffness_ : Real(in_.law_a) * in_.slider_length * across_;
    auto const places = quadrature_over_wet(square);
    for (std::size_t i = 0; i < 4; ++i) {
        Real elastic = 0, force = 0;
        for (auto const& [place, area] : places) {
            Real const share = area / 4 * stiffness * place.depth * (1 + square[i].along * place.along) * (1 + square[i].across * place.across) / 4;
            elastic += share;
            force += share * (1 + slope * place.rate);
        }
        add(face_.corners[i], elastic, std::max(force, Real(0)));
    }
    for (auto const& [place, area] : places) potential_ += area / 4 * stiffness * place.depth * place.depth / 2;
}

void FaceLoads::add(int p, Real elastic, Real force) const {
    at(p).elastic += elastic;
    at(p).force += force;
}

Real FaceLoads::damped(Real elastic, Real rate, Real chi, std::vector<int> const& touching) const {
    Real factor = 1;
    if (parts_.damping == Damping::rate) factor += chi * rate;
    if (parts_.damping == Damping::restitution) {
        Real impact_speed = 0;
        for (int p : touching) impact_speed = std::max(impact_speed, at(p).impact_speed);
        factor += slope_ * rate / impact_speed;
    }
    return elastic * std::max(factor, Real(0));
}

void FaceLoads::load_point(int p) {
    Real const depth = at(p).depth, n = in_.hertz_exponent;
    Real const elastic = point_stiffness_ * std::pow(depth, n);
    Real const force = parts_.damping == Damping::restitution
                           ? damped(elastic, at(p).rate, 0, {p})
                           : std::max(elastic + in_.eta * point_stiffness_ * depth * at(p).rate, Real(0));
    add(p, elastic, force);
    potential_ += point_stiffness_ * std::pow(depth, n + 1) / (n + 1);
}

}  // namespace oracle::detail
