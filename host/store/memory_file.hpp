// A result in memory: what a result file holds, without the file.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/store/data_file.hpp"

namespace slideway {

/// A handle: copies and groups share the same data and keep it.  One thread at a time may write.
class MemoryFile final : public DataFile {
public:
    explicit MemoryFile(std::string name);

    std::string const& path() const override;
    int add_dimension(std::string const& name, std::size_t length) override;
    int add_variable(std::string const& name, Type type, std::span<int const> dimensions, bool fill = false) override;
    void put(int variable, std::string const& name, Value const& value) override;
    using DataFile::read;
    void write(int variable, void const* values) override;
    void write(int variable, std::span<std::size_t const> start, std::span<std::size_t const> count, void const* values) override;
    void read(int variable, std::span<std::size_t const> start, std::span<std::size_t const> count, void* values) const override;
    std::unique_ptr<DataFile> add_group(std::string const& name) override;
    std::unique_ptr<DataFile> group(std::string const& name) const override;
    std::vector<std::string> groups() const override;
    int dimension(std::string const& name) const override;
    std::vector<Dimension> dimensions() const override;
    std::vector<Variable> variables() const override;
    std::optional<Value> attribute(int variable, std::string const& name) const override;

    /// As they were put.
    std::vector<Attribute> const& attributes(int variable) const;
    /// All values of a variable in C order; valid as long as a handle is.
    std::byte const* data(int variable) const;

    /// A group that is there.  @throws FileError if it is not
    MemoryFile inner(std::string const& name) const;

    /// Defines and writes into `to` all that is in here.
    void copy_to(DataFile& to) const;

private:
    struct Node;
    explicit MemoryFile(std::shared_ptr<Node> node) : node_(std::move(node)) {}

    std::shared_ptr<Node> node_;
};

}  // namespace slideway
