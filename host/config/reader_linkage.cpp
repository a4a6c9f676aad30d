// [body.<name>] and [link.<name>]: the bodies of a linkage, and the joints between them.
#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/backend/own_modules.hpp"
#include "host/config/descriptors.hpp"
#include "host/config/linkages.hpp"
#include "host/config/loads.hpp"
#include "host/config/outputs.hpp"
#include "host/config/reader.hpp"

namespace slideway {
namespace {

constexpr int ground = LinkageBody::ground, none = LinkageBody::none;
constexpr LoadKind kinds_of_loads[] = {LoadKind::push, LoadKind::spring, LoadKind::stop};

struct GivenBody {
    Node const* node;
    std::map<std::string_view, int> numbers;  // places among Inputs::linkage_0 …
    bool is_held = false;                     // some joint is its own
    int place = none;                         // in the plan

    int at(std::string_view name) const { return numbers.contains(name) ? numbers.at(name) : none; }
};
struct GivenLink {
    Node const* node;
    LinkKind kind;
    int body[2];  // among the given bodies, or the ground
    std::map<std::string_view, int> numbers;
    bool is_used = false;

    int at(std::string_view name) const { return numbers.contains(name) ? numbers.at(name) : none; }
    int other(int of) const { return body[0] == of ? body[1] : body[0]; }
};

class LinkageReader {
public:
    explicit LinkageReader(Reading& reading) : reading_(reading), linkage_(std::make_unique<Linkage>()) {}

    void read() {
        read_bodies();
        read_links();
        read_drive();
        plant();
        name_states();
        Scene& scene = reading_.scene;
        if (!linkage_->plan.has_clearance()) {
            for (std::string_view const idle : {"friction", "contact"}) {
                if (Node const* const node = reading_.given(idle)) reading_.warn(fmt::format("{}: [{}] has no effect, for no joint has clearance", node->where, idle));
            }
        }
        Mechanism const mechanism = known_linkage(std::move(linkage_));
        scene.parts.mechanism = mechanism;
        scene.parts.linkage = &linkage_of(mechanism)->plan;
        scene.inputs.mechanism_a = follows;
    }

private:
    /// The tables below one: [body.crank], [body.rod] …
    std::span<Node const> tables(std::string_view name, std::string_view noun) const {
        Node const* const table = reading_.given(name);
        if (table == nullptr || !table->is_table() || table->children.empty())
            refuse_missing(*reading_.given("mechanism.kind"), fmt::format("{}.<name>", name), fmt::format("a linkage is made of {}", noun),
                           fmt::format("add [{}.crank]", name));
        for (Node const& node : table->children) {
            if (!node.is_table()) refuse(node, {fmt::format("a {} is a table", name), fmt::format("write [{}] and its keys below", node.name)});
            if (!is_module_name(node.key) || node.key == ground_name)
                refuse_that(node, fmt::format("is no name of a {}", name), {"names have at most 60 small letters, digits and '_', a letter first", "rename it"});
        }
        return table->children;
    }

    char const* keep(std::string text) { return linkage_->texts.emplace_back(std::move(text)).c_str(); }

    /// Makes the keys of a table's numbers.  @param words what it says beside them, of the resolved scene
    std::map<std::string_view, int> read_numbers(Node const& node, std::string_view table, unsigned kinds, std::span<std::string_view const> others, std::string words) {
        std::map<std::string_view, int> places;
        Linkage::Row row{node.name, std::move(words), {}};
        for (Node const& child : node.children) {
            auto const found = std::ranges::find_if(part_numbers(), [&](PartNumber const& one) { return one.table == table && one.name == child.key; });
            if (found == part_numbers().end()) {
                if (std::ranges::find(others, child.key) != others.end()) continue;
                std::vector<std::string_view> known(others.begin(), others.end());
                for (PartNumber const& one : part_numbers()) {
                    if (one.table == table) known.push_back(one.name);
                }
                refuse_that(child, fmt::format("is no key of a {}", table), {"mistyped, it would have no effect", choice_advice(child.key, known)});
            }
            if (table == link_table && (found->kinds & kinds) == 0) refuse(child, {"a joint of this kind does not have it", "remove it"});
            if (linkage_->keys.size() == most_linkage_numbers)
                refuse(child, {fmt::format("the bodies and links of a scene have {} numbers at most together", most_linkage_numbers), "leave out those that are 0"});
            auto const place = static_cast<int>(linkage_->keys.size());
            row.keys.push_back(linkage_->keys.size());
            linkage_->keys.push_back({keep(child.name), linkage_inputs[place], found->unit, found->rule, KeyGroup::load, found->meaning, 0});
            places[found->name] = place;
        }
        linkage_->rows.push_back(std::move(row));
        return places;
    }

