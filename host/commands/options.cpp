#include "host/commands/options.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/base/error.hpp"
#include "host/base/numbers.hpp"

namespace slideway::cli {

bool FailureLimit::exceeded(std::uint64_t failed, std::uint64_t members) const {
    double const allowed = percent ? value / 100 * static_cast<double>(members) : value;
    return static_cast<double>(failed) > allowed;
}

std::string FailureLimit::text() const { return fmt::format("{}{}", value, percent ? "%" : ""); }

int parse_threads(std::string_view text) {
    constexpr int most = 4096;  // beyond it the OpenMP runtime ends the process instead of complaining
    auto const threads = parse_number<int>(text);
    if (threads && *threads >= 1 && *threads <= most) return *threads;
    throw SceneError(fmt::format("--threads {}: give a whole number from 1 to {}", text, most));
}

double parse_hours(std::string_view text) {
    auto const hours = parse_number<double>(text);
    if (hours && *hours >= 0) return *hours;
    throw SceneError(fmt::format("--max-hours {}: give a number of hours, 0 or more", text));
}

MemberRange parse_member(std::string_view text) {
    auto const member = parse_number<std::uint64_t>(text);
    if (member) return {*member, 1};
    throw SceneError(fmt::format("--member {}: give the number of a member, counted from 0", text));
}

RunPart parse_part(std::string_view text) {
    auto const slash = text.find('/');
    if (slash != text.npos) {
        auto const number = parse_number<std::uint32_t>(text.substr(0, slash));
        auto const parts = parse_number<std::uint32_t>(text.substr(slash + 1));
        if (number && parts && *number >= 1 && *number <= *parts) return {*number, *parts, true};
    }
    throw SceneError(fmt::format("--shard {}: give the part and how many there are as I/N, from 1/N to N/N", text));
}

std::size_t parse_block_members(std::string_view text) {
    constexpr std::uint32_t most = 1'000'000;  // results of a block stay in memory while it runs
    auto const members = parse_number<std::uint32_t>(text);
    if (members && *members >= 1 && *members <= most) return *members;
    throw SceneError(fmt::format("--block-members {}: give a whole number from 1 to {}", text, most));
}

FailureLimit parse_failure_limit(std::string_view text) {
    bool const percent = text.ends_with('%');
    std::string_view const number = percent ? text.substr(0, text.size() - 1) : text;
    auto const value = parse_number<double>(number);
    bool const whole = value && (percent || *value == std::floor(*value));
    if (!whole || !std::isfinite(*value) || *value < 0 || (percent && *value > 100)) {
        throw SceneError(fmt::format("--max-failures {}: give a number of members (3) or a percentage (0.5%)", text));
    }
    return {*value, percent};
}

MemberRange parse_member_range(std::string_view text) {
    auto const dots = text.find("..");
    if (dots != text.npos) {
        auto const first = parse_number<std::uint64_t>(text.substr(0, dots));
        auto const last = parse_number<std::uint64_t>(text.substr(dots + 2));
        if (first && last && *first <= *last && *last < std::numeric_limits<std::uint64_t>::max()) {
            return {*first, *last - *first + 1};
        }
    }
    throw SceneError(fmt::format("--members {}: give the first and the last member as A..B, counted from 0", text));
}

std::size_t parse_count(std::string_view option, std::string_view text, std::size_t least) {
    auto const count = parse_number<std::uint32_t>(text);
    if (count && *count >= least) return *count;
    throw SceneError(fmt::format("{} {}: give a whole number, {} or more", option, text, least));
}

double parse_seconds(std::string_view option, std::string_view text) {
    auto const seconds = parse_number<double>(text);
    if (seconds && *seconds > 0 && std::isfinite(*seconds)) return *seconds;
    throw SceneError(fmt::format("{} {}: give a number of seconds, more than 0", option, text));
}

FitWindow parse_fit(std::string_view text) {
    auto const dots = text.find("..");
    if (dots != text.npos) {
        auto const first = parse_number<std::uint32_t>(text.substr(0, dots));
        auto const last = parse_number<std::uint32_t>(text.substr(dots + 2));
        if (first && last && *first < *last) return {*first, *last};
    }
    throw SceneError(
        fmt::format("--fit {}: give the first and the last sample of the fit as A..B, A less than B", text));
}

std::pair<std::string, std::string> parse_override(std::string_view text) {
    auto const sign = text.find('=');
    if (sign == text.npos || sign == 0) {
        throw SceneError(fmt::format("--set {}: give key=value, for instance --set contact.law=conservative", text));
    }
    return {std::string(text.substr(0, sign)), std::string(text.substr(sign + 1))};
}

Isa parse_isa(std::string_view text) {
    if (text == "auto") {
        cpu_backend(best_isa());  // or it says that no kernels of this program run here
        return best_isa();
    }
    std::string known = "auto", built, supported;
    for (Isa const isa : all_isas()) {
        known += fmt::format(", {}", name_of(isa));
        if (is_built(isa)) built += fmt::format("{}{}", built.empty() ? "" : ", ", name_of(isa));
        if (is_supported(isa)) supported += fmt::format("{}{}", supported.empty() ? "" : ", ", name_of(isa));
    }
    for (Isa const isa : all_isas()) {
        if (name_of(isa) != text) continue;
        if (is_supported(isa)) return isa;
        if (!is_built(isa)) throw SceneError(fmt::format("--isa {}: is not in this build, which has {}", text, built));
        throw SceneError(fmt::format("--isa {}: this machine does not have it; it has {}", text, supported));
    }
    throw SceneError(fmt::format("--isa {}: no such instruction set; use one of {}", text, known));
}

BackendRequest parse_backend(std::string_view backend, std::string_view isa) {
    BackendRequest request;
    if (backend == "cpu") {
        request.kind = BackendRequest::Kind::cpu;
    } else if (backend == "cuda") {
        request.kind = BackendRequest::Kind::cuda;
    } else if (backend != "auto") {
        throw SceneError(fmt::format("--backend {}: no such backend; use one of {}", backend, fmt::join(backend_words, ", ")));
    }
    if (isa == "auto") return request;
    if (request.kind == BackendRequest::Kind::cuda) {
        throw SceneError(
            fmt::format("--isa {}: is of the processor, and --backend is cuda; leave one of them out", isa));
    }
    request.isa = parse_isa(isa);
    return request;
}

std::string shell_quoted(std::string_view word) {
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
    if (!word.empty() && word.find_first_not_of(plain) == word.npos) return std::string(word);
    std::string quoted = "'";
    for (char const c : word) {
        if (c == '\'')
            quoted += "'\\''";
        else
            quoted += c;
    }
    return quoted + "'";
}

}  // namespace slideway::cli
