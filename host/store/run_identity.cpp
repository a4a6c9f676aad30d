#include "host/store/run_identity.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/base/bytes.hpp"
#include "host/base/error.hpp"
#include "host/store/shard_folder.hpp"

namespace slideway {
namespace {

constexpr std::string_view title_line =
    "# What the shards beside this file belong to; slideway run --resume continues it.";
constexpr std::string_view checksum_mark = "# checksum: ", program_mark = "# program: ", arithmetic_mark = "# arithmetic: ",
                           members_mark = "# members: ", table_mark = "# table: ";
constexpr std::string_view fused = "fused", contracted = "contracted";

/// Keys of a resolved scene with their values; a value of several lines is one.
std::map<std::string, std::string> scene_values(std::string const& scene) {
    std::map<std::string, std::string> values;
    std::istringstream lines(scene);
    std::string table, key;
    for (std::string line; std::getline(lines, line);) {
        if (auto const comment = line.find("  # "); comment != line.npos && line.find('"') == line.npos)
            line.resize(comment);
        if (line.empty() || line.starts_with("#")) continue;
        if (line.starts_with("[") && line.ends_with("]") && line.find(',') == line.npos) {
            table = line.substr(1, line.size() - 2) + ".";
        } else if (auto const equals = line.find(" = "); equals != line.npos && !line.starts_with(" ")) {
            key = table + line.substr(0, equals);
            values[key] = line.substr(equals + 3);
        } else {
            values[key] += line;
        }
    }
    return values;
}

/// Where a resolved scene has a key of [study], from the end of the line before on: offset, or npos.  @param key "\nverify = "
std::size_t place_in_study(std::string_view scene, std::string_view key) {
    auto const start = scene.find("\n[study]\n");
    if (start == scene.npos) return scene.npos;
    auto const at = scene.find(key, start);
    return scene.find("\n[", start + 1) < at ? scene.npos : at;
}

/// Where a resolved scene quotes the path of its table: offset and length, none without one.
struct Quoted {
    std::size_t at = 0, length = 0;
};
Quoted quoted_table(std::string_view scene) {
    constexpr std::string_view key = "\ntable = ", comment = "\"  # ";
    auto const at = place_in_study(scene, key);
    if (at == scene.npos) return {};
    std::size_t const first = at + key.size();
    std::string_view const line = scene.substr(first, scene.find('\n', first) - first);
    // From the end: a path may hold anything, the comment does not.
    auto const end = line.rfind(comment);
    if (end == line.npos) return {};
    return {first, end + 1};
}

/// What is left to compare of study.table: "3 rows, FNV-1a 0123456789abcdef".
std::string_view content_of_table(std::string_view value) {
    auto const comment = value.rfind("  # ");
    return comment == value.npos ? value : value.substr(comment + 4);
}

std::string named_arithmetic(std::string const& arithmetic) {
    return arithmetic == contracted ? arithmetic + " (a build with SLIDEWAY_CUDA_FMAD)" : arithmetic;
}

}  // namespace

std::string arithmetic_of(std::string_view isa) { return std::string(isa.ends_with("-fmad") ? contracted : fused); }

std::string RunIdentity::difference(RunIdentity const& earlier) const {
    if (program != earlier.program) return fmt::format("the program was {}, is {}", earlier.program, program);
    if (arithmetic != earlier.arithmetic) {
        return fmt::format("the arithmetic was {}, is {}", named_arithmetic(earlier.arithmetic),
                           named_arithmetic(arithmetic));
    }
    if (scene != earlier.scene) {
        auto const before = scene_values(earlier.scene), now = scene_values(scene);
        constexpr std::size_t longest = 60;
        auto const shown = [](std::string_view value) {
            return std::string(value.substr(0, longest)) + (value.size() <= longest ? "" : "...");
        };
        // What changed first: a law may bring many keys of its own.
        std::vector<std::string> found, brought;
        for (auto const& [key, value] : now) {
            auto const old = before.find(key);
            auto const words = [is_table = key == "study.table"](std::string_view text) { return is_table ? content_of_table(text) : text; };
            if (old == before.end())
                brought.push_back(fmt::format("{} = {} is new", key, shown(value)));
            else if (old->second != value)
                found.push_back(fmt::format("{} was {}, is {}", key, shown(words(old->second)), shown(words(value))));
        }
        found.insert(found.end(), brought.begin(), brought.end());
        for (auto const& [key, value] : before) {
            if (!now.contains(key)) found.push_back(fmt::format("{} = {} is gone", key, shown(value)));
        }
        constexpr std::size_t named = 3;
        if (found.empty()) return "the scene's text changed";
        std::string const more = found.size() > named ? fmt::format("; and {} more", found.size() - named) : "";
        return fmt::format("{}{}", fmt::join(std::span(found).first(std::min(named, found.size())), "; "), more);
    }
    if (!(members == earlier.members)) {
        return fmt::format("the members were {}, are {}", earlier.members.text(), members.text());
    }
    return "";
}

std::string table_of(std::string const& scene) {
    Quoted const table = quoted_table(scene);
    return scene.substr(table.at, table.length);
}

std::string with_table(std::string const& scene, std::string_view quoted) {
    Quoted const table = quoted_table(scene);
    if (table.length == 0) return scene;
    return fmt::format("{}{}{}", scene.substr(0, table.at), quoted, scene.substr(table.at + table.length));
}

std::string portable_scene(std::string const& scene) {
    std::string text = with_table(scene, fmt::format("\"{}\"", shard_names::table));
    constexpr std::string_view checked = "\nverify = ";
    // Once in a scene; a text that was edited may have it more often, or in other tables.
    for (auto at = place_in_study(text, checked); at != text.npos; at = place_in_study(text, checked)) text.erase(at, text.find('\n', at + 1) - at);
    return text;
}

std::string identity_text(RunIdentity const& identity) {
    std::string const table =
        identity.table.empty() ? std::string() : fmt::format("{}{}\n", table_mark, identity.table);
    std::string const rest = fmt::format("{}{}\n{}{}\n{}{}\n{}\n{}", program_mark, identity.program, arithmetic_mark,
                                         identity.arithmetic, members_mark, identity.members.text(), table, identity.scene);
    return fmt::format("{}\n{}{:016x}\n{}", title_line, checksum_mark, fnv1a(rest), rest);
}

RunIdentity parse_identity(std::string const& text, std::string const& path) {
    RunIdentity identity;
    std::string_view rest = text;
    auto const next_line = [&rest] {
        auto const end = std::min(rest.find('\n'), rest.size());
        std::string_view const line = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        return line;
    };
    auto const require = [&](bool is_ours) {
        if (!is_ours) {
            throw FileError(
                fmt::format("{}: is not what slideway run writes; the folder belongs to something else", path));
        }
    };
    auto const marked = [&](std::string_view line, std::string_view mark) {
        require(line.starts_with(mark));
        return std::string(line.substr(mark.size()));
    };
    require(next_line() == title_line);
    // Second, so that no single change makes a text without one of a text with it: those of before had none.
    if (rest.starts_with(checksum_mark)) {
        std::string const checksum = marked(next_line(), checksum_mark);
        if (checksum != fmt::format("{:016x}", fnv1a(rest))) throw FileError(fmt::format("{}: is damaged (its checksum differs)", path));
    }
    identity.program = marked(next_line(), program_mark);
    identity.arithmetic = marked(next_line(), arithmetic_mark);
    require(identity.arithmetic == fused || identity.arithmetic == contracted);
    auto const members = MemberSet::parse(marked(next_line(), members_mark));
    std::string_view line = next_line();
    if (line.starts_with(table_mark)) {
        identity.table = marked(line, table_mark);
        line = next_line();
    }
    require(line.empty());
    if (!members) throw FileError(fmt::format("{}: its line of members is damaged", path));
    identity.members = *members;
    identity.scene = std::string(rest);
    return identity;
}

}  // namespace slideway
