#include "host/base/suggest.hpp"

#include <algorithm>
#include <vector>

namespace slideway {
namespace {

std::string_view leaf(std::string_view name) {
    auto const dot = name.rfind('.');
    return dot == std::string_view::npos ? name : name.substr(dot + 1);
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
        int distance = std::min(edit_distance(name, candidate), 1 + edit_distance(leaf(name), leaf(candidate)));
        if (abbreviates(name, candidate) || abbreviates(candidate, name)) distance = std::min(distance, 1);
        if (distance < best_distance) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

}  // namespace slideway
