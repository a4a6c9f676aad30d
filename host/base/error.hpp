#pragma once

#include <stdexcept>
#include <string>

namespace slideway {

/// A command line or scene that cannot be used.  `what()` is the whole line to print:
/// `scenes/a.toml:12: joint.clearance is 0 m (the joint needs a gap); use a value > 0`.  Exit code 2.
class SceneError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A file that cannot be read or written.  Exit code 4.
class FileError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace slideway
