// The data model of a result, netCDF-4's: dimensions, variables, attributes and groups.  In a file (netcdf_file.hpp) or in memory
// (memory_file.hpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace slideway {

class DataFile {
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
        std::vector<std::string> dimensions = {};  // their names
        std::size_t size() const { return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>()); }
    };
    /// As what values are stored.
    template <class T>
    static constexpr Type type_of = std::is_same_v<T, double> ? Type::float64 : std::is_same_v<T, int> ? Type::int32 : Type::int8;
    static constexpr std::size_t size_of(Type type) { return type == Type::float64 ? 8 : type == Type::int32 ? 4 : 1; }

    using Value = std::variant<std::string, double, int, std::vector<signed char>>;
    struct Attribute {
        std::string name;
        Value value;
    };

    virtual ~DataFile() = default;
    virtual std::string const& path() const = 0;  // its name in messages

    virtual int add_dimension(std::string const& name, std::size_t length) = 0;
    /// A float64 variable reads as NaN wherever nothing was written, if `fill` is set.
    virtual int add_variable(std::string const& name, Type type, std::span<int const> dimensions, bool fill = false) = 0;
    static constexpr int global = -1;  // as `variable`: the file itself
    /// An attribute, in the place of one of its name.
    virtual void put(int variable, std::string const& name, Value const& value) = 0;

    /// All values of a variable, in C order.
    virtual void write(int variable, void const* values) = 0;
    /// A hyperslab; `count` and `start` have one entry per dimension.
    virtual void write(int variable, std::span<std::size_t const> start, std::span<std::size_t const> count, void const* values) = 0;
    virtual void read(int variable, std::span<std::size_t const> start, std::span<std::size_t const> count, void* values) const = 0;
    void read(Variable const& variable, void* values) const {
        if (variable.size() > 0) read(variable.id, std::vector<std::size_t>(variable.shape.size(), 0), variable.shape, values);
    }
    template <class T> std::vector<T> read(Variable const& variable) const {
        std::vector<T> values(variable.size());
        read(variable, values.data());
        return values;
    }

    /// Groups: handles that must not outlive the file.  They see the dimensions of what they lie in.
    virtual std::unique_ptr<DataFile> add_group(std::string const& name) = 0;
    virtual std::unique_ptr<DataFile> group(std::string const& name) const = 0;  // @throws FileError if there is none
    virtual std::vector<std::string> groups() const = 0;                         // names, in the order of their definition
    bool has_group(std::string const& name) const { return std::ranges::count(groups(), name) > 0; }
    /// A dimension of this group or of those it lies in.  @throws FileError if there is none.
    virtual int dimension(std::string const& name) const = 0;

    virtual std::vector<Dimension> dimensions() const = 0;  // of a group: its own
    virtual std::vector<Variable> variables() const = 0;
    /// An attribute of one value; none where there is no such.
    virtual std::optional<Value> attribute(int variable, std::string const& name) const = 0;
    std::string text(int variable, std::string const& name) const;  // "" when there is none
    std::optional<double> number(int variable, std::string const& name) const;
};

inline std::string DataFile::text(int variable, std::string const& name) const {
    auto const value = attribute(variable, name);
    auto const* const text = value ? std::get_if<std::string>(&*value) : nullptr;
    return text != nullptr ? *text : std::string();
}

inline std::optional<double> DataFile::number(int variable, std::string const& name) const {
    auto const value = attribute(variable, name);
    if (!value) return {};
    if (auto const* const real = std::get_if<double>(&*value)) return *real;
    if (auto const* const whole = std::get_if<int>(&*value)) return *whole;
    return {};
}

}  // namespace slideway
