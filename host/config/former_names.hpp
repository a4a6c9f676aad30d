// What earlier versions called quantities: scenes may, and results of the formats of then do.
#pragma once

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>

namespace slideway {

struct FormerName {
    std::string_view then, now;
};
/// No key, series, signal or column of a result has a name of then.
inline constexpr FormerName former_names[] = {{"crank_work", "drive_work"}};  // in results of formats 1 and 2

/// A name of then as it is now; any other as it is.
constexpr std::string_view name_of_now(std::string_view name) {
    auto const* const found = std::ranges::find(former_names, name, &FormerName::then);
    return found == std::end(former_names) ? name : found->now;
}

/// A text with the names in it as they are now: "yield of crank_work [1]".
inline std::string words_of_now(std::string_view text) {
    constexpr std::string_view of_names = "abcdefghijklmnopqrstuvwxyz0123456789_";
    std::string words;
    while (!text.empty()) {
        auto const length = std::min(text.find_first_not_of(of_names), text.size());
        words += name_of_now(text.substr(0, length));
        text.remove_prefix(length);
        auto const between = std::min(text.find_first_of(of_names), text.size());
        words += text.substr(0, between);
        text.remove_prefix(between);
    }
    return words;
}

}  // namespace slideway
