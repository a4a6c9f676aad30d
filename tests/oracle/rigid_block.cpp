#include "rigid_block.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "linear_solve.hpp"
#include "numbers.hpp"
#include "rigid_frame.hpp"
#include "runge_kutta.hpp"

namespace oracle {
namespace {

using namespace detail;
using Vector2 = Eigen::Matrix<Real, 2, 1>;

constexpr Real least_speed = 1e-9L;   // a rebound below it ends in lasting contact if the block is pushed to the wall
constexpr Real on_wall = 1e-18L;      // rounding of a height [m]
constexpr Real rattle_gap = 1e-15L;   // impacts in turn go on until the other corner is as near [m]
constexpr Real still = 1e-12L;        // slip that is none [m/s]

enum class Doing { open, stick, forwards, backwards };
struct Contact {
    int corner;
    Doing doing;
};
Real sign_of(Doing doing) { return doing == Doing::forwards ? 1 : doing == Doing::backwards ? -1 : 0; }

struct Forces {
    Vector3 change;  // q'' or the jump of q'
    std::array<Real, 4> push{}, drag{};
};

class Block {
public:
    Block(Inputs const& in, Parts const& parts) : in_(in), free_(parts.drive.turns_freely()) {
        mu_slip_ = parts.friction ? in.friction_kinetic : 0;
        mu_hold_ = parts.friction ? std::max(in.friction_static, in.friction_kinetic) : 0;
        state_ = planar_start(in);
        settle();
    }

    [[nodiscard]] PlanarState const& state() const { return state_; }
    [[nodiscard]] Real energy() const { return frame(state_).energy; }

    void advance(Real until, Real step) {
        while (time_ < until && run.solved) {
            Real const h = std::min(step, until - time_);
            if (!happens(moved(h))) {
                state_ = moved(h), time_ += h;
                put_back();
                continue;
            }
            Real before = 0, past = h;
            for (int i = 0; i < 90 && past - before > 1e-19L; ++i) {
                Real const middle = (before + past) / 2;
                (happens(moved(middle)) ? past : before) = middle;
            }
            state_ = moved(past), time_ += past;
            settle();
        }
        if (until - time_ < step) time_ = until;
    }

    RigidBlockRun run;

private:
    [[nodiscard]] static Vector3 rates(PlanarState const& s) { return {s[3], s[4], s[5]}; }

    [[nodiscard]] RigidFrame frame(PlanarState const& s) const { return rigid_frame(in_, s); }

    /// mass · change = load + forces, with what the contacts do: normal · change = onto of each closed contact, tangent · change = halt of one that sticks.
    template <class Onto, class Halt>
    [[nodiscard]] Forces forces(RigidFrame const& f, Vector3 const& load, std::vector<Contact> const& contacts, Onto const& onto, Halt const& halt) const {
        auto const n = static_cast<Eigen::Index>(contacts.size());
        Matrix system = Matrix::Zero(3 + 2 * n, 3 + 2 * n), right = Matrix::Zero(3 + 2 * n, 1);
        system.topLeftCorner(3, 3) = f.mass;
        right.topRows(3) = load;
        for (Eigen::Index k = 0; k < n; ++k) {
            auto const [c, doing] = contacts[static_cast<std::size_t>(k)];
            Eigen::Index const push = 3 + 2 * k, drag = push + 1;
            system.block(0, push, 3, 1) = -f.normal[c].transpose();
            system.block(0, drag, 3, 1) = -f.tangent[c].transpose();
            if (doing == Doing::open) {
                system(push, push) = system(drag, drag) = 1;
                continue;
            }
            system.block(push, 0, 1, 3) = f.normal[c];
            right(push, 0) = onto(c);
            if (doing == Doing::stick) {
                system.block(drag, 0, 1, 3) = f.tangent[c];
                right(drag, 0) = halt(c);
            } else {
                system(drag, drag) = 1;
                system(drag, push) = sign_of(doing) * mu_slip_;
            }
        }
        if (!free_) {  // the drive holds the crank's speed
            system.row(0).setZero();
            system(0, 0) = 1;
            right(0, 0) = 0;
        }
        Matrix const solved = solution(system, right);
        Forces result;
        result.change = solved.topRows(3);
        for (Eigen::Index k = 0; k < n; ++k) {
            int const c = contacts[static_cast<std::size_t>(k)].corner;
            result.push[c] = solved(3 + 2 * k, 0), result.drag[c] = solved(4 + 2 * k, 0);
        }
        return result;
    }

