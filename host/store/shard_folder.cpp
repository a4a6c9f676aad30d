#include "host/store/shard_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <sstream>

#include <fmt/format.h>

#include "host/base/bytes.hpp"
#include "host/base/durable_file.hpp"
#include "host/base/error.hpp"
#include "host/base/numbers.hpp"

namespace slideway {
namespace {

bool take(std::string_view& text, std::string_view start) {
    if (!text.starts_with(start)) return false;
    text.remove_prefix(start.size());
    return true;
}

/// A number as it is printed with at least `width` digits: more only where it has them.
bool take_number(std::string_view& text, std::size_t width) {
    auto const is_digit = [](char c) { return c >= '0' && c <= '9'; };
    auto const end = std::find_if_not(text.begin(), text.end(), is_digit);
    auto const digits = static_cast<std::size_t>(end - text.begin());
    if (digits < width || (digits > width && text.front() == '0')) return false;
    text.remove_prefix(digits);
    return true;
}

constexpr std::size_t member_digits = 10, manifest_digits = 6;

bool is_shard(std::string_view name) {
    if (take(name, shard_names::members)) return take_number(name, member_digits) && name == ".nc";
    return take(name, shard_names::statistics) && take_number(name, member_digits) && take(name, "-") &&
           take_number(name, 1) && name == ".bin";
}

bool is_manifest(std::string_view name) {
    return take(name, shard_names::manifest) && take_number(name, manifest_digits) && name == ".txt";
}

/// "load.plunger.table.csv"
bool is_table(std::string_view name) {
    constexpr std::string_view of_keys = "abcdefghijklmnopqrstuvwxyz0123456789_.";
    return name.size() > shard_names::table.size() && name.ends_with(shard_names::table) && name.find_first_not_of(of_keys) == name.npos;
}

/// "lock", "lock-begin", "lock-3-of-8"
bool is_lock(std::string_view name) {
    if (!take(name, shard_names::lock)) return false;
    if (name.empty() || name == "-begin") return true;
    return take(name, "-") && take_number(name, 1) && take(name, "-of-") && take_number(name, 1) && name.empty();
}

/// A whole line of a manifest; nothing of any other.
std::optional<Shard> shard_of(std::string line) {
    auto const space = line.rfind(' ');
    if (space == line.npos) return {};
    auto const own = parse_number<std::uint64_t>(std::string_view(line).substr(space + 1), 16);
    line.resize(space);
    if (own != fnv1a(line)) return {};  // also of none
    std::istringstream words(line);
    Shard shard{};
    std::string checksum, members;
    words >> shard.name >> shard.bytes >> checksum >> members;
    auto const set = MemberSet::parse(members);
    auto const sum = parse_number<std::uint64_t>(checksum, 16);
    if (!words || !set || !sum) return {};
    shard.checksum = *sum;
    shard.members = *set;
    return shard;
}

/// @return whether all lines are whole, but for a last one without its end: there a process was killed
bool read_manifest(std::string const& path, std::vector<Shard>& shards) {
    std::istringstream lines(read_text(path));
    bool is_whole = true;
    for (std::string line; std::getline(lines, line);) {
        if (auto shard = shard_of(std::move(line)))
            shards.push_back(std::move(*shard));
        else if (!lines.eof())
            is_whole = false;
    }
    return is_whole;
}

constexpr std::string_view identity_files[] = {shard_names::identity, shard_names::identity_copy};

/// What is whole of the two; what cannot be read is not taken for damaged.  @param damaged the other's name, or "": a copy may be missing
RunIdentity read_identity(std::string const& folder, std::string& damaged) {
    std::optional<RunIdentity> found;
    std::optional<FileError> damage;
    for (std::string_view const name : identity_files) {
        std::string const file = in_folder(folder, name);
        if (!is_there(file)) {
            if (name == shard_names::identity) damaged = file;
            continue;
        }
        std::string const text = read_text(file);
        try {
            RunIdentity identity = parse_identity(text, file);
            if (!found) found = std::move(identity);
        } catch (FileError const& error) {
            if (!damage) damage = error;
            damaged = file;
        }
    }
    if (found) return *found;
    throw damage.value_or(FileError(folder + ": is no folder of shards any more"));
}

/// What the manifests say.  @param damaged manifests that are
std::vector<Shard> all_in(std::string const& folder, std::vector<DamagedShard>* damaged = nullptr) {
    std::vector<Shard> shards;
    for (std::string const& name : names_in(folder)) {
        if (!name.starts_with(shard_names::manifest)) continue;
        bool const is_whole = read_manifest(in_folder(folder, name), shards);
        if (!is_whole && damaged != nullptr) damaged->push_back({{name, 0, 0, {}}, false, true});
    }
    return shards;
}

/// A shard that was damaged once, and whose members ran again, may be listed beside its successors: the later line counts.
std::vector<Shard> without_repeats(std::vector<Shard> shards) {
    std::reverse(shards.begin(), shards.end());
    std::vector<Shard> kept;
    MemberSet done;
    for (Shard& shard : shards) {
        if (done.overlaps(shard.members)) continue;
        done.add(shard.members);
        kept.push_back(std::move(shard));
    }
    std::sort(kept.begin(), kept.end(), [](Shard const& a, Shard const& b) {
        return a.members.ranges().front().first < b.members.ranges().front().first;
    });
    return kept;
}

bool is_what_was_written(std::vector<std::byte> const& bytes, Shard const& shard) {
    return bytes.size() == shard.bytes && fnv1a(bytes) == shard.checksum;
}

/// Only a file that is gone or holds something else is damaged: whoever may not open it now may find it whole later.
bool read_intact(std::string const& folder, Shard const& shard, bool& is_gone) {
    std::string const path = in_folder(folder, shard.name);
    is_gone = !is_there(path);
    if (is_gone) return false;
    try {
        return is_what_was_written(read_bytes(path), shard);
    } catch (FileError const&) {
        // Another part joins its shards of statistics, and removes them, at any time.
        is_gone = !is_there(path);
        if (!is_gone) throw;
        return false;
    }
}

}  // namespace

ShardFile kind_of(std::string_view name) {
    if (is_lock(name)) return ShardFile::lock;
    constexpr std::string_view temporary = ".tmp";
    if (name.ends_with(temporary)) name.remove_suffix(temporary.size());
    for (std::string_view const identity : {shard_names::identity, shard_names::identity_copy, shard_names::finished}) {
        if (name == identity) return ShardFile::identity;
    }
    if (is_shard(name) || is_manifest(name) || is_table(name)) return ShardFile::content;
    return take(name, shard_names::damaged) && is_shard(name) ? ShardFile::content : ShardFile::foreign;
}

namespace fs = std::filesystem;

std::string manifest_name(int number) { return fmt::format("{}{:06}.txt", shard_names::manifest, number); }

std::string manifest_line(Shard const& shard) {
    std::string const line =
        fmt::format("{} {} {:016x} {}", shard.name, shard.bytes, shard.checksum, shard.members.text());
    return fmt::format("{} {:016x}", line, fnv1a(line));
}

std::vector<std::string> names_in(std::string const& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        names.push_back(entry->path().filename().string());
    }
    if (error) throw FileError(fmt::format("{}: cannot read the folder: {}", folder, error.message()));
    std::sort(names.begin(), names.end());
    return names;
}

