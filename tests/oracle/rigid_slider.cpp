#include "rigid_slider.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "bulirsch_stoer.hpp"
#include "coulomb_problem.hpp"
#include "slider_frame.hpp"

namespace oracle {
namespace {

using namespace detail;
using Vector2 = Eigen::Matrix<Real, 2, 1>;
using Table = CoulombProblem::Table;
using Column = CoulombProblem::Column;
using Index = Eigen::Index;
using Numbers = std::array<Real, 13>;

constexpr Real least_speed = 1e-9L;  // a contact that is slower is at rest if something pushes it to its wall
constexpr Real on_wall = 1e-18L;     // as good as touching [m]
constexpr Real rattle_gap = 1e-14L;  // impacts in turn go on until all are as near [m]
constexpr Real rattle_time = 1e-9L;  // and so many of them have come within it [s]
constexpr int rattles = 12;
constexpr Real still = 1e-12L;         // slip that is none [m/s]
constexpr Real same = 1e-10L;          // accelerations that differ by less, over the largest, are equal
constexpr Real other = 1e-8L;          // those that differ by more are of another set of contacts
constexpr int most_settlements = 400;  // without time going on
constexpr Real longest_step = 1e-4L;   // a pair that comes and goes within a step is not seen
constexpr int columns = 5;             // order 10

struct Held {
    int pair;
    bool sticks;
    Vector2 along;  // of its slip
};

[[nodiscard]] Column least_norm(Table const& m, Column const& right) {
    auto decomposition = Eigen::CompleteOrthogonalDecomposition<Table>();
    decomposition.setThreshold(1e-12L);
    decomposition.compute(m);
    return decomposition.solve(right);
}

[[nodiscard]] Numbers numbers_of(SliderPlace const& p) {
    auto const& q = p.attitude;
    return {p.centre.x(), p.centre.y(), p.centre.z(), p.velocity.x(), p.velocity.y(), p.velocity.z(), q.w(),
            q.x(),        q.y(),        q.z(),        p.spin.x(),     p.spin.y(),     p.spin.z()};
}

[[nodiscard]] SliderPlace place_of(Numbers const& n, Real time) {
    SliderPlace p;
    p.time = time;
    p.centre = Vector3(n[0], n[1], n[2]), p.velocity = Vector3(n[3], n[4], n[5]);
    p.attitude = Eigen::Quaternion<Real>(n[6], n[7], n[8], n[9]).normalized();
    p.spin = Vector3(n[10], n[11], n[12]);
    return p;
}

class Slider {
public:
    Slider(Inputs const& in, Parts const& parts) : frame_(in, parts), e_(in.restitution) {
        mu_slip_ = parts.friction ? in.friction_kinetic : 0;
        mu_hold_ = parts.friction ? std::max(in.friction_static, in.friction_kinetic) : 0;
        place_ = frame_.start();
        frame_.move_to(place_);
        initial_energy_ = frame_.energy();
        settle();
    }

    [[nodiscard]] RigidSliderState state() const { return SliderFrame::state(place_); }
    [[nodiscard]] std::vector<int> held_pairs() const {
        std::vector<int> all;
        for (Held const& h : held_) all.push_back(h.pair);
        return all;
    }
    [[nodiscard]] Real energy_change() {
        frame_.move_to(place_);
        return frame_.energy() - initial_energy_;
    }

    void advance(Real until) {
        Real h = longest_step / 8;
        while (run.solved && place_.time < until) {
            h = std::min({h, longest_step, until - place_.time, slip_limit()});
            auto [next, error] = step(h);
            if (error > 1) {
                h *= std::max(Real(0.2L), 0.8L * std::pow(error, -1.0L / (2 * columns - 1)));
                continue;
            }
            if (happens(next)) {
                SliderPlace const event = located(h, next);
                (void)step(event.time - place_.time);
                run.friction_loss += drag_loss_;
                place_ = event;
                settle();
                continue;
            }
            if (h == until - place_.time) next.time = until;
            place_ = next;
            run.friction_loss += drag_loss_;
            put_back();
            for (Held& c : held_) turn_along(c);
            if (std::ranges::any_of(held_, [&](Held const& c) { return !c.sticks && has_stopped(c); })) settle();
            h *= std::min(Real(2), 0.8L * std::pow(error + 1e-6L, -1.0L / (2 * columns - 1)));
        }
    }

    RigidSliderRun run;

private:
    struct Forces {
        Vector6 change;
        Column normal, along;  // N; T of both tangents, one pair after the other
    };

