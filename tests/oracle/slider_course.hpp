// A rigid slider between its events: what holds it, and how it moves.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "bulirsch_stoer.hpp"
#include "coulomb_problem.hpp"
#include "linear_solve.hpp"
#include "rigid_slider.hpp"
#include "slider_frame.hpp"

namespace oracle::detail {

using Vector2 = Eigen::Matrix<Real, 2, 1>;
using Table = CoulombProblem::Table;
using Column = CoulombProblem::Column;
using Index = Eigen::Index;
using Numbers = std::array<Real, 13>;

inline constexpr Real least_speed = 1e-9L;  // a contact that is slower is at rest if something pushes it to its wall
inline constexpr Real on_wall = 1e-18L;     // as good as touching [m]
inline constexpr Real rattle_gap = 1e-14L;  // impacts in turn go on until all are as near [m]
inline constexpr Real rattle_time = 1e-9L;  // and so many of them have come within it [s]
inline constexpr int rattles = 12;
inline constexpr Real still = 1e-12L;         // slip that is none [m/s]
inline constexpr Real same = 1e-10L;          // accelerations that differ by less, over the largest, are equal
inline constexpr Real other = 1e-8L;          // those that differ by more are of another set of contacts
inline constexpr int most_settlements = 400;  // without time going on
inline constexpr Real longest_step = 1e-4L;   // a pair that comes and goes within a step is not seen
inline constexpr int columns = 5;             // order 10

struct Held {
    int pair;
    bool sticks;
    Vector2 along;  // of its slip
};

[[nodiscard]] inline Numbers numbers_of(SliderPlace const& p) {
    auto const& q = p.attitude;
    return {p.centre.x(), p.centre.y(), p.centre.z(), p.velocity.x(), p.velocity.y(), p.velocity.z(), q.w(),
            q.x(),        q.y(),        q.z(),        p.spin.x(),     p.spin.y(),     p.spin.z()};
}

[[nodiscard]] inline SliderPlace place_of(Numbers const& n, Real time) {
    SliderPlace p;
    p.time = time;
    p.centre = Vector3(n[0], n[1], n[2]), p.velocity = Vector3(n[3], n[4], n[5]);
    p.attitude = Eigen::Quaternion<Real>(n[6], n[7], n[8], n[9]).normalized();
    p.spin = Vector3(n[10], n[11], n[12]);
    return p;
}

class SliderCourse {
protected:
    SliderCourse(Inputs const& in, Parts const& parts) : frame_(in, parts), e_(in.restitution) {}

    [[nodiscard]] std::vector<int> held_pairs() const {
        std::vector<int> all;
        for (Held const& h : held_) all.push_back(h.pair);
        return all;
    }

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
        Table rows(3 * n, 6);
        for (Index i = 0; i < n; ++i) rows.middleRows(3 * i, 3) = frame_.pair(contacts[static_cast<std::size_t>(i)].pair).rows;
        // Equal springs under a rigid slider: their loads are those of one small displacement of it.
        Table const springs = equations * rows;
        Column const displacement = least_norm(equations * p.mobility * spread * springs, -equations * p.motion, 1e-12L);
        Column const forces = spread * (springs * displacement);
        return {frame_.free() + change_by(pairs, forces), Column(forces(Eigen::seq(0, Eigen::last, 3))), forces};
    }

    /// Of the contacts that are held, at the frame's place.  Loads that are shared in more than one way are those of equal springs (M13.13), which do not
    /// pull.
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

    [[nodiscard]] static Real weighed(Vector6 const& a) { return a.head<3>().norm() + 0.01L * a.tail<3>().norm(); }

    SliderFrame frame_;
    Real e_, mu_slip_ = 0, mu_hold_ = 0, initial_energy_ = 0, settled_ = -1, drag_loss_ = 0;
    int settlements_ = 0;
    SliderPlace place_;
    std::vector<Held> held_;
};

}  // namespace oracle::detail