    void require(Node const& node, std::map<std::string_view, int> const& numbers, std::string_view name, std::string_view why, std::string_view advice) const {
        if (!numbers.contains(name)) refuse_missing(node, fmt::format("{}.{}", node.name, name), why, advice);
    }

    void read_bodies() {
        for (Node const& node : tables(body_table, "bodies")) {
            if (bodies_.size() == LinkagePlan::most_bodies) refuse_that(node, "is one body too many", {fmt::format("there are {} at most", LinkagePlan::most_bodies), "use fewer"});
            bodies_.push_back({&node, read_numbers(node, body_table, 0, {}, {})});
            require(node, bodies_.back().numbers, "mass", "every body has one", "add mass = \"0.2 kg\"");
        }
    }

    int body_of(Node const& link, std::string_view side) const {
        Node const* const given = link.find(side);
        if (given == nullptr) refuse_missing(link, fmt::format("{}.{}", link.name, side), "which body the joint is on", fmt::format("add {} = \"ground\", or a body", side));
        std::string const& name = read_text_value(*given);
        if (name == ground_name) return ground;
        std::vector<std::string_view> known{ground_name};
        for (GivenBody const& body : bodies_) known.push_back(body.node->key);
        auto const found = std::ranges::find(known, name);
        if (found == known.end()) refuse(*given, {"there is no such body", choice_advice(name, known)});
        return static_cast<int>(found - known.begin()) - 1;
    }

    void read_links() {
        static constexpr std::string_view others[] = {"kind", "first", "second"};
        for (Node const& node : tables(link_table, "joints")) {
            Node const* const kind = node.find("kind");
            if (kind == nullptr) refuse_missing(node, node.name + ".kind", "which joint it is", fmt::format("add kind = \"{}\"", fmt::join(link_kinds, "\", or \"")));
            GivenLink link{&node, static_cast<LinkKind>(read_choice(*kind, "kind of joint", link_kinds)), {body_of(node, "first"), body_of(node, "second")}, {}};
            if (link.body[0] == link.body[1]) refuse(*node.find("second"), {"a joint is between two bodies", "name another one"});
            std::string const words = fmt::format("kind = \"{}\"\nfirst = \"{}\"\nsecond = \"{}\"\n", link_kinds[static_cast<int>(link.kind)],
                                                  node.find("first")->text, node.find("second")->text);
            link.numbers = read_numbers(node, link_table, 1u << static_cast<int>(link.kind), others, words);
            bool const is_block = link.kind == LinkKind::block;
            if (is_block || link.kind == LinkKind::journal) require(node, link.numbers, "clearance", "how much play it has", "add clearance = \"0.1 mm\"");
            if (link.kind == LinkKind::journal) require(node, link.numbers, "radius", "where its contact is", "add radius = \"10 mm\"");
            if (is_block) {
                require(node, link.numbers, "length", "where its corners are", "add length = \"40 mm\"");
                require(node, link.numbers, "height", "where its corners are", "add height = \"20 mm\"");
                require(node, link.numbers, "stiffness", "how far its corners give way", "add stiffness = 1e10");
            }
            for (int const body : link.body) {
                if (body != ground) bodies_[static_cast<std::size_t>(body)].is_held = true;
            }
            links_.push_back(std::move(link));
        }
        for (GivenBody const& body : bodies_) {
            if (!body.is_held) refuse_that(*body.node, "is held by no link", {"it would fall by itself", fmt::format("add a [link.<name>] with first or second = \"{}\"", body.node->key)});
        }
    }

