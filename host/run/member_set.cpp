#include "host/run/member_set.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

namespace slideway {

MemberSet MemberSet::of(std::span<std::uint64_t const> members) {
    std::vector<std::uint64_t> sorted(members.begin(), members.end());
    std::sort(sorted.begin(), sorted.end());
    MemberSet set;
    for (std::uint64_t const member : sorted) set.add({member, 1});
    return set;
}

void MemberSet::add(MemberRange range) {
    if (range.count == 0) return;
    // The ranges that overlap or touch the new one become one with it.
    auto const first = std::lower_bound(ranges_.begin(), ranges_.end(), range.first,
                                        [](MemberRange const& a, std::uint64_t member) { return a.end() < member; });
    auto last = first;
    std::uint64_t begin = range.first, end = range.end();
    for (; last != ranges_.end() && last->first <= range.end(); ++last) {
        begin = std::min(begin, last->first);
        end = std::max(end, last->end());
    }
    MemberRange const joined{begin, end - begin};
    if (first == last) {
        ranges_.insert(first, joined);
    } else {
        *first = joined;
        ranges_.erase(first + 1, last);
    }
}

void MemberSet::add(MemberSet const& other) {
    for (MemberRange const& range : other.ranges_) add(range);
}

MemberSet MemberSet::without(MemberSet const& other) const {
    MemberSet rest;
    auto hole = other.ranges_.begin();
    for (MemberRange const& range : ranges_) {
        std::uint64_t from = range.first;
        while (hole != other.ranges_.end() && hole->end() <= from) ++hole;
        for (auto next = hole; next != other.ranges_.end() && next->first < range.end(); ++next) {
            if (next->first > from) rest.ranges_.push_back({from, next->first - from});
            from = std::max(from, next->end());
        }
        if (from < range.end()) rest.ranges_.push_back({from, range.end() - from});
    }
    return rest;
}

std::uint64_t MemberSet::count() const {
    std::uint64_t sum = 0;
    for (MemberRange const& range : ranges_) sum += range.count;
    return sum;
}

bool MemberSet::contains(std::uint64_t member) const {
    auto const range =
        std::partition_point(ranges_.begin(), ranges_.end(), [&](MemberRange const& a) { return a.end() <= member; });
    return range != ranges_.end() && range->first <= member;
}

bool MemberSet::overlaps(MemberSet const& other) const {
    return std::any_of(other.ranges_.begin(), other.ranges_.end(), [this](MemberRange const& range) {
        auto const next = std::partition_point(ranges_.begin(), ranges_.end(),
                                               [&](MemberRange const& own) { return own.end() <= range.first; });
        return next != ranges_.end() && next->first < range.end();
    });
}

std::uint64_t MemberSet::place(std::uint64_t member) const {
    std::uint64_t smaller = 0;
    for (MemberRange const& range : ranges_) {
        if (range.first >= member) break;
        smaller += std::min(range.count, member - range.first);
    }
    return smaller;
}

std::vector<std::uint64_t> MemberSet::members(std::uint64_t offset, std::uint64_t count) const {
    std::vector<std::uint64_t> found;
    for (MemberRange const& range : ranges_) {
        if (found.size() == count) break;
        if (offset >= range.count) {
            offset -= range.count;
            continue;
        }
        std::uint64_t const taken = std::min<std::uint64_t>(range.count - offset, count - found.size());
        for (std::uint64_t i = 0; i < taken; ++i) found.push_back(range.first + offset + i);
        offset = 0;
    }
    return found;
}

std::string MemberSet::text() const {
    std::string text;
    for (MemberRange const& range : ranges_) {
        if (!text.empty()) text += ',';
        text += std::to_string(range.first);
        if (range.count > 1) text += '-' + std::to_string(range.end() - 1);
    }
    return text;
}

std::optional<MemberSet> MemberSet::parse(std::string_view text) {
    MemberSet set;
    char const* at = text.data();
    char const* const end = at + text.size();
    auto const number = [&](std::uint64_t& value) {
        auto const [next, error] = std::from_chars(at, end, value);
        at = next;
        return error == std::errc{};
    };
    while (at != end) {
        std::uint64_t first = 0, last = 0;
        if (!number(first)) return std::nullopt;
        last = first;
        if (at != end && *at == '-') {
            ++at;
            if (!number(last) || last < first) return std::nullopt;
        }
        if (last == std::numeric_limits<std::uint64_t>::max())
            return std::nullopt;  // the end of its range has no number
        set.add({first, last - first + 1});
        if (at == end) break;
        if (*at++ != ',' || at == end) return std::nullopt;
    }
    return set;
}

}  // namespace slideway