    // --- the smooth motion between events

    [[nodiscard]] std::pair<SliderPlace, Real> step(Real h) {
        Real const t = place_.time;
        using Clocked = std::array<Real, 15>;  // the time, and what friction takes
        Clocked start{}, scale{};
        Numbers const now = numbers_of(place_);
        std::copy(now.begin(), now.end(), start.begin());
        start[13] = t;
        for (std::size_t i = 0; i < 3; ++i) scale[i] = 1e-19L, scale[3 + i] = 1e-17L;
        for (std::size_t i = 6; i < 10; ++i) scale[i] = 1e-17L;
        for (std::size_t i = 10; i < 13; ++i) scale[i] = 1e-15L;
        scale[13] = scale[14] = 1;
        auto const derivative = [this](Clocked const& c) {
            Numbers n{};
            std::copy_n(c.begin(), n.size(), n.begin());
            SliderPlace const p = place_of(n, c[13]);
            frame_.move_to(p);
            Forces const f = held_.empty() ? Forces{frame_.free(), Column(0), Column(0)} : lasting();
            Vector6 const& a = f.change;
            auto const q = p.attitude * Eigen::Quaternion<Real>(0, p.spin.x() / 2, p.spin.y() / 2, p.spin.z() / 2);
            return Clocked{n[3],  n[4],  n[5], a[0], a[1], a[2], q.w(),       q.x(),
                           q.y(), q.z(), a[3], a[4], a[5], 1,    drag_loss(f)};
        };
        auto const [end, error] = extrapolated<columns>(start, h, derivative, scale);
        Numbers n{};
        std::copy_n(end.begin(), n.size(), n.begin());
        drag_loss_ = end[14];
        return {place_of(n, t + h), error};
    }

    /// What friction takes from lasting contacts [W].
    [[nodiscard]] Real drag_loss(Forces const& f) const {
        Real loss = 0;
        for (std::size_t i = 0; i < held_.size(); ++i) {
            Vector2 const slip = (frame_.pair(held_[i].pair).rows * rates()).tail<2>();
            loss -= slip.dot(Vector2(f.along.segment<2>(3 * static_cast<Index>(i) + 1)));
        }
        return loss;
    }

    /// A slip that comes to an end is approached by halves: its direction has no limit from beyond.
    [[nodiscard]] Real slip_limit() {
        Real limit = longest_step;
        if (held_.empty() || mu_slip_ == 0) return limit;
        frame_.move_to(place_);
        Forces const f = lasting();
        for (Held const& c : held_) {
            SliderPair const p = frame_.pair(c.pair);
            Vector2 const slip = (p.rows * place_.rates()).tail<2>(), rate = (p.rows * f.change + p.biases).tail<2>();
            if (!c.sticks && slip.norm() > still && slip.dot(rate) < 0)
                limit = std::min(limit, std::max(slip.norm() / rate.norm() / 2, Real(1e-16L)));
        }
        return limit;
    }

    [[nodiscard]] bool has_stopped(Held const& c) {
        frame_.move_to(place_);
        SliderPair const p = frame_.pair(c.pair);
        Vector2 const slip = (p.rows * place_.rates()).tail<2>(),
                      rate = (p.rows * lasting().change + p.biases).tail<2>();
        return mu_slip_ > 0 && slip.norm() <= still && slip.dot(rate) < 0;
    }

    /// Rows, mobility and motion without forces of pairs.  @param v to which rows are applied  @param biased at the level of accelerations
    [[nodiscard]] CoulombProblem problem(std::vector<int> const& pairs, Vector6 const& v, bool biased) const {
        auto const n = static_cast<Index>(pairs.size());
        Table rows(3 * n, 6);
        CoulombProblem p;
        p.motion.resize(3 * n);
        for (Index i = 0; i < n; ++i) {
            SliderPair const pair = frame_.pair(pairs[static_cast<std::size_t>(i)]);
            rows.middleRows(3 * i, 3) = pair.rows;
            p.motion.segment<3>(3 * i) = pair.rows * v;
            if (biased) p.motion.segment<3>(3 * i) += pair.biases;
        }
        p.mobility = rows * frame_.mobility() * rows.transpose();
        p.contacts.resize(pairs.size());
        return p;
    }

    [[nodiscard]] Vector6 change_by(std::vector<int> const& pairs, Column const& impulses) const {
        Vector6 push = Vector6::Zero();
        for (Index i = 0; i < static_cast<Index>(pairs.size()); ++i) {
            push += frame_.pair(pairs[static_cast<std::size_t>(i)]).rows.transpose() * impulses.segment<3>(3 * i);
        }
        return frame_.mobility() * push;
    }

