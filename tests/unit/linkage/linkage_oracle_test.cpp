// Right-hand sides of linkages, with loads, springs and stops or without, against another formulation: absolute coordinates of all bodies and a
// multiplier for each constraint, in long double.
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <Eigen/LU>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/backend/backend.hpp"
#include "host/backend/linkage_numbers.hpp"
#include "host/config/descriptors.hpp"
#include "host/config/linkages.hpp"
#include "host/config/scene.hpp"
#include "host/study/probe.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "tests/unit/linkage/linkage_description.hpp"

namespace slideway::linkage_oracle_test {
namespace {

using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Column = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
/// What loads do in a state: power of pushes, loss of dampers, potential of springs and stops.
struct LoadSums { Real power = 0, loss = 0, potential = 0; };


/// The linkage in absolute coordinates.
class AbsoluteLinkage {
public:
    AbsoluteLinkage(Description const& of, Scene const& scene, StateNumbers const& state) : of_(of) {
        Linkage const& linkage = *linkage_of(scene.parts.mechanism);
        place_.resize(of.bodies.size()), speed_ = place_;
        std::vector<bool> stands(of.bodies.size(), false);
        // The tree's coordinates give positions: of a body that floats its mass centre, of others what joints to those that stand say.
        for (int i = 0; i < linkage.plan.bodies; ++i) {
            auto const& node = linkage.plan.body[i];
            auto const at = index_of(linkage.bodies[static_cast<std::size_t>(i)]);
            auto const number = [&](int c, int rate) { return Real(state[static_cast<std::size_t>(2 * (node.coordinate + c) + rate)]); };
            if (node.joint == TreeJoint::floating) {
                put(at, {number(0, 0), number(1, 0)}, number(2, 0), {number(0, 1), number(1, 1)}, number(2, 1));
            } else {
                hang(at, linkage, node, number);
            }
            stands[at] = true;
        }
    }

    /// Accelerations x'', y'' of mass centres and θ'' of each body.
    Column accelerations() const {
        auto const n = static_cast<Eigen::Index>(3 * of_.bodies.size());
        Matrix mass = Matrix::Zero(n, n);
        Column force = Column::Zero(n);
        for (std::size_t i = 0; i < of_.bodies.size(); ++i) {
            auto const k = static_cast<Eigen::Index>(3 * i);
            mass(k, k) = mass(k + 1, k + 1) = of_.bodies[i].mass;
            mass(k + 2, k + 2) = of_.bodies[i].inertia;
            force(k + 1) = -of_.bodies[i].mass * Real(9.81);
        }
        for (Link const& link : of_.links) {
            if (link.kind == "journal") add_journal(link, force);
            if (link.kind == "block") add_block(link, force);
        }
        for (Acting const& load : of_.loads) add_load(load, force);
        std::vector<Column> rows;
        std::vector<Real> biases;  // row · a = bias
        for (Link const& link : of_.links) add_rows(link, n, rows, biases);
        if (of_.is_driven) {
            Column row = Column::Zero(n);
            row(2) = 1;
            rows.push_back(row), biases.push_back(0);
        }
        auto const m = static_cast<Eigen::Index>(rows.size());
        Matrix whole = Matrix::Zero(n + m, n + m);
        Column right(n + m);
        whole.topLeftCorner(n, n) = mass;
        right.head(n) = force;
        for (Eigen::Index i = 0; i < m; ++i) {
            whole.block(n + i, 0, 1, n) = rows[static_cast<std::size_t>(i)].transpose();
            whole.block(0, n + i, n, 1) = rows[static_cast<std::size_t>(i)];
            right(n + i) = biases[static_cast<std::size_t>(i)];
        }
        return Column(whole.fullPivLu().solve(right)).head(n);
    }

    /// Of the state, once accelerations are known.
    LoadSums sums() const {
        Column nothing = Column::Zero(static_cast<Eigen::Index>(3 * of_.bodies.size()));
        LoadSums all;
        for (Acting const& load : of_.loads) add_load(load, nothing, &all);
        return all;
    }

