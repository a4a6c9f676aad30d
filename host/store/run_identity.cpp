#include "host/store/run_identity.hpp"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/backend/commit.hpp"
#include "host/base/bytes.hpp"
#include "host/base/error.hpp"
#include "host/base/numbers.hpp"
#include "host/config/document.hpp"

namespace slideway {
namespace {

/// The first value of a key of /proc/cpuinfo; "unknown" without it.
std::string cpu_info(std::string const& key) {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        auto const colon = line.find(": ");
        if (colon != std::string::npos && line.substr(0, line.find_last_not_of(" \t", colon - 1) + 1) == key) {
            return line.substr(colon + 2);
        }
    }
    return "unknown";
}

/// Piece by piece: a program is larger than many a run.
std::uint64_t checksum_of(std::string const& program) {
    std::ifstream file(program, std::ios::binary);
    Fnv1a hash;
    std::vector<char> piece(1 << 16);
    while (file) {
        file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        hash.add(std::string_view(piece.data(), static_cast<std::size_t>(file.gcount())));
    }
    if (!file.eof()) throw FileError(fmt::format("{}: cannot be read", program));
    return hash.value();
}

}  // namespace

std::string build_of(std::string const& commit, std::string const& program) {
    if (!commit.ends_with("-dirty") && commit != "unknown") return commit;
    return fmt::format("{}-{:016x}", commit, checksum_of(program));
}

BuildInfo const& build_info() {
    static BuildInfo const info{SLIDEWAY_VERSION, build_of(SLIDEWAY_COMMIT, "/proc/self/exe"), SLIDEWAY_COMPILER};
    return info;
}

std::string BuildInfo::text() const { return fmt::format("slideway {}, commit {}, {}", version, commit, compiler); }

std::string cpu_name() {
    static std::string const name = fmt::format("{}, family {} model {}", cpu_info("model name"), cpu_info("cpu family"), cpu_info("model"));
    return name;
}

std::string machine_name() { return fmt::format("{} ({} threads)", cpu_name(), std::thread::hardware_concurrency()); }

std::string creation_time() {
    std::time_t seconds = std::time(nullptr);
    if (char const* const text = std::getenv("SOURCE_DATE_EPOCH")) {
        auto const given = parse_number<std::time_t>(text);
        // Beyond the year 9999 ISO 8601 needs an agreement that nobody made.
        if (given && *given >= 0 && *given < 253402300800) seconds = *given;
    }
    std::tm utc{};
    gmtime_r(&seconds, &utc);
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", utc);
}

std::vector<DataFile::Attribute> attributes_of(Provenance const& provenance) {
    BuildInfo const& build = build_info();
    std::vector<DataFile::Attribute> attributes{{"Conventions", "CF-1.8"},
                                                {"title", provenance.title},
                                                {"source", "slideway " + build.version},
                                                {"version", build.version},
                                                {"commit", build.commit},
                                                {"compiler", build.compiler},
                                                {"flags", provenance.maker.flags},
                                                {"backend", provenance.maker.backend},
                                                {"isa", provenance.maker.isa},
                                                {"machine", machine_name()},
                                                {"threads", provenance.maker.threads},
                                                {"seed", fmt::format("{}", provenance.seed)},  // CF-1.8 has no 64-bit integers
                                                {"created", creation_time()},
                                                {"scene", provenance.scene}};
    if (!provenance.modules.empty()) attributes.push_back({"modules", provenance.modules});
    // For readers that know no mechanism or law by its name.
    attributes.push_back({"mechanism_meaning", provenance.mechanism});
    if (provenance.law.empty()) return attributes;
    attributes.push_back({"contact_law_meaning", provenance.law});
    attributes.push_back({"contact_law_switches", provenance.law_switches ? 1 : 0});
    return attributes;
}

