// [load.<name>], [spring.<name>] and [stop.<name>] of a linkage: which bodies or joint they act on.
#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "host/config/linkages.hpp"
#include "host/config/loads.hpp"
#include "host/config/reader.hpp"

namespace slideway {
namespace {

class LinkageLoadReader {
public:
    LinkageLoadReader(Reading const& reading, Node const& node, Load& load)
        : reading_(reading), node_(node), load_(load), linkage_(*linkage_of(reading.scene.parts.mechanism)) {}

    std::string read() {
        if (load_.kind == LoadKind::push) return read_push();
        Node const* const of_angle = first("ang");
        load_.turns = of_angle != nullptr;
        for (Node const& child : node_.children) {
            LoadNumber const* const number = find_load_number(load_.kind, child.key);
            if (load_.turns && number != nullptr && !is_of_angle(child))
                refuse(child, {fmt::format("{} makes it one of an angle", of_angle->name), "remove one of the two, or write two of them"});
        }
        return load_.kind == LoadKind::spring ? read_spring() : read_stop();
    }

private:
    static bool is_of_angle(Node const& child) { return child.key.starts_with("ang"); }
    Node const* first(std::string_view prefix) const {
        auto const found = std::ranges::find_if(node_.children, [&](Node const& child) { return child.key.starts_with(prefix); });
        return found == node_.children.end() ? nullptr : &*found;
    }
    void require(std::string_view name, std::string_view why, std::string_view advice) const {
        if (node_.find(name) == nullptr) refuse_missing(node_, fmt::format("{}.{}", node_.name, name), why, advice);
    }

    std::string read_push() {
        std::string const words = read_bodies("which body it acts on");
        Node const* const frame = node_.find("frame");
        static constexpr std::string_view frames[] = {load_frames[0], load_frames[2]};
        load_.turns_with_slider = frame != nullptr && read_choice(*frame, "frame", frames) == 1;
        return words + fmt::format("frame = \"{}\"\n", frames[load_.turns_with_slider ? 1 : 0]);
    }

    std::string read_spring() {
        std::string const words = read_place();
        if (first("stiffness") == nullptr && first("damping") == nullptr && first("preload") == nullptr && !load_.turns)
            require("stiffness", "a spring without a stiffness, a damping or a preload does nothing", "add stiffness = \"2 N/mm\", or angular_stiffness");
        if (node_.find("stiffness") != nullptr)
            require("rest_length", "the length at which the spring is slack but for its preload", "add rest_length = \"50 mm\"");
        if (!load_.turns) return words;
        if (first("angular") == nullptr)
            require("angular_stiffness", "a spring without a stiffness, a damping or a preload does nothing", "add angular_stiffness = \"2 N m/rad\"");
        if (node_.find("angular_stiffness") != nullptr)
            require("angle", "the angle at which the spring is slack but for its preload", "add angle = \"30 deg\"");
        return words;
    }

    std::string read_stop() {
        std::string words = read_place();
        std::string_view const own = load_.turns ? "angle" : "position";
        if (!load_.turns && load_.coordinate == Load::none && load_.closure == Load::none)
            refuse_missing(node_, node_.name + ".link", "a stop is of a joint's displacement, or of an angle",
                           "add link = \"…\", a prismatic joint or block, or give angle for position");
        require(own, "where the stop is touched", load_.turns ? "add angle = \"30 deg\"" : "add position = 0.15");
        require(load_.turns ? "angular_stiffness" : "stiffness", "how far the stop gives way",
                load_.turns ? "add angular_stiffness = \"1e4 N m/rad\"" : "add stiffness = \"1e7 N/m\"");
        auto const sides = std::span(stop_sides).subspan(load_.turns ? 2 : 0, 2);
        require("blocks", "which way it cannot go on", fmt::format("add blocks = \"{}\", or \"{}\"", sides[0], sides[1]));
        load_.side = read_choice(*node_.find("blocks"), "blocks", sides) == 0 ? 1 : -1;
        return words + fmt::format("blocks = \"{}\"\n", sides[load_.side > 0 ? 0 : 1]);
    }

    /// Of a spring or stop: its bodies, or a joint in their place.
    std::string read_place() {
        Node const* const link = node_.find("link");
        if (link == nullptr) return read_bodies("which body or joint it acts on");
        for (std::string_view const idle : {"on", "against", "point_x", "point_y", "anchor_x", "anchor_y"}) {
            if (Node const* const node = node_.find(idle))
                refuse(*node, {fmt::format("{} says which bodies it is between, and where", link->name), "remove one of the two"});
        }
        Node const& joint = joint_of(*link);
        std::string const& kind = joint.find("kind")->text;
        bool const slides = kind == link_kinds[static_cast<int>(LinkKind::prismatic)], is_block = kind == link_kinds[static_cast<int>(LinkKind::block)];
        if (load_.turns && (slides || is_block)) refuse(*link, {"it leads along a line", "use on and against, or what is no angle"});
        if (!load_.turns && !slides && !is_block)
            refuse(*link, {"a pin has no displacement", "use angle and angular_stiffness, or a prismatic joint or block"});
        if (is_block) {
            load_.closure = static_cast<int>(std::ranges::find(linkage_.closures, joint.name) - linkage_.closures.begin());
        } else if (slides) {
            load_.coordinate = linkage_.plan.body[body_called(*joint.find("second"))].coordinate;
        } else {
            load_.body[0] = body_called(*joint.find("second")), load_.body[1] = body_called(*joint.find("first"));
        }
        return fmt::format("link = \"{}\"\n", link->text);
    }

    Node const& joint_of(Node const& link) const {
        std::string const& name = read_text_value(link);
        Node const& all = *reading_.given(link_table);
        std::vector<std::string_view> known;
        for (Node const& one : all.children) known.push_back(one.key);
        auto const found = std::ranges::find(known, name);
        if (found == known.end()) refuse(link, {"there is no such joint", choice_advice(name, known)});
        return all.children[static_cast<std::size_t>(found - known.begin())];
    }

    std::string read_bodies(std::string_view why) {
        Node const *const on = node_.find("on"), *const against = node_.find("against");
        if (on == nullptr) refuse_missing(node_, node_.name + ".on", why, fmt::format("add on = \"{}\", or another body", linkage_.bodies.front()));
        load_.body[0] = body_called(*on);
        if (load_.body[0] == LinkageBody::ground) refuse(*on, {"the ground stays where it is", "name a body"});
        if (against != nullptr) load_.body[1] = body_called(*against);
        if (load_.body[1] == load_.body[0]) refuse(*against, {"it acts between two bodies", "name another one"});
        return fmt::format("on = \"{}\"\nagainst = \"{}\"\n", on->text, against == nullptr ? ground_name : against->text);
    }
    int body_called(Node const& node) const {
        std::string const& name = read_text_value(node);
        if (name == ground_name) return LinkageBody::ground;
        auto const found = std::ranges::find(linkage_.bodies, name);
        std::vector<std::string_view> known(linkage_.bodies.begin(), linkage_.bodies.end());
        known.push_back(ground_name);
        if (found == linkage_.bodies.end()) refuse(node, {"there is no such body", choice_advice(name, known)});
        return static_cast<int>(found - linkage_.bodies.begin());
    }

    Reading const& reading_;
    Node const& node_;
    Load& load_;
    Linkage const& linkage_;
};

}  // namespace

std::string read_place_on_linkage(Reading const& reading, Node const& node, Load& load) { return LinkageLoadReader(reading, node, load).read(); }

}  // namespace slideway