    void read_drive() {
        Node const* const given = reading_.given("drive.body");
        if (given == nullptr) {
            if (Node const* const drive = reading_.given_of({"drive", "mechanism.crank_speed", "mechanism.start_angle"}))
                refuse_missing(*drive, "drive.body", "which body the drive turns", fmt::format("add body = \"{}\" to [drive]", bodies_.front().node->key));
            return;
        }
        std::string const& name = read_text_value(*given);
        auto const found = std::ranges::find_if(bodies_, [&](GivenBody const& body) { return body.node->key == name; });
        if (found == bodies_.end()) refuse(*given, {"there is no such body", "name one of [body.<name>]"});
        driven_ = static_cast<int>(found - bodies_.begin());
        linkage_->driven = name;
        for (std::string_view const idle : {"angle", "speed"}) {
            if (Node const* const node = found->node->find(idle))
                refuse(*node, {"the drive turns this body", fmt::format("use mechanism.{}", idle == "angle" ? "start_angle" : "crank_speed")});
        }
        bool const on_ground = std::ranges::any_of(links_, [&](GivenLink const& link) { return may_carry(link, driven_, ground); });
        if (!on_ground) refuse(*given, {"a drive turns a body on the ground", "name one that a revolute link holds there"});
    }

    /// Whether a joint without clearance leads from what stands to a body, as a pin.
    bool may_carry(GivenLink const& link, int body, int below) const {
        return !link.is_used && link.kind == LinkKind::revolute && ((link.body[0] == body && link.body[1] == below) || (link.body[1] == body && link.body[0] == below));
    }

    bool stands(int body) const { return body == ground || bodies_[static_cast<std::size_t>(body)].place != none; }

    /// Grows the tree from the ground: the driven body first, prismatic joints before revolute ones, for loops are closed by these; then what floats.
    void plant() {
        LinkagePlan& plan = linkage_->plan;
        plan.is_driven = driven_ != none;
        if (plan.is_driven) {
            for (GivenLink& link : links_) {
                if (!stands(driven_) && may_carry(link, driven_, ground)) hang(link, driven_);
            }
        }
        while (hang_next(LinkKind::prismatic) || hang_next(LinkKind::revolute) || float_next()) {}
        for (GivenLink const& link : links_) {
            if (link.is_used) continue;
            if (link.kind == LinkKind::prismatic)
                refuse_that(*link.node, "closes a loop", {"loops are closed by pins, and lines are on the nearer body to the ground", "swap first and second, or make another joint the slide"});
            close(link);
        }
        count_pairs();
        find_points();
        warn_of_islands();
        if (plan.loops() > LinkagePlan::most_loops)
            refuse_that(*links_.front().node, "is one of too many joints", {fmt::format("a linkage has {} loops of ideal joints at most", LinkagePlan::most_loops), "give some of them clearance"});
    }

    /// Of bodies that no chain of joints leads to the ground from.
    void warn_of_islands() {
        std::set<int> held{ground};
        for (std::size_t round = 0; round < bodies_.size(); ++round) {
            for (GivenLink const& link : links_) {
                if (held.contains(link.body[0]) || held.contains(link.body[1])) held.insert({link.body[0], link.body[1]});
            }
        }
        std::vector<std::string_view> loose;
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            if (!held.contains(static_cast<int>(i))) loose.push_back(bodies_[i].node->name);
        }
        if (!loose.empty()) reading_.warn(fmt::format("{}: no joint leads from {} to the ground, so that they fall freely", reading_.scene.path, fmt::join(loose, ", ")));
    }

