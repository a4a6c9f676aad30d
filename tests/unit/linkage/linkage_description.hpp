// Linkages as a test describes them, and such that are drawn at random.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

namespace slideway::linkage_oracle_test {

using Real = long double;
using Pair = Eigen::Matrix<Real, 2, 1>;

constexpr int ground = -1;

struct Body { std::string name; double mass, inertia, center_x, center_y, angle = 0, speed = 0; };
/// @param more lines of the scene that say the rest
struct Link { std::string kind; int first, second; double x1, y1, x2, y2; std::map<std::string, double> more; };
/// A load, spring or stop.  @param link number of a joint, or −1  @param words lines of the scene beside numbers
struct Acting { std::string kind; int on, against, link; std::map<std::string, double> numbers; std::string words; };
struct Description {
    std::vector<Body> bodies;
    std::vector<Link> links;
    bool is_driven = true, has_friction = false;
    double speed = 20;
    std::vector<Acting> loads = {};
};

inline Pair across(Pair const& v) { return {-v.y(), v.x()}; }
inline Pair turned(Real angle, double x, double y) { return {std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y}; }

/// A body on a slide has neither angle nor speed of its own.
inline bool slides(Description const& of, int body) {
    return std::ranges::any_of(of.links, [&](Link const& link) { return link.kind == "prismatic" && link.second == body; });
}

inline std::string scene_text(Description const& of, double start_angle) {
    std::string text = fmt::format("schema = 1\n[mechanism]\nkind = \"linkage\"\n");
    if (of.is_driven) text += fmt::format("crank_speed = {}\nstart_angle = {}\n[drive]\nbody = \"{}\"\n", of.speed, start_angle, of.bodies[0].name);
    for (std::size_t i = 0; i < of.bodies.size(); ++i) {
        Body const& body = of.bodies[i];
        text += fmt::format("[body.{}]\nmass = {}\ninertia = {}\ncenter_x = {}\ncenter_y = {}\n", body.name, body.mass, body.inertia, body.center_x, body.center_y);
        if (body.angle != 0) text += fmt::format("angle = {}\n", body.angle);
        if (body.speed != 0 && !slides(of, static_cast<int>(i)) && !(of.is_driven && i == 0)) text += fmt::format("speed = {}\n", body.speed);
    }
    auto const name = [&](int body) { return body == ground ? std::string("ground") : of.bodies[static_cast<std::size_t>(body)].name; };
    for (std::size_t i = 0; i < of.links.size(); ++i) {
        Link const& link = of.links[i];
        text += fmt::format("[link.l{}]\nkind = \"{}\"\nfirst = \"{}\"\nsecond = \"{}\"\nfirst_x = {}\nfirst_y = {}\nsecond_x = {}\nsecond_y = {}\n", i, link.kind, name(link.first),
                            name(link.second), link.x1, link.y1, link.x2, link.y2);
        for (auto const& [key, value] : link.more) text += fmt::format("{} = {}\n", key, value);
    }
    for (std::size_t i = 0; i < of.loads.size(); ++i) {
        Acting const& load = of.loads[i];
        text += fmt::format("[{}.a{}]\n{}", load.kind, i, load.words);
        if (load.link >= 0) text += fmt::format("link = \"l{}\"\n", load.link);
        else text += fmt::format("on = \"{}\"\nagainst = \"{}\"\n", name(load.on), name(load.against));
        for (auto const& [key, value] : load.numbers) text += fmt::format("{} = {}\n", key, value);
    }
    if (of.has_friction) text += "[friction]\nstatic = 0.3\nkinetic = 0.2\nstick_speed = 0.01\nslip_speed = 0.05\n";
    return text + "[contact]\neta = 0.3\n[study]\nduration = 0.1\n";
}

/// A linkage at random: each body on the ground or on one before it, by a pin, a slide or a journal; then more journals and blocks, and pins that close loops, as
/// far as freedom is left.  All joints close in one pose, in which points of joints are drawn.
class Drawn {
public:
    Drawn(std::uint64_t seed, int loops) : random_(seed) {
        description_.is_driven = chance(0.5);
        description_.has_friction = true;
        int const bodies = whole(4, 6);
        freedom_ = description_.is_driven ? -1 : 0;
        for (int i = 0; i < bodies; ++i) add_body(i, bodies - 1 - i);
        for (int tries = 0; tries < 50 && loops > 0 && freedom_ >= 3; ++tries) loops -= add_link("revolute", whole(ground, bodies - 1), whole(0, bodies - 1)) ? 1 : 0;
        for (int tries = 0; tries < 50 && contacts_ < 3 && freedom_ >= 2; ++tries) add_link(chance(0.5) ? "journal" : "block", whole(0, bodies - 1), whole(ground, bodies - 1));
        is_whole_ = loops == 0 && contacts_ > 0;
    }
    bool is_whole() const { return is_whole_; }
    Description const& description() const { return description_; }

private:
    struct Pose { Pair place{0, 0}; Real angle = 0; };

