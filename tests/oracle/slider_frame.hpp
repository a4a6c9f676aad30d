// What a state of a spatial mechanism says of inertia, loads and apices, for rigid contacts: v' = free + mobility · (forces along the rows of pairs).
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "numbers.hpp"
#include "oracle.hpp"

namespace oracle::detail {

using Vector6 = Eigen::Matrix<Real, 6, 1>;
using Matrix6 = Eigen::Matrix<Real, 6, 6>;

/// Where the slider is: a quaternion, so that no angle is special.
struct SliderPlace {
    Real time = 0;
    Vector3 centre, velocity;
    Eigen::Quaternion<Real> attitude;
    Vector3 spin;  // in the slider's frame

    [[nodiscard]] Vector6 rates() const;
    void set_rates(Vector6 const& v);
    void shift(Vector6 const& by);  // small changes: of the centre, and turns about the slider's axes
};

/// An apex of the way and a face of the slider.  Rows act on (u', ω in the slider's frame).
struct SliderPair {
    using Rows = Eigen::Matrix<Real, 3, 6>;
    Real gap = 0;
    Rows rows;       // gap', and the slip along both axes of the face
    Vector3 biases;  // what rows · v' lacks to be their rate
};

/// The slider between its drive and its way.
class SliderFrame {
public:
    SliderFrame(Inputs const& in, Parts const& parts);

    /// Where the inputs start it.
    [[nodiscard]] SliderPlace start() const;
    /// The numbers of the state y z vy vz roll yaw pitch wx wy wz x vx.
    [[nodiscard]] static std::array<Real, 12> state(SliderPlace const& place);

    void move_to(SliderPlace const& place);
    [[nodiscard]] SliderPlace const& place() const { return place_; }
    [[nodiscard]] Matrix6 const& mobility() const { return mobility_; }
    [[nodiscard]] Vector6 const& free() const { return free_; }
    [[nodiscard]] Real energy() const { return energy_; }
    /// @param number Y faces P1..P8, then Z faces P1..P8
    [[nodiscard]] SliderPair pair(int number) const;
    [[nodiscard]] Real gap(int number) const;

private:
    struct Apex3 {
        int axis;
        Real side;
        Vector3 arm;
    };
    [[nodiscard]] Apex3 apex(int number) const;
    using Jacobian = Eigen::Matrix<Real, 3, 6>;
    /// Of a point of the slider at r from the hole's centre: velocity = jacobian · rates, acceleration = jacobian · rates' + pull.
    [[nodiscard]] Jacobian jacobian(Vector3 const& r) const;
    [[nodiscard]] Vector3 pull(Vector3 const& r) const;
    void add_drive(Vector6 const& force, Matrix6 const& mass);

    Inputs in_;
    Parts parts_;
    Matrix3 way_;
    Vector3 way_centre_, gravity_, inertia_;
    SliderPlace place_;
    Matrix3 attitude_;                  // of the slider in way coordinates
    Vector3 centre_, velocity_, turn_;  // in way coordinates
    Matrix6 mobility_;
    Vector6 free_;
    Real energy_ = 0;
};

}  // namespace oracle::detail
