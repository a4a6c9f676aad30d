#include "host/scene/drive_period.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "host/scene/descriptors.hpp"

namespace slideway {
namespace {

/// Nothing holds a speed, of a crank or of the slider.
bool is_free(Parts const& parts) {
    return parts.free_crank || info(parts.mechanism).drive == DriveKind::none;
}

}  // namespace

double drive_period(Parts const& parts, Inputs const& inputs) {
    if (is_free(parts)) return std::numeric_limits<double>::infinity();
    if (info(parts.mechanism).drive == DriveKind::carriage) {
        return 2 * (inputs.stroke / inputs.carriage_speed + inputs.reversal_time);
    }
    return 2 * std::numbers::pi / std::abs(inputs.crank_speed);
}

double first_time_at(double phase, Parts const& parts, Inputs const& inputs) {
    double const turn = drive_period(parts, inputs);
    double const from_start = info(parts.mechanism).drive == DriveKind::carriage
                                  ? phase * (turn / (2 * std::numbers::pi))
                                  : (phase - inputs.start_angle) / inputs.crank_speed;
    double const time = std::fmod(from_start, turn);
    double const positive = time > 0 ? time : time + turn;
    // A start at the phase itself is no return to it.
    return positive > 1e-9 * turn ? positive : positive + turn;
}

std::string why_no_period(Parts const& parts) {
    if (!is_free(parts)) return "mechanism.crank_speed is 0";
    return std::string("nothing drives a ") + (parts.free_crank ? "free crank" : info(parts.mechanism).name);
}

}  // namespace slideway
