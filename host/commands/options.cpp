#include "host/commands/commands.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/base/error.hpp"
#include "host/base/numbers.hpp"
#include "host/base/text.hpp"

namespace slideway::cli {

bool FailureLimit::exceeded(std::uint64_t failed, std::uint64_t members) const {
    double const allowed = percent ? value / 100 * static_cast<double>(members) : value;
    return static_cast<double>(failed) > allowed;
}

std::string FailureLimit::text() const { return fmt::format("{}{}", value, percent ? "%" : ""); }

namespace {

/// The value, if the word has one that can be used.
template <class Value, class Accepts>
Value given(std::optional<Value> const& value, Accepts const& accepts, std::string_view option, std::string_view word, std::string_view wanted) {
    if (value && accepts(*value)) return *value;
    throw SceneError(fmt::format("{} {}: give {}", option, word, wanted));
}

/// "3..9", "1/4".
template <class Number> std::optional<std::pair<Number, Number>> parse_pair(std::string_view word, std::string_view between) {
    auto const at = word.find(between);
    if (at == word.npos) return {};
    auto const first = parse_number<Number>(word.substr(0, at)), second = parse_number<Number>(word.substr(at + between.size()));
    return first && second ? std::optional(std::pair(*first, *second)) : std::nullopt;
}

}  // namespace

std::function<std::uint32_t(std::string_view, std::string_view)> whole_number(std::uint32_t least, std::uint32_t most) {
    return [=](std::string_view option, std::string_view word) {
        auto const accepts = [=](std::uint32_t number) { return least <= number && number <= most; };
        return given(parse_number<std::uint32_t>(word), accepts, option, word,
                     most < ~0u ? fmt::format("a whole number from {} to {}", least, most) : fmt::format("a whole number, {} or more", least));
    };
}

double parse_hours(std::string_view option, std::string_view word) {
    return given(parse_number<double>(word), [](double hours) { return hours >= 0; }, option, word, "a number of hours, 0 or more");
}

double parse_seconds(std::string_view option, std::string_view word) {
    auto const accepts = [](double seconds) { return seconds > 0 && std::isfinite(seconds); };
    return given(parse_number<double>(word), accepts, option, word, "a number of seconds, more than 0");
}

double parse_time(std::string_view option, std::string_view word) {
    return given(parse_number<double>(word), [](double seconds) { return std::isfinite(seconds); }, option, word, "a number of seconds");
}

std::uint64_t parse_member(std::string_view option, std::string_view word) {
    return given(parse_number<std::uint64_t>(word), [](std::uint64_t) { return true; }, option, word, "the number of a member, counted from 0");
}

MemberRange parse_member_range(std::string_view option, std::string_view word) {
    auto const accepts = [](auto const& ends) { return ends.first <= ends.second && ends.second < std::numeric_limits<std::uint64_t>::max(); };
    auto const [first, last] = given(parse_pair<std::uint64_t>(word, ".."), accepts, option, word, "the first and the last member as A..B, counted from 0");
    return {first, last - first + 1};
}

RunPart parse_part(std::string_view option, std::string_view word) {
    auto const accepts = [](auto const& part) { return part.first >= 1 && part.first <= part.second; };
    auto const [number, parts] = given(parse_pair<std::uint32_t>(word, "/"), accepts, option, word, "the part and how many there are as I/N, from 1/N to N/N");
    return {number, parts, true};
}

FailureLimit parse_failure_limit(std::string_view option, std::string_view word) {
    bool const percent = word.ends_with('%');
    auto const accepts = [&](double value) { return value >= 0 && (percent ? value <= 100 : std::isfinite(value) && value == std::floor(value)); };
    return {given(parse_number<double>(word.substr(0, word.size() - (percent ? 1 : 0))), accepts, option, word, "a number of members (3) or a percentage (0.5%)"), percent};
}

FitWindow parse_fit(std::string_view option, std::string_view word) {
    auto const accepts = [](auto const& ends) { return ends.first < ends.second; };
    auto const [first, last] = given(parse_pair<std::uint32_t>(word, ".."), accepts, option, word, "the first and the last sample of the fit as A..B, A less than B");
    return {first, last};
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
    auto const names = [](auto accepts) {
        std::vector<std::string_view> all;
        for (Isa const isa : built_isas()) {
            if (accepts(isa)) all.push_back(name_of(isa));
        }
        return fmt::format("{}", fmt::join(all, ", "));
    };
    std::string const built = names([](Isa) { return true; });
    for (Isa const isa : all_isas()) {
        if (name_of(isa) != text) continue;
        if (is_supported(isa)) return isa;
        if (!is_built(isa)) throw SceneError(fmt::format("--isa {}: is not in this build, which has {}", text, built));
        throw SceneError(fmt::format("--isa {}: this machine does not have it; it has {}", text, names(is_supported)));
    }
    throw SceneError(fmt::format("--isa {}: no such instruction set; use one of auto, {}", text, built));
}

BackendRequest parse_backend(std::string_view backend, std::string_view isa) {
    auto const word = std::ranges::find(backend_words, backend);
    if (word == std::end(backend_words)) {
        throw SceneError(fmt::format("--backend {}: no such backend; use one of {}", backend, fmt::join(backend_words, ", ")));
    }
    BackendRequest request;
    request.kind = static_cast<BackendRequest::Kind>(word - backend_words);
    if (isa == "auto") return request;
    if (request.kind == BackendRequest::Kind::cuda) {
        throw SceneError(
            fmt::format("--isa {}: is of the processor, and --backend is cuda; leave one of them out", isa));
    }
    request.isa = parse_isa(isa);
    return request;
}

namespace {

/// As bash, zsh and ksh read it, and POSIX since 2024.
std::string octal_quoted(std::string_view word) {
    std::string quoted = "$'";
    for (char const c : word) {
        auto const byte = static_cast<unsigned char>(c);
        bool const as_it_is = byte >= 0x20 && byte < 0x7f && c != '\'' && c != '\\';
        quoted += as_it_is ? std::string(1, c) : fmt::format("\\{:03o}", byte);
    }
    return quoted + "'";
}

}  // namespace

std::string shell_quoted(std::string_view word) {
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
    if (!word.empty() && word.find_first_not_of(plain) == word.npos) return std::string(word);
    if (!is_plain(word)) return octal_quoted(word);
    std::string quoted = "'";
    for (char const c : word) {
        quoted += c == '\'' ? "'\\''" : std::string(1, c);
    }
    return quoted + "'";
}

}  // namespace slideway::cli
