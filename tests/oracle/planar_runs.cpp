#include "planar_runs.hpp"

#include <algorithm>
#include <cmath>

#include "numbers.hpp"
#include "oracle.hpp"
#include "runge_kutta.hpp"

namespace oracle {
namespace {

using namespace detail;

constexpr Real least_impact_speed = 1e-4;

class CompliantRun {
public:
    CompliantRun(Inputs const& in, Parts const& parts, CompliantSteps const& steps)
        : mechanism_(in, parts), clearance_(in.clearance_y), steps_(steps), state_(planar_start(in)) {
        impact_speeds_.fill(least_impact_speed);
        last_ = mechanism_.at(state_, &impact_speeds_);
    }

    [[nodiscard]] PlanarSample sample() const { return {state_[0] / (2 * pi), state_[1], last_.y / clearance_}; }

    void advance(Real duration) {
        Real left = duration;
        while (left > 0) {
            Real const gap = -*std::max_element(last_.depth.begin(), last_.depth.end());
            Real const fastest = *std::max_element(last_.rate.begin(), last_.rate.end());
            bool const near = gap < 5 * steps_.in_flight * std::abs(fastest) + 1e-8L;
            left -= step(std::min(left, near ? steps_.near_wall : steps_.in_flight));
        }
    }

private:
    [[nodiscard]] PlanarState after(Real h) const {
        return runge_kutta(state_, h,
                           [this](PlanarState const& s) { return mechanism_.at(s, &impact_speeds_).derivative; });
    }
    [[nodiscard]] bool touches_anew(PlanarResult const& r) const {
        for (int i = 0; i < 4; ++i)
            if (last_.depth[i] <= 0 && r.depth[i] > 0) return true;
        return false;
    }

    /// One step, or the part of it up to the first touch.  @return how long it was
    Real step(Real h) {
        PlanarState next = after(h);
        PlanarResult reached = mechanism_.at(next, &impact_speeds_);
        if (touches_anew(reached)) {
            Real before = 0, past = h;
            while (past - before > 1e-17L) {
                Real const middle = (before + past) / 2;
                (touches_anew(mechanism_.at(after(middle), &impact_speeds_)) ? past : before) = middle;
            }
            h = past;
            next = after(h);
            reached = mechanism_.at(next, &impact_speeds_);
            for (int i = 0; i < 4; ++i)
                if (last_.depth[i] <= 0 && reached.depth[i] > 0)
                    impact_speeds_[i] = std::max(least_impact_speed, reached.rate[i]);
        }
        state_ = next;
        last_ = mechanism_.at(state_, &impact_speeds_);
        return h;
    }

    PlanarMechanism mechanism_;
    Real clearance_;
    CompliantSteps steps_;
    PlanarState state_;
    Corners impact_speeds_;
    PlanarResult last_;
};

}  // namespace

Inputs planar_check_inputs() {
    Inputs in;
    in.crank_length = 0.153, in.rod_length = 0.306;
    in.slider_length = 0.1, in.slider_height = 0.05, in.clearance_y = 1e-3;
    in.crank_mass = in.rod_mass = 0.038, in.slider_mass = 0.076;
    in.crank_inertia = 7.4e-5, in.rod_inertia = 5.9e-4, in.slider_inertia_z = 2.7e-6;
    in.gravity = 9.81;
    in.start_angle = 0, in.crank_speed = 150;  // y = vy = 0: the rod turns at -75 rad/s
    in.point_stiffness = 1e11, in.hertz_exponent = 1.5, in.restitution = 0.4;
    return completed(in);
}

std::vector<PlanarSample> compliant_run(Inputs const& in, Parts const& parts, long double every, int count,
                                        CompliantSteps const& steps) {
    CompliantRun run(in, parts, steps);
    std::vector<PlanarSample> samples{run.sample()};
    for (int i = 0; i < count; ++i) {
        run.advance(every);
        samples.push_back(run.sample());
    }
    return samples;
}

}  // namespace oracle
