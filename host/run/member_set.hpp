// Which members of a scene: those that are asked for, those that are done, those that are left.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace slideway {

/// Members [first, first + count) of a scene.
struct MemberRange {
    std::uint64_t first = 0;
    std::uint64_t count = 1;
    std::uint64_t end() const { return first + count; }
    friend bool operator==(MemberRange const&, MemberRange const&) = default;
};

/// A set of members as ascending ranges with gaps between them: small even where the members are many.
class MemberSet {
public:
    MemberSet() = default;
    explicit MemberSet(MemberRange range) { add(range); }
    static MemberSet of(std::span<std::uint64_t const> members);  // in any order

    void add(MemberRange range);
    void add(MemberSet const& other);
    MemberSet without(MemberSet const& other) const;
    MemberSet common(MemberSet const& other) const { return without(without(other)); }

    bool empty() const { return ranges_.empty(); }
    std::uint64_t count() const;
    bool contains(std::uint64_t member) const;
    bool overlaps(MemberSet const& other) const;
    /// How many members are smaller.
    std::uint64_t place(std::uint64_t member) const;
    /// The members from the `offset`-th smallest on, `count` of them or as many as there are.
    std::vector<std::uint64_t> members(std::uint64_t offset, std::uint64_t count) const;
    std::span<MemberRange const> ranges() const { return ranges_; }

    /// "0-511,600,700-799"; "" for none.
    std::string text() const;
    /// The other way; nothing if it is no such text.
    static std::optional<MemberSet> parse(std::string_view text);

    friend bool operator==(MemberSet const&, MemberSet const&) = default;

private:
    std::vector<MemberRange> ranges_;
};

}  // namespace slideway
