#include "host/store/shard_names.hpp"

#include <algorithm>
#include <cstddef>

namespace slideway {
namespace {

bool take(std::string_view& text, std::string_view start) {
    if (!text.starts_with(start)) return false;
    text.remove_prefix(start.size());
    return true;
}

/// A number as it is printed with at least `width` digits: more only where it has them.
bool take_number(std::string_view& text, std::size_t width) {
    auto const is_digit = [](char c) { return c >= '0' && c <= '9'; };
    auto const end = std::find_if_not(text.begin(), text.end(), is_digit);
    auto const digits = static_cast<std::size_t>(end - text.begin());
    if (digits < width || (digits > width && text.front() == '0')) return false;
    text.remove_prefix(digits);
    return true;
}

constexpr std::size_t member_digits = 10, manifest_digits = 6;

bool is_shard(std::string_view name) {
    if (take(name, shard_names::members)) return take_number(name, member_digits) && name == ".nc";
    return take(name, shard_names::statistics) && take_number(name, member_digits) && take(name, "-") &&
           take_number(name, 1) && name == ".bin";
}

bool is_manifest(std::string_view name) {
    return take(name, shard_names::manifest) && take_number(name, manifest_digits) && name == ".txt";
}

/// "lock", "lock-begin", "lock-3-of-8"
bool is_lock(std::string_view name) {
    if (!take(name, shard_names::lock)) return false;
    if (name.empty() || name == "-begin") return true;
    return take(name, "-") && take_number(name, 1) && take(name, "-of-") && take_number(name, 1) && name.empty();
}

}  // namespace

ShardFile kind_of(std::string_view name) {
    if (is_lock(name)) return ShardFile::lock;
    constexpr std::string_view temporary = ".tmp";
    if (name.ends_with(temporary)) name.remove_suffix(temporary.size());
    for (std::string_view const identity : {shard_names::identity, shard_names::identity_copy, shard_names::finished}) {
        if (name == identity) return ShardFile::identity;
    }
    if (is_shard(name) || is_manifest(name) || name == shard_names::table) return ShardFile::content;
    return take(name, shard_names::damaged) && is_shard(name) ? ShardFile::content : ShardFile::foreign;
}

}  // namespace slideway
