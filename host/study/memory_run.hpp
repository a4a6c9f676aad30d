// A study in memory: nothing is written to disk, and nothing is kept of one that was stopped.
#pragma once

#include <memory>
#include <optional>

#include "host/backend/backend.hpp"
#include "host/config/scene.hpp"
#include "host/run/stop.hpp"
#include "host/store/memory_file.hpp"

namespace slideway {

struct MemoryRun {
    std::shared_ptr<Backend const> backend;
    int threads = 1;
    bool verify = false;  // as study.verify says; the group `verification`
    StopRequest stop;
};

/// Integrates all members.  @return what the result file of the same run holds, without its hashes; nothing if it was stopped
std::optional<MemoryFile> run_in_memory(Scene const& scene, MemoryRun const& run);

}  // namespace slideway
