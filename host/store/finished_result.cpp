#include "host/store/finished_result.hpp"

#include <vector>

#include <fmt/format.h>

#include "host/base/durable_file.hpp"
#include "host/base/error.hpp"
#include "host/store/provenance.hpp"

namespace slideway {

std::string difference(ResultReader const& result, RunIdentity const& identity) {
    RunIdentity found;
    found.program = BuildInfo{result.attribute("version"), result.attribute("commit"), result.attribute("compiler")}.text();
    found.arithmetic = arithmetic_of(result.attribute("isa"));
    found.scene = portable_scene(result.attribute("scene"));
    if (result.stores_members()) {
        std::vector<std::uint64_t> members;
        for (double const member : result.values("member")) members.push_back(count_of(member));
        found.members = MemberSet::of(members);
    } else {
        found.members = MemberSet::parse(result.attribute("members")).value_or(MemberSet());
    }
    return identity.difference(found);
}

std::string why_not_finished(std::string const& path, RunIdentity const& identity) {
    try {
        if (!is_there(path)) return fmt::format("there is no {}", path);
        if (std::string const damage = check_result(path).damage(); !damage.empty()) return fmt::format("of {} {}", path, damage);
        ResultReader const result(path);
        if (std::string const other = difference(result, identity); !other.empty()) return fmt::format("{} is of another run ({})", path, other);
        std::string const completeness = result.attribute("completeness");
        return completeness == "complete" ? std::string() : fmt::format("{} is not complete ({})", path, completeness);
    } catch (FileError const& error) {
        return error.what();
    }
}

std::string words_on_need(ShardFolder const& folder, std::string const& result, bool names_scene) {
    std::string const why = why_not_finished(result, folder.identity());
    if (why.empty() && names_scene) return folder.path() + " is needed for the scene that the commands above read, and for nothing else";
    if (why.empty()) return folder.path() + " is no longer needed";
    return fmt::format("{} is still needed: {}", folder.path(), why);
}

}  // namespace slideway
