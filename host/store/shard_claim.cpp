#include "host/store/shard_claim.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "host/base/durable_file.hpp"
#include "host/base/error.hpp"
#include "host/store/run_identity.hpp"

namespace slideway {
namespace {

using Kind = FileLock::Kind;
using Wait = FileLock::Wait;

constexpr std::string_view begin_suffix = "-begin", division_mark = "-of-";

std::string lock_of(std::string const& folder, std::string_view suffix = {}) {
    return in_folder(folder, fmt::format("{}{}", shard_names::lock, suffix));
}

/// "-of-8" of a part "3-of-8" or of its lock.
std::string_view division_of(std::string_view name) {
    auto const at = name.rfind(division_mark);
    return at == name.npos ? std::string_view() : name.substr(at);
}

void make_folder(std::string const& folder) {
    if (mkdir(folder.c_str(), 0777) == 0) {
        sync_name(folder);
    } else if (errno != EEXIST) {
        throw FileError(fmt::format("{}: cannot create the folder: {}", folder, std::strerror(errno)));
    }
}

/// Makes the folder, again if another run removes it meanwhile, and holds the right to begin in it.
std::unique_ptr<FileLock> make_and_lock(std::string const& folder) {
    for (;;) {
        make_folder(folder);
        try {
            return std::make_unique<FileLock>(lock_of(folder, begin_suffix), Kind::alone, Wait::yes);
        } catch (FileError const&) {
            if (is_there(folder)) throw;
        }
    }
}

/// By its name, if it is a file: folders and pipes are nobody's of a run, whatever their names.
ShardFile kind_in(std::string const& folder, std::string_view name) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(in_folder(folder, name), ignored) ? kind_of(name) : ShardFile::foreign;
}

bool holds(std::string const& folder, ShardFile kind) {
    for (std::string const& name : names_in(folder)) {
        if (kind_in(folder, name) == kind) return true;
    }
    return false;
}

/// Whether somebody began to remove the folder.
bool is_finished(std::string const& folder) { return kind_in(folder, shard_names::finished) == ShardFile::identity; }

/// What a process left that was killed in `remove_folder`; of its last steps only locks, or nothing.
bool is_remains(std::string const& folder) {
    if (ShardFolder::exists(folder)) return false;
    if (is_finished(folder)) return true;
    return names_in(folder).empty() || (holds(folder, ShardFile::lock) && !holds(folder, ShardFile::content));
}

/// What every shard holds, of members or of statistics.
bool is_shard_within(std::string const& path) {
    std::string const text = read_text(path);
    return text.find("slideway") != text.npos || text.find("slkstat") != text.npos;
}

std::string count_text(std::uint64_t members) {
    return fmt::format("{} finished member{}", members, members == 1 ? "" : "s");
}

}  // namespace

ShardClaim::ShardClaim(std::string folder, Wanted const& wanted) : folder_(std::move(folder)) {
    tables_.emplace();
    for (auto const& [name, text] : wanted.tables) tables_->push_back(name);
    // Parts begin one after another: the first writes the identity.
    auto const begins = make_and_lock(folder_);
    bool const is_whole = wanted.part.empty();
    whole_.emplace(lock_of(folder_), is_whole ? Kind::alone : Kind::shared, Wait::no, Rival{folder_});
    if (!is_whole) {
        part_.emplace(lock_of(folder_, "-" + wanted.part), Kind::alone, Wait::no, Rival{folder_});
        require_one_division(wanted.part);
    }
    begin(wanted);
}

ShardClaim::ShardClaim(std::string folder) : folder_(std::move(folder)) {
    whole_.emplace(lock_of(folder_), Kind::alone, Wait::no, Rival{folder_});
}

/// Parts of another division have members in common with this one.
void ShardClaim::require_one_division(std::string const& part) const {
    for (std::string const& name : names_in(folder_)) {
        if (kind_in(folder_, name) != ShardFile::lock || division_of(name).empty()) continue;
        if (division_of(name) == division_of(part)) continue;
        std::string const other = name.substr(shard_names::lock.size() + 1);
        std::string const detail = fmt::format(", part {} of another division than part {}", other, part);
        FileLock const probe(in_folder(folder_, name), Kind::shared, Wait::no, Rival{folder_, detail, "wait for its end or divide the run alike"});
    }
}

void ShardClaim::begin(Wanted const& wanted) {
    std::string const end = in_folder(folder_, shard_names::finished);
    if (is_there(end) && !is_finished(folder_)) throw FileError(end + ": is no file; move it away");
    std::string changed;
    if (ShardFolder::exists(folder_)) {
        ShardFolder const folder(folder_);
        std::vector<DamagedShard> damaged;
        MemberSet const found = members_of(folder.intact(damaged));
        changed = wanted.identity.difference(folder.identity());
        if (!changed.empty() && !found.empty()) {
            throw SceneError(
                fmt::format("{}: {}holds {} of another run ({}); give another name with -o, or move the folder away",
                            folder_, wanted.resume ? "cannot resume: it " : "", count_text(found.count()), changed));
        }
        done_ = found.common(wanted.mine);
        if (!done_.empty() && !wanted.resume) {
            throw SceneError(
                fmt::format("{}: holds {} of this run; add --resume to go on with it, or move the folder away", folder_,
                            count_text(done_.count())));
        }
        if (changed.empty()) {
            mended_ = folder.damaged_identity();
            folder.mend();
            put_aside(damaged, wanted.mine);
            write_tables(wanted);
            return;
        }
        require_alone(wanted);
    } else if (!is_finished(folder_) && holds(folder_, ShardFile::content)) {
        throw SceneError(
            fmt::format("{}: holds shards but no {}, which says what they belong to; give another name with -o, or "
                        "move the folder away",
                        folder_, shard_names::identity));
    }
    take_over(wanted);
}

