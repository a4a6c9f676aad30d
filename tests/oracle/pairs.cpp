#include "pairs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "loads.hpp"
#include "poses.hpp"

namespace oracle::detail {
namespace {

Real const least_impact_speed = 1e-4;

}  // namespace

PairTable pairs_of(Inputs const& in, Parts const& parts, SliderMotion const& motion, Matrix4 const& way, Pairs const* impact_speeds) {
    Matrix4 const from_inertial = inverse_of(way);
    Matrix4 const slider = from_inertial * motion.pose;
    Matrix4 const slider_rate = from_inertial * motion.pose_rate;
    Matrix4 const into_slider = inverse_of(slider);
    Matrix3 const attitude = slider.topLeftCorner<3, 3>();
    Vector3 const centre = slider.topRightCorner<3, 1>();
    Vector3 const velocity = slider_rate.topRightCorner<3, 1>();
    Vector3 const angular_velocity = attitude * motion.angular_velocity;
    // The hole is the way and both clearances wide; a slider in the middle of the frame has each face's to it.
    auto const own = [](double face, double common) { return Real(std::isnan(face) ? common : face); };
    Real const plus[3] = {0, own(in.clearance_y_plus, in.clearance_y), own(in.clearance_z_plus, in.clearance_z)};
    Real const minus[3] = {0, own(in.clearance_y_minus, in.clearance_y), own(in.clearance_z_minus, in.clearance_z)};
    Real const widths[3] = {0, in.way_width, in.way_depth};
    Real half_hole[3] = {}, middle[3] = {};
    for (int axis : {1, 2}) {
        half_hole[axis] = (widths[axis] + plus[axis] + minus[axis]) / 2;
        middle[axis] = half_hole[axis] - plus[axis] - widths[axis] / 2;
    }

    PairTable table;
    for (int i = 0; i < 8; ++i) {
        auto const [s1, s2, s3] = apices[i];
        // The contact segment of the way runs along with the slider, but not beyond the way's ends.
        Real const along = centre.x() + s3 * Real(in.slider_length) / 2, place = along + way(0, 3), nearest = way_place(in, parts, place);
        bool const stays = nearest != place;
        Real const at = stays ? nearest - way(0, 3) : along;
        Vector4 const apex(at, middle[1] + s1 * Real(in.way_width) / 2,
                           middle[2] + s2 * Real(in.way_depth) / 2, 1);
        Vector4 const apex_rate(stays ? Real(0) : velocity.x(), 0, 0, 0);
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
            // The face lies back there; apex and arm stay those of a straight one.
            TableMotion const back = way_depth(in, parts, 2 * (axis - 1) + (pair.side > 0 ? 0 : 1), nearest);
            pair.stays = stays;
            pair.opens = stays ? Real(0) : back.slope;
            pair.depth -= back.value;
            pair.rate -= pair.opens * velocity.x();
            Vector3 const sliding = velocity + angular_velocity.cross(pair.arm);
            pair.slip = sliding - sliding.dot(pair.normal) * pair.normal;
            Real const remembered = impact_speeds ? (*impact_speeds)[(axis - 1) * 8 + i] : 0.0;
            pair.impact_speed = std::max(remembered, least_impact_speed);
        }
    }
    return table;
}

}  // namespace oracle::detail
