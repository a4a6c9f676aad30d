// A file that a command writes, and what it must not destroy.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "host/base/durable_file.hpp"

namespace slideway {

/// What may be lost by writing a file: nothing that is there, unless the user says so; then only what slideway wrote; inputs never.
struct OutputRules {
    std::span<std::string const> inputs;  // files that the command reads; those that do not exist do not count
    bool force = false;                   // --force
    /// Whether a file, which can be read, is one of slideway's, of the kind that the command writes; an empty one is none.
    std::function<bool(std::string const& path)> is_ours;
    char const* instead = "add --force to replace it, or give another name with -o";  // where one is there, and not forced
};

/// What a chain of links ends at, there or not: a file has one name, by whichever it is asked for.  @throws FileError where links lead to themselves
std::string followed(std::string const& path);

/// Where a command writes, found out before anything is computed.
class OutputTarget {
public:
    /// @throws FileError: `path` is empty, a folder, a device or a pipe, lies in no folder or is a link to itself; it is an input; there is
    /// a file, and it is not forced, or cannot be read, or is none of slideway's
    OutputTarget(std::string const& path, OutputRules const& rules);

    /// As the user gave it.
    std::string const& name() const { return name_; }
    /// Where it is: links followed.
    std::string const& path() const { return path_; }
    /// Whether there was one, which may be replaced.
    bool replaces() const { return replaces_; }
    /// What becomes of one that has come there since.
    Existing existing() const { return replaces_ ? Existing::replaced : Existing::kept; }

    /// Writes by a file beside it, fsync, rename, fsync of the folder.  @throws FileError; nothing has changed then
    void write(std::function<void(NewFile& file)> const& content) const;
    void write(std::string_view text) const {
        write([&](NewFile& file) { file.append(text); });
    }

private:
    std::string name_, path_;
    bool replaces_ = false;
};

/// For `OutputRules::is_ours`: a text whose first line satisfies a condition.
bool begins_with(std::string const& path, std::function<bool(std::string_view line)> const& condition);

}  // namespace slideway
