// netCDF-C behind one class: whatever fails throws FileError with the file's path and netCDF's reason.
// netCDF-C is not thread-safe: one thread at a time may be in here, whatever file it works on.
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/store/data_file.hpp"

namespace slideway {

class NetcdfFile final : public DataFile {
public:
    static NetcdfFile create(std::string const& path);  // netCDF-4; the file must not exist
    static NetcdfFile open(std::string const& path);    // to read
    /// In memory; `name` stands for the path in messages.  `close_to_bytes` gives what the file would hold.
    static NetcdfFile create_in_memory(std::string const& name);
    std::vector<std::byte> close_to_bytes();
    static NetcdfFile open_in_memory(std::string const& name, std::vector<std::byte> bytes);  // to read
    NetcdfFile(NetcdfFile&& other) noexcept;
    NetcdfFile& operator=(NetcdfFile&&) = delete;
    ~NetcdfFile() override;  // closes; what fails then is lost: call close()
    void close();

    std::string const& path() const override { return path_; }
    int add_dimension(std::string const& name, std::size_t length) override;
    int add_variable(std::string const& name, Type type, std::span<int const> dimensions, bool fill = false) override;
    void put(int variable, std::string const& name, Value const& value) override;
    void flush();  // to the disk

    using DataFile::read;
    void write(int variable, void const* values) override;
    void write(int variable, std::span<std::size_t const> start, std::span<std::size_t const> count, void const* values) override;
    void read(int variable, std::span<std::size_t const> start, std::span<std::size_t const> count, void* values) const override;

    /// They do what the file does but flush and close.  Moving the file leaves them valid.
    std::unique_ptr<DataFile> add_group(std::string const& name) override;
    std::unique_ptr<DataFile> group(std::string const& name) const override;
    NetcdfFile inner(std::string const& name) const;  // a group.  @throws FileError if there is none
    std::vector<std::string> groups() const override;
    int dimension(std::string const& name) const override;

    std::vector<Dimension> dimensions() const override;
    std::vector<Variable> variables() const override;  // as they were defined; by name if made in memory
    std::optional<Value> attribute(int variable, std::string const& name) const override;
    std::vector<std::string> attribute_names(int variable) const;  // sorted
    /// What an attribute is, to the last bit: netCDF's number of its type, the number of its values, the values.
    std::vector<std::byte> attribute_bytes(int variable, std::string const& name) const;

    /// Attributes, by the path of what has them, a "." for the file; and in words what is of another type than `Type`, by `uncovered`.
    void list_content(std::string const& prefix, std::map<std::string, std::set<std::string>>& attributes, std::vector<std::string>& foreign) const;
    /// Not in memory.
    bool is_on_disk() const { return kind_ == Kind::written || kind_ == Kind::read; }

private:
    enum class Kind { other, written, read, group };  // written, read: at a path; group: of a file that another closes
    NetcdfFile(std::string path, int id, Kind kind = Kind::other) : path_(std::move(path)), id_(id), kind_(kind) {}
    int close_with_reason(bool& hdf5_failed) noexcept;
    void require(int code, std::string_view action) const;
    static bool stores(int type);  // of the types that netCDF numbers, those of `Type`
    template <class Call> std::string name_by(Call call) const;
    template <class Call> int number_by(std::string_view action, Call call) const;
    std::vector<std::string> strings(int variable, std::string const& name, std::size_t count) const;

    std::string path_;
    int id_;
    Kind kind_;
    std::vector<std::byte> bytes_ = {};  // of a file in memory that is read
};

}  // namespace slideway