    /// What the kernel's coordinate of a body should accelerate by.
    Real expected(Linkage const& linkage, int node_index, int c, Column const& a) const {
        auto const& node = linkage.plan.body[node_index];
        auto const at = index_of(linkage.bodies[static_cast<std::size_t>(node_index)]);
        auto const k = static_cast<Eigen::Index>(3 * at);
        if (node.joint == TreeJoint::floating) return a(k + c);
        if (node.joint == TreeJoint::revolute) return a(k + 2);
        // s = U · (p2 − p1).
        Link const& link = link_of(linkage, node_index);
        auto const p1 = point(link.first, link.x1, link.y1), p2 = point(link.second, link.x2, link.y2);
        Pair const u = turned(angle(link.first) + direction(link), 1, 0), d = p2.place - p1.place, v = p2.velocity - p1.velocity;
        Real const w = spin(link.first), alpha = link.first == ground ? Real(0) : a(3 * link.first + 2);
        Pair const relative = acceleration(link.second, p2, a) - acceleration(link.first, p1, a);
        return u.dot(relative) + 2 * w * across(u).dot(v) + (alpha * across(u) - w * w * u).dot(d);
    }

private:
    struct Point { Pair arm, place, velocity; };
    using Triple = Eigen::Matrix<Real, 3, 1>;

    std::size_t index_of(std::string const& name) const {
        std::size_t i = 0;
        while (of_.bodies[i].name != name) ++i;
        return i;
    }
    Link const& link_of(Linkage const& linkage, int node_index) const {
        int const body = static_cast<int>(index_of(linkage.bodies[static_cast<std::size_t>(node_index)]));
        for (Link const& link : of_.links) {
            if (link.kind == "prismatic" && link.second == body) return link;
        }
        throw std::logic_error("no such joint");
    }
    static double number(Link const& link, std::string const& name) { return link.more.contains(name) ? link.more.at(name) : 0; }
    static double direction(Link const& link) { return number(link, "direction"); }
    Real angle(int body) const { return body == ground ? Real(0) : place_[static_cast<std::size_t>(body)](2); }
    Real spin(int body) const { return body == ground ? Real(0) : speed_[static_cast<std::size_t>(body)](2); }
    Point point(int body, double x, double y) const {
        if (body == ground) return {{x, y}, {x, y}, {0, 0}};
        auto const i = static_cast<std::size_t>(body);
        Pair const arm = turned(place_[i](2), x - of_.bodies[i].center_x, y - of_.bodies[i].center_y);
        return {arm, Pair(place_[i].head<2>()) + arm, Pair(speed_[i].head<2>()) + speed_[i](2) * across(arm)};
    }
    Pair acceleration(int body, Point const& p, Column const& a) const {
        if (body == ground) return {0, 0};
        Real const w = spin(body);
        return Pair(a.segment<2>(3 * body)) + a(3 * body + 2) * across(p.arm) - w * w * p.arm;
    }
    void put(std::size_t body, Pair const& center, Real angle, Pair const& velocity, Real spin) {
        place_[body] << center, angle;
        speed_[body] << velocity, spin;
    }
    template <class Number> void hang(std::size_t body, Linkage const& linkage, LinkageBody const& node, Number const& coordinate) {
        int const below = node.parent < 0 ? ground : static_cast<int>(index_of(linkage.bodies[static_cast<std::size_t>(node.parent)]));
        for (Link const& link : of_.links) {
            bool const is_second = link.second == static_cast<int>(body), slides = link.kind == "prismatic";
            if ((is_second ? link.first : link.second) != below || (is_second ? link.second : link.first) != static_cast<int>(body)) continue;
            if (!slides && link.kind != "revolute") continue;
            Point const at = is_second ? point(below, link.x1, link.y1) : point(below, link.x2, link.y2);
            Body const& own = of_.bodies[body];
            double const x = is_second ? link.x2 : link.x1, y = is_second ? link.y2 : link.y1;
            Pair u{0, 0};
            Real s = 0, rate = 0, turn = coordinate(0, 0), w = coordinate(0, 1);
            if (slides) {
                u = turned(angle(below) + direction(link), 1, 0);
                s = coordinate(0, 0), rate = coordinate(0, 1);
                turn = angle(below) + number(link, "turn"), w = spin(below);
            }
            Pair const joint = at.place + s * u, arm = turned(turn, own.center_x - x, own.center_y - y);
            Pair const velocity = at.velocity + rate * u + spin(below) * across(Pair(s * u));
            put(body, joint + arm, turn, velocity + w * across(arm), w);
            return;
        }
        throw std::logic_error("a body of the tree hangs on nothing");
    }

