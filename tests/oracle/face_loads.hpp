// What the contacts of one face of the way carry, by any of the laws.
#pragma once

#include <array>
#include <iterator>
#include <vector>

#include "pairs.hpp"

namespace oracle::detail {

/// The contacts of one face: adds each one's shares to its pairs and its potential to the sum.
class FaceLoads {
public:
    FaceLoads(Inputs const& in, Parts const& parts, FaceOfWay const& face, std::array<Pair, 8>& pairs);

    /// Lists the contacts as section 4 counts them.
    void detect();
    /// After detect(): by the law of the parts.
    void load();

    [[nodiscard]] int surfaces() const { return surface_ ? 1 : 0; }
    [[nodiscard]] int lines() const { return static_cast<int>(lines_.size()); }
    [[nodiscard]] int points() const { return static_cast<int>(points_.size()); }
    [[nodiscard]] Real potential() const { return potential_; }

private:
    void load_by_paper();         // the listed contacts alone
    void load_by_conservative();  // each apex, line and surface that touches
    void load_by_kelvin_voigt();  // each apex that touches
    void load_by_foundation();    // what is wet of the face
    [[nodiscard]] Pair& at(int p) const { return pairs_[p - 1]; }
    [[nodiscard]] bool touches(int p) const { return at(p).depth > 0; }
    [[nodiscard]] Real length(Edge const& edge) const {
        return edge.run == Run::along_x ? Real(in_.slider_length) : across_;
    }
    [[nodiscard]] std::vector<int> corner_list() const { return {std::begin(face_.corners), std::end(face_.corners)}; }

    void add(int p, Real elastic, Real force) const;
    /// Line or surface with its dissipation; never pulls.
    [[nodiscard]] Real damped(Real elastic, Real rate, Real chi, std::vector<int> const& touching) const;
    void load_point(int p);

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

}  // namespace oracle::detail
