// When work will be done whose rate changes on the way.
#pragma once

#include <deque>

namespace slideway {

/// Told now and then how much work is done, says how long the rest will take.  Members rattle and come to rest, and cost more then than now: half of
/// its word is the rate since the start, half that of the later half of the time so far, so that it follows without jumping.
class TimeLeft {
public:
    /// @param seconds since the start, later than those of the last call  @param done work since the start, no less than then
    void note(double seconds, double done);
    /// @param left work still to do, >= 0  @return [s]; NaN as long as nothing is done, and something left
    double seconds(double left) const;

private:
    struct Point {
        double seconds = 0, done = 0;
    };
    Point now_;
    std::deque<Point> window_{Point{}};  // from half the time so far on, or just before; some seventy at most
};

}  // namespace slideway
