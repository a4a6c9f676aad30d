// Values of options that are more than a word or a number.
#pragma once

#include <cstdint>
#include <functional>
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

// Of an option's name and its word.  Each throws SceneError with one line for a word that cannot be used.

double parse_hours(std::string_view option, std::string_view word);
double parse_seconds(std::string_view option, std::string_view word);            // finite, > 0
std::uint64_t parse_member(std::string_view option, std::string_view word);      // from 0
MemberRange parse_member_range(std::string_view option, std::string_view word);  // "A..B", both included, from 0
RunPart parse_part(std::string_view option, std::string_view word);              // "I/N", 1 <= I <= N
FailureLimit parse_failure_limit(std::string_view option, std::string_view word);  // "3", "0.5%"
FitWindow parse_fit(std::string_view option, std::string_view word);               // "A..B", both included, A < B, from 0
/// What parses a whole number from least to most.
std::function<std::uint32_t(std::string_view option, std::string_view word)> whole_number(std::uint32_t least, std::uint32_t most = ~0u);

std::pair<std::string, std::string> parse_override(std::string_view text);  // "key=value"
Isa parse_isa(std::string_view text);                                       // also "auto"; supported by this machine
/// What --backend takes, in the order of `BackendRequest::Kind`.
inline constexpr std::string_view backend_words[] = {"auto", "cpu", "cuda"};
/// Of --backend and --isa.
BackendRequest parse_backend(std::string_view backend, std::string_view isa);

/// 'a b' for a shell; words without special characters stay as they are.
std::string shell_quoted(std::string_view word);

}  // namespace slideway::cli
