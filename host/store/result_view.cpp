#include "host/store/result_view.hpp"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <new>
#include <numeric>
#include <sstream>
#include <string_view>
#include <system_error>
#include <type_traits>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/base/open_file.hpp"
#include "host/base/process.hpp"
#include "host/config/outputs.hpp"
#include "host/run/ranks.hpp"
#include "host/store/column.hpp"

namespace slideway {

namespace {

template <class T> std::vector<double> read_as(DataFile const& file, int variable, std::span<std::size_t const> start, std::vector<std::size_t> const& count) {
    std::vector<T> values(std::accumulate(count.begin(), count.end(), std::size_t{1}, std::multiplies<>()));
    if (!values.empty()) file.read(variable, start, count, values.data());
    if constexpr (std::is_same_v<T, double>) return values;
    else return {values.begin(), values.end()};
}

/// A part of a variable of numbers.
std::vector<double> numbers_of(DataFile const& file, DataFile::Variable const& of, std::span<std::size_t const> start, std::vector<std::size_t> const& count) {
    if (of.type == DataFile::Type::int8) return read_as<signed char>(file, of.id, start, count);
    if (of.type == DataFile::Type::int32) return read_as<int>(file, of.id, start, count);
    if (of.type == DataFile::Type::float64) return read_as<double>(file, of.id, start, count);
    throw FileError(fmt::format("{}: {} is no number", file.path(), of.name));
}

/// As text, also a number.
std::string attribute_text(DataFile const& file, std::string const& attribute) {
    if (auto const number = file.number(DataFile::global, attribute)) return fmt::format("{}", *number);
    return file.text(DataFile::global, attribute);
}

constexpr std::string_view error_mark = "error ";

constexpr char const* what_to_do = "copy it again, or run its scene again";

/// Ten times what an intact file takes, and more.
ApartLimits limits_of(std::string const& path) {
    std::error_code error;
    auto const size = std::filesystem::file_size(path, error);
    std::uint64_t const bytes = error ? 0 : size;
    constexpr std::uint64_t seconds = 5, bytes_a_second = 10'000'000, memory = std::uint64_t{1} << 30;
    return {seconds + bytes / bytes_a_second, memory + 2 * bytes};
}

/// What somebody looks for in a file; its words come back.
std::string look_apart(std::string const& path, std::function<std::string(ResultReader const&)> const& look) {
    require_file(path);
    // A process that has begun MPI may not be forked (its network's memory is registered): the ranks of a job look for themselves.
    auto const launch = find_launch([](char const* name) -> char const* { return std::getenv(name); });
    if (launch && launch->count != 1) return look(ResultReader(path));
    auto const work = [&] {
        try {
            return look(ResultReader(path));
        } catch (FileError const& error) {
            return fmt::format("{}{}", error_mark, error.what());
        }
    };
    // With less an intact file looks damaged.
    constexpr std::uint64_t least_memory = 48 << 20;
    require_memory(least_memory);
    ApartLimits const limits = limits_of(path);
    bool const is_short = memory_room() < limits.bytes;
    ApartOutcome const outcome = run_apart(work, limits);
    if (outcome.answer) {
        if (outcome.answer->starts_with(error_mark)) throw FileError(outcome.answer->substr(error_mark.size()));
        return *outcome.answer;
    }
    if (is_short && outcome.signal != SIGXCPU) throw std::bad_alloc();
    std::string const how = outcome.signal == SIGXCPU  ? "does not come to an end with it"
                            : outcome.signal == 0 ? "runs out of memory"
                                                  : fmt::format("crashes on it ({})", strsignal(outcome.signal));
    throw FileError(fmt::format("{}: is damaged so badly that the HDF5 library {}; {}", path, how, what_to_do));
}

}  // namespace

ResultView::ResultView(std::shared_ptr<DataFile const> file) : variables_(file->variables()), file_(std::move(file)) {
    for (DataFile::Variable& variable : variables_) variable.name = name_of_now(variable.name);
    std::string const name = stores_members() ? "status" : "status_count";
    if (!has(name) || shape(name).size() != 1) throw FileError(path() + ": is a netCDF file, but not a result of slideway");
}

DataFile::Variable const& ResultView::find(std::string const& variable) const {
    auto const found = std::ranges::find(variables_, variable, &DataFile::Variable::name);
    if (found == variables_.end()) throw FileError(fmt::format("{}: has no variable {}", file_->path(), variable));
    return *found;
}

std::string ResultView::attribute(std::string const& name) const { return attribute_text(*file_, name); }

std::string ResultView::group_attribute(std::string const& group, std::string const& name) const {
    auto const found = this->group(group);
    return found ? attribute_text(*found, name) : std::string();
}

std::vector<std::string> ResultView::variable_names() const {
    std::vector<std::string> names;
    for (DataFile::Variable const& variable : variables_) names.push_back(variable.name);
    return names;
}

std::vector<double> ResultView::values(std::string const& variable) const {
    DataFile::Variable const& found = find(variable);
    return numbers_of(*file_, found, std::vector<std::size_t>(found.shape.size(), 0), found.shape);
}

std::vector<double> ResultView::rows(std::string const& variable, std::size_t first, std::size_t count) const {
    DataFile::Variable const& found = find(variable);
    std::vector<std::size_t> start(found.shape.size(), 0), shape = found.shape;
    start.at(0) = first, shape[0] = count;
    return numbers_of(*file_, found, start, shape);
}

std::vector<double> ResultView::values(std::string const& variable, std::size_t count) const {
    std::vector<double> found = values(variable);
    if (found.size() == count) return found;
    throw FileError(fmt::format("{}: is damaged ({} has {} values in place of {}); run the study again", file_->path(), variable, found.size(), count));
}

std::vector<std::string> ResultView::texts(std::string const& name) const {
    DataFile::Variable const& variable = find(name);
    if (variable.type != DataFile::Type::text || variable.shape.size() != 2) throw FileError(fmt::format("{}: variable {} holds no texts", path(), name));
    return read_texts(*file_, variable);
}

std::vector<double> ResultView::column(std::string const& variable, std::size_t index) const {
    DataFile::Variable const& found = find(variable);
    std::size_t const rank = found.shape.size();
    if (found.type != DataFile::Type::float64 || rank < 1 || rank > 2 || index >= (rank == 2 ? found.shape[1] : 1)) {
        throw FileError(fmt::format("{}: {} has no column {}", file_->path(), variable, index));
    }
    std::vector<double> values(found.shape[0]);
    std::size_t const start[2] = {0, index}, count[2] = {found.shape[0], 1};
    if (!values.empty()) file_->read(found.id, {start, rank}, {count, rank}, values.data());
    return values;
}

ResultReader::ResultReader(std::string const& path) : ResultView(std::make_shared<NetcdfFile const>(NetcdfFile::open(path))) {
    format_of(*file_);
    if (stored_hash().empty()) throw FileError(path + ": is unfinished: the run that wrote it did not come to its end");
}

SealCheck check_result(std::string const& path) {
    std::istringstream words(look_apart(path, [](ResultReader const& results) {
        SealCheck seal = results.check();
        // What stands in the place of a hash may be anything.
        for (std::string* const stored : {&seal.payload, &seal.metadata, &seal.foreign}) std::replace(stored->begin(), stored->end(), '\n', '?');
        return fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n", seal.version, seal.payload, seal.metadata, seal.payload_found, seal.metadata_found, seal.foreign);
    }));
    SealCheck seal;
    words >> seal.version;
    words.ignore();
    for (std::string* const hash : {&seal.payload, &seal.metadata, &seal.payload_found, &seal.metadata_found, &seal.foreign}) std::getline(words, *hash);
    return seal;
}

void require_intact(std::string const& path) {
    std::string const damage = check_result(path).damage();
    if (!damage.empty()) throw FileError(fmt::format("{}: {}; the file is damaged or was edited, see slideway info", path, damage));
}

bool is_result_file(std::string const& path) {
    try {
        look_apart(path, [](ResultReader const&) { return std::string(); });
        return true;
    } catch (FileError const&) {
        return false;
    }
}

}  // namespace slideway
