// Linkages: mechanisms that a scene describes, body by body and joint by joint (docs/explanation/linkages.md).  To the rest of the host each is a mechanism
// as those of the tree are; its keys are the scene's own.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/base/error.hpp"
#include "kernels/key.hpp"
#include "kernels/linkage/linkage_plan.hpp"
#include "kernels/mechanisms/mechanism_info.hpp"
#include "kernels/members/start.hpp"

namespace slideway {

struct Node;
struct Reading;
struct Scene;
struct Setting;
struct Defect;

/// mechanism.kind of all of them.
inline constexpr std::string_view linkage_kind = "linkage";
/// That of a scene whose bodies are not read yet; linkages that are have the numbers behind it, those of the tree and of modules smaller ones.
inline constexpr auto any_linkage = static_cast<Mechanism>(1 << 20);
constexpr bool is_linkage(Mechanism mechanism) { return mechanism >= any_linkage; }

inline constexpr std::string_view body_table = "body", link_table = "link", ground_name = "ground";
inline constexpr std::string_view link_kinds[] = {"revolute", "prismatic", "journal", "block"};
enum class LinkKind { revolute, prismatic, journal, block };

/// A number that a body or a link may have: body.<name>.mass …
struct PartNumber {
    std::string_view table, name, unit, meaning;
    Rule rule = Rule::any;
    unsigned kinds = 0;  // of links that have it, bit i of LinkKind i
};
std::span<PartNumber const> part_numbers();
/// Rows of the table of keys for them, and for what else these tables say.
std::vector<Setting> linkage_settings();

/// What scenes with the same bodies and links have in common, numbers apart.  Made once, and kept.
struct Linkage {
    /// Of the resolved scene: "body.crank", what it says beside numbers, and these.
    struct Row {
        std::string name, words;
        std::vector<std::size_t> keys;
    };

    MechanismInfo info{};
    LinkagePlan plan;
    std::string driven;  // body that the drive turns; "" of none
    std::vector<std::string> bodies, closures;  // in the plan's order: crank, link.A
    std::vector<Row> rows;
    std::deque<std::string> texts;  // that infos and keys point to
    std::vector<SeriesInfo> series;
    std::vector<QuantityInfo> quantities;  // work of its loads
    std::deque<Key> keys;

    Key const* find_key(std::string_view name) const;
    /// The same linkage has the same.
    std::string identity() const;
};

/// nullptr of what is none, and of `any_linkage`.
Linkage const* linkage_of(Mechanism mechanism);
/// @return its number, that of the same one where there is one.  @throws SceneError if there are thousands
Mechanism known_linkage(std::unique_ptr<Linkage> linkage);
/// Of the placeholder, and of those that are known.
MechanismInfo const& linkage_info(Mechanism mechanism);

/// Whether a key of the tables counts for linkages.
bool counts_for_linkages(Key const& key, bool driven);
/// What numbers of a member's bodies and links ask of one another; it also has to go together at the start.
std::optional<Defect> defect_of_linkage(Inputs const& in, Linkage const& linkage);

/// A scene whose linkage does not go together, and how far it does.
struct OpenLinkage : SceneError {
    OpenLinkage(std::string_view line, std::shared_ptr<Scene const> of, StateNumbers const& as_far, std::string worst)
        : SceneError(line), scene(std::move(of)), state(as_far), joint(std::move(worst)) {}

    std::shared_ptr<Scene const> scene;  // read as far as its physics
    StateNumbers state;
    std::string joint;  // link.wrist, the worst one
};
/// @throws OpenLinkage with this line, if so
void refuse_open(Scene const& scene, std::string const& line);
/// Which bodies or joint a load, spring or stop of a linkage is on.  @return what the resolved scene says of that
std::string read_place_on_linkage(Reading const& reading, Node const& node, Load& load);

/// [body.<name>] and [link.<name>]: the scene's mechanism, Parts::linkage, and the keys of their numbers; needs the drive.
void read_linkage(Reading& reading);

}  // namespace slideway