    void push(int body, Point const& at, Pair const& where, Pair const& by, Real torque, Column& force) const {
        if (body == ground) return;
        Pair const arm = where - (at.place - at.arm);
        force.segment<2>(3 * body) += by;
        force(3 * body + 2) += arm.x() * by.y() - arm.y() * by.x() + torque;
    }
    static Real coefficient(Real speed) {
        Real const pi = std::acos(Real(-1));
        if (speed < 0.01L) return 0.3L * std::sin(pi * speed / 0.02L);
        if (speed >= 0.05L) return 0.2L;
        return 0.25L + 0.05L * std::cos(pi * (speed - 0.01L) / 0.04L);
    }
    void add_journal(Link const& link, Column& force) const {
        auto const a = point(link.first, link.x1, link.y1), b = point(link.second, link.x2, link.y2);
        Pair const e = a.place - b.place, n = e / e.norm(), v = a.velocity - b.velocity;
        Real const c = number(link, "clearance"), bearing = number(link, "radius"), journal = bearing - c, depth = e.norm() - c;
        if (depth <= 0) return;
        Real const load = elastic(link, depth, journal, bearing), normal = std::max(Real(0), load * (1 + 0.3L * depth * n.dot(v) / std::pow(depth, 1.5L)));
        // The touching point of the journal, as both bodies move there.
        Pair const touch = a.place + journal * n, on_a = a.velocity + spin(link.first) * across(Pair(journal * n)),
                   on_b = b.velocity + spin(link.second) * across(Pair(touch - b.place));
        Real const slip = across(n).dot(Pair(on_a - on_b));
        Real const drag = of_.has_friction ? -coefficient(std::abs(slip)) * normal * (slip < 0 ? -1 : 1) : Real(0);
        Pair const by = -normal * n + drag * across(n);
        push(link.first, a, touch, by, 0, force);
        push(link.second, b, touch, Pair(-by), 0, force);
    }
    /// Forces on both bodies at one place of the ground.
    void push_both(int on, int against, Pair const& place, Pair const& by, Real torque, Column& force) const {
        push(on, point(on, 0, 0), place, by, torque, force);
        push(against, point(against, 0, 0), place, Pair(-by), -torque, force);
    }
    Pair velocity_at(int body, Pair const& place) const {
        Point const origin = point(body, 0, 0);
        return origin.velocity + spin(body) * across(Pair(place - origin.place));
    }
    /// Of a spring or stop against stretch or depth.
    static Real pull_of(Acting const& load, bool turns, double side, Real stretch, Real rate, LoadSums* sums) {
        std::string const prefix = turns ? "angular_" : "";
        auto const number = [&](std::string const& key) { return load.numbers.contains(key) ? Real(load.numbers.at(key)) : Real(0); };
        Real const k = number(prefix + "stiffness"), c = number(prefix + "damping"), chi = number(prefix + "dissipation"), preload = number(prefix + "preload");
        Real pull = preload + k * stretch + c * rate, stored = preload * stretch + k * stretch * stretch / 2, loss = c * rate * rate;
        if (load.kind == "stop") {
            Real const depth = side * stretch, speed = side * rate;
            Real const push = depth > 0 ? std::max(Real(0), k * depth * (1 + chi * speed) + c * speed) : Real(0);
            pull = side * push, stored = depth > 0 ? k * depth * depth / 2 : 0, loss = depth > 0 ? (push - k * depth) * speed : 0;
        }
        if (sums != nullptr) sums->loss += loss, sums->potential += stored;
        return pull;
    }
    void add_load(Acting const& load, Column& force, LoadSums* sums = nullptr) const {
        auto const number = [&](std::string const& key) { return load.numbers.contains(key) ? load.numbers.at(key) : 0.0; };
        double const side = load.words.find("\"-") != std::string::npos ? -1 : 1;
        if (load.kind == "load") {
            Point const at = point(load.on, number("point_x"), number("point_y"));
            double const scale = load.numbers.contains("scale") ? number("scale") : 1;
            Pair const by = Real(scale) * turned(load.words.find("body") != std::string::npos ? angle(load.on) : Real(0), number("force_x"), number("force_y"));
            Real const torque = Real(scale) * Real(number("torque"));
            push_both(load.on, load.against, at.place, by, torque, force);
            if (sums != nullptr) sums->power += by.dot(Pair(at.velocity - velocity_at(load.against, at.place))) + torque * (spin(load.on) - spin(load.against));
        } else if (load.numbers.contains("angle")) {
            Real const torque = pull_of(load, true, side, angle(load.on) - angle(load.against) - Real(number("angle")), spin(load.on) - spin(load.against), sums);
            push_both(load.on, load.against, {0, 0}, {0, 0}, -torque, force);
        } else if (load.link >= 0) {
            // Along the line of a joint, which is on its first body, or on the walls of its second one.
            Link const& link = of_.links[static_cast<std::size_t>(load.link)];
            bool const slides = link.kind == "prismatic";
            int const line = slides ? link.first : link.second, moving = slides ? link.second : link.first;
            Point const from = slides ? point(line, link.x1, link.y1) : point(line, link.x2, link.y2), to = slides ? point(moving, link.x2, link.y2) : point(moving, link.x1, link.y1);
            Pair const along = turned(angle(line) + direction(link), 1, 0);
            Real const rest = load.kind == "stop" ? number("position") : number("rest_length");
            Real const pull = pull_of(load, false, side, along.dot(Pair(to.place - from.place)) - rest, along.dot(Pair(to.velocity - velocity_at(line, to.place))), sums);
            push_both(moving, line, to.place, Pair(-pull * along), 0, force);
        } else {
            Point const at = point(load.on, number("point_x"), number("point_y")), anchor = point(load.against, number("anchor_x"), number("anchor_y"));
            Pair const span = at.place - anchor.place, along = span / span.norm();
            Real const pull = pull_of(load, false, side, span.norm() - Real(number("rest_length")), along.dot(Pair(at.velocity - anchor.velocity)), sums);
            push_both(load.on, load.against, at.place, Pair(-pull * along), 0, force);
        }
    }