    /// Forces that keep contacts: no motion across the walls, nor along them where they stick.
    [[nodiscard]] Forces kept(std::vector<Held> const& contacts, CoulombProblem const& p) const {
        std::vector<int> pairs;
        Index unknowns = 0;
        for (Held const& c : contacts) pairs.push_back(c.pair), unknowns += c.sticks ? 3 : 1;
        auto const n = static_cast<Index>(contacts.size());
        Table spread = Table::Zero(3 * n, unknowns), equations = Table::Zero(unknowns, 3 * n);
        for (Index i = 0, at = 0; i < n; ++i) {
            Held const& c = contacts[static_cast<std::size_t>(i)];
            spread(3 * i, at) = equations(at, 3 * i) = 1;
            if (c.sticks) {
                for (Index k = 1; k <= 2; ++k) spread(3 * i + k, at + k) = equations(at + k, 3 * i + k) = 1;
            } else {
                spread.block<2, 1>(3 * i + 1, at) = -mu_slip_ * c.along;
            }
            at += c.sticks ? 3 : 1;
        }
        if (n == 0) return {frame_.free(), Column(0), Column(0)};
        Column const forces = spread * least_norm(equations * p.mobility * spread, -equations * p.motion);
        return {frame_.free() + change_by(pairs, forces), Column(forces(Eigen::seq(0, Eigen::last, 3))), forces};
    }

    /// Of the contacts that are held, at the frame's place.  Loads that are shared in more than one way are shared as evenly as may be: the least squares
    /// of all, and of those alone that do not come to pull.
    [[nodiscard]] Forces lasting() const {
        std::vector<Held> now = held_;
        for (Held& c : now) turn_along(c);
        Forces const all = sharing(now, held_pairs());
        Forces shared = all;
        std::vector<int> loaded = held_pairs();
        while (!loaded.empty() && shared.normal.minCoeff() < 0) {
            Index most = 0;
            shared.normal.minCoeff(&most);
            std::erase(loaded, held_[static_cast<std::size_t>(most)].pair);
            shared = sharing(now, loaded);
        }
        return keeps(shared) ? shared : all;
    }
    [[nodiscard]] Forces sharing(std::vector<Held> const& contacts, std::vector<int> const& loaded) const {
        std::vector<Held> some;
        for (Held const& c : contacts) {
            if (std::ranges::find(loaded, c.pair) != loaded.end()) some.push_back(c);
        }
        Forces const of_some = kept(some, problem(loaded, frame_.free(), true));
        Forces f{of_some.change, Column::Zero(static_cast<Index>(contacts.size())),
                 Column::Zero(3 * static_cast<Index>(contacts.size()))};
        for (std::size_t i = 0, k = 0; i < contacts.size(); ++i) {
            if (k == some.size() || some[k].pair != contacts[i].pair) continue;
            f.normal[static_cast<Index>(i)] = of_some.normal[static_cast<Index>(k)];
            f.along.segment<3>(3 * static_cast<Index>(i)) = of_some.along.segment<3>(3 * static_cast<Index>(k));
            ++k;
        }
        return f;
    }
    /// Whether forces hold all contacts at their walls.
    [[nodiscard]] bool keeps(Forces const& f) const {
        return std::ranges::all_of(held_, [&](Held const& c) {
            SliderPair const p = frame_.pair(c.pair);
            return std::abs(p.rows.row(0).dot(f.change) + p.biases[0]) <= same * weighed(frame_.free());
        });
    }
    void turn_along(Held& c) const {
        Vector2 const slip = (frame_.pair(c.pair).rows * rates()).tail<2>();
        if (slip.norm() > 10 * still) c.along = slip.normalized();
    }
    [[nodiscard]] Vector6 rates() const { return frame_.place().rates(); }

    [[nodiscard]] bool is_held(int pair) const {
        return std::ranges::any_of(held_, [&](Held const& c) { return c.pair == pair; });
    }

    // --- events

    [[nodiscard]] Real nearest(SliderPlace const& p) {
        frame_.move_to(p);
        Real least = 1;
        for (int i = 0; i < 16; ++i) {
            if (!is_held(i)) least = std::min(least, frame_.gap(i));
        }
        return least;
    }

