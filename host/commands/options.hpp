// Values of options that are more than a word or a number.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "host/backend/backend.hpp"
#include "host/chaos/divergence.hpp"
#include "host/study/backend_choice.hpp"
#include "host/study/study_run.hpp"

namespace slideway::cli {

/// How many members may fail before the exit code says so.
struct FailureLimit {
    double value = 1;
    bool percent = true;
    bool exceeded(std::uint64_t failed, std::uint64_t members) const;
    std::string text() const;
};

// Each throws SceneError with one line for a text that cannot be used.

int parse_threads(std::string_view text);
double parse_hours(std::string_view text);
MemberRange parse_member(std::string_view text);  // "A", from 0
RunPart parse_part(std::string_view text);        // "I/N", 1 <= I <= N
std::size_t parse_block_members(std::string_view text);
FailureLimit parse_failure_limit(std::string_view text);  // "3", "0.5%"
MemberRange parse_member_range(std::string_view text);    // "A..B", both included, from 0
std::size_t parse_count(std::string_view option, std::string_view text, std::size_t least);
double parse_seconds(std::string_view option, std::string_view text);       // finite, > 0
FitWindow parse_fit(std::string_view text);                                 // "A..B", both included, A < B, from 0
std::pair<std::string, std::string> parse_override(std::string_view text);  // "key=value"
Isa parse_isa(std::string_view text);                                       // also "auto"; supported by this machine
/// What --backend takes.
inline constexpr char const* backend_words[] = {"auto", "cpu", "cuda"};
/// Of --backend and --isa.
BackendRequest parse_backend(std::string_view backend, std::string_view isa);

/// 'a b' for a shell; words without special characters stay as they are.
std::string shell_quoted(std::string_view word);

}  // namespace slideway::cli