    bool hang_next(LinkKind kind) {
        for (GivenLink& link : links_) {
            if (link.is_used || link.kind != kind) continue;
            for (int side = 0; side < 2; ++side) {
                int const body = link.body[side];
                bool const may = !stands(body) && stands(link.body[1 - side]) && (kind == LinkKind::revolute || side == 1);
                if (may) return hang(link, body), true;
            }
        }
        return false;
    }

    bool float_next() {
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            if (stands(static_cast<int>(i))) continue;
            GivenBody& body = bodies_[i];
            LinkageBody& of = add(body, ground, TreeJoint::floating);
            of.angle = body.at("angle"), of.speed = body.at("speed");
            require(*body.node, body.numbers, "inertia", "the body turns", "add inertia = \"1e-4 kg m2\"");
            return true;
        }
        return false;
    }

    LinkageBody& add(GivenBody& body, int below, TreeJoint joint) {
        LinkagePlan& plan = linkage_->plan;
        int const coordinates = joint == TreeJoint::floating ? 3 : 1;
        if (plan.coordinates + coordinates > LinkagePlan::most_coordinates)
            refuse_that(*body.node, "has one coordinate too many", {fmt::format("a linkage has {} at most, a body that floats between journals 3", LinkagePlan::most_coordinates), "use fewer bodies"});
        LinkageBody& of = plan.body[plan.bodies];
        of.parent = below == ground ? ground : bodies_[static_cast<std::size_t>(below)].place;
        of.joint = joint;
        of.coordinate = plan.coordinates;
        of.mass = body.at("mass"), of.inertia = body.at("inertia");
        of.center[0] = body.at("center_x"), of.center[1] = body.at("center_y");
        int above = -1;
        if (of.parent != ground) {
            LinkageBody const& parent = plan.body[of.parent];
            above = parent.coordinate + (parent.joint == TreeJoint::floating ? 2 : 0);
        }
        for (int i = 0; i < coordinates; ++i) {
            plan.above[plan.coordinates] = above;
            plan.owner[plan.coordinates] = plan.bodies;
            above = plan.coordinates++;
        }
        body.place = plan.bodies++;
        linkage_->bodies.push_back(body.node->key);
        return of;
    }

    void hang(GivenLink& link, int body) {
        link.is_used = true;
        GivenBody& given = bodies_[static_cast<std::size_t>(body)];
        bool const slides = link.kind == LinkKind::prismatic;
        LinkageBody& of = add(given, link.other(body), slides ? TreeJoint::prismatic : TreeJoint::revolute);
        bool const is_second = link.body[1] == body;
        for (int axis = 0; axis < 2; ++axis) {
            int const first = link.at(axis == 0 ? "first_x" : "first_y"), second = link.at(axis == 0 ? "second_x" : "second_y");
            of.on_parent[axis] = is_second ? first : second;
            of.own[axis] = is_second ? second : first;
        }
        if (slides) {
            of.direction = link.at("direction"), of.turn = link.at("turn");
            of.angle = link.at("position"), of.speed = link.at("speed");
            for (std::string_view const idle : {"angle", "speed"}) {
                if (Node const* const node = given.node->find(idle)) refuse(*node, {"a prismatic joint holds its angle", fmt::format("use {}.turn", link.node->name)});
            }
            return;
        }
        require(*given.node, given.numbers, "inertia", "the body turns", "add inertia = \"1e-4 kg m2\"");
        of.angle = given.at("angle"), of.speed = given.at("speed");
    }

