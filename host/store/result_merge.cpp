#include "host/store/result_merge.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <numeric>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/base/file_lock.hpp"
#include "host/base/numbers.hpp"
#include "host/store/memory_file.hpp"
#include "host/store/result_seal.hpp"

namespace slideway {
namespace {

/// Rows [row, row + count) of a shard belong at `place` and after it.
struct Run {
    std::size_t row, count, place;
};

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
std::vector<std::size_t> section_places(std::vector<MergedShard> const& shards, MemberSet const& all) {
    std::vector<std::size_t> begin(static_cast<std::size_t>(all.count()) + 1, 0);
    for (MergedShard const& shard : shards) {
        auto const file = shard.open();
        auto const variables = file->variables();
        std::vector<int> const counts = file->read<int>(*std::ranges::find(variables, "section_count", &DataFile::Variable::name));
        for (Run const& run : member_runs(shard.members, all)) {
            for (std::size_t i = 0; i < run.count; ++i) begin[run.place + i + 1] = static_cast<std::size_t>(counts[run.row + i]);
        }
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    return begin;
}

/// The rows of the sections of members.
std::vector<Run> section_runs(std::vector<Run> const& members, std::vector<std::size_t> const& begin) {
    std::vector<Run> rows;
    std::size_t row = 0;
    for (Run const& run : members) {
        rows.push_back({row, begin[run.place + run.count] - begin[run.place], begin[run.place]});
        row += rows.back().count;
    }
    return rows;
}

void copy_rows(DataFile const& from, DataFile::Variable const& variable, std::vector<Run> const& runs, DataFile& to, int target) {
    if (variable.size() == 0) return;
    std::size_t const row_bytes = variable.size() / variable.shape[0] * DataFile::size_of(variable.type);
    std::vector<std::byte> rows(variable.shape[0] * row_bytes);
    from.read(variable, rows.data());
    std::vector<std::size_t> start(variable.shape.size(), 0), count = variable.shape;
    for (Run const& run : runs) {
        if (run.count == 0) continue;
        start[0] = run.place;
        count[0] = run.count;
        to.write(target, start, count, rows.data() + run.row * row_bytes);
    }
}

/// The first value makes HDF5 allocate a variable's storage and fill it with NaN: a full disk so shows before the shards are read.
void reserve_space(DataFile& file, ResultColumns const& list, std::vector<int> const& variables) {
    for (std::size_t i = 0; i < variables.size(); ++i) {
        ResultColumn const& column = list.columns[i];
        if (!column.source || column.type != DataFile::Type::float64 || list.size(column) == 0) continue;
        std::size_t const rank = column.dimensions.size();
        file.write(variables[i], std::vector<std::size_t>(rank, 0), std::vector<std::size_t>(rank, 1), &nan);
    }
}

/// HDF5 may be told that a write failed, try again as it closes, and say nothing: what counts is what can be read.
void require_sound(std::string const& part) {
    NetcdfFile const file = NetcdfFile::open(part);
    if (!check_seal(file).intact()) throw FileError(part + ": does not hold what was written to it");
}

/// Writes those members of a block that have ended.
MemberSet write_block(DataFile& file, ResultLayout layout, BlockResult const& block) {
    std::vector<std::size_t> places;
    std::vector<std::vector<double>> study;
    layout.members = {};
    for (std::size_t i = 0; i < block.members.size(); ++i) {
        if (block.records[i].status == Status::not_run) continue;
        places.push_back(i);
        study.push_back(layout.study_row ? layout.study_row(block, i) : std::vector<double>());
        layout.members.add({block.members[i], 1});
        if (layout.sections > 0) layout.section_rows += sections_of(block, i).size() / section_columns(block.states());
    }
    if (places.empty()) return {};
    ResultColumns const list = result_columns(layout);
    std::vector<int> const variables = define(file, list, layout.members);
    for (std::size_t i = 0; i < variables.size(); ++i) {
        ResultColumn const& column = list.columns[i];
        ResultColumn::Numbers numbers;
        for (std::size_t k = 0; k < places.size() && column.source; ++k) column.source({block, places[k], study[k]}, numbers);
        put_numbers(file, variables[i], list, column, numbers);
    }
    return layout.members;
}

std::string lock_file_of(std::string const& path) { return path + ".part.lock"; }

/// The right to write the file: HDF5's own locks may be switched off, and it takes them only once the file is emptied.
FileLock lock_on(std::string const& path) {
    return {lock_file_of(path), FileLock::Kind::alone, FileLock::Wait::no, {path}};
}

void write_part(std::string const& part, std::string const& completeness, std::function<void(NetcdfFile& file)> const& write) {
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

MergedShard memory_shard(std::string const& name, ResultLayout const& layout, BlockResult const& block) {
    MemoryFile shard(name);
    MemberSet members = write_block(shard, layout, block);
    return {std::move(members), [shard] { return std::make_unique<MemoryFile>(shard); }};
}

ShardImage shard_image(std::string const& name, ResultLayout const& layout, Provenance const& provenance, BlockResult const& block) {
    NetcdfFile file = NetcdfFile::create_in_memory(name);
    put_attributes(file, DataFile::global, attributes_of(provenance));
    ShardImage image{write_block(file, layout, block), {}};
    if (image.members.empty()) return image;
    file.put(DataFile::global, "completeness", "shard");
    seal(file);
    image.bytes = file.close_to_bytes();
    return image;
}

void write_merged(DataFile& file, std::vector<MergedShard> const& shards, ResultMerge& merge) {
    MemberSet const& all = merge.layout.members;
    std::vector<std::size_t> sections;
    if (merge.layout.sections > 0) {
        sections = section_places(shards, all);
        merge.layout.section_rows = sections.back();
    }
    put_attributes(file, DataFile::global, attributes_of(merge.provenance));
    ResultColumns const list = result_columns(merge.layout);
    std::vector<int> const variables = define(file, list, all);
    reserve_space(file, list, variables);
    for (MergedShard const& shard : shards) {
        merge.may_pause();
        auto const from = shard.open();
        std::vector<Run> const members = member_runs(shard.members, all);
        std::vector<Run> const rows = sections.empty() ? std::vector<Run>() : section_runs(members, sections);
        for (DataFile::Variable const& variable : from->variables()) {
            auto const column = std::ranges::find(list.columns, variable.name, &ResultColumn::name);
            if (column == list.columns.end()) throw FileError(fmt::format("{}: has a {} that no result of its scene has", from->path(), variable.name));
            if (!column->source) continue;
            int const target = variables[static_cast<std::size_t>(column - list.columns.begin())];
            copy_rows(*from, variable, variable.dimensions.front() == "member" ? members : rows, file, target);
        }
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

void write_result(std::string const& path, std::string const& completeness, std::function<void(NetcdfFile& file)> const& write, Existing existing) {
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

void merge_shards(ShardFolder const& folder, std::vector<Shard> const& shards, ResultMerge merge, std::string const& path) {
    std::vector<MergedShard> merged;
    merged.reserve(shards.size());
    for (Shard const& shard : shards) {
        auto const open = [&folder, &shard] { return std::make_unique<NetcdfFile>(NetcdfFile::open_in_memory(shard.name, folder.read(shard))); };
        merged.push_back({shard.members, open});
    }
    merge_shards(merged, std::move(merge), path);
}

}  // namespace slideway
