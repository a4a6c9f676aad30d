#include "host/output/shard_claim.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "host/output/durable_file.hpp"
#include "host/scene/error.hpp"

namespace slideway {
namespace {

std::string join(std::string const& folder, std::string_view name) {
    return (std::filesystem::path(folder) / name).string();
}

[[noreturn]] void fail_of_rival(std::string const& folder) {
    throw FileError(
        fmt::format("{}: another run is writing here; wait for its end or give another name with -o", folder));
}

/// A lock that ends with the process, however it ends.
int locked(std::string const& folder, std::string const& name, int operation) {
    std::string const path = join(folder, name);
    int const file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0) throw FileError(fmt::format("{}: cannot create: {}", path, std::strerror(errno)));
    if (flock(file, operation) == 0 || errno != EWOULDBLOCK) return file;  // some file systems have no locks
    close(file);
    fail_of_rival(folder);
}

void remove_file(std::string const& folder, std::string_view name) {
    std::string const path = join(folder, name);
    if (unlink(path.c_str()) != 0 && errno != ENOENT) {
        throw FileError(fmt::format("{}: cannot remove: {}", path, std::strerror(errno)));
    }
}

std::string count_text(std::uint64_t members) {
    return fmt::format("{} finished member{}", members, members == 1 ? "" : "s");
}

}  // namespace

ShardClaim::ShardClaim(std::string folder, Wanted const& wanted) : folder_(std::move(folder)) {
    if (mkdir(folder_.c_str(), 0777) == 0) {
        sync_name(folder_);
    } else if (errno != EEXIST) {
        throw FileError(fmt::format("{}: cannot create the folder: {}", folder_, std::strerror(errno)));
    }
    std::string const lock(shard_names::lock);
    try {
        // Parts begin one after another: the first writes the identity.
        int const begins = locked(folder_, lock + "-begin", LOCK_EX);
        try {
            whole_ = locked(folder_, lock, (wanted.part.empty() ? LOCK_EX : LOCK_SH) | LOCK_NB);
            if (!wanted.part.empty()) part_ = locked(folder_, lock + "-" + wanted.part, LOCK_EX | LOCK_NB);
            begin(wanted);
        } catch (...) {
            close(begins);
            throw;
        }
        close(begins);
    } catch (...) {
        release();
        throw;
    }
}

ShardClaim::ShardClaim(std::string folder)
    : folder_(std::move(folder)), whole_(locked(folder_, std::string(shard_names::lock), LOCK_EX | LOCK_NB)) {}

ShardClaim::~ShardClaim() { release(); }

void ShardClaim::release() {
    for (int* const file : {&whole_, &part_}) {
        if (*file >= 0) close(std::exchange(*file, -1));
    }
}

void ShardClaim::begin(Wanted const& wanted) {
    std::string changed;
    if (ShardFolder::exists(folder_)) {
        ShardFolder const folder(folder_);
        std::vector<Shard> damaged;
        MemberSet const found = members_of(folder.intact(damaged));
        changed = wanted.identity.difference(folder.identity());
        if (!changed.empty() && !found.empty()) {
            throw SceneError(
                fmt::format("{}: {}holds {} of another run ({}); give another name with -o, or remove the folder",
                            folder_, wanted.resume ? "cannot resume: it " : "", count_text(found.count()), changed));
        }
        done_ = found.common(wanted.mine);
        if (!done_.empty() && !wanted.resume) {
            throw SceneError(
                fmt::format("{}: holds {} of this run; add --resume to go on with it, or remove the folder", folder_,
                            count_text(done_.count())));
        }
        if (changed.empty()) {
            remove_damaged(damaged, wanted.mine);
            return;
        }
        require_alone(wanted);
    }
    // Nobody's, or of a run that finished nothing.
    remove_shards();
    write_durably(join(folder_, shard_names::identity), identity_text(wanted.identity));
}

/// What is damaged must not stand in the way of its successor.  Other parts see to theirs.
void ShardClaim::remove_damaged(std::vector<Shard> const& damaged, MemberSet const& mine) {
    for (Shard const& shard : damaged) {
        if (!shard.members.overlaps(mine)) continue;
        remove_file(folder_, shard.name);
        damaged_.push_back(shard.name);
    }
}

/// A part of another run that is at work has finished nothing yet, but will.
void ShardClaim::require_alone(Wanted const& wanted) {
    if (wanted.part.empty()) return;
    // Nobody can begin meanwhile.
    if (flock(whole_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) fail_of_rival(folder_);
    flock(whole_, LOCK_SH);
}

void ShardClaim::remove_shards() {
    for (std::string const& name : names_in(folder_)) {
        for (std::string_view const ours : {shard_names::manifest, shard_names::members, shard_names::statistics}) {
            if (name.starts_with(ours)) remove_file(folder_, name);
        }
    }
}

void ShardClaim::remove_folder() {
    // The identity first: a folder without one is nobody's.
    remove_file(folder_, shard_names::identity);
    sync_folder(folder_);
    remove_shards();
    for (std::string const& name : names_in(folder_)) {
        if (name.starts_with(shard_names::lock) || name.starts_with(shard_names::identity)) remove_file(folder_, name);
    }
    if (rmdir(folder_.c_str()) != 0 && errno != ENOTEMPTY && errno != EEXIST) {
        throw FileError(fmt::format("{}: cannot remove the folder: {}", folder_, std::strerror(errno)));
    }
}

void ShardClaim::remove_remains(std::string const& folder) {
    std::error_code ignored;
    if (!std::filesystem::is_directory(folder, ignored)) return;
    ShardClaim claim(folder);
    // Another process may have begun anew meanwhile.
    if (!ShardFolder::exists(folder)) claim.remove_folder();
}

}  // namespace slideway