/// A folder of nobody, of a run that finished nothing, or the remains of one whose result stands.
void ShardClaim::take_over(Wanted const& wanted) {
    remove_content(true);
    if (is_finished(folder_)) {
        // Last, also after a power loss: without it the rest would be anybody's.
        sync_folder(folder_);
        remove_file(in_folder(folder_, shard_names::finished));
    }
    write_identity(folder_, wanted.identity);
    write_tables(wanted);
}

/// After the identity, so that they are never anybody's; those that a killed process had not written yet are written now.
void ShardClaim::write_tables(Wanted const& wanted) const {
    for (auto const& [name, text] : wanted.tables) {
        std::string const path = in_folder(folder_, name);
        if (!is_there(path) || read_text(path) != *text) write_durably(path, *text);
    }
}

/// What is damaged must not stand in the way of its successor, but may be worth a look.  Other parts see to theirs.
void ShardClaim::put_aside(std::vector<DamagedShard> const& damaged, MemberSet const& mine) {
    for (DamagedShard const& one : damaged) {
        if (!one.is_manifest && !one.shard.members.overlaps(mine)) continue;
        std::string const path = in_folder(folder_, one.shard.name);
        std::string const aside = in_folder(folder_, fmt::format("{}{}", shard_names::damaged, one.shard.name));
        if (!one.is_gone && !one.is_manifest) rename_file(path, aside);
        damaged_.push_back(one);
    }
}

/// A part of another run that is at work has finished nothing yet, but will.
void ShardClaim::require_alone(Wanted const& wanted) {
    if (wanted.part.empty()) return;
    // Nobody can begin meanwhile.
    whole_->change(Kind::alone, {folder_});
    whole_->change(Kind::shared, {folder_});
}

/// Shards go that a manifest lists, and others that a process was killed before it could list, or after it had removed the manifest.
/// @param all_tables and not only those of the run
void ShardClaim::remove_content(bool all_tables) {
    std::vector<std::string> const listed = listed_names(folder_);
    for (std::string const& name : names_in(folder_)) {
        bool const is_listed = std::ranges::binary_search(listed, name);
        ShardFile const kind = is_listed ? kind_of(name) : kind_in(folder_, name);
        bool const is_kept = name.ends_with(shard_names::table) && !all_tables && tables_ && std::ranges::find(*tables_, name) == tables_->end();
        if (kind != ShardFile::content || is_kept) continue;
        std::string const path = in_folder(folder_, name);
        bool const is_shard = (name.starts_with(shard_names::members) || name.starts_with(shard_names::statistics)) && !name.ends_with(".tmp");
        if (!is_shard || is_listed || is_shard_within(path)) remove_file(path);
    }
}

std::vector<std::string> ShardClaim::remove_folder() {
    // Nobody begins meanwhile: whoever waits finds the lock's file gone then, and makes a new one.
    FileLock begins(lock_of(folder_, begin_suffix), Kind::alone, Wait::yes);
    // First, so that whoever finds what a killed process left knows that it may go.
    remove_file(in_folder(folder_, shard_names::identity_copy));
    if (ShardFolder::exists(folder_)) {
        rename_file(in_folder(folder_, shard_names::identity), in_folder(folder_, shard_names::finished));
        sync_folder(folder_);
    }
    remove_content(false);
    sync_folder(folder_);
    for (ShardFile const kind : {ShardFile::identity, ShardFile::lock}) {
        for (std::string const& name : names_in(folder_)) {
            if (kind_in(folder_, name) == kind) remove_file(in_folder(folder_, name));
        }
    }
    // ENOTDIR: a link to a folder, which somebody made elsewhere for this.
    if (rmdir(folder_.c_str()) == 0) return {};
    if (errno != ENOTEMPTY && errno != EEXIST && errno != ENOTDIR) {
        throw FileError(fmt::format("{}: cannot remove the folder: {}", folder_, std::strerror(errno)));
    }
    return names_in(folder_);
}

void ShardClaim::remove_remains(std::string const& folder) {
    std::error_code ignored;
    if (!std::filesystem::is_directory(folder, ignored)) return;
    if (!is_remains(folder)) return;
    ShardClaim claim(folder);
    // Another process may have begun anew meanwhile.
    if (is_remains(folder)) claim.remove_folder();
}

void ShardClaim::remove_merged(std::string const& folder) {
    ShardClaim claim(folder);
    RunIdentity const identity = ShardFolder(folder).identity();
    claim.tables_.emplace();
    for (auto const& [key, path] : identity.tables) claim.tables_->push_back(copy_of_table(key));
    claim.remove_folder();
}

void ShardClaim::require_nobody(std::string const& folder, std::string const& result) { FileLock::require_free(lock_of(folder), {result}); }

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
