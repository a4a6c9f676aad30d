#include "host/store/result_merge.hpp"

#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/base/file_lock.hpp"
#include "host/base/numbers.hpp"
#include "host/store/result_seal.hpp"
#include "host/store/result_definition.hpp"

namespace slideway {
namespace {

using Variables = std::map<std::string, DataFile::Variable>;

/// Rows [row, row + count) of a shard belong at `place` and after it.
struct Run {
    std::size_t row, count, place;
};

Variables variables_of(DataFile const& file) {
    Variables variables;
    for (DataFile::Variable& variable : file.variables()) variables.emplace(variable.name, std::move(variable));
    return variables;
}

/// Where the members of a shard belong among those of the run.
std::vector<Run> member_runs(MemberSet const& shard, MemberSet const& all) {
    std::vector<Run> runs;
    std::size_t row = 0;
    for (MemberRange const& range : shard.ranges()) {
        auto const count = static_cast<std::size_t>(range.count);
        // A range of a shard lies within one of the run: it was drawn from it.
        runs.push_back({row, count, static_cast<std::size_t>(all.place(range.first))});
        row += count;
    }
    return runs;
}

/// Where the section rows of each member begin, by place; one more entry is the end.
class SectionPlaces {
public:
    SectionPlaces(std::vector<MergedShard> const& shards, MemberSet const& all) : begin_(static_cast<std::size_t>(all.count()) + 1, 0) {
        for (MergedShard const& shard : shards) {
            shard.open([&](DataFile const& file) {
                std::vector<int> const counts = file.read<int>(variables_of(file).at("section_count"));
                for (Run const& run : member_runs(shard.members, all)) {
                    for (std::size_t i = 0; i < run.count; ++i) begin_[run.place + i + 1] = static_cast<std::uint64_t>(counts[run.row + i]);
                }
            });
        }
        for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    }
    std::uint64_t rows() const { return begin_.back(); }
    /// The rows of a run of members.
    std::size_t begin(Run const& run) const { return static_cast<std::size_t>(begin_[run.place]); }
    std::size_t count(Run const& run) const { return static_cast<std::size_t>(begin_[run.place + run.count] - begin_[run.place]); }

private:
    std::vector<std::uint64_t> begin_;
};

/// Copies the rows of one shard into the file of all.
class ShardCopy {
public:
    ShardCopy(DataFile& to, Variables const& variables) : to_(to), variables_(variables) {}

    void copy(DataFile const& from, std::vector<Run> const& members, SectionPlaces const* sections) {
        std::vector<Run> rows;
        std::size_t row = 0;
        for (Run const& run : members) {
            if (sections == nullptr) break;
            rows.push_back({row, sections->count(run), sections->begin(run)});
            row += rows.back().count;
        }
        for (DataFile::Variable const& variable : from.variables()) {
            std::string const dimension = from.first_dimension(variable);
            if (dimension == "member") copy_rows(from, variable, members);
            if (dimension == "section") copy_rows(from, variable, rows);
        }
    }

private:
    void copy_rows(DataFile const& from, DataFile::Variable const& variable, std::vector<Run> const& runs) {
        DataFile::Variable const& target = variables_.at(variable.name);
        if (variable.size() == 0) return;
        std::size_t const row_bytes = variable.size() / variable.shape[0] * DataFile::size_of(variable.type);
        buffer_.resize(variable.shape[0] * row_bytes);
        from.read(variable.id, buffer_.data());
        std::vector<std::size_t> start(variable.shape.size(), 0), count = variable.shape;
        for (Run const& run : runs) {
            if (run.count == 0) continue;
            start[0] = run.place;
            count[0] = run.count;
            to_.write(target.id, start, count, buffer_.data() + run.row * row_bytes);
        }
    }

