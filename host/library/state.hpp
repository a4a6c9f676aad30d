// What stands behind the library's classes; the Python module reads it too.
#pragma once

#include <string>

#include "host/config/scene.hpp"
#include "host/library/slideway.hpp"
#include "host/store/memory_file.hpp"

namespace slideway {

struct Result::Data {
    MemoryFile file;
};

struct Ensemble::State {
    std::string text, name;
    Settings settings;
    Scene scene;
    Table given;  // by with_members
};

}  // namespace slideway
