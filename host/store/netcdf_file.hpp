// netCDF-C behind one class: whatever fails throws FileError with the file's path and netCDF's reason.
// netCDF-C is not thread-safe: one thread at a time may be in here, whatever file it works on.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace slideway {

class NetcdfFile {
public:
    enum class Type { int8, int32, float64, text };
    struct Dimension {
        std::string name;
        std::size_t length;
    };
    struct Variable {
        int id;
        std::string name;
        Type type;
        std::vector<std::size_t> shape;
        std::size_t size() const;  // product of the shape
    };

    static NetcdfFile create(std::string const& path);  // netCDF-4; the file must not exist
    static NetcdfFile open(std::string const& path);    // to read
    /// In memory; `name` stands for the path in messages.  `close_to_bytes` gives what the file would hold.
    static NetcdfFile create_in_memory(std::string const& name);
    std::vector<std::byte> close_to_bytes();
    /// To read from `bytes`, which must outlive the file.
    static NetcdfFile open_in_memory(std::string const& name, std::span<std::byte const> bytes);
    NetcdfFile(NetcdfFile&& other) noexcept;
    NetcdfFile& operator=(NetcdfFile&&) = delete;
    ~NetcdfFile();  // closes; what fails then is lost: call close()
    void close();

    static constexpr std::size_t unlimited = 0;  // as `length`: grows with what is written
    int add_dimension(std::string const& name, std::size_t length);
    /// A float64 variable reads as NaN wherever nothing was written, if `fill` is set.
    int add_variable(std::string const& name, Type type, std::span<int const> dimensions, bool fill = false);
    static constexpr int global = -1;  // as `variable`: the file itself
    void put_text(int variable, std::string const& name, std::string_view value);
    void put_number(int variable, std::string const& name, double value);
    void put_number(int variable, std::string const& name, int value);
    void put_bytes(int variable, std::string const& name, std::span<signed char const> values);
    void end_definitions();
    void flush();  // to the disk

    /// All values of a variable, in C order.
    void write(int variable, void const* values);
    void read(int variable, void* values) const;
    template <class T> std::vector<T> read(Variable const& variable) const {
        std::vector<T> values(variable.size());
        if (!values.empty()) read(variable.id, values.data());
        return values;
    }
    /// A hyperslab; `count` and `start` have one entry per dimension.
    void write(int variable, std::span<std::size_t const> start, std::span<std::size_t const> count, void const* values);
    void read(int variable, std::span<std::size_t const> start, std::span<std::size_t const> count, void* values) const;

    /// Groups: handles that share this file and must not outlive it.  They do what the file does but flush and close;
    /// they see the dimensions of what they lie in.  Moving the file leaves them valid.
    NetcdfFile add_group(std::string const& name);
    NetcdfFile group(std::string const& name) const;  // @throws FileError if there is none
    bool has_group(std::string const& name) const;
    std::vector<std::string> groups() const;  // names, in the order of their definition
    /// A dimension of this group or of those it lies in.  @throws FileError if there is none.
    int dimension(std::string const& name) const;

    std::vector<Dimension> dimensions() const;                      // of a group: its own
    std::vector<Variable> variables() const;                        // as they were defined; by name if made in memory
    std::vector<std::string> dimension_names(Variable const& variable) const;
    std::string first_dimension(Variable const& variable) const;    // its name; "" of a scalar
    std::vector<std::string> attribute_names(int variable) const;   // sorted
    /// What an attribute is, to the last bit: netCDF's number of its type, the number of its values, the values.
    std::vector<std::byte> attribute_bytes(int variable, std::string const& name) const;
    std::string text(int variable, std::string const& name) const;  // "" when there is none
    bool number(int variable, std::string const& name, double& value) const;

    std::string const& path() const { return path_; }
    static std::size_t size_of(Type type);
    /// As what values are stored.
    template <class T>
    static constexpr Type type_of = std::is_same_v<T, double> ? Type::float64 : std::is_same_v<T, int> ? Type::int32 : Type::int8;

private:
    enum class Kind { other, written, group };  // written: to a path; group: of a file that another closes
    NetcdfFile(std::string path, int id, Kind kind = Kind::other) : path_(std::move(path)), id_(id), kind_(kind) {}
    int close_with_reason(bool& hdf5_failed) noexcept;
    void require(int code, std::string_view action) const;
    template <class Call> std::string name_by(Call call) const;
    std::vector<std::string> strings(int variable, std::string const& name, std::size_t count) const;
    bool has_attribute(int variable, std::string const& name, int& type, std::size_t& length) const;

    std::string path_;
    int id_;
    Kind kind_;
};

}  // namespace slideway