bool ShardFolder::exists(std::string const& path) {
    auto const has = [&](std::string_view name) { return is_there(in_folder(path, name)); };
    return has(shard_names::identity) || (has(shard_names::identity_copy) && !has(shard_names::finished));
}

void ShardFolder::mend() const {
    std::string const text = identity_text(identity_);
    for (std::string_view const name : identity_files) {
        std::string const file = in_folder(path_, name);
        if (!is_there(file) || read_text(file) != text) write_durably(file, text);
    }
}

void write_identity(std::string const& folder, RunIdentity const& identity) {
    std::string const copy = in_folder(folder, shard_names::identity_copy), text = identity_text(identity);
    // One that is older than run.toml would speak for it some day.
    if (is_there(copy)) remove_file(copy);
    write_durably(in_folder(folder, shard_names::identity), text);
    write_durably(copy, text);
}

ShardFolder::ShardFolder(std::string path) : path_(std::move(path)) {
    if (!exists(path_))
        throw FileError(path_ + ": is no folder of shards; give the folder that a run left, OUT.nc.shards");
    identity_ = read_identity(path_, damaged_);
}

std::vector<Shard> ShardFolder::listed() const {
    std::vector<Shard> shards = all_in(path_);
    std::erase_if(shards, [&](Shard const& shard) {
        std::string const file = in_folder(path_, shard.name);
        std::error_code error;
        auto const size = fs::file_size(file, error);
        if (error == std::errc::no_such_file_or_directory) return true;
        if (error) throw FileError(fmt::format("{}: cannot read: {}", file, error.message()));
        return size != shard.bytes;
    });
    return without_repeats(std::move(shards));
}

std::vector<Shard> ShardFolder::intact(std::vector<DamagedShard>& damaged) const {
    std::vector<Shard> whole;
    std::vector<DamagedShard> broken, manifests;
    for (Shard& shard : all_in(path_, &manifests)) {
        bool is_gone = false;
        if (read_intact(path_, shard, is_gone))
            whole.push_back(std::move(shard));
        else
            broken.push_back({std::move(shard), is_gone});
    }
    whole = without_repeats(std::move(whole));
    MemberSet const done = members_of(whole);
    if (!(done == identity_.members)) damaged.insert(damaged.end(), manifests.begin(), manifests.end());
    for (DamagedShard& one : broken) {
        // The line of a shard outlives it: its successor may have its name.
        auto const has_its_name = [&](Shard const& other) { return other.name == one.shard.name; };
        if (std::any_of(whole.begin(), whole.end(), has_its_name)) continue;
        auto const was_found = [&](DamagedShard const& other) { return has_its_name(other.shard); };
        if (std::any_of(damaged.begin(), damaged.end(), was_found)) continue;
        if (!one.shard.members.without(done).empty()) damaged.push_back(std::move(one));
    }
    return whole;
}

std::vector<std::string> listed_names(std::string const& folder) {
    std::vector<std::string> names;
    for (Shard& shard : all_in(folder)) names.push_back(std::move(shard.name));
    std::ranges::sort(names);
    return names;
}

std::vector<std::byte> read_shard(std::string const& folder, Shard const& shard) {
    std::string const path = in_folder(folder, shard.name);
    std::vector<std::byte> bytes = read_bytes(path);
    if (!is_what_was_written(bytes, shard)) throw FileError(path + ": is not what was written (its checksum differs)");
    return bytes;
}

MemberSet members_of(std::vector<Shard> const& shards) {
    MemberSet members;
    for (Shard const& shard : shards) members.add(shard.members);
    return members;
}

}  // namespace slideway
