// Sections of the members' orbits as CF contiguous ragged arrays.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "host/driver/block_result.hpp"
#include "host/output/netcdf_file.hpp"

namespace slideway {

/// `section_count(member)` says how many rows of `section_time(section)`, `section_y(section)` … belong to each member, in the order of
/// the members (CF-1.8, 9.3.3).  Blocks may come in any order: one that comes early waits for its turn, so that the file
/// is the same whatever the order.
class SectionWriter {
public:
    /// @param crossings of a surface: members may have more than are stored, and `section_crossings(member)` says how many.
    void define(NetcdfFile& file, int member_dimension, bool crossings);
    void write(NetcdfFile& file, BlockResult const& block);
    /// Writes what still waits; members that never came have no rows.
    void finish(NetcdfFile& file, std::uint64_t members);

private:
    /// The rows of a block's members, one after another.
    struct Rows {
        std::vector<int> counts;     // [members]
        std::vector<int> crossings;  // [members]
        std::vector<double> columns[section_columns];
    };
    static Rows rows_of(BlockResult const& block);
    void append(NetcdfFile& file, Rows const& rows);

    int count_ = -1;
    int crossings_ = -1;  // not there
    int columns_[section_columns] = {};
    std::map<std::uint64_t, Rows> waiting_;  // by their first member
    std::uint64_t next_member_ = 0;
    std::size_t next_row_ = 0;
};

}  // namespace slideway