    [[nodiscard]] Forces lasting(RigidFrame const& f, std::vector<Contact> const& contacts) const {
        return forces(f, f.load, contacts, [&](int c) { return -f.normal_bias[c]; }, [&](int c) { return -f.tangent_bias[c]; });
    }

    [[nodiscard]] PlanarState moved(Real h) const {
        return runge_kutta(state_, h, [this](PlanarState const& s) -> PlanarState {
            Vector3 const q = lasting(frame(s), held_).change;
            return {s[3], s[4], s[5], q[0], q[1], q[2]};
        });
    }

    [[nodiscard]] bool is_held(int corner) const {
        return std::ranges::any_of(held_, [&](Contact const& c) { return c.corner == corner; });
    }

    /// Whether something has happened up to this state of the present step.
    [[nodiscard]] bool happens(PlanarState const& s) const {
        RigidFrame const f = frame(s);
        for (int i = 0; i < 4; ++i) {
            if (!is_held(i) && f.gap[i] < -on_wall) return true;
        }
        Forces const now = lasting(f, held_);
        return std::ranges::any_of(held_, [&](Contact const& c) {
            if (now.push[c.corner] < 0) return true;
            if (mu_hold_ == 0) return false;
            if (c.doing == Doing::stick) return std::abs(now.drag[c.corner]) > mu_hold_ * now.push[c.corner];
            return sign_of(c.doing) * f.tangent[c.corner].dot(rates(s)) < -still;
        });
    }

    /// Every guess of what the corners do.  Of several that are right the first counts: what flies or slips is not caught by friction as large as it
    /// takes to hold it, as a crank at its dead centre could be.
    template <class Try> static void each_guess(std::vector<int> const& corners, bool friction, Try const& attempt) {
        std::vector<Contact> guess;
        for (int const c : corners) guess.push_back({c, Doing::open});
        std::vector<Doing> const all = friction ? std::vector{Doing::open, Doing::forwards, Doing::backwards, Doing::stick}
                                                : std::vector{Doing::open, Doing::forwards};
        auto const vary = [&](auto const& self, std::size_t k, int sticking) -> void {
            if (k == guess.size()) return attempt(guess);
            for (Doing const doing : all) {
                if (doing == Doing::stick && sticking > 0) continue;
                guess[k].doing = doing;
                self(self, k + 1, sticking + (doing == Doing::stick ? 1 : 0));
            }
        };
        vary(vary, 0, 0);
    }

