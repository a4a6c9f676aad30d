#pragma once

#include "tests/models/models.hpp"
#include "tests/models/plain_model.hpp"
#include "tests/models/plain_observer.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Records kind, time and state of the first events of every lane.
template <class Real> class BallObserver : public PlainObserver<Real> {
public:
    static constexpr int columns = 4 * testing::recorded_ball_events;

    template <class Report> SLIDEWAY_FN void start(Mask<Real> fresh, Report const&, Real const*, bool) {
        count_ = select(fresh, Real(0.0), count_);
    }

    SLIDEWAY_HD void event(Mask<Real> at, int kind, Real t, Real const* state) {
        for (int i = 0; i < lanes<Real>; ++i) {
            auto const place = static_cast<int>(lane(count_, i));
            if (!holds(at, i) || place >= testing::recorded_ball_events) continue;
            double const row[4] = {static_cast<double>(kind), lane(t, i), lane(state[0], i), lane(state[1], i)};
            for (int j = 0; j < 4; ++j) set_lane(value_[4 * place + j], i, row[j]);
        }
        count_ = count_ + count<Real>(at);
    }

    SLIDEWAY_HD void settle(Mask<Real>, Real const*) {}
    SLIDEWAY_FN Mask<Real> complete() const { return mask_of<Real>(false); }

    SLIDEWAY_HD void finish(int index, double, Selection, double* row) const {
        int const recorded = 4 * static_cast<int>(lane(count_, index));
        for (int i = 0; i < columns; ++i) row[i] = i < recorded ? lane(value_[i], index) : -1;
    }

private:
    Real count_;
    Real value_[columns];
};

struct BallModel : PlainModel<2> {
    using Inputs = testing::BallInputs;
    using Event = testing::BallEvent;
    template <class Real> struct Parameters { Real gravity, restitution, level, jerk; };
    template <class Real> using Observer = BallObserver<Real>;
    static constexpr int events = 3;
    static constexpr EventInfo event_table[events] = {
        {Direction::falling, true}, {Direction::falling, false}, {Direction::both, false}};

    template <bool Full, class Real>
    SLIDEWAY_FN static Faults<Real> derivative(Real t, Real const* s, Parameters<Real> const& p, Memory<Real> const&,
                                               Real* rates, Report<Real>*) {
        rates[0] = s[1];
        rates[1] = fms(p.jerk, t, p.gravity);
        return Faults<Real>::none();
    }

    template <class Real>
    SLIDEWAY_FN static void event_values(Real, Real const* s, Real const* rates, Parameters<Real> const& p, Real* value,
                                         Real* slope) {
        value[Event::impact] = s[0];
        slope[Event::impact] = rates[0];
        value[Event::apex] = s[1];
        slope[Event::apex] = rates[1];
        value[Event::level] = s[0] - p.level;
        slope[Event::level] = rates[0];
    }

    template <class Real> SLIDEWAY_FN static void reset(int event, Mask<Real> at, Real* s, Parameters<Real> const& p) {
        if (event != Event::impact) return;
        s[0] = select(at, Real(0.0), s[0]);
        // A ball that barely grazes the floor may be found there on its way up.
        s[1] = select(at, p.restitution * abs(s[1]), s[1]);
    }

    template <class Real> SLIDEWAY_FN static Mask<Real> at_rest(Real const*) { return mask_of<Real>(false); }

    static Parameters<double> parameters(Inputs const& in) { return {in.gravity, in.restitution, in.level, in.jerk}; }
    static void initial_state(Inputs const& in, double* s) { s[0] = in.height, s[1] = in.speed; }
};

}  // namespace slideway::inline SLIDEWAY_ISA