    /// Whether what is held pushes as it may; where loads are shared in more than one way, whether some way of sharing does.
    [[nodiscard]] bool lasts(SliderPlace const& p) {
        if (held_.empty()) return true;
        frame_.move_to(p);
        Forces const f = lasting();
        bool plain = true;
        for (Index i = 0; i < static_cast<Index>(held_.size()); ++i) {
            Held const& c = held_[static_cast<std::size_t>(i)];
            plain = plain && f.normal[i] >= 0 &&
                    (!c.sticks || Vector2(f.along.segment<2>(3 * i + 1)).norm() <= mu_hold_ * f.normal[i]);
        }
        if (plain) return true;
        auto const [contacts, solution] = chosen(held_pairs());
        Vector6 const right = frame_.free() + change_by(held_pairs(), solution.impulses);
        return weighed(right - f.change) <= other * (weighed(right) + weighed(frame_.free()));
    }
    [[nodiscard]] static Real weighed(Vector6 const& a) { return a.head<3>().norm() + 0.01L * a.tail<3>().norm(); }

    [[nodiscard]] bool happens(SliderPlace const& p) { return nearest(p) < -on_wall || !lasts(p); }

    [[nodiscard]] SliderPlace located(Real h, SliderPlace const& end) {
        Real span = h;
        SliderPlace found = end;
        if (nearest(end) < -on_wall) std::tie(span, found) = touched(h, end);
        if (lasts(found)) return found;
        Real before = 0;
        for (int i = 0; i < 50; ++i) {
            Real const middle = (before + span) / 2;
            SliderPlace const p = step(middle).first;
            if (lasts(p))
                before = middle;
            else
                span = middle, found = p;
        }
        return found;
    }

    /// Where the nearest pair is half of `on_wall` inside: by false position, which halves where it is slow.
    [[nodiscard]] std::pair<Real, SliderPlace> touched(Real h, SliderPlace const& end) {
        constexpr Real aim = -on_wall / 2;
        Real before = 0, past = h, low = nearest(place_) - aim, high = nearest(end) - aim;
        SliderPlace found = end;
        for (Real at = h / 2; low <= 0 && at > h * 1e-9L; at /= 2) {  // a pair that has just left is as deep as that
            if (Real const value = nearest(step(at).first) - aim; value > 0) before = at, low = value;
        }
        for (int i = 0; i < 200 && low > 0; ++i) {
            Real const share = i % 3 == 2 ? Real(0.5L) : std::clamp(low / (low - high), Real(1e-6L), Real(1 - 1e-6L));
            // A little beyond the guess, so that both ends close in.
            Real const at = before + (past - before) * (i % 3 == 1 ? std::min(Real(1), share * 1.0001L) : share);
            SliderPlace const p = step(at).first;
            Real const value = nearest(p) - aim;
            if (std::abs(value) <= on_wall / 4) return {at, p};
            if (value < 0)
                past = at, high = value, found = p;
            else
                before = at, low = value;
        }
        for (int i = 0; i < 60 && low <= 0; ++i) {
            Real const middle = (before + past) / 2;
            SliderPlace const p = step(middle).first;
            if (nearest(p) < -on_wall)
                past = middle, found = p;
            else
                before = middle;
        }
        return {past, found};
    }

    void settle() {
        for (int rounds = 0; rounds < 200 && run.solved; ++rounds) {
            frame_.move_to(place_);
            std::vector<int> meeting;
            bool hits = false;
            for (int i = 0; i < 16; ++i) {
                if (!is_held(i) && frame_.gap(i) > on_wall) continue;
                bool const comes = speed(i) > least_speed;
                if (is_held(i) || comes) meeting.push_back(i);
                hits = hits || comes;
            }
            if (!hits) break;
            rattling() ? bring_together() : collide(meeting);
        }
        settlements_ = place_.time > settled_ ? 0 : settlements_ + 1;
        settled_ = place_.time;
        run.solved = run.solved && settlements_ < most_settlements;
        frame_.move_to(place_);
        std::vector<int> resting;
        for (int i = 0; i < 16; ++i) {
            if ((is_held(i) || frame_.gap(i) <= on_wall) && std::abs(speed(i)) <= least_speed) resting.push_back(i);
        }
        halt(resting);
        last(resting);
        put_back();
    }
    /// What is too slow for an impact stops at its wall, or it would be inside although its acceleration leads away.
    void halt(std::vector<int> const& pairs) {
        if (std::ranges::none_of(pairs, [&](int i) { return speed(i) > 0; })) return;
        CoulombProblem const p = problem(pairs, place_.rates(), false);
        jump(pairs, p, solve(p).impulses);
    }
    /// Towards the wall.
    [[nodiscard]] Real speed(int pair) const { return -frame_.pair(pair).rows.row(0).dot(place_.rates()); }

