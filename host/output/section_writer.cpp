#include "host/output/section_writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "kernels/observers/quantities.hpp"

namespace slideway {

void SectionWriter::define(NetcdfFile& file, int member_dimension, bool crossings) {
    int const dimension = file.add_dimension("section", NetcdfFile::unlimited);
    count_ = file.add_variable("section_count", NetcdfFile::Type::int32, std::array{member_dimension});
    file.put_text(count_, "long_name", "sections of the member");
    file.put_text(count_, "units", "1");
    file.put_text(count_, "sample_dimension", "section");
    if (crossings) {
        crossings_ = file.add_variable("section_crossings", NetcdfFile::Type::int32, std::array{member_dimension});
        file.put_text(crossings_, "long_name", "crossings of the section, also those beyond study.max_crossings");
        file.put_text(crossings_, "units", "1");
    }
    auto const add = [&](std::size_t column, std::string const& name, char const* unit, std::string const& long_name) {
        columns_[column] = file.add_variable(name, NetcdfFile::Type::float64, std::array{dimension});
        file.put_text(columns_[column], "units", unit);
        file.put_text(columns_[column], "long_name", long_name);
    };
    add(0, "section_time", "s", "time of the section since the start of the run");
    for (std::size_t i = 0; i < state_size; ++i) {
        SeriesInfo const& info = series_table[i];
        add(1 + i, std::string("section_") + info.name, info.unit, std::string(info.long_name) + " at the section");
    }
}

SectionWriter::Rows SectionWriter::rows_of(BlockResult const& block) {
    Rows rows;
    std::size_t const members = block.records.size();
    std::size_t const most = members == 0 ? 0 : block.sections.size() / (members * section_columns);
    for (std::size_t member = 0; member < members; ++member) {
        int count = 0;
        for (std::size_t i = 0; i < most; ++i) {
            auto const row = block.sections.subspan((member * most + i) * section_columns, section_columns);
            if (std::isnan(row[0])) break;
            for (std::size_t j = 0; j < section_columns; ++j) rows.columns[j].push_back(row[j]);
            ++count;
        }
        rows.counts.push_back(count);
        constexpr std::uint64_t largest = std::numeric_limits<int>::max();
        rows.crossings.push_back(static_cast<int>(std::min(block.records[member].crossings, largest)));
    }
    return rows;
}

void SectionWriter::append(NetcdfFile& file, Rows const& rows) {
    std::size_t const members = rows.counts.size(), sections = rows.columns[0].size();
    std::size_t const first = static_cast<std::size_t>(next_member_);
    file.write(count_, std::array{first}, std::array{members}, rows.counts.data());
    if (crossings_ >= 0) file.write(crossings_, std::array{first}, std::array{members}, rows.crossings.data());
    if (sections > 0) {
        for (std::size_t j = 0; j < section_columns; ++j) {
            file.write(columns_[j], std::array{next_row_}, std::array{sections}, rows.columns[j].data());
        }
    }
    next_member_ += members;
    next_row_ += sections;
}

void SectionWriter::write(NetcdfFile& file, BlockResult const& block) {
    waiting_.emplace(block.first, rows_of(block));
    for (auto next = waiting_.begin(); next != waiting_.end() && next->first == next_member_; next = waiting_.begin()) {
        append(file, next->second);
        waiting_.erase(next);
    }
}

void SectionWriter::finish(NetcdfFile& file, std::uint64_t members) {
    auto const skip_to = [&](std::uint64_t member) {
        if (member <= next_member_) return;
        std::vector<int> const none(static_cast<std::size_t>(member - next_member_), 0);
        append(file, {none, none, {}});
    };
    for (auto const& [first, rows] : waiting_) {
        skip_to(first);
        append(file, rows);
    }
    waiting_.clear();
    skip_to(members);
}

}  // namespace slideway