    Real elastic(Link const& link, Real depth, Real journal, Real bearing) const {
        Real k = number(link, "stiffness");
        if (k == 0) {
            Real const nu = 0.29L, modulus = 2.07e11L / (2 * (1 - nu * nu));
            k = 4 * modulus / 3 * std::sqrt(journal * bearing / (bearing - journal));
        }
        return k * std::pow(depth, 1.5L);
    }
    void add_block(Link const& link, Column& force) const {
        auto const a = point(link.first, link.x1, link.y1), b = point(link.second, link.x2, link.y2);
        Real const turn = angle(link.second) + direction(link), wall_spin = spin(link.second);
        Pair const along = turned(turn, 1, 0), up = across(along);
        Real const c = number(link, "clearance"), half = number(link, "height") / 2;
        for (int s3 : {1, -1}) {
            for (int s1 : {1, -1}) {
                // A corner of the block, its height over the middle, and how fast it nears its wall: the walls stand at half + c.
                Pair const corner = turned(angle(link.first), s3 * number(link, "length") / 2, s1 * double(half)), at = a.place + corner;
                Pair const v = a.velocity + spin(link.first) * across(corner) - b.velocity - wall_spin * across(Pair(at - b.place));
                Real const depth = s1 * up.dot(Pair(at - b.place)) - half - c, rate = s1 * up.dot(v);
                if (depth <= 0) continue;
                Real const load = elastic(link, depth, 0, 1), normal = std::max(Real(0), load * (1 + 0.3L * depth * rate / std::pow(depth, 1.5L))), slip = along.dot(v);
                Real const drag = of_.has_friction ? -coefficient(std::abs(slip)) * normal * (slip < 0 ? -1 : 1) : Real(0);
                Pair const by = -s1 * normal * up + drag * along;
                push(link.first, a, at, by, 0, force);
                push(link.second, b, at, Pair(-by), 0, force);
            }
        }
    }

