#include "host/store/shard_store.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/base/fnv1a.hpp"

namespace slideway {

void ShardStore::begin_manifest() {
    for (int number = 1; !manifest_; ++number) {
        std::string const path = in_folder(folder_, manifest_name(number));
        std::error_code ignored;
        if (std::filesystem::exists(path, ignored)) continue;
        try {
            manifest_ = std::make_unique<LineFile>(path);
            sync_folder(folder_);
        } catch (FileError const&) {
            // Another rank may have been first.
            if (!manifest_ && std::filesystem::exists(path, ignored)) continue;
            throw;
        }
    }
}

Shard ShardStore::put_as(std::string name, MemberSet const& members, std::vector<std::byte> const& bytes) {
    Shard shard{std::move(name), bytes.size(), fnv1a(bytes), members};
    write_durably(in_folder(folder_, shard.name), bytes);
    begin_manifest();
    manifest_->append(manifest_line(shard));
    return shard;
}

void ShardStore::put(MemberSet const& members, std::vector<std::byte> const& bytes) {
    // Shards of a generation have no member in common, so the first one names it.
    auto const first = [](MemberSet const& of) { return of.ranges().front().first; };
    if (!join_) {
        put_as(fmt::format("{}{:010}.nc", shard_names::members, first(members)), members, bytes);
        return;
    }
    auto const name = [&](MemberSet const& of, std::size_t generation) {
        return fmt::format("{}{:010}-{}.bin", shard_names::statistics, first(of), generation);
    };
    if (generations_.empty()) generations_.emplace_back();
    generations_[0].push_back(put_as(name(members, 0), members, bytes));
    for (std::size_t g = 0; generations_[g].size() == shards_joined; ++g) {
        std::vector<Shard> const parts = std::move(generations_[g]);
        generations_[g].clear();
        if (generations_.size() == g + 1) generations_.emplace_back();
        MemberSet const all = members_of(parts);
        generations_[g + 1].push_back(put_as(name(all, g + 1), all, join_(folder_, parts)));
        for (Shard const& part : parts) remove_file(in_folder(folder_, part.name));
    }
}

}  // namespace slideway
