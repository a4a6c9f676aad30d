// When work will be done whose rate changes on the way.
#pragma once

#include <deque>
#include <limits>

namespace slideway {

/// Told now and then how much work is done, says how long the rest will take.  Members rattle and come to rest, and cost more then than now: half of
/// its word is the rate since the start, half that of the later half of the time so far, so that it follows without jumping.
class TimeLeft {
public:
    /// @param seconds since the start, later than those of the last call  @param done work since the start, no less than then
    void note(double seconds, double done) {
        constexpr double window = 0.5, spacing = 0.01;  // of the time so far
        now_ = {seconds, done};
        if (seconds - window_.back().seconds >= spacing * seconds) window_.push_back(now_);
        while (window_.size() > 1 && window_[1].seconds <= (1 - window) * seconds) window_.pop_front();
    }
    /// @param left work still to do, >= 0  @return [s]; NaN as long as nothing is done, and something left
    double seconds(double left) const {
        if (left <= 0) return 0;
        if (!(now_.done > 0)) return std::numeric_limits<double>::quiet_NaN();
        double const so_far = now_.seconds / now_.done;
        Point const& from = window_.front();
        double const of_late = now_.done > from.done ? (now_.seconds - from.seconds) / (now_.done - from.done) : so_far;
        return left * (so_far + of_late) / 2;
    }

private:
    struct Point {
        double seconds = 0, done = 0;
    };
    Point now_;
    std::deque<Point> window_{Point{}};  // from half the time so far on, or just before; some seventy at most
};

}  // namespace slideway