    void add_rows(Link const& link, Eigen::Index n, std::vector<Column>& rows, std::vector<Real>& biases) const {
        if (link.kind == "journal" || link.kind == "block") return;
        auto const a = point(link.first, link.x1, link.y1), b = point(link.second, link.x2, link.y2);
        auto const row_along = [&](Pair const& direction, Real sign, int body, Point const& p, Column& row) {
            if (body == ground) return;
            row.segment<2>(3 * body) += sign * direction;
            row(3 * body + 2) += sign * direction.dot(across(p.arm));
        };
        auto const centripetal = [&](int body, Point const& p) -> Pair { return -spin(body) * spin(body) * p.arm; };
        Pair const bias = (link.second == ground ? Pair(0, 0) : centripetal(link.second, b)) - (link.first == ground ? Pair(0, 0) : centripetal(link.first, a));
        if (link.kind == "revolute") {
            for (Pair const direction : {Pair(1, 0), Pair(0, 1)}) {
                Column row = Column::Zero(n);
                row_along(direction, 1, link.second, b, row);
                row_along(direction, -1, link.first, a, row);
                rows.push_back(row), biases.push_back(-direction.dot(bias));
            }
            return;
        }
        Pair const up = across(turned(angle(link.first) + direction(link), 1, 0)), d = b.place - a.place, v = b.velocity - a.velocity;
        Real const w = spin(link.first);
        Column row = Column::Zero(n), turn = Column::Zero(n);
        row_along(up, 1, link.second, b, row);
        row_along(up, -1, link.first, a, row);
        if (link.first != ground) row(3 * link.first + 2) += across(up).dot(d);
        rows.push_back(row), biases.push_back(-up.dot(bias) - 2 * w * across(up).dot(v) + w * w * up.dot(d));
        turn(3 * link.second + 2) = 1;
        if (link.first != ground) turn(3 * link.first + 2) = -1;
        rows.push_back(turn), biases.push_back(0);
    }