    double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
    bool chance(double of) { return real(0, 1) < of; }
    Pose pose(int body) const { return body == ground ? Pose{} : poses_[static_cast<std::size_t>(body)]; }
    /// In a body's axes.
    Pair seen(int body, Pair const& place) const {
        Pose const from = pose(body);
        Pair const d = place - from.place;
        return turned(-from.angle, static_cast<double>(d.x()), static_cast<double>(d.y()));
    }

    void add_body(int i, int later) {
        poses_.push_back({{real(-0.2, 0.2), real(-0.2, 0.2)}, i == 0 ? 0.25 : real(-0.7, 0.7)});
        description_.bodies.push_back({fmt::format("b{}", i), real(0.1, 0.6), real(2e-4, 2e-3), real(-0.05, 0.05), real(-0.05, 0.05), i == 0 && description_.is_driven ? 0 : double(poses_.back().angle)});
        bool const may_float = i > 0 && contacts_ < 3 && coordinates_ + 3 + later <= 8;
        std::string const kind = i == 0 ? "revolute" : may_float && chance(0.4) ? "journal" : chance(0.3) ? "prismatic" : "revolute";
        coordinates_ += kind == "journal" ? 3 : 1, freedom_ += kind == "journal" ? 3 : 1;
        if (kind == "prismatic") description_.bodies.back().angle = 0;
        int const below = i == 0 ? ground : whole(ground, i - 1);
        kind == "journal" ? add_link(kind, i, below) : add_link(kind, below, i);
    }

    /// Joins two bodies that nothing joins yet, and neither the ground to itself nor a body to itself.
    bool add_link(std::string const& kind, int first, int second) {
        if (first == second) return false;
        for (Link const& link : description_.links) {
            if ((link.first == first && link.second == second) || (link.first == second && link.second == first)) return false;
        }
        Pair const p{real(-0.25, 0.25), real(-0.25, 0.25)};
        Pair const a = seen(first, p);
        Pair b = seen(second, p);
        std::map<std::string, double> more;
        if (kind == "journal") more = {{"clearance", 1e-4}, {"radius", 0.01}, {"stiffness", 5e9}};
        double const between = static_cast<double>(pose(first).angle - pose(second).angle);
        if (kind == "block") more = {{"clearance", 1e-4}, {"length", 0.04}, {"height", 0.02}, {"stiffness", 5e9}, {"direction", between}};
        if (kind == "prismatic") {
            double const direction = real(-1, 1), position = real(0.05, 0.2);
            more = {{"direction", direction}, {"position", position}, {"turn", -between}};
            b = seen(second, Pair(p + turned(pose(first).angle + direction, position, 0)));
        }
        bool const touches = kind == "journal" || kind == "block", is_of_tree = description_.links.size() < description_.bodies.size() && !touches;
        contacts_ += touches ? 1 : 0;
        freedom_ -= is_of_tree ? 0 : 2;
        description_.links.push_back({kind, first, second, double(a.x()), double(a.y()), double(b.x()), double(b.y()), more});
        return true;
    }

    std::mt19937_64 random_;
    Description description_;
    std::vector<Pose> poses_;
    int coordinates_ = 0, freedom_ = 0, contacts_ = 0;
    bool is_whole_ = false;
};

}  // namespace slideway::linkage_oracle_test
