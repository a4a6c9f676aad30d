#include "host/run/time_left.hpp"

#include <limits>

namespace slideway {

void TimeLeft::note(double seconds, double done) {
    constexpr double window = 0.5, spacing = 0.01;  // of the time so far
    now_ = {seconds, done};
    if (seconds - window_.back().seconds >= spacing * seconds) window_.push_back(now_);
    while (window_.size() > 1 && window_[1].seconds <= (1 - window) * seconds) window_.pop_front();
}

double TimeLeft::seconds(double left) const {
    if (left <= 0) return 0;
    if (!(now_.done > 0)) return std::numeric_limits<double>::quiet_NaN();
    double const so_far = now_.seconds / now_.done;
    Point const& from = window_.front();
    double const of_late = now_.done > from.done ? (now_.seconds - from.seconds) / (now_.done - from.done) : so_far;
    return left * (so_far + of_late) / 2;
}

}  // namespace slideway