    void close(GivenLink const& link) {
        LinkagePlan& plan = linkage_->plan;
        if (plan.closures == LinkagePlan::most_closures)
            refuse_that(*link.node, "is one joint too many", {fmt::format("a linkage has {} journals and loops at most together", LinkagePlan::most_closures), "use fewer"});
        LinkageClosure& of = plan.closure[plan.closures++];
        for (int side = 0; side < 2; ++side) {
            of.body[side] = link.body[side] == ground ? ground : bodies_[static_cast<std::size_t>(link.body[side])].place;
            of.point[side][0] = link.at(side == 0 ? "first_x" : "second_x");
            of.point[side][1] = link.at(side == 0 ? "first_y" : "second_y");
        }
        bool const is_block = link.kind == LinkKind::block;
        of.kind = is_block ? ClosureKind::block : link.kind == LinkKind::journal ? ClosureKind::journal : ClosureKind::pin;
        of.clearance = link.at("clearance"), of.radius = link.at("radius"), of.stiffness = link.at("stiffness");
        of.length = link.at("length"), of.height = link.at("height"), of.direction = link.at("direction");
        of.offset[0] = link.at(is_block ? "offset_y" : "offset_x"), of.offset[1] = link.at(is_block ? "tilt" : "offset_y");
        linkage_->closures.push_back(link.node->name);
    }

    /// Bodies whose mass centre and joints lie in one point.  Loads may be anywhere.
    void find_points() {
        LinkagePlan& plan = linkage_->plan;
        for (int i = 0; i < plan.bodies; ++i) {
            LinkageBody& of = plan.body[i];
            of.arm = arm_of(of.parent, of.on_parent);
            of.moment = arm_of(i, of.center);
        }
        for (int i = 0; i < plan.bodies; ++i) {
            LinkageBody const& of = plan.body[i];
            if (of.joint == TreeJoint::revolute && of.parent != ground) plan.body[of.parent].moment = std::max(plan.body[of.parent].moment, of.arm);
        }
        for (int i = 0; i < plan.bodies; ++i) {
            LinkageBody& of = plan.body[i];
            of.is_point = of.joint == TreeJoint::revolute && of.moment == Arm::none;
            for (int k = 0; k < plan.bodies; ++k) {
                if (plan.body[k].parent == i && plan.body[k].joint != TreeJoint::revolute) of.is_point = 0;
            }
        }
        for (int k = 0; k < plan.closures; ++k) {
            LinkageClosure& closure = plan.closure[k];
            for (int side = 0; side < 2; ++side) {
                int const body = closure.body[side];
                bool const is_walls = closure.kind == ClosureKind::block && side == 1;
                closure.arm[side] = arm_of(body, closure.point[side]);
                if (body != ground && (is_walls || closure.arm[side] != Arm::none)) plan.body[body].is_point = 0;
            }
            closure.is_level = closure.body[1] == ground && closure.direction == none;
        }
        for (LoadKind const kind : kinds_of_loads) {
            Node const* const table = reading_.given(table_of(kind));
            for (int i = 0; table != nullptr && !table->children.empty() && i < plan.bodies; ++i) plan.body[i].is_point = 0;
        }
    }

    /// Of a point from a body's origin: its joint's point, its mass centre where it floats.
    Arm arm_of(int body, int const (&at)[2]) const {
        constexpr int origin[2] = {none, none};
        LinkageBody const* const of = body == ground ? nullptr : &linkage_->plan.body[body];
        auto const& from = of == nullptr ? origin : of->joint == TreeJoint::floating ? of->center : of->own;
        if (at[0] == none && at[1] == none && from[0] == none && from[1] == none) return Arm::none;
        bool const turns = of != nullptr && of->joint == TreeJoint::prismatic;  // its axes are those of another body
        return at[1] == none && from[1] == none && !turns ? Arm::along_x : Arm::any;
    }

    /// A block has a quad of pairs to itself; journals share what is left.
    void count_pairs() {
        LinkagePlan& plan = linkage_->plan;
        int blocks = 0, journals = 0;
        for (int k = 0; k < plan.closures; ++k) {
            LinkageClosure& of = plan.closure[k];
            if (of.kind == ClosureKind::block) of.pair = LinkagePlan::most_pairs - 4 * ++blocks;
            if (of.kind == ClosureKind::journal) of.pair = journals++;
            int const pairs = journals + 4 * blocks;
            if (pairs > LinkagePlan::most_pairs)
                refuse_that(*reading_.given(linkage_->closures[static_cast<std::size_t>(k)]), "is one joint with clearance too many",
                            {fmt::format("with it journals touch in {} places and blocks, with four corners each, in {}: {} together, of {} that there may be", journals,
                                         4 * blocks, pairs, LinkagePlan::most_pairs), "make some of them ideal"});
        }
    }