namespace {

constexpr std::string_view title_line =
    "# What the shards beside this file belong to; slideway run --resume continues it.";
constexpr std::string_view checksum_mark = "# checksum: ", program_mark = "# program: ", arithmetic_mark = "# arithmetic: ",
                           members_mark = "# members: ", table_mark = "# table: ";
constexpr std::string_view fused = "fused", contracted = "contracted";

/// Where a text has a value.
struct Place {
    std::size_t begin, end;
    std::string_view in(std::string_view text) const { return text.substr(begin, end - begin); }
};

void add_places(std::map<std::string, Place>& places, Node const& table, std::string const& before) {
    constexpr std::string_view bare = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    for (Node const& node : table.children) {
        std::string const name = before + (node.key.find_first_not_of(bare) == node.key.npos ? node.key : toml_string(node.key));
        if (node.is_table() && !node.inline_table)
            add_places(places, node, name + ".");
        else
            places[name] = {node.begin, node.end};
    }
}

/// Of the values of a scene, by their keys; none of a text that is no scene.
std::map<std::string, Place> places_in(std::string const& scene) {
    std::map<std::string, Place> places;
    try {
        add_places(places, read_document(scene, "", {}), "");
    } catch (SceneError const&) {  // an edited result may hold anything
    }
    return places;
}

std::optional<Place> find(std::string const& scene, std::string const& key) {
    auto const places = places_in(scene);
    auto const found = places.find(key);
    return found == places.end() ? std::nullopt : std::optional(found->second);
}

/// The scene but for where modules lie: of those the sources count.
std::string without_search(std::string scene) {
    constexpr std::string_view table = "\n[modules]\nsearch = ";  // as the resolved scene has it
    auto const begin = scene.find(table);
    if (begin != scene.npos) scene.erase(begin, scene.find('\n', begin + table.size()) + 1 - begin);
    return scene;
}

/// "  # source 1f0a…" behind the name of a law or mechanism of a module; "" of the tree's.
std::string source_behind(std::string const& scene, Place const& place) {
    std::string const line = scene.substr(place.end, scene.find('\n', place.end) - place.end);
    return line.starts_with("  # source ") ? line : std::string();
}

/// "3 rows, FNV-1a 0123456789abcdef" behind the path of a table; "" behind other values.
std::string content_behind(std::string const& scene, std::string_view key, Place const& place) {
    constexpr std::string_view comment = "  # ", mark = " rows, FNV-1a ";
    if (!key.ends_with(".table") || scene.compare(place.end, comment.size(), comment) != 0) return {};
    auto const begin = place.end + comment.size();
    std::string content = scene.substr(begin, scene.find('\n', begin) - begin);
    return content.find(mark) == content.npos ? std::string() : content;
}

/// "rows.csv" of a quoted path.
std::string_view file_of(std::string_view quoted) {
    quoted = quoted.substr(0, quoted.rfind('"'));
    return quoted.substr(std::min(quoted.find_last_of("/\"") + 1, quoted.size()));
}

/// What is compared: of tables not where they lie.
std::map<std::string, std::string> values_of(std::string const& scene) {
    std::map<std::string, std::string> values;
    for (auto const& [key, place] : places_in(scene)) {
        std::string& value = values[key] = place.in(scene);
        std::erase(value, '\n');
        if (std::string content = content_behind(scene, key, place); !content.empty()) value = std::move(content);
        if (key == "contact.law" || key == "mechanism.kind") value += source_behind(scene, place);
    }
    return values;
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
    if (std::string const here = without_search(scene), former = without_search(earlier.scene); here != former) {
        auto const before = values_of(former), now = values_of(here);
        constexpr std::size_t longest = 60;
        auto const shown = [](std::string_view value) {
            return std::string(value.substr(0, longest)) + (value.size() <= longest ? "" : "...");
        };
        // What changed first, and tables before all, of which a longest step may follow: a law may bring many keys of its own.
        std::vector<std::string> changed, found, brought;
        for (auto const& [key, value] : now) {
            auto const old = before.find(key);
            if (old == before.end())
                brought.push_back(fmt::format("{} = {} is new", key, shown(value)));
            else if (auto const table = tables.find(key); old->second != value && table != tables.end())
                changed.push_back(fmt::format("{}: {} has changed since the run began, from {} to {}", key, file_of(table->second), old->second, value));
            else if (old->second != value)
                found.push_back(fmt::format("{} was {}, is {}", key, shown(old->second), shown(value)));
        }
        found.insert(found.begin(), changed.begin(), changed.end());
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

OfTables paths_of_tables(std::string const& scene) {
    OfTables paths;
    for (auto const& [key, place] : places_in(scene)) {
        if (!content_behind(scene, key, place).empty()) paths[key] = place.in(scene);
    }
    return paths;
}

OfTables contents_of_tables(std::string const& scene) {
    OfTables contents;
    for (auto const& [key, place] : places_in(scene)) {
        if (std::string content = content_behind(scene, key, place); !content.empty()) contents[key] = std::move(content);
    }
    return contents;
}

std::string with_tables(std::string const& scene, OfTables const& quoted) {
    std::map<std::size_t, std::pair<std::size_t, std::string_view>, std::greater<>> changes;  // from the end on, so that places before stay
    for (auto const& [key, place] : places_in(scene)) {
        auto const path = quoted.find(key);
        if (path != quoted.end() && !content_behind(scene, key, place).empty()) changes[place.begin] = {place.end, path->second};
    }
    std::string text = scene;
    for (auto const& [begin, change] : changes) text.replace(begin, change.first - begin, change.second);
    return text;
}

std::string copy_of_table(std::string_view key) { return fmt::format("{}.csv", key); }

std::string portable_scene(std::string const& scene) {
    OfTables copies = paths_of_tables(scene);
    for (auto& [key, path] : copies) path = toml_string(copy_of_table(key));
    std::string text = with_tables(scene, copies);
    if (auto const checked = find(text, "study.verify")) {
        auto const line = text.rfind('\n', checked->begin) + 1;
        text.erase(line, std::min(text.find('\n', line), text.size() - 1) + 1 - line);
    }
    return text;
}

std::string identity_text(RunIdentity const& identity) {
    std::string tables;
    for (auto const& [key, path] : identity.tables) tables += fmt::format("{}{} = {}\n", table_mark, key, path);
    std::string const rest = fmt::format("{}{}\n{}{}\n{}{}\n{}\n{}", program_mark, identity.program, arithmetic_mark,
                                         identity.arithmetic, members_mark, identity.members.text(), tables, identity.scene);
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
    for (; line.starts_with(table_mark); line = next_line()) {
        std::string const table = marked(line, table_mark);
        auto const end = table.find(" = ");
        require(end != table.npos);
        identity.tables[table.substr(0, end)] = table.substr(end + 3);
    }
    require(line.empty());
    if (!members) throw FileError(fmt::format("{}: its line of members is damaged", path));
    identity.members = *members;
    identity.scene = std::string(rest);
    return identity;
}

}  // namespace slideway
