#include "bed.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

namespace oracle::detail {

namespace {

BedPlace mixed(BedPlace const& a, BedPlace const& b, Real share) {
    auto const mix = [share](Real x, Real y) { return x + share * (y - x); };
    return {mix(a.along, b.along), mix(a.across, b.across), mix(a.depth, b.depth), mix(a.rate, b.rate)};
}

/// Sutherland and Hodgman's algorithm, of one line.
std::vector<BedPlace> wet_polygon(std::vector<BedPlace> const& square) {
    std::vector<BedPlace> polygon;
    for (std::size_t i = 0; i < square.size(); ++i) {
        BedPlace const &here = square[i], &next = square[(i + 1) % square.size()];
        if (here.depth >= 0) polygon.push_back(here);
        if ((here.depth > 0 && next.depth < 0) || (here.depth < 0 && next.depth > 0)) {
            polygon.push_back(mixed(here, next, here.depth / (here.depth - next.depth)));
            polygon.back().depth = 0;
        }
    }
    return polygon;
}

BedPlace at(BedPlace const& a, BedPlace const& b, BedPlace const& c, Real x, Real y) {
    auto const mix = [x, y](Real p, Real q, Real r) { return (1 - x - y) * p + x * q + y * r; };
    return {mix(a.along, b.along, c.along), mix(a.across, b.across, c.across), mix(a.depth, b.depth, c.depth), mix(a.rate, b.rate, c.rate)};
}

}  // namespace

std::vector<WeightedPlace> quadrature_over_wet(std::vector<BedPlace> const& square) {
    auto const polygon = wet_polygon(square);
    // J. Radon, Monatsh. Math. Phys. 52 (1948) 286: seven places, exact up to degree five.
    Real const root = std::sqrt(Real(15)), near = (6 - root) / 21, far = (6 + root) / 21, third = 1 / Real(3);
    Real const near_weight = (155 - root) / 1200, far_weight = (155 + root) / 1200, middle_weight = 9 / Real(40);
    std::vector<WeightedPlace> places;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        BedPlace const &a = polygon[0], &b = polygon[i - 1], &c = polygon[i];
        Real const area = std::abs((b.along - a.along) * (c.across - a.across) - (c.along - a.along) * (b.across - a.across)) / 2;
        auto const add = [&](Real x, Real y, Real weight) { places.push_back({at(a, b, c, x, y), area * weight}); };
        add(third, third, middle_weight);
        for (auto const& [inner, weight] : {std::pair{near, near_weight}, std::pair{far, far_weight}}) {
            add(inner, inner, weight);
            add(inner, 1 - 2 * inner, weight);
            add(1 - 2 * inner, inner, weight);
        }
    }
    return places;
}

}  // namespace oracle::detail