    void name_states() {
        Linkage& linkage = *linkage_;
        LinkagePlan const& plan = linkage.plan;
        // Columns as kernels/linkage/linkage_report.hpp has them.
        linkage.series.assign(LinkagePlan::most_states + 2 + 3 * LinkagePlan::most_closures + 2 * LinkagePlan::most_loads, {"", "1", ""});
        MechanismInfo& info = linkage.info;
        std::set<std::string_view> names;
        auto const put = [&](std::size_t at, std::string const& name, char const* unit, std::string const& meaning, Node const& node) {
            linkage.series[at] = {keep(name), unit, keep(meaning)};
            info.series |= Selection{1} << at;
            bool const is_quantity = std::ranges::any_of(quantity_table, [&](QuantityInfo const& one) { return name == one.name; });
            if (is_quantity) refuse_that(node, "has the column of a quantity", {fmt::format("results have a {} already", name), "rename it"});
            if (!names.insert(linkage.series[at].name).second) refuse_that(node, "shares a column with another", {fmt::format("results would have two {}", name), "rename it"});
        };
        for (std::string const& closure : linkage.closures) {
            for (Quantity const of : {Quantity::peak_apex_force, Quantity::mean_apex_force}) names.insert(keep(name_of_joint_quantity(of, closure.substr(closure.find('.') + 1))));
        }
        for (GivenBody const& body : bodies_) {
            LinkageBody const& of = plan.body[body.place];
            auto const name = [&](int coordinate, std::string_view place, char const* unit, std::string_view rate, char const* rate_unit) {
                auto const at = static_cast<std::size_t>(2 * coordinate);
                put(at, fmt::format("{}_{}", body.node->key, place), unit, fmt::format("{} of {}", place, body.node->key), *body.node);
                put(at + 1, fmt::format("{}_{}", body.node->key, rate), rate_unit, fmt::format("rate of that of {}", body.node->key), *body.node);
            };
            int const c = of.coordinate;
            if (of.joint == TreeJoint::prismatic) name(c, "displacement", "m", "velocity", "m s-1");
            if (of.joint == TreeJoint::floating) name(c, "x", "m", "vx", "m s-1"), name(c + 1, "y", "m", "vy", "m s-1");
            if (of.joint != TreeJoint::prismatic) name(of.joint == TreeJoint::floating ? c + 2 : c, "angle", "rad", "angular_velocity", "rad s-1");
        }
        for (int i = 0; i < plan.states(); ++i) info.state[i] = static_cast<Series>(i);
        info.always = info.series;
        std::size_t at = LinkagePlan::most_states;
        Node const& root = *reading_.given("mechanism.kind");
        if (plan.is_driven) put(at, "drive_torque", "N m", "torque of the drive", root);
        put(at + 1, "normal_force", "N", "sum of the normal forces in joints with clearance", root);
        at += 2;
        for (GivenLink const& link : links_) {
            auto const found = std::ranges::find(linkage.closures, link.node->name);
            if (found == linkage.closures.end() || link.kind == LinkKind::revolute) continue;
            std::size_t const first = at + 3 * static_cast<std::size_t>(found - linkage.closures.begin());
            if (link.kind == LinkKind::block) {
                put(first, fmt::format("{}_y", link.node->key), "m", fmt::format("place of the block of {} across its walls", link.node->key), *link.node);
                put(first + 1, fmt::format("{}_tilt", link.node->key), "rad", fmt::format("angle of the block of {} against its walls", link.node->key), *link.node);
            }
            for (int axis = 0; axis < 2 && link.kind == LinkKind::journal; ++axis)
                put(first + static_cast<std::size_t>(axis), fmt::format("{}_{}", link.node->key, axis == 0 ? "x" : "y"), "m",
                    fmt::format("journal of {} in its bearing, along the ground's {}", link.node->key, axis == 0 ? "X" : "Y"), *link.node);
            put(first + 2, fmt::format("{}_force", link.node->key), "N", fmt::format("normal force in {}", link.node->key), *link.node);
        }
        name_loads(LinkagePlan::most_states + 2 + 3 * LinkagePlan::most_closures, put);
        MechanismInfo const& any = info_of_any();
        info.name = any.name;
        info.meaning = any.meaning;
        info.states = plan.states();
        info.own_series = linkage.series;
        using enum Quantity;
        info.quantities = selections::of({peak_normal_force, mean_normal_force, mode_time, contact_onsets, energy_residual, energy_change, drive_work, friction_loss,
                                          damping_loss, load_work, spring_loss});
        if (plan.is_driven) info.quantities |= selections::of({peak_crank_torque, rms_crank_torque});
        info.own_quantities = linkage.quantities;
        info.drive = plan.is_driven ? DriveKind::crank : DriveKind::none;
        info.spatial = false;
        info.prescribed = plan.is_driven ? 0b11u : 0u;
        info.may_turn_freely = plan.is_driven;
        info.has_exponents = plan.loops() == 0;
    }
    /// Columns and quantities of loads, springs and stops, in the order in which read_loads has them.
    template <class Put> void name_loads(std::size_t at, Put const& put) {
        for (LoadKind const kind : kinds_of_loads) {
            Node const* const table = reading_.given(table_of(kind));
            for (std::size_t i = 0; table != nullptr && i < table->children.size() && linkage_->quantities.size() < LinkagePlan::most_loads; ++i, at += 2) {
                Node const& node = table->children[i];
                std::string const &name = node.key, of = fmt::format("of {}", node.name);
                bool const turns = std::ranges::any_of(node.children, [](Node const& child) { return child.key.starts_with("ang"); });
                if (kind == LoadKind::push) {
                    put(at + 1, name + "_power", "W", "power " + of, node);
                } else {
                    put(at, name + (turns ? "_torque" : "_force"), turns ? "N m" : "N",
                        (turns ? "torque " : kind == LoadKind::spring ? "tension " : "force ") + of, node);
                    put(at + 1, name + "_energy", "J", "potential " + of, node);
                }
                linkage_->quantities.push_back({keep(name + "_work"), Statistic::integral, Keeper::mechanism, "J", 1, nullptr,
                                               keep(fmt::format("work {} on the bodies", of))});
            }
        }
    }
    static MechanismInfo const& info_of_any() { return linkage_info(any_linkage); }

    Reading& reading_;
    std::unique_ptr<Linkage> linkage_;
    std::vector<GivenBody> bodies_;
    std::vector<GivenLink> links_;
    int driven_ = none;
};

}  // namespace

void read_linkage(Reading& reading) {
    bool const asked = is_linkage(reading.scene.parts.mechanism);
    for (std::string_view const table : {body_table, link_table}) {
        if (Node const* const node = reading.given(table); node != nullptr && !asked)
            throw SceneError(fmt::format("{}: [{}] is of kind = \"{}\"; set mechanism.kind to that, or remove it", node->where, table, linkage_kind));
    }
    if (Node const* const body = reading.given("drive.body"); body != nullptr && !asked) refuse_meaningless(body->where, "drive.body", reading.scene.parts.mechanism);
    if (!asked) return;
    static constexpr std::string_view other[] = {"ground_motion", "film", "way_profile", "way_ends"};
    for (std::string_view const table : other) {
        if (Node const* const node = reading.given(table)) throw SceneError(fmt::format("{}: [{}] does not act on linkages yet; remove it", node->where, table));
    }
    LinkageReader(reading).read();
}

}  // namespace slideway
