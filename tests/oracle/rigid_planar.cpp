#include <array>
#include <cmath>

#include "numbers.hpp"
#include "planar_runs.hpp"
#include "runge_kutta.hpp"

// Why two coordinates are enough: the hinge at the block's centre hands on no moment, nor does the weight, so in flight
// ψ'' = 0.  A block that lies parallel meets a wall with both corners at once, at the same speed y'; the two impulses
// that reverse both speeds to -e y' are equal (their 2 x 2 matrix is regular, and equal ones do), and so are the two
// forces of lasting contact.  Equal ones at +-a have no moment: with ψ = ψ' = 0 at the start, ψ stays zero.

namespace oracle {
namespace {

using namespace detail;

/// θ1 θ2 θ1' θ2'.
using Links = std::array<Real, 4>;

/// An impact slower than this ends in lasting contact if the block is pushed to the wall: its bounces, lower
/// than the last digit of y, would be over within 1e-10 s.
constexpr Real least_speed = 1e-8L;

class RigidBlock {
public:
    explicit RigidBlock(Inputs const& in) : in_(in), state_{in.start_angle, 0, in.crank_speed, 0} {
        PlanarState const start = planar_start(in);
        state_[1] = start[1], state_[3] = start[4];
    }

    [[nodiscard]] Real now() const { return time_; }
    [[nodiscard]] PlanarSample sample() const {
        return {state_[0] / (2 * pi), state_[1], height(state_) / Real(in_.clearance_y)};
    }
    [[nodiscard]] Real energy() const {
        auto const [m11, m12, m22] = masses(state_);
        Real const w1 = state_[2], w2 = state_[3], beta = in_.inclination;
        auto const rise = [beta](Real angle) { return std::sin(angle + beta); };
        return (m11 * w1 * w1 + 2 * m12 * w1 * w2 + m22 * w2 * w2) / 2 + crank_moment() * rise(state_[0]) +
               rod_moment() * rise(state_[1]);
    }

    void advance(Real until, Real step, RigidRun& run) {
        while (time_ < until) {
            Real const h = std::min(step, until - time_);
            wall_ == 0 ? fly(h, run) : slide(h, run);
        }
    }

private:
    struct Masses {
        Real m11, m12, m22;
    };
    // By hand from ½Σ m|v|² + J w², the second route to what the oracle of the compliant block finds by Jacobians.
    [[nodiscard]] Masses masses(Links const& s) const {
        Real const r = in_.crank_length, l = in_.rod_length, rod = in_.rod_mass, block = in_.slider_mass;
        return {in_.crank_inertia + r * r * (Real(in_.crank_mass) / 4 + rod + block),
                r * l * (rod / 2 + block) * std::cos(s[0] - s[1]), in_.rod_inertia + l * l * (rod / 4 + block)};
    }
    [[nodiscard]] Real crank_moment() const {
        return in_.gravity * Real(in_.crank_length) * (Real(in_.crank_mass) / 2 + in_.rod_mass + in_.slider_mass);
    }
    [[nodiscard]] Real rod_moment() const {
        return in_.gravity * Real(in_.rod_length) * (Real(in_.rod_mass) / 2 + in_.slider_mass);
    }
    [[nodiscard]] Real height(Links const& s) const {
        return in_.crank_length * std::sin(s[0]) + in_.rod_length * std::sin(s[1]);
    }
    [[nodiscard]] Real lift(Links const& s) const {  // y'
        return in_.crank_length * std::cos(s[0]) * s[2] + in_.rod_length * std::cos(s[1]) * s[3];
    }
    [[nodiscard]] std::array<Real, 2> slopes(Links const& s) const {  // ∂y/∂θ
        return {in_.crank_length * std::cos(s[0]), in_.rod_length * std::cos(s[1])};
    }
    /// What the velocities gain from an impulse of 1 along Y at the block.
    [[nodiscard]] std::array<Real, 2> response(Links const& s) const {
        auto const [m11, m12, m22] = masses(s);
        auto const [j1, j2] = slopes(s);
        Real const determinant = m11 * m22 - m12 * m12;
        return {(m22 * j1 - m12 * j2) / determinant, (m11 * j2 - m12 * j1) / determinant};
    }
    [[nodiscard]] std::array<Real, 2> free_accelerations(Links const& s) const {
        auto const [m11, m12, m22] = masses(s);
        Real const coupling = in_.crank_length * Real(in_.rod_length) * (Real(in_.rod_mass) / 2 + in_.slider_mass) *
                              std::sin(s[0] - s[1]);
        Real const f1 = -coupling * s[3] * s[3] - crank_moment() * std::cos(s[0] + in_.inclination);
        Real const f2 = coupling * s[2] * s[2] - rod_moment() * std::cos(s[1] + in_.inclination);
        Real const determinant = m11 * m22 - m12 * m12;
        return {(m22 * f1 - m12 * f2) / determinant, (m11 * f2 - m12 * f1) / determinant};
    }
    [[nodiscard]] Real free_lift_rate(Links const& s) const {  // y'' without a wall
        auto const [a1, a2] = free_accelerations(s);
        auto const [j1, j2] = slopes(s);
        return j1 * a1 + j2 * a2 - in_.crank_length * std::sin(s[0]) * s[2] * s[2] -
               in_.rod_length * std::sin(s[1]) * s[3] * s[3];
    }
    /// Force along Y that keeps y'' = 0.
    [[nodiscard]] Real holding_force(Links const& s) const {
        auto const [j1, j2] = slopes(s);
        auto const [r1, r2] = response(s);
        return -free_lift_rate(s) / (j1 * r1 + j2 * r2);
    }

