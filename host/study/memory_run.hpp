// A study in memory: nothing is written to disk.
#pragma once

#include <cstdint>
#include <memory>

#include "host/backend/backend.hpp"
#include "host/config/scene.hpp"
#include "host/run/progress.hpp"
#include "host/run/stop.hpp"
#include "host/store/memory_file.hpp"

namespace slideway {

struct MemoryRun {
    std::shared_ptr<Backend const> backend;
    int threads = 1;
    bool verify = false;  // as study.verify says; the group `verification`
    Progress::Style progress = Progress::Style::none;  // on stderr
    StopRequest stop;
};

/// Integrates the members, or those that end before a stop: the others have status not_run.
/// @return what the result file of the same run holds, without its hashes
MemoryFile run_in_memory(Scene const& scene, MemoryRun const& run);
/// Bytes of such a result.
std::uint64_t memory_bytes(Scene const& scene);

}  // namespace slideway
