// The lubricant between the slider's faces and the way, face by face as between two plates (model.md 14).
#pragma once

#include "mechanism.hpp"
#include "numbers.hpp"

namespace oracle::detail {

/// Inertial frame; the torque is about the slider's centre.
struct FilmLoads {
    Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
    Real loss = 0;  // [W]
    Real load = 0;  // Σ of the magnitudes of all forces [N]
};
/// Nothing where the parts have no film.
FilmLoads film_loads(Inputs const& in, Parts const& parts, SliderMotion const& slider);

}  // namespace oracle::detail
