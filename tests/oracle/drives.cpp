// The mechanisms that prescribe where the slider is along the way.
#include <cmath>

#include "numbers.hpp"
#include "oracle.hpp"

namespace oracle {

using namespace detail;

AlongTheWay carriage_motion(Inputs const& in, long double t) {
    Real const speed = in.carriage_speed, reversal = in.reversal_time;
    Real const straight = in.stroke / speed;
    // There and back are alike: x(t + half) = stroke - x(t).
    Real const half = straight + reversal;
    Real const halves = std::floor(t / half);
    bool const back = std::fmod(halves, 2) != 0;
    Real const since = t - halves * half;
    AlongTheWay way_out;
    if (since <= straight) {
        way_out = {speed * since, speed, 0};
    } else {
        Real const rate = pi / reversal, angle = rate * (since - straight);
        way_out = {in.stroke + speed / rate * std::sin(angle), speed * std::cos(angle),
                   -speed * rate * std::sin(angle)};
    }
    return back ? AlongTheWay{in.stroke - way_out.x, -way_out.vx, -way_out.ax} : way_out;
}

AlongTheWay scotch_yoke_motion(Inputs const& in, long double t) {
    Real const radius = in.crank_length, speed = in.crank_speed, angle = in.start_angle + speed * t;
    // The pin's x, and its two derivatives.
    Real const x = radius * std::cos(angle);
    return {x, -radius * speed * std::sin(angle), -speed * speed * x};
}

}  // namespace oracle
