// What a run calls its files in a folder of shards, and how they are told from files of others.
#pragma once

#include <string_view>

namespace slideway {

namespace shard_names {
inline constexpr std::string_view identity = "run.toml", manifest = "manifest-", lock = "lock";
/// The same again: whichever is whole counts.
inline constexpr std::string_view identity_copy = "run-copy.toml";
/// What the identity is called once the result stands elsewhere, while the folder is cleared.
inline constexpr std::string_view finished = "finished.toml";
inline constexpr std::string_view members = "members-", statistics = "statistics-";  // what shards begin with
inline constexpr std::string_view damaged = "damaged-";  // before the name of one that is put aside
inline constexpr std::string_view table = "table.csv";   // the study's table, for whom the original is out of reach
}  // namespace shard_names

enum class ShardFile {
    foreign,
    identity,  // run.toml, its copy, finished.toml
    content,   // shards, manifests, what is damaged, the table: of worth only beside the identity
    lock
};

/// By the exact forms of the names that a run gives; a temporary file `.tmp` is of the kind of the one that it was to become.
/// A name that is merely alike (`members-of-the-board.nc`) is foreign.
ShardFile kind_of(std::string_view name);

}  // namespace slideway