    /// The right guess at the level of velocities (an impact) or accelerations.  @param least γ_N of a corner that is not pushed
    template <class Solve, class After, class Least>
    std::optional<std::pair<std::vector<Contact>, Forces>> choose(std::vector<int> const& corners, Real holding, Solve const& solve, After const& after,
                                                                  Least const& least, Vector3 const* velocity, RigidFrame const& f) {
        std::optional<std::pair<std::vector<Contact>, Forces>> found;
        Real smallest = 1e-8L;
        each_guess(corners, mu_slip_ > 0 || mu_hold_ > 0, [&](std::vector<Contact> const& guess) {
            for (Contact const& c : guess) {
                Real const slip = velocity == nullptr ? 0 : f.tangent[c.corner].dot(*velocity);
                if (velocity == nullptr || std::abs(slip) <= 10 * still || c.doing == Doing::open || mu_slip_ == 0) continue;
                if (slip * sign_of(c.doing) <= 0) return;
            }
            Forces const tried = solve(guess);
            Real worst = 0;
            for (Contact const& c : guess) {
                Vector2 const motion = after(c.corner, tried);
                Real const push = tried.push[c.corner], drag = tried.drag[c.corner];
                if (c.doing == Doing::open) worst = std::max(worst, least(c.corner) - motion.x());
                else worst = std::max(worst, -push);
                if (c.doing == Doing::stick) worst = std::max(worst, std::abs(drag) - holding * push);
                if (mu_slip_ > 0) worst = std::max(worst, -sign_of(c.doing) * motion.y() * (velocity == nullptr || is_still(f, c.corner, *velocity)));
            }
            if (worst < smallest) smallest = worst, found.emplace(guess, tried);
        });
        if (!found) run.solved = false;
        return found;
    }
    [[nodiscard]] static bool is_still(RigidFrame const& f, int c, Vector3 const& q) { return std::abs(f.tangent[c].dot(q)) <= 10 * still; }

    void jump(RigidFrame const& f, Forces const& by) {
        Vector3 const before = rates(state_);
        for (int i = 0; i < 3; ++i) state_[3 + i] += by.change[i];
        Vector3 const mean = (before + rates(state_)) / 2;
        Real gain = 0;
        for (int c = 0; c < 4; ++c) {
            Real const normal = f.normal[c].dot(mean) * by.push[c], along = f.tangent[c].dot(mean) * by.drag[c];
            run.restitution_loss -= normal, run.friction_loss -= along;
            gain += normal + along;
        }
        run.largest_gain = std::max(run.largest_gain, gain);
    }

    /// Newton's impact of the corners that approach, and of those that are held.
    void collide(RigidFrame const& f, std::vector<int> const& corners) {
        Vector3 const before = rates(state_);
        Real fastest = 0;
        int first = corners.front();
        auto const target = [&](int c) { return is_held(c) ? Real(0) : std::max(Real(0), -Real(in_.restitution) * f.normal[c].dot(before)); };
        for (int const c : corners) {
            if (-f.normal[c].dot(before) > fastest) fastest = -f.normal[c].dot(before), first = c;
        }
        auto const solve = [&](std::vector<Contact> const& guess) {
            return forces(f, Vector3::Zero(), guess, [&](int c) { return target(c) - f.normal[c].dot(before); },
                          [&](int c) { return -f.tangent[c].dot(before); });
        };
        auto const after = [&](int c, Forces const& by) {
            Vector3 const q = before + by.change;
            return Vector2(f.normal[c].dot(q), f.tangent[c].dot(q));
        };
        auto const found = choose(corners, mu_slip_, solve, after, target, nullptr, f);
        run.events.push_back({RigidBlockEvent::Kind::impact, time_, first, fastest});
        if (found) jump(f, found->second);
    }

    /// Both corners at rest on their walls, as after impacts without end.
    void bring_to_rest(RigidFrame const& f, std::vector<int> const& corners) {
        Vector3 const q = rates(state_);
        std::vector<Contact> all;
        for (int const c : corners) all.push_back({c, f.tangent[c].dot(q) < 0 ? Doing::backwards : Doing::forwards});
        jump(f, forces(f, Vector3::Zero(), all, [&](int c) { return -f.normal[c].dot(q); }, [](int) { return Real(0); }));
    }

