#pragma once

#include <stdexcept>
#include <string_view>

#include "host/base/shown.hpp"

namespace slideway {

/// A command line or scene that cannot be used.  `what()` is the whole line to print:
/// `scenes/a.toml:12: joint.clearance is 0 m (the joint needs a gap); use a value > 0`.  Exit code 2.
class SceneError : public std::runtime_error {
public:
    explicit SceneError(std::string_view line) : std::runtime_error(shown(line)) {}
};

/// A file that cannot be read or written.  Exit code 4.
class FileError : public std::runtime_error {
public:
    explicit FileError(std::string_view line) : std::runtime_error(shown(line)) {}
};

}  // namespace slideway
