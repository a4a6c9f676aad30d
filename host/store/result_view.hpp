// Reads the variables of a result, and a result file back.  Whether a file is what was written is found out in a process apart: HDF5 crashes on
// some files of which a single byte has changed.  In a job of several ranks it is found out by the rank itself: MPI does not outlive a fork.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "host/store/netcdf_file.hpp"
#include "host/store/result_seal.hpp"
#include "kernels/status.hpp"

namespace slideway {

/// Reads a result through a file that somebody else keeps open; also one that is still being written.  The variables
/// are those defined when the view was made.  The file must not be moved or closed while the view is in use.
class ResultView {
public:
    /// @throws FileError if the file has no `status` of members and no counts of them, so is no result of slideway.
    explicit ResultView(DataFile const& file) : ResultView(std::shared_ptr<DataFile const>(&file, [](DataFile const*) {})) {}

    std::vector<DataFile::Dimension> dimensions() const { return file_->dimensions(); }
    /// Whether the members are there, or what they come to together (`store` is "statistics").
    bool stores_members() const { return attribute("store") != "statistics"; }
    std::string attribute(std::string const& name) const;  // as text, also numbers; "" when there is none
    std::string group_attribute(std::string const& group, std::string const& name) const;  // "" when there is none
    /// Not to outlive the file; nullptr where there is none.
    std::unique_ptr<DataFile> group(std::string const& name) const { return file_->has_group(name) ? file_->group(name) : nullptr; }
    bool has(std::string const& variable) const { return std::ranges::count(variables_, variable, &DataFile::Variable::name) > 0; }
    std::vector<std::string> variable_names() const;
    std::string unit(std::string const& variable) const { return file_->text(find(variable).id, "units"); }
    std::string long_name(std::string const& variable) const { return file_->text(find(variable).id, "long_name"); }
    /// "" when there is none.
    std::string attribute_of(std::string const& variable, std::string const& name) const { return file_->text(find(variable).id, name); }
    std::vector<std::string> dimensions_of(std::string const& variable) const { return find(variable).dimensions; }
    /// All values in C order.  @throws FileError if there is no such variable or it is not a number.
    std::vector<double> values(std::string const& variable) const;
    /// The same of so many.  @throws FileError also if there are not: the file was edited.
    std::vector<double> values(std::string const& variable, std::size_t count) const;
    /// Those of `count` entries of its first dimension.
    std::vector<double> rows(std::string const& variable, std::size_t first, std::size_t count) const;
    /// The texts of a variable of them, one for each entry of its first dimension.  @throws FileError if there is no such variable
    std::vector<std::string> texts(std::string const& variable) const;
    /// Of a float64 variable of one dimension, or of two, its column: the values along the first dimension.
    /// @throws FileError if there is no such variable or column.
    std::vector<double> column(std::string const& variable, std::size_t index) const;
    std::vector<std::size_t> shape(std::string const& variable) const { return find(variable).shape; }
    std::string const& path() const { return file_->path(); }

private:
    DataFile::Variable const& find(std::string const& variable) const;

    std::vector<DataFile::Variable> variables_;

protected:
    explicit ResultView(std::shared_ptr<DataFile const> file);
    std::shared_ptr<DataFile const> file_;  // somebody else's, or a reader's own
};

/// A finished result file; usable wherever a view is.  Of files that were not just written `check_result` comes first.
class ResultReader : public ResultView {
public:
    /// @throws FileError if the file is missing, not netCDF, not a result of slideway, of a newer format, or unfinished.
    explicit ResultReader(std::string const& path);

    std::string stored_hash() const { return attribute("payload_hash"); }
    std::string computed_hash() const { return payload_hash(*file_); }  // reads all data
    /// Of a file that was just written and looked at.
    SealCheck seal() const { return {format_of(*file_), stored_hash(), attribute("metadata_hash"), stored_hash(), attribute("metadata_hash")}; }
    SealCheck check() const { return check_seal(static_cast<NetcdfFile const&>(*file_)); }  // reads all data
};

/// Stored numbers as what they count or name.  One that is out of range, in a file that was edited, becomes 0, and no known status.
inline std::uint64_t count_of(double stored) { return stored >= 0 && stored < 0x1p64 ? static_cast<std::uint64_t>(stored) : 0; }
inline signed char int8_of(double stored) { return stored >= -128 && stored <= 127 ? static_cast<signed char>(stored) : 127; }
inline Status status_of(double stored) { return static_cast<Status>(int8_of(stored)); }

/// Opens a result, reads all of it and computes both hashes, before this process opens it.
/// @throws FileError with one line: it is missing, no finished result of slideway, of a newer format, or so damaged that it cannot be read;
/// hashes that do not match are told by what is returned; std::bad_alloc where this process has too little memory to tell
SealCheck check_result(std::string const& path);

/// @throws FileError also if a hash does not match; the line says which part is damaged
void require_intact(std::string const& path);

/// Whether a file is a finished result, as far as its header tells: damaged data are no matter.
bool is_result_file(std::string const& path);

}  // namespace slideway
