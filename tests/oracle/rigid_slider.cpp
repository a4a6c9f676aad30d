#include "rigid_slider.hpp"

#include <algorithm>
#include <cmath>

#include "coulomb_problem.hpp"
#include "slider_course.hpp"

namespace oracle {
namespace {

using namespace detail;

class Slider : SliderCourse {
public:
    Slider(Inputs const& in, Parts const& parts) : SliderCourse(in, parts) {
        mu_slip_ = parts.friction ? in.friction_kinetic : 0;
        mu_hold_ = parts.friction ? std::max(in.friction_static, in.friction_kinetic) : 0;
        place_ = frame_.start();
        frame_.move_to(place_);
        initial_energy_ = frame_.energy();
        settle();
    }

    [[nodiscard]] RigidSliderState state() const { return SliderFrame::state(place_); }
    using SliderCourse::held_pairs;
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