    Description const& of_;
    std::vector<Triple> place_, speed_;
};

/// Linkages, and whether their joints are pressed.
std::vector<std::pair<std::string, Description>> linkages() {
    Body const crank{"crank", 0.3, 2e-4, 0.02, 0.003}, rod{"rod", 0.21, 4e-4, 0.06, -0.002, -0.2}, slider{"slider", 0.14, 1e-4, 0.004, 0.001};
    Link const shaft{"revolute", ground, 0, 0, 0, 0, 0, {}}, pin{"revolute", 0, 1, 0.05, 0, 0, 0, {}};
    Link const way{"prismatic", ground, 2, 0.01, -0.002, 0, 0, {{"direction", 0.1}, {"position", 0.16}, {"turn", 0.3}}};
    std::map<std::string, double> const gap{{"clearance", 1e-4}, {"radius", 0.01}}, soft{{"clearance", 1e-4}, {"radius", 0.01}, {"stiffness", 5e9}};
    std::map<std::string, double> const walls{{"clearance", 1e-4}, {"length", 0.04}, {"height", 0.02}, {"stiffness", 5e9}, {"direction", -0.2}};
    Body const four_crank{"crank", 0.4, 3e-4, 0.03, 0.002}, coupler{"coupler", 0.6, 2e-3, 0.12, 0.01, 0.5}, rocker{"rocker", 0.5, 1e-3, 0.07, -0.004, 1.4};
    Link const four_shaft{"revolute", ground, 0, 0, 0, 0, 0, {}}, post{"revolute", ground, 2, 0.22, 0.01, 0, 0, {}};
    auto const journal = [&](int a, int b, double x1, double x2, std::map<std::string, double> more) { return Link{"journal", a, b, x1, 0, x2, 0, std::move(more)}; };
    std::vector<std::pair<std::string, Description>> all;
    all.push_back({"wrist_journal", {{crank, rod, slider}, {shaft, pin, journal(1, 2, 0.12, 0.004, soft), way}, true, true}});
    all.push_back({"wrist_journal_free", {{crank, rod, slider}, {shaft, pin, journal(1, 2, 0.12, 0.004, gap), way}, false, true}});
    all.push_back({"block_in_walls", {{crank, rod, slider}, {shaft, pin, {"revolute", 1, 2, 0.12, 0, 0.002, 0.001, {}}, {"block", 2, ground, 0.001, 0, 0.01, 0, walls}}, true, true}});
    all.push_back({"both", {{crank, rod, slider}, {shaft, pin, journal(1, 2, 0.12, 0.002, soft), {"block", 2, ground, 0, 0, 0, 0, walls}}, true, true}});
    all.push_back({"four_bar_ideal", {{four_crank, coupler, rocker}, {four_shaft, {"revolute", 0, 1, 0.06, 0, 0, 0, {}}, {"revolute", 1, 2, 0.25, 0, 0.15, 0, {}}, post}, true, false}});
    all.push_back({"four_bar_one_journal", {{four_crank, coupler, rocker}, {four_shaft, {"revolute", 0, 1, 0.06, 0, 0, 0, {}}, journal(1, 2, 0.25, 0.15, soft), post}, true, true}});
    all.push_back({"four_bar_three_journals",
                   {{four_crank, coupler, rocker}, {four_shaft, journal(0, 1, 0.06, 0, soft), journal(1, 2, 0.25, 0.15, soft), journal(2, ground, 0, 0.22, soft)}, true, true}});
    Body const arm{"arm", 0.5, 2e-3, 0.1, 0.005, 0.4}, stone{"stone", 0.1, 1e-5, 0.002, 0.001};
    all.push_back({"quick_return", {{{"crank", 0.4, 3e-4, 0.02, 0.001}, arm, stone},
                                    {shaft, {"revolute", ground, 1, -0.15, -0.02, 0, 0, {}}, {"prismatic", 1, 2, 0.01, 0.002, 0, 0, {{"position", 0.18}, {"direction", 0.05}}},
                                     {"revolute", 2, 0, 0, 0, 0.06, 0, {}}}, true, false}});
    all.push_back({"block_on_turning_arm", {{{"crank", 0.4, 3e-4, 0.02, 0.001}, arm, {"stone", 0.1, 1e-4, 0.002, 0.001, 0.45}},
                                            {shaft, {"revolute", ground, 1, -0.15, -0.02, 0, 0, {}}, {"revolute", 0, 2, 0.06, 0, 0, 0, {}},
                                             {"block", 2, 1, 0, 0, 0.01, 0.002, {{"clearance", 2e-4}, {"length", 0.03}, {"height", 0.02}, {"stiffness", 3e9}, {"direction", 0.05}}}}, true, true}});
    all.push_back({"block_on_a_turning_arm_off_its_line",
                   {{{"arm", 0.5, 2e-3, 0.1, 0.005}, {"weight", 2, 3e-3, 0.01, 0.05}}, {{"revolute", ground, 0, 0, 0, 0, 0, {}}, {"prismatic", 0, 1, 0.02, 0.01, 0, 0, {{"position", 0.2}, {"direction", 0.3}, {"turn", 0.4}}}},
                    true, false}});
    Description six{{{"crank", 0.3, 2e-4, 0.03, 0.001}, {"b2", 0.5, 1.5e-3, 0.1, 0.01, 0.5}, {"b3", 0.45, 1.1e-3, 0.07, -0.005, 1.5}, {"b4", 0.35, 1e-3, 0.09, 0, 0.2}, {"b5", 0.4, 9e-4, 0.06, 0.004, 1.4}},
                    {shaft, {"revolute", 0, 1, 0.06, 0, 0, 0, {}}, {"revolute", ground, 2, 0.22, 0, 0, 0, {}}, {"revolute", 2, 3, 0.12, -0.05, 0, 0, {}},
                     {"revolute", ground, 4, 0.45, 0.02, 0, 0, {}}, {"revolute", 1, 2, 0.2, 0, 0.14, 0, {}}, {"revolute", 3, 4, 0.2, 0, 0.15, 0, {}}}, true, false};
    all.push_back({"six_bar", six});
    return all;
}

/// Which bodies stand on loops.
std::vector<bool> on_loops(LinkagePlan const& plan) {
    std::vector<bool> are(static_cast<std::size_t>(plan.bodies), false);
    for (int i = 0; i < plan.closures; ++i) {
        for (int body : plan.closure[i].body) {
            for (; !plan.closure[i].has_clearance() && body != LinkageBody::ground; body = plan.body[body].parent) are[static_cast<std::size_t>(body)] = true;
        }
    }
    return are;
}

/// Whether it goes together in the pose that it was drawn in, and one of its joints can be pressed while loops are left as they are.
bool starts(Description const& of) {
    try {
        Scene const scene = parse_scene(scene_text(of, 0.25), "drawn", {});
        LinkagePlan const& plan = linkage_of(scene.parts.mechanism)->plan;
        auto const is_held = on_loops(plan);
        bool const is_free = std::ranges::any_of(plan.closure, plan.closure + plan.closures, [&](LinkageClosure const& of) {
            return of.has_clearance() && std::ranges::any_of(of.body, [&](int body) { return body != LinkageBody::ground && !is_held[static_cast<std::size_t>(body)]; });
        });
        // Elsewhere than where they were drawn all joints may lie at the ends of their clearances, and nothing shakes them.
        auto const start = assembled(plan, member_inputs(scene, 0));
        return is_free && start.fault == AssemblyFault::none && std::abs(start.distance) < 1e-9;
    } catch (SceneError const&) {
        return false;  // a dead centre, or one coordinate too many
    }
}

constexpr int fixed_linkages = 11, drawn_linkages = 8;

/// Half of them with a loop or two.
std::pair<std::string, Description> drawn(int which) {
    int found = 0;
    for (std::uint64_t seed = 1; seed < 1000; ++seed) {
        Drawn const tried(seed, found % 2 == 0 ? 0 : 1 + found % 4 / 2);
        if (!tried.is_whole() || !starts(tried.description())) continue;
        if (found++ == which) return {fmt::format("drawn_{}", seed), tried.description()};
    }
    throw std::logic_error("no linkage was drawn");
}

/// A linkage with pushes and springs between points, or with what acts along its joints and between angles.
Description loaded(Description of, bool on_joints) {
    // The other body of a spring is free to answer it, where there is one beside a driven crank.
    int const last = static_cast<int>(of.bodies.size()) - 1, other = last > 1 ? 1 : 0;
    if (!on_joints) {
        of.loads.push_back({"load", last, ground, -1, {{"force_x", 30}, {"force_y", -50}, {"point_x", 0.02}, {"point_y", -0.03}, {"torque", 0.7}}, "frame = \"body\"\n"});
        of.loads.push_back({"load", 0, last, -1, {{"force_x", -20}, {"force_y", 15}, {"point_x", 0.04}, {"torque", -0.4}, {"scale", 1.5}}, "frame = \"ground\"\n"});
        of.loads.push_back({"spring", 1, ground, -1, {{"point_x", 0.05}, {"point_y", 0.01}, {"anchor_x", -0.2}, {"anchor_y", 0.3}, {"stiffness", 800}, {"damping", 3}, {"rest_length", 0.1}, {"preload", 5}}, ""});
        of.loads.push_back({"spring", last, other, -1, {{"point_x", 0.01}, {"anchor_y", 0.07}, {"stiffness", 500}, {"damping", 2}, {"rest_length", 0.3}}, ""});
        return of;
    }
    of.loads.push_back({"spring", last, other, -1, {{"angle", 0.3}, {"angular_stiffness", 4}, {"angular_damping", 0.02}, {"angular_preload", 0.5}}, ""});
    of.loads.push_back({"stop", last, ground, -1, {{"angle", -3}, {"angular_stiffness", 0.8}, {"angular_damping", 0.01}, {"angular_dissipation", 0.02}}, "blocks = \"+angle\"\n"});
    of.loads.push_back({"stop", 0, last, -1, {{"angle", 4}, {"angular_stiffness", 0.5}}, "blocks = \"-angle\"\n"});
    for (std::size_t i = 0; i < of.links.size(); ++i) {
        if (of.links[i].kind != "prismatic" && of.links[i].kind != "block") continue;
        int const at = static_cast<int>(i);
        of.loads.push_back({"spring", 0, 0, at, {{"rest_length", 0.05}, {"stiffness", 900}, {"damping", 4}, {"preload", -3}}, ""});
        of.loads.push_back({"stop", 0, 0, at, {{"position", -0.1}, {"stiffness", 700}, {"damping", 2}, {"dissipation", 0.05}}, "blocks = \"+x\"\n"});
        break;
    }
    return of;
}

/// A state near the one that a linkage starts in, with joints pressed: places within the scales of the state, rates of the order of the drive's.
/// What stands on loops is left as it is.
StateNumbers shaken(StateNumbers state, Linkage const& linkage, std::mt19937_64& random, double by) {
    std::uniform_real_distribution<double> const any(-1, 1);
    auto draw = any;
    auto const is_held = on_loops(linkage.plan);
    for (int c = 0; c < linkage.plan.coordinates; ++c) {
        if ((linkage.plan.is_driven && c == 0) || is_held[static_cast<std::size_t>(linkage.plan.owner[c])]) continue;
        auto const at = static_cast<std::size_t>(2 * c);
        state[at] += by * draw(random) * (linkage.plan.is_angle(c) ? 10 : 1);
        state[at + 1] += draw(random) * (linkage.plan.is_angle(c) ? 5 : 0.3);
    }
    return state;
}

class LinkagesAgainstOracle : public ::testing::TestWithParam<int> {};

TEST_P(LinkagesAgainstOracle, AccelerateAlike) {
    int const which = GetParam() < 3 * fixed_linkages ? GetParam() % fixed_linkages : GetParam() - 2 * fixed_linkages, kind = GetParam() < 3 * fixed_linkages ? GetParam() / fixed_linkages : 0;
    bool const is_drawn = which >= fixed_linkages;
    auto const [name, bare] = is_drawn ? drawn(which - fixed_linkages) : linkages()[static_cast<std::size_t>(which)];
    Description const description = kind == 0 ? bare : loaded(bare, kind == 2);
    int const wanted_states = kind == 0 ? 200 : 60;
    std::mt19937_64 random(1);
    int pressed = 0, states = 0;
    for (int tries = 0; states < wanted_states; ++tries) {
        ASSERT_LT(tries, 1000) << name;
        double const start = description.is_driven ? std::uniform_real_distribution<double>(-0.4, 0.9)(random) : 0;
        Description turned_to = description;
        for (Body& body : turned_to.bodies) body.speed = is_drawn ? std::uniform_real_distribution<double>(-5, 5)(random) : 0;
        Scene const scene = parse_scene(scene_text(turned_to, start), name, {});
        Linkage const& linkage = *linkage_of(scene.parts.mechanism);
        Inputs in = member_inputs(scene, 0);
        StateNumbers state = start_of(scene.parts.mechanism, in);
        // Not at every angle of the crank does what was drawn go together.
        if (is_drawn && std::isnan(state[0])) continue;
        ASSERT_FALSE(std::isnan(state[0])) << name;
        state = shaken(state, linkage, random, 2e-4);
        set_start(info(scene.parts.mechanism), state, in);
        auto const told = probe(Isa::scalar, scene.parts, {in}, {0}).front();
        ASSERT_EQ(told.status, Status::finished) << name;
        AbsoluteLinkage const absolute(description, scene, state);
        auto const wanted = absolute.accelerations();
        Real largest = 0;
        for (Real const a : wanted) largest = std::max(largest, std::abs(a));
        for (int k = 0; k < linkage.plan.bodies; ++k) {
            auto const& node = linkage.plan.body[k];
            for (int c = 0; c < (node.joint == TreeJoint::floating ? 3 : 1); ++c) {
                Real const want = absolute.expected(linkage, k, c, wanted);
                EXPECT_NEAR(told.derivative[2 * (node.coordinate + c) + 1], double(want), 2e-8 * double(largest)) << name << ", " << linkage.bodies[static_cast<std::size_t>(k)];
            }
        }
        LoadSums const sums = absolute.sums();
        Parts unloaded = scene.parts;
        unloaded.loads = {};
        double const stored = told.energy - probe(Isa::scalar, unloaded, {in}, {0}).front().energy, size = std::abs(told.energy) + std::abs(stored);
        EXPECT_NEAR(told.power_load, double(sums.power), 1e-11 * (1 + std::abs(told.power_load))) << name;
        EXPECT_NEAR(told.loss_springs, double(sums.loss), 1e-11 * (1 + told.loss_springs)) << name;
        EXPECT_NEAR(stored, double(sums.potential), 1e-13 * (1 + size)) << name;
        pressed += told.contact_potential > 0 ? 1 : 0;
        ++states;
    }
    if (description.has_friction) EXPECT_GT(pressed, is_drawn ? 20 : wanted_states / 4) << name;
}

INSTANTIATE_TEST_SUITE_P(Linkages, LinkagesAgainstOracle, ::testing::Range(0, 3 * fixed_linkages + drawn_linkages));

}  // namespace
}  // namespace slideway::linkage_oracle_test
