#include "host/base/text.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include <fmt/format.h>

namespace slideway {
namespace {

/// First and last code point of what is obeyed instead of seen.
constexpr std::uint32_t obeyed[][2] = {
    {0x00, 0x1f}, {0x7f, 0x9f}, {0x061c, 0x061c}, {0x200e, 0x200f}, {0x2028, 0x202e}, {0x2066, 0x206f}};

bool is_obeyed(std::uint32_t code) {
    for (auto const& [first, last] : obeyed) {
        if (first <= code && code <= last) return true;
    }
    return false;
}

std::string escaped(std::string_view text, std::size_t longest, std::string_view kept) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        if (result.size() > longest) return result + "...";
        std::size_t const length = character_length(text, at);
        if (length == 0) {
            result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[at++]));
            continue;
        }
        std::string_view const character = text.substr(at, length);
        std::uint32_t const code = code_point(character);
        if (is_obeyed(code) && kept.find(text[at]) == kept.npos)
            result += fmt::format("\\u{:04x}", code);
        else
            result += character;
        at += length;
    }
    return result;
}

}  // namespace

std::string shown(std::string_view text, std::size_t longest) { return escaped(text, longest, ""); }

std::string shown_lines(std::string_view text) { return escaped(text, std::string_view::npos, "\n\t"); }

bool is_plain(std::string_view text) { return shown(text) == text; }

namespace {

std::string_view leaf(std::string_view name) {
    auto const dot = name.rfind('.');
    return dot == std::string_view::npos ? name : name.substr(dot + 1);
}

/// Which letters a name has, by their last six bits.
std::uint64_t letters_of(std::string_view name) {
    std::uint64_t letters = 0;
    for (char const c : name) letters |= std::uint64_t{1} << (static_cast<unsigned char>(c) & 63u);
    return letters;
}

/// The distance of two names where it is less than the limit, else the limit.  An edit changes the length by one at most, and takes at most one letter that
/// the other name has not: most names are told apart so, without a distance that costs the product of their lengths.
int distance_below(int limit, std::string_view a, std::string_view b) {
    auto const least = static_cast<int>(std::max(a.size(), b.size()) - std::min(a.size(), b.size()));
    if (least >= limit) return limit;
    std::uint64_t const of_a = letters_of(a), of_b = letters_of(b);
    if (std::max(std::popcount(of_a & ~of_b), std::popcount(of_b & ~of_a)) >= limit) return limit;
    return std::min(edit_distance(a, b), limit);
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
    std::vector<int> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = static_cast<int>(j);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before.swap(above);
        above.swap(row);
        row[0] = static_cast<int>(i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            int const change = a[i - 1] == b[j - 1] ? 0 : 1;
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = std::min(row[j], before[j - 2] + 1);
            }
        }
    }
    return row[b.size()];
}

std::string_view nearest_name(std::string_view name, std::span<std::string_view const> names) {
    constexpr std::size_t longest = 100;  // nobody mistypes a name to more; the distance costs the product of lengths
    if (name.size() > longest) return {};
    std::string_view best;
    auto const abbreviates = [](std::string_view a, std::string_view b) {
        return a.size() >= 3 && b.starts_with(a) && b.find('.', a.size()) == std::string_view::npos;
    };
    int best_distance = 1 + static_cast<int>(std::max<std::size_t>(1, leaf(name).size() / 3));
    for (std::string_view const candidate : names) {
        // A key in the wrong table is likelier mistaken than one in the right table mistyped by two letters.
        int distance = std::min(distance_below(best_distance, name, candidate), 1 + distance_below(best_distance - 1, leaf(name), leaf(candidate)));
        if (abbreviates(name, candidate) || abbreviates(candidate, name)) distance = std::min(distance, 1);
        if (distance < best_distance) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

}  // namespace slideway
