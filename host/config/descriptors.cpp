// Compiled under a name of its own (CMakeLists.txt here): it shares no code with the kernels.
#include "host/config/descriptors.hpp"

#include <iterator>

#include "kernels/all_laws.hpp"
#include "kernels/all_mechanisms.hpp"
#include "kernels/members/start.hpp"

namespace slideway {
namespace {

constexpr LawInfo law_infos[] = {
#define SLIDEWAY_INFO(name, Type) Type::info,
    SLIDEWAY_LAWS(SLIDEWAY_INFO)
#undef SLIDEWAY_INFO
};

constexpr MechanismInfo mechanism_infos[] = {
#define SLIDEWAY_INFO(name, Type, Base) Type::info,
    SLIDEWAY_MECHANISMS(SLIDEWAY_INFO)
#undef SLIDEWAY_INFO
};

// Names stand twice, in the lists and in the headers.
#define SLIDEWAY_CHECK(row, Type)                                                                  \
    static_assert(Type::info.name == #row, "the info of law " #row " bears another name"); \
    static_assert(Type::info.keys.size() <= 4, "law " #row " has more than four numbers of its own");
SLIDEWAY_LAWS(SLIDEWAY_CHECK)
#undef SLIDEWAY_CHECK
#define SLIDEWAY_CHECK(row, Type, Base)                                                                             \
    static_assert(std::string_view(Type::info.name) == #row, "the info of mechanism " #row " bears another name"); \
    static_assert(Type::info.states == Type::size && Type::size <= most_states,                                     \
                  "the state of mechanism " #row " has another size");                                                \
    static_assert(has_start_inputs(Type::info),                                                                     \
                  "a component of the state of mechanism " #row " starts from no input: it lacks a row in start_inputs (kernels/members/start.hpp)");
SLIDEWAY_MECHANISMS(SLIDEWAY_CHECK)
#undef SLIDEWAY_CHECK

}  // namespace

std::span<MechanismInfo const> mechanisms() { return mechanism_infos; }
std::span<LawInfo const> laws() { return law_infos; }

std::span<std::string_view const> mechanism_names() {
#define SLIDEWAY_NAME(name, Type, Base) #name,
    static constexpr std::string_view names[] = {SLIDEWAY_MECHANISMS(SLIDEWAY_NAME)};
#undef SLIDEWAY_NAME
    return names;
}
std::span<std::string_view const> law_names() {
#define SLIDEWAY_NAME(name, Type) #name,
    static constexpr std::string_view names[] = {SLIDEWAY_LAWS(SLIDEWAY_NAME)};
#undef SLIDEWAY_NAME
    return names;
}

MechanismInfo const& info(Mechanism mechanism) { return mechanism_infos[static_cast<int>(mechanism)]; }
LawInfo const& info(Law law) { return law_infos[static_cast<int>(law)]; }
LawInfo const& contact_info(Parts const& parts) { return parts.rigid ? rigid_contact : info(parts.law); }

std::span<std::string_view const> contact_law_names() {
#define SLIDEWAY_NAME(name, Type) #name,
    static constexpr std::string_view names[] = {SLIDEWAY_LAWS(SLIDEWAY_NAME) rigid_contact.name};
#undef SLIDEWAY_NAME
    return names;
}

bool has_contact_law(Mechanism mechanism) { return info(mechanism).spatial || may_be_rigid(mechanism); }

bool makes_energy(Parts const& parts) { return info(parts.mechanism).spatial && contact_info(parts).switches; }

bool is_prescribed(Parts const& parts, int component) {
    return !parts.free_crank && (info(parts.mechanism).prescribed >> component & 1u) != 0;
}

int free_states(Parts const& parts) {
    int count = 0;
    for (int i = 0; i < info(parts.mechanism).states; ++i) count += is_prescribed(parts, i) ? 0 : 1;
    return count;
}

std::vector<std::string> labels_of(std::string_view dimension) {
    if (dimension == "apex") return {"P1", "P2", "P3", "P4", "P5", "P6", "P7", "P8"};
    if (dimension == "mode_class") return {std::begin(mode_class_names), std::end(mode_class_names)};
    if (dimension == "axis") return {"roll", "yaw", "pitch"};
    if (dimension == "direction") return {"x", "y", "z"};
    if (dimension == "channel") return {"top", "front"};
    return {};
}

}  // namespace slideway
