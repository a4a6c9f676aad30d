// Runs of a program whose calls on files fail by plan (failing_calls.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace slideway::testing {

/// How a disk fails, from its `at`-th call on (from 1; 0: never).
struct DiskFailure {
    char const* error = "ENOSPC";
    bool once = false;       // only that call
    bool is_short = false;   // it writes half, later ones fail
    char const* calls = "";  // families of calls, comma-separated; all if empty
};

/// The start of a shell command: what follows meets the failure in calls under `folder`, and tells of them in `count_file`, which
/// should lie elsewhere.
inline std::string with_failing_calls(std::filesystem::path const& folder, std::filesystem::path const& count_file,
                                      std::uint64_t at, DiskFailure const& failure) {
    return "SLIDEWAY_FAIL_UNDER='" + folder.string() + "' SLIDEWAY_FAIL_COUNT='" + count_file.string() +
           "' SLIDEWAY_FAIL_AT=" + std::to_string(at) + " SLIDEWAY_FAIL_ERRNO=" + failure.error +
           " SLIDEWAY_FAIL_CALLS=" + failure.calls + (failure.once ? " SLIDEWAY_FAIL_ONCE=1" : "") +
           (failure.is_short ? " SLIDEWAY_FAIL_SHORT=1" : "") + " LD_PRELOAD='" SLIDEWAY_FAILING_CALLS "' ";
}

struct CallCounts {
    std::uint64_t counted = 0, failed = 0;
};

/// What the last such run told; it must have written the file anew.
inline CallCounts call_counts(std::filesystem::path const& count_file) {
    std::ifstream in(count_file, std::ios::binary);
    std::array<std::uint64_t, 2> numbers{};
    in.read(reinterpret_cast<char*>(numbers.data()), sizeof numbers);
    return {numbers[0], numbers[1]};
}

}  // namespace slideway::testing
