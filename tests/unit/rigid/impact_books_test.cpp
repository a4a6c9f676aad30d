// Which pairs an impact of rigid contacts has met, as its books have it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>

#include "kernels/mechanisms/list.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "kernels/rigid/planar_slider_crank.hpp"
#include "tests/support/rigid_free_slider.hpp"

namespace slideway::impact_books_test {
namespace {

Parts parts_of(Mechanism mechanism) {
    Parts parts;
    parts.mechanism = mechanism;
    parts.rigid = true;
    return parts;
}

Inputs inputs() {
    Inputs in;
    in.restitution = 0.5;
    return complete_inputs(in);
}

/// Pairs that an impact in a state has met.
template <class Model, std::size_t size> unsigned met(Model const& model, std::array<double, size> state) {
    auto const p = Model::parameters(inputs());
    typename Model::template Memory<double> memory;
    start_memory(memory);
    memory.begun = 1;
    std::array<double, size> rates{};
    typename Model::template Report<double> report;
    model.template derivative<true>(0.0, state.data(), p, memory, rates.data(), &report);
    model.settle(true, 0.0, 1.0, state.data(), p, memory, report.contact);
    return static_cast<unsigned>(memory.books.met);
}

/// A bit for each of some apices, from 1.
template <class Model> unsigned bits_of(bool z_faces, std::initializer_list<int> apices) {
    unsigned bits = 0;
    for (int const apex : apices) bits |= 1u << Model::met_bit(z_faces, apex - 1);
    return bits;
}

// The hole of a slider that goes down meets the way from above: with the apices on its side +y.
TEST(ImpactBooks, OfAFaceNameItsApices) {
    RigidFreeSlider const model(parts_of(Mechanism::free_slider));
    double const c = inputs().clearance_y, cz = inputs().clearance_z;
    using Faces = RigidFreeSlider;
    EXPECT_EQ(met(model, std::array<double, 12>{-c, 0, -0.1}), bits_of<Faces>(false, {1, 4, 5, 8}));
    EXPECT_EQ(met(model, std::array<double, 12>{c, 0, 0.1}), bits_of<Faces>(false, {2, 3, 6, 7}));
    EXPECT_EQ(met(model, std::array<double, 12>{0, -cz, 0, -0.1}), bits_of<Faces>(true, {1, 2, 5, 6}));
    EXPECT_EQ(met(model, std::array<double, 12>{0, cz, 0, 0.1}), bits_of<Faces>(true, {3, 4, 7, 8}));
    EXPECT_EQ(met(model, std::array<double, 12>{0, cz, 0, -0.1}), 0u) << "it leaves";
}

// Corners a to d: front above, front below, rear below, rear above.
TEST(ImpactBooks, OfAPlanarSliderNameItsCorners) {
    RigidPlanarSliderCrank const model(parts_of(Mechanism::planar_slider_crank));
    Inputs const in = inputs();
    auto const at = [&](double side, double tilt) {
        // The crank lies along the way: the slider is as high as the rod lifts it, and goes where that and the crank turn it.
        double const lift = in.slider_length / 2 * std::abs(std::sin(tilt)), gap = in.clearance_y + in.way_width / 2 * (1 - std::cos(tilt));
        double const angle = std::asin(side * (gap - lift) / in.rod_length);
        double const turning = (side * 0.1 - in.crank_length * in.crank_speed) / (in.rod_length * std::cos(angle));
        return std::array<double, 6>{0, angle, tilt, in.crank_speed, turning, 0};
    };
    using Corners = RigidPlanarSliderCrank;
    EXPECT_EQ(met(model, at(1, 0)), bits_of<Corners>(false, {1, 4}));
    EXPECT_EQ(met(model, at(-1, 0)), bits_of<Corners>(false, {2, 3}));
    EXPECT_EQ(met(model, at(1, 1e-4)), bits_of<Corners>(false, {1}));
    EXPECT_EQ(met(model, at(1, -1e-4)), bits_of<Corners>(false, {4}));
    EXPECT_EQ(met(model, at(-1, 1e-4)), bits_of<Corners>(false, {3}));
}

}  // namespace
}  // namespace slideway::impact_books_test
