#pragma once

#include <stdexcept>
#include <string_view>

#include "host/base/text.hpp"

namespace slideway {

/// A command line or scene that cannot be used.  `what()` is the whole line to print:
/// `scenes/a.toml:12: joint.clearance is -1 m (a preload of more than 0.1 mm is not elastic); use a value >= -0.1 mm`.  Exit code 2.
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