    DataFile& to_;
    Variables const& variables_;
    std::vector<std::byte> buffer_;
};

/// The first value makes HDF5 allocate a variable's storage and fill it with NaN: a full disk so shows before the shards are read.
void reserve_space(DataFile& file) {
    for (DataFile::Variable const& variable : file.variables()) {
        if (variable.type != DataFile::Type::float64 || variable.size() == 0) continue;
        std::string const dimension = file.first_dimension(variable);
        if (dimension != "member" && dimension != "section") continue;
        std::size_t const rank = variable.shape.size();
        file.write(variable.id, std::vector<std::size_t>(rank, 0), std::vector<std::size_t>(rank, 1), &nan);
    }
}

/// HDF5 may be told that a write failed, try again as it closes, and say nothing: what counts is what can be read.
void require_sound(std::string const& part) {
    NetcdfFile const file = NetcdfFile::open(part);
    if (!check_seal(file).intact()) throw FileError(part + ": does not hold what was written to it");
}

std::string lock_file_of(std::string const& path) { return path + ".part.lock"; }

/// The right to write the file: HDF5's own locks may be switched off, and it takes them only once the file is emptied.
FileLock lock_on(std::string const& path) {
    return {lock_file_of(path), FileLock::Kind::alone, FileLock::Wait::no, {path}};
}

void write_part(std::string const& part, std::string const& completeness,
                std::function<void(NetcdfFile& file)> const& write) {
    try {
        NetcdfFile file = NetcdfFile::create(part);
        write(file);
        file.put(DataFile::global, "completeness", completeness);
        file.flush();
        seal(file);
        file.close();
        require_sound(part);
    } catch (...) {
        std::remove(part.c_str());
        throw;
    }
}

}  // namespace

void write_merged(DataFile& file, std::vector<MergedShard> const& shards, ResultMerge& merge) {
    std::optional<SectionPlaces> sections;
    if (merge.layout.sections > 0) {
        sections.emplace(shards, merge.layout.members);
        merge.layout.section_rows = sections->rows();
    }
    define_result(file, merge.layout, merge.provenance);
    reserve_space(file);
    Variables const variables = variables_of(file);
    ShardCopy shard_copy(file, variables);
    for (MergedShard const& shard : shards) {
        merge.may_pause();
        shard.open([&](DataFile const& contents) {
            shard_copy.copy(contents, member_runs(shard.members, merge.layout.members), sections ? &*sections : nullptr);
        });
    }
    merge.may_pause();
    if (merge.conclude) merge.conclude(file);
    merge.may_pause();
}

/// A lock is a file without a byte, and beside it a part may lie that a killed merge has left: what else has these names is somebody's.
void require_room_beside(std::string const& path) {
    std::error_code ignored;
    auto const is_in_the_way = [](std::string const& name) {
        return FileError(name + ": is in the way, and no merge left it; move it away, or give another name with -o");
    };
    std::string const part = path + ".part", lock_file = lock_file_of(path);
    bool const left = is_there(lock_file);
    if (left && !(std::filesystem::is_regular_file(lock_file, ignored) && std::filesystem::file_size(lock_file, ignored) == 0))
        throw is_in_the_way(lock_file);
    if (is_there(part) && !(left && std::filesystem::is_regular_file(part, ignored))) throw is_in_the_way(part);
}

void write_result(std::string const& path, std::string const& completeness,
                  std::function<void(NetcdfFile& file)> const& write, Existing existing) {
    std::string const part = path + ".part", lock_file = lock_file_of(path);
    require_room_beside(path);
    FileLock lock = lock_on(path);
    bool ours = false;
    try {
        remove_file(part);
        ours = true;
        write_part(part, completeness, write);
        rename_durably(part, path, existing);
    } catch (...) {
        // Beside a part that stays, the lock says whose it is.
        std::error_code ignored;
        if (!ours || !std::filesystem::exists(part, ignored)) std::remove(lock_file.c_str());
        throw;
    }
    lock.remove();
}

void remove_merge_lock(std::string const& path) {
    if (is_there(lock_file_of(path))) lock_on(path).remove();
}

void merge_shards(std::vector<MergedShard> const& shards, ResultMerge merge, std::string const& path) {
    write_result(path, merge.completeness, [&](NetcdfFile& file) { write_merged(file, shards, merge); }, merge.existing);
}

void merge_shards(ShardFolder const& folder, std::vector<Shard> const& shards, ResultMerge merge,
                  std::string const& path) {
    std::vector<MergedShard> merged;
    merged.reserve(shards.size());
    for (Shard const& shard : shards) {
        merged.push_back({shard.members, [&folder, &shard](MergedShard::Use const& use) {
                              std::vector<std::byte> const bytes = folder.read(shard);
                              use(NetcdfFile::open_in_memory(shard.name, bytes));
                          }});
    }
    merge_shards(merged, std::move(merge), path);
}

}  // namespace slideway