    [[nodiscard]] std::vector<int> near() const {
        std::vector<int> all;
        for (int i = 0; i < 16; ++i) {
            if (is_held(i) || frame_.gap(i) < rattle_gap) all.push_back(i);
        }
        return all;
    }
    [[nodiscard]] bool rattling() const {
        auto const recent = std::ranges::count_if(run.events, [&](RigidSliderEvent const& e) {
            return e.kind == RigidSliderEvent::Kind::impact && e.time > place_.time - rattle_time;
        });
        return recent > rattles && near().size() > 1;
    }

    /// What impacts in turn come to: all that is near stops at its wall.
    void bring_together() {
        std::vector<int> const pairs = near();
        CoulombProblem p = problem(pairs, place_.rates(), false);
        for (auto& c : p.contacts) c.friction = mu_slip_;
        CoulombSolution const s = solved(p);
        run.events.push_back({RigidSliderEvent::Kind::rattle, place_.time, pairs.front(), speed(pairs.front()),
                              static_cast<int>(pairs.size())});
        jump(pairs, p, s.impulses);
        for (int const i : pairs) {
            if (!is_held(i) && std::abs(speed(i)) <= least_speed) held_.push_back({i, false, Vector2::Zero()});
        }
        put_back();
    }

    void collide(std::vector<int> const& pairs) {
        CoulombProblem p = problem(pairs, place_.rates(), false);
        Real fastest = 0;
        int first = pairs.front();
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            Real const comes = -p.motion[3 * static_cast<Index>(i)];
            p.contacts[i].friction = mu_slip_;
            p.contacts[i].least = is_held(pairs[i]) ? Real(0) : e_ * std::max(Real(0), comes);
            if (!is_held(pairs[i]) && comes > fastest) fastest = comes, first = pairs[i];
        }
        run.events.push_back(
            {RigidSliderEvent::Kind::impact, place_.time, first, fastest, static_cast<int>(pairs.size())});
        Column impulses = solved(p).impulses;
        if (gain(p, impulses) > 1e-14L * std::abs(p.motion.dot(impulses))) impulses = without_gain(p, impulses);
        jump(pairs, p, impulses);
    }

    [[nodiscard]] CoulombSolution solved(CoulombProblem const& p) {
        CoulombSolution const s = solve(p);
        run.solved = run.solved && s.solved;
        return s;
    }

    /// Energy that impulses make: by the mean of the velocities before and after.
    [[nodiscard]] static Real gain(CoulombProblem const& p, Column const& impulses) {
        return impulses.dot(p.motion) + impulses.dot(p.mobility * impulses) / 2;
    }

    /// (M13.7): between the impulses without restitution and these, as far as none is made.
    [[nodiscard]] Column without_gain(CoulombProblem p, Column const& impulses) {
        for (auto& c : p.contacts) c.least = 0;
        Column const base = solved(p).impulses, more = impulses - base;
        Real const a = more.dot(p.mobility * more) / 2, b = more.dot(p.motion + p.mobility * base),
                   c = std::min(Real(0), gain(p, base));
        ++run.limited;
        Real const root = std::sqrt(b * b - 4 * a * c);
        Real const share = b > 0 ? -2 * c / (b + root) : (root - b) / (2 * a);
        return base + std::clamp(share, Real(0), Real(1)) * more;
    }

    void jump(std::vector<int> const& pairs, CoulombProblem const& p, Column const& impulses) {
        Column const mean = p.motion + p.mobility * impulses / 2;
        Real made = 0;
        for (Index i = 0; i < static_cast<Index>(pairs.size()); ++i) {
            Real const across = mean[3 * i] * impulses[3 * i],
                       along = mean.segment<2>(3 * i + 1).dot(impulses.segment<2>(3 * i + 1));
            run.restitution_loss -= across, run.friction_loss -= along;
            made += across + along;
        }
        run.largest_gain = std::max(run.largest_gain, made);
        place_.set_rates(place_.rates() + change_by(pairs, impulses));
        frame_.move_to(place_);
    }

