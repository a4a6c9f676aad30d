// The data model of a result, netCDF-4's: dimensions, variables, attributes and groups.  In a file (netcdf_file.hpp) or in memory
// (memory_file.hpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <numeric>
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
        std::size_t size() const { return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>()); }
    };
    /// As what values are stored.
    template <class T>
    static constexpr Type type_of = std::is_same_v<T, double> ? Type::float64 : std::is_same_v<T, int> ? Type::int32 : Type::int8;
    static constexpr std::size_t size_of(Type type) { return type == Type::float64 ? 8 : type == Type::int32 ? 4 : 1; }

    virtual ~DataFile() = default;
    virtual std::string const& path() const = 0;  // its name in messages

    virtual int add_dimension(std::string const& name, std::size_t length) = 0;
    /// A float64 variable reads as NaN wherever nothing was written, if `fill` is set.
    virtual int add_variable(std::string const& name, Type type, std::span<int const> dimensions, bool fill = false) = 0;
    static constexpr int global = -1;  // as `variable`: the file itself
    using Value = std::variant<std::string, double, int, std::vector<signed char>>;
    /// An attribute, in the place of one of its name.
    virtual void put(int variable, std::string const& name, Value const& value) = 0;
    virtual void end_definitions() = 0;

    /// All values of a variable, in C order.
    virtual void write(int variable, void const* values) = 0;
    virtual void read(int variable, void* values) const = 0;
    template <class T> std::vector<T> read(Variable const& variable) const {
        std::vector<T> values(variable.size());
        if (!values.empty()) read(variable.id, values.data());
        return values;
    }
    /// A hyperslab; `count` and `start` have one entry per dimension.
    virtual void write(int variable, std::span<std::size_t const> start, std::span<std::size_t const> count, void const* values) = 0;
    virtual void read(int variable, std::span<std::size_t const> start, std::span<std::size_t const> count, void* values) const = 0;

    /// Groups: handles that must not outlive the file.  They see the dimensions of what they lie in.
    virtual std::unique_ptr<DataFile> add_group(std::string const& name) = 0;
    virtual std::unique_ptr<DataFile> group(std::string const& name) const = 0;  // @throws FileError if there is none
    virtual std::vector<std::string> groups() const = 0;                         // names, in the order of their definition
    /// A dimension of this group or of those it lies in.  @throws FileError if there is none.
    virtual int dimension(std::string const& name) const = 0;

    virtual std::vector<Dimension> dimensions() const = 0;  // of a group: its own
    virtual std::vector<Variable> variables() const = 0;
    virtual std::vector<std::string> dimension_names(Variable const& variable) const = 0;
    virtual std::string text(int variable, std::string const& name) const = 0;  // of an attribute; "" when there is none
    virtual bool number(int variable, std::string const& name, double& value) const = 0;

    bool has_group(std::string const& name) const {
        auto const names = groups();
        return std::find(names.begin(), names.end(), name) != names.end();
    }
    /// Its name; "" of a scalar.
    std::string first_dimension(Variable const& variable) const {
        auto const names = dimension_names(variable);
        return names.empty() ? std::string() : names.front();
    }
};

}  // namespace slideway