    void settle() {
        RigidFrame const f = frame(state_);
        auto const speed = [&](int c) { return -f.normal[c].dot(rates(state_)); };
        auto const near = [&](Real within) {
            std::vector<int> corners;
            for (int i = 0; i < 4; ++i) {
                if (is_held(i) || f.gap[i] < within) corners.push_back(i);
            }
            return corners;
        };
        std::vector<int> const touching = near(2 * on_wall);
        for (int rounds = 0; rounds < 50 && run.solved; ++rounds) {
            std::vector<int> meeting;
            bool hits = false;
            for (int const c : touching) {
                if (is_held(c) || speed(c) > 0) meeting.push_back(c);
                hits = hits || (!is_held(c) && speed(c) > 0);
            }
            if (!hits) break;
            collide(f, meeting);
        }
        // Impacts in turn that have come so near to one another that only their limit is left.
        std::vector<int> const both = near(rattle_gap);
        auto const recent = std::ranges::count_if(run.events, [&](RigidBlockEvent const& e) {
            return e.kind == RigidBlockEvent::Kind::impact && e.time > time_ - 1e-9L;
        });
        std::vector<int> resting;
        if (both.size() == 2 && held_.empty() && recent > 6 && std::ranges::any_of(both, [&](int c) { return speed(c) > least_speed; })) {
            run.events.push_back({RigidBlockEvent::Kind::rattle, time_, both[0], speed(both[0])});
            bring_to_rest(f, both);
            resting = both;
        } else {
            for (int const c : touching) {
                if (std::abs(speed(c)) < least_speed) resting.push_back(c);
            }
            if (!resting.empty()) bring_to_rest(f, resting);
        }
        last(frame(state_), resting);
        put_back();
    }

    void last(RigidFrame const& f, std::vector<int> const& resting) {
        Vector3 const q = rates(state_);
        auto const solve = [&](std::vector<Contact> const& guess) { return lasting(f, guess); };
        auto const after = [&](int c, Forces const& by) {
            return Vector2(f.normal[c].dot(by.change) + f.normal_bias[c], f.tangent[c].dot(by.change) + f.tangent_bias[c]);
        };
        auto const found = choose(resting, mu_hold_, solve, after, [](int) { return Real(0); }, &q, f);
        std::vector<Contact> next;
        if (found) {
            for (Contact const& c : found->first) {
                if (c.doing != Doing::open) next.push_back(c);
            }
        }
        auto const note = [&](RigidBlockEvent::Kind kind, int c) { run.events.push_back({kind, time_, c, 0}); };
        for (Contact const& c : held_) {
            if (std::ranges::none_of(next, [&](Contact const& n) { return n.corner == c.corner; })) note(RigidBlockEvent::Kind::leave, c.corner);
        }
        for (Contact const& c : next) {
            if (!is_held(c.corner)) note(RigidBlockEvent::Kind::rest, c.corner);
        }
        held_ = next;
    }

    /// Held corners exactly onto their walls, and at rest against them.
    void put_back() {
        if (held_.empty()) return;
        std::vector<Contact> plain;
        for (Contact const& c : held_) plain.push_back({c.corner, Doing::forwards});
        Real const friction = mu_slip_;
        mu_slip_ = 0;
        RigidFrame f = frame(state_);
        Forces const shift = forces(f, Vector3::Zero(), plain, [&](int c) { return -f.gap[c]; }, [](int) { return Real(0); });
        for (int i = 0; i < 3; ++i) state_[i] += shift.change[i];
        f = frame(state_);
        Vector3 const q = rates(state_);
        Forces const halt = forces(f, Vector3::Zero(), plain, [&](int c) { return -f.normal[c].dot(q); }, [](int) { return Real(0); });
        for (int i = 0; i < 3; ++i) state_[3 + i] += halt.change[i];
        mu_slip_ = friction;
    }

    Inputs in_;
    bool free_;
    Real mu_slip_ = 0, mu_hold_ = 0, time_ = 0;
    PlanarState state_{};
    std::vector<Contact> held_;
};

}  // namespace

RigidBlockRun rigid_block_run(Inputs const& in, Parts const& parts, long double every, int count, long double step) {
    Block block(in, parts);
    Real const start = block.energy();
    block.run.samples.push_back(block.state());
    for (int i = 1; i <= count && block.run.solved; ++i) {
        block.advance(i * every, step);
        block.run.samples.push_back(block.state());
    }
    block.run.energy_change = block.energy() - start;
    return block.run;
}

}  // namespace oracle
