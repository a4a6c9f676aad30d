#include "host/store/output_target.hpp"

#include <cstdio>
#include <filesystem>
#include <istream>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "host/base/error.hpp"
#include "host/base/open_file.hpp"
#include "host/store/shard_folder.hpp"

namespace slideway {
namespace {

namespace fs = std::filesystem;

/// Before a library tries: its reasons for a folder ("HDF error") tell nobody what to do.
void require_writable_place(std::string const& name, std::string const& path) {
    std::error_code ignored;
    // The renaming at the end would put a file in the place of /dev/null; what /dev/stdout leads to has no name.
    auto const is_special = [&](std::string const& place) {
        return fs::exists(place, ignored) && !fs::is_regular_file(place, ignored) && !fs::is_directory(place, ignored);
    };
    if (is_special(name) || is_special(path)) throw FileError(name + ": is a device or a pipe; give the name of a file with -o");
    if (name.empty()) throw FileError("-o: the name of the file is empty; give one");
    if (fs::is_directory(path, ignored)) throw FileError(name + ": is a folder; give a file name with -o");
    std::string const folder = folder_of(path);
    if (!fs::is_directory(folder, ignored)) {
        throw FileError(fmt::format("{}: cannot create: there is no folder '{}'", name, folder));
    }
}

}  // namespace

std::string followed(std::string const& path) {
    constexpr int most = 40;  // as Linux
    fs::path place = path;
    std::error_code ignored;
    for (int links = 0; fs::is_symlink(place, ignored); ++links) {
        if (links == most) throw FileError(path + ": is a link that leads to itself; give another name with -o");
        fs::path const next = fs::read_symlink(place, ignored);
        place = next.is_absolute() ? next : place.parent_path() / next;
    }
    return place.string();
}

OutputTarget::OutputTarget(std::string const& path, OutputRules const& rules) : name_(path), path_(followed(path)) {
    require_writable_place(name_, path_);
    for (std::string const& input : rules.inputs) {
        std::error_code ignored;
        // Hard links are the same file, too.  A result is written under another name first.
        for (char const* const ending : {"", ".part", ".part.lock"}) {
            if (fs::equivalent(path_ + ending, input, ignored))
                throw FileError(fmt::format("{}{}: is what this command reads; give another name with -o", name_, ending));
        }
    }
    // In the place of a shard it would be the end of another run.
    bool const has_name_of_one = kind_of(fs::path(path_).filename().string()) != ShardFile::foreign;
    if (has_name_of_one && is_there(in_folder(folder_of(path_), shard_names::identity))) {
        throw FileError(name_ + ": lies in the folder of the shards of a run, under a name of theirs; give another name with -o");
    }
    replaces_ = is_there(path_);
    if (!replaces_) return;
    if (!rules.force) throw FileError(fmt::format("{}: is there already; {}", name_, rules.instead));
    // What cannot be read is somebody's for all that can be told.
    require_readable(path_);
    if (rules.is_ours(path_)) return;
    throw FileError(fmt::format("{}: is there already, and is no file of slideway, or a damaged one: --force does not replace it; give another name with -o, "
                                "or move it away",
                                name_));
}

void OutputTarget::write(std::function<void(NewFile& file)> const& content) const {
    // Nobody else's file has this name, and no other process writes it.
    std::string const part = fmt::format("{}.{}.part", path_, ::getpid());
    {
        NewFile file(part);
        content(file);
        file.finish();
    }
    try {
        rename_durably(part, path_, existing());
    } catch (...) {
        std::remove(part.c_str());
        throw;
    }
}

bool begins_with(std::string const& path, std::function<bool(std::string_view line)> const& condition) {
    std::string line;
    return std::getline(*file_stream(path), line) && condition(line);
}

}  // namespace slideway