    [[nodiscard]] Links flown(Real h) const {
        return runge_kutta(state_, h, [this](Links const& s) -> Links {
            auto const [a1, a2] = free_accelerations(s);
            return {s[2], s[3], a1, a2};
        });
    }
    [[nodiscard]] Links slid(Real h) const {
        Links s = runge_kutta(state_, h, [this](Links const& s) -> Links {
            auto const [a1, a2] = free_accelerations(s);
            auto const [r1, r2] = response(s);
            Real const force = holding_force(s);
            return {s[2], s[3], a1 + force * r1, a2 + force * r2};
        });
        lay_on_wall(s);
        return s;
    }
    void lay_on_wall(Links& s) const {
        s[1] = std::asin((wall_ * Real(in_.clearance_y) - in_.crank_length * std::sin(s[0])) / in_.rod_length);
        s[3] = -in_.crank_length * std::cos(s[0]) * s[2] / (in_.rod_length * std::cos(s[1]));
    }

    /// The least h in (0, most] at which `over` has become true, which it is at `most`.
    template <class Over> static Real first(Real most, Over const& over) {
        Real before = 0, past = most;
        for (int i = 0; i < 80 && past - before > 1e-20L; ++i) {
            Real const middle = (before + past) / 2;
            (over(middle) ? past : before) = middle;
        }
        return past;
    }

    void fly(Real h, RigidRun& run) {
        auto const outside = [&](Real part) { return std::abs(height(flown(part))) > in_.clearance_y; };
        Links next = flown(h);
        // A step may begin on the wall that the block has just left, whichever side rounding put it on.  It may also
        // pass the wall and come back: then its speed towards the wall changes sign on the way.
        Real limit = h;
        bool hit = outside(h);
        if (!hit && lift(state_) * lift(next) < 0) {
            bool const rising = lift(state_) > 0;
            Real const turn = first(h, [&](Real part) { return (lift(flown(part)) > 0) != rising; });
            bool const just_left = std::abs(std::abs(height(state_)) - in_.clearance_y) < 1e-15L;
            bool const towards_wall = height(state_) * lift(state_) > 0;
            if (outside(turn) && !(just_left && !towards_wall)) hit = true, limit = turn;
        }
        if (!hit) {
            state_ = next, time_ += h;
            return;
        }
        Real const part = first(limit, outside);
        state_ = flown(part), time_ += part;
        bounce(run);
    }

    void bounce(RigidRun& run) {
        int const side = height(state_) > 0 ? 1 : -1;
        Real const speed = lift(state_), before = energy();
        run.impacts.push_back({time_, std::abs(speed), side});
        Real const e = in_.restitution;
        bool const comes_to_rest = e * std::abs(speed) < least_speed && side * free_lift_rate(state_) > 0;
        auto const [j1, j2] = slopes(state_);
        auto const [r1, r2] = response(state_);
        Real const impulse = -(comes_to_rest ? 1 : 1 + e) * speed / (j1 * r1 + j2 * r2);
        state_[2] += impulse * r1, state_[3] += impulse * r2;
        if (comes_to_rest) {
            wall_ = side;
            lay_on_wall(state_);
            run.rests.push_back(time_);
        }
        run.energy_lost += before - energy();
    }

    void slide(Real h, RigidRun& run) {
        auto const let_go = [&](Real part) { return wall_ * holding_force(slid(part)) > 0; };
        bool const leaves = let_go(h);
        Real const part = leaves ? first(h, let_go) : h;
        state_ = slid(part), time_ += part;
        if (!leaves) return;
        wall_ = 0;
        run.leaves.push_back(time_);
    }

    Inputs in_;
    Links state_;
    Real time_ = 0;
    int wall_ = 0;  // of lasting contact
};

}  // namespace

RigidRun rigid_run(Inputs const& in, long double every, int count, long double step) {
    RigidBlock block(in);
    RigidRun run;
    Real const start = block.energy();
    run.samples.push_back(block.sample());
    for (int i = 1; i <= count; ++i) {
        block.advance(i * every, step, run);
        run.samples.push_back(block.sample());
    }
    run.energy_change = block.energy() - start;
    return run;
}

}  // namespace oracle
