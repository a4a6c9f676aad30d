#include "host/study/tolerance_members.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "host/base/error.hpp"

namespace slideway {

std::size_t design_width(Scene const& scene) { return scene.design.kind == DesignKind::saltelli ? scene.variations.size() + 2 : 0; }

ToleranceMembers::ToleranceMembers(ResultView const& results, std::size_t width, std::uint64_t members)
    : results_(results), width_(width) {
    std::vector<double> const numbers = results.values("member");
    if (!std::is_sorted(numbers.begin(), numbers.end())) {
        places_.resize(numbers.size());
        std::iota(places_.begin(), places_.end(), std::size_t{0});
        std::sort(places_.begin(), places_.end(),
                  [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
    }
    std::vector<double> const statuses = results.values("status");
    if (statuses.size() != numbers.size()) {
        throw FileError(fmt::format("{}: has {} numbers of members and {} statuses; the file is damaged",
                                    results.path(), numbers.size(), statuses.size()));
    }
    numbers_.reserve(numbers.size());
    statuses_.reserve(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        std::size_t const place = places_.empty() ? i : places_[i];
        double const number = numbers[place];
        if (!(number >= 0) || number >= static_cast<double>(members)) {
            throw FileError(fmt::format("{}: holds member {}, but the design has {} members; give the scene of this result", results.path(), number, members));
        }
        numbers_.push_back(static_cast<std::uint64_t>(number));
        if (i > 0 && numbers_[i] == numbers_[i - 1]) {
            throw FileError(fmt::format("{}: holds member {} twice; the file is damaged", results.path(), numbers_[i]));
        }
        statuses_.push_back(status_of(statuses[place]));
    }
}

std::vector<double> ToleranceMembers::column(std::string const& variable, std::size_t index) const {
    std::vector<double> stored = results_.column(variable, index);
    if (stored.size() != size()) throw FileError(fmt::format("{}: {} is not of the members", results_.path(), variable));
    if (places_.empty()) return stored;
    std::vector<double> ordered;
    ordered.reserve(stored.size());
    for (std::size_t const place : places_) ordered.push_back(stored[place]);
    return ordered;
}

std::vector<StatusCount> ToleranceMembers::count(bool draws_only) const {
    StatusCounts counts;
    for (std::size_t i = 0; i < size(); ++i) {
        if (!draws_only || is_draw(i)) ++counts[static_cast<unsigned char>(status(i))];
    }
    return listed(counts);
}

}  // namespace slideway