    /// What contacts at rest across their walls do, at the frame's place.
    [[nodiscard]] std::pair<std::vector<Held>, CoulombSolution> chosen(std::vector<int> const& pairs) {
        CoulombProblem p = problem(pairs, frame_.free(), true);
        std::vector<Held> all;
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            Vector2 const slip = (frame_.pair(pairs[i]).rows * rates()).tail<2>();
            bool const slips = mu_slip_ == 0 || slip.norm() > 10 * still;
            p.contacts[i].slips = slips;
            p.contacts[i].friction = slips ? mu_slip_ : mu_hold_;
            if (slips && mu_slip_ > 0) p.contacts[i].along = slip.normalized();
        }
        CoulombSolution s = solve(p);
        // What static friction does not hold slips with the kinetic one.
        for (std::size_t i = 0; i < pairs.size() && mu_hold_ > mu_slip_; ++i) {
            auto const at = 3 * static_cast<Index>(i);
            Vector2 const drag = s.impulses.segment<2>(at + 1);
            if (p.contacts[i].slips || s.after.segment<2>(at + 1).norm() <= same * p.motion.norm() || drag.norm() == 0)
                continue;
            p.contacts[i].slips = true, p.contacts[i].friction = mu_slip_, p.contacts[i].along = -drag.normalized();
        }
        if (mu_hold_ > mu_slip_) s = solve(p);
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            auto const at = 3 * static_cast<Index>(i);
            if (s.after[at] > same * p.motion.norm()) continue;
            Vector2 const drag = s.impulses.segment<2>(at + 1);
            bool const sticks = !p.contacts[i].slips && s.after.segment<2>(at + 1).norm() <= same * p.motion.norm();
            Vector2 along = p.contacts[i].along;
            if (!p.contacts[i].slips && !sticks)
                along =
                    drag.norm() > 0 ? Vector2(-drag.normalized()) : Vector2(s.after.segment<2>(at + 1).normalized());
            all.push_back({pairs[i], sticks, along});
        }
        return {all, s};
    }

    void last(std::vector<int> const& resting) {
        std::vector<Held> next;
        if (!resting.empty()) {
            auto const [contacts, solution] = chosen(resting);
            next = contacts;
            run.solved = run.solved && solution.solved;
        }
        auto const note = [&](RigidSliderEvent::Kind kind, int pair) {
            run.events.push_back({kind, place_.time, pair, 0});
        };
        for (Held const& c : held_) {
            if (std::ranges::none_of(next, [&](Held const& n) { return n.pair == c.pair; }))
                note(RigidSliderEvent::Kind::leave, c.pair);
        }
        for (Held const& c : next) {
            if (!is_held(c.pair)) note(RigidSliderEvent::Kind::rest, c.pair);
        }
        held_ = next;
    }

    /// What is held exactly onto its walls, and at rest against them.
    void put_back() {
        if (held_.empty()) return;
        std::vector<Held> across = held_;
        for (Held& c : across) c.sticks = false, c.along.setZero();
        frame_.move_to(place_);
        CoulombProblem p = problem(held_pairs(), Vector6::Zero(), false);
        for (Index i = 0; i < static_cast<Index>(held_.size()); ++i)
            p.motion[3 * i] = frame_.gap(held_[static_cast<std::size_t>(i)].pair);
        place_.shift(kept(across, p).change - frame_.free());
        frame_.move_to(place_);
        p = problem(held_pairs(), place_.rates(), false);
        for (Held& c : across)
            c.sticks = std::ranges::any_of(held_, [&](Held const& h) { return h.pair == c.pair && h.sticks; });
        place_.set_rates(place_.rates() + kept(across, p).change - frame_.free());
        frame_.move_to(place_);
    }

    SliderFrame frame_;
    Real e_, mu_slip_ = 0, mu_hold_ = 0, initial_energy_ = 0, settled_ = -1, drag_loss_ = 0;
    int settlements_ = 0;
    SliderPlace place_;
    std::vector<Held> held_;
};

}  // namespace

RigidSliderRun rigid_slider_run(Inputs const& in, Parts const& parts, std::vector<long double> const& times,
                                std::size_t most_held) {
    Slider slider(in, parts);
    for (Real const t : times) {
        if (!slider.run.held.empty() && slider.run.held.back().size() > most_held) break;
        slider.advance(t);
        slider.run.samples.push_back(slider.state());
        slider.run.held.push_back(slider.held_pairs());
        slider.run.impacts.push_back(static_cast<int>(std::ranges::count_if(
            slider.run.events, [](RigidSliderEvent const& e) { return e.kind == RigidSliderEvent::Kind::impact; })));
    }
    slider.run.energy_change = slider.energy_change();
    return slider.run;
}

}  // namespace oracle
