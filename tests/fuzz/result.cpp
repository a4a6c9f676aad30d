// Results as the readers find them: variables, shapes, types and values are anything.
// The input says what is in a result, and is not a file: the libraries themselves crash on files with damaged bytes, and would hide what
// our readers do.  Of such files `payload_hash` and the checksums of shards are to tell.  Most results are in memory; every eighth goes
// through a whole file, of netCDF's classic format, which the readers take as well and which is made in a fiftieth of the time of one of HDF5.
#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <netcdf.h>
#include <netcdf_mem.h>

#include "host/store/block_statistics.hpp"
#include "host/store/memory_file.hpp"
#include "host/store/netcdf_file.hpp"
#include "host/store/result_seal.hpp"
#include "host/study/result_summary.hpp"
#include "host/study/series_file.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace slideway::fuzz {
namespace {

/// Numbers from the input, zeros when it has ended.
class Choices {
public:
    Choices(std::uint8_t const* data, std::size_t size) : rest_(data, size) {}
    std::uint8_t byte() {
        if (rest_.empty()) return 0;
        std::uint8_t const value = rest_.front();
        rest_ = rest_.subspan(1);
        return value;
    }
    unsigned below(unsigned end) { return byte() % end; }
    double real() {
        static constexpr double limit = std::numeric_limits<double>::max(), infinity = std::numeric_limits<double>::infinity();
        static constexpr std::array special = {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity, limit, -1.0, 0.5, 1e19, -1e19};
        unsigned const choice = byte();
        return choice < 128 ? choice : choice < 192 ? special[choice % special.size()] : (choice - 192) * 0.1;
    }

private:
    std::span<std::uint8_t const> rest_;
};

constexpr std::array names = {"status", "member", "end_time", "time", "y", "accumulators", "status_value", "status_count", "failed_member",
                              "failed_status", "failed_time", "section_time", "section_count", "section_y", "section_crossings", "peak_normal_force",
                              "mode_time", "steps_accepted", "steps_rejected", "lyapunov_exponent", "lyapunov_exponent_late",
                              "lyapunov_exponent_half_width", "lyapunov_resolution", "lyapunov_history", "history", "rescalings", "lost_offsets",
                              "grown_offsets", "lyapunov_time"};
constexpr std::array dimensions = {"member", "sample", "section", "mode_class"};
constexpr unsigned growing = 0;
constexpr std::array types = {DataFile::Type::int8, DataFile::Type::int32, DataFile::Type::float64,
                              DataFile::Type::text};

void write_values(MemoryFile& file, DataFile::Variable const& variable, Choices& choices) {
    std::size_t const count = variable.size();
    std::vector<std::byte> bytes(count * sizeof(double));
    for (std::size_t i = 0; i < count; ++i) {
        if (variable.type == DataFile::Type::float64) {
            double const value = choices.real();
            std::memcpy(bytes.data() + i * sizeof value, &value, sizeof value);
        } else if (variable.type == DataFile::Type::int32) {
            int const value = static_cast<signed char>(choices.byte()) * (choices.byte() < 128 ? 1 : 1 << 20);
            std::memcpy(bytes.data() + i * sizeof value, &value, sizeof value);
        } else {
            bytes[i] = std::byte{choices.byte()};
        }
    }
    file.write(variable.id, bytes.data());
}

MemoryFile make_result(Choices& choices) {
    MemoryFile file("made.nc");
    // The first may have no entry: the classic format has one dimension that grows.
    for (unsigned i = 0; i < dimensions.size(); ++i)
        file.add_dimension(dimensions[i], i == growing ? choices.below(6) : 1 + choices.below(5));
    if (choices.below(2) == 1) file.put(DataFile::global, "store", "statistics");
    if (choices.below(4) == 1) file.put(DataFile::global, "sweep_parameter", "mode_time");
    if (choices.below(8) > 0) file.put(DataFile::global, "payload_hash", "0123456789abcdef");
    file.put(DataFile::global, "quantities", "peak_normal_force mode_time");
    for (char const* const name : names) {
        if (choices.below(4) == 0) continue;
        DataFile::Type const type = types[choices.below(8) == 0 ? choices.below(4) : 2];
        std::vector<int> shape;
        for (unsigned rank = choices.below(8) == 0 ? 0 : 1 + choices.below(3); rank > 0; --rank) {
            unsigned const dimension = choices.below(dimensions.size());
            // What grows is the first of a variable, or none of its.
            shape.push_back(static_cast<int>(!shape.empty() && dimension == growing ? growing + 1 : dimension));
        }
        int const variable = file.add_variable(name, type, shape);
        if (choices.below(2) == 1) file.put(variable, "units", "m");
    }
    for (DataFile::Variable const& variable : file.variables()) write_values(file, variable, choices);
    return file;
}

void check(int code) { require(code == NC_NOERR, nc_strerror(code)); }

int new_file() {
    int file = -1;
    check(nc_create_mem("made.nc", 0, 1 << 12, &file));
    return file;
}

void put_texts(int file, int variable, MemoryFile const& result) {
    for (auto const& [name, value] : result.attributes(variable)) {
        auto const& text = std::get<std::string>(value);
        check(nc_put_att_text(file, variable, name.c_str(), text.size(), text.data()));
    }
}

/// The bytes of a file that holds the same.
std::vector<std::byte> classic_file(MemoryFile const& result) {
    constexpr std::array type_numbers = {NC_BYTE, NC_INT, NC_DOUBLE, NC_CHAR};  // in the order of DataFile::Type
    // netCDF's list of open files has 512 KiB, which it makes for the first file and frees after the last one.
    static int const kept_open = new_file();
    static_cast<void>(kept_open);
    int const file = new_file();
    int id = 0;
    for (auto const& [name, length] : result.dimensions())
        check(nc_def_dim(file, name.c_str(), length == 0 ? NC_UNLIMITED : length, &id));
    put_texts(file, NC_GLOBAL, result);
    std::vector<DataFile::Variable> const variables = result.variables();
    for (DataFile::Variable const& variable : variables) {
        std::vector<int> shape;
        for (std::string const& name : variable.dimensions) shape.push_back(result.dimension(name));
        check(nc_def_var(file, variable.name.c_str(), type_numbers[static_cast<std::size_t>(variable.type)],
                         static_cast<int>(shape.size()), shape.data(), &id));
        put_texts(file, id, result);
    }
    check(nc_enddef(file));
    for (DataFile::Variable const& variable : variables) {
        std::vector<std::size_t> const start(variable.shape.size(), 0);
        if (variable.size() > 0)
            check(nc_put_vara(file, variable.id, start.data(), variable.shape.data(), result.data(variable.id)));
    }
    NC_memio memory{};
    check(nc_close_memio(file, &memory));
    auto const* const first = static_cast<std::byte const*>(memory.memory);
    std::vector<std::byte> bytes(first, first + memory.size);
    std::free(memory.memory);
    return bytes;
}

/// Everything that info, run and Python's callers ask of a result.
void read_result(ResultView const& results) {
    for (std::string const& name : results.variable_names()) {
        results.unit(name);
        results.long_name(name);
        accepted([&] { results.values(name); });
        // Most have no column 1, and one refusal is like another.
        if (results.shape(name).size() == 2 || name == "y") accepted([&] { results.column(name, 1); });
    }
    accepted([&] { count_statuses(results); });
    accepted([&] { summarise_quantities(results); });
    accepted([&] { failed_members(results, 3); });
    accepted([&] { member_rows(results, {1, 2}); });
    accepted([&] { summarise_exponents(results); });
    accepted([&] { offset_health(results); });
    accepted([&] { summarise_columns(results); });
    accepted([&] { exponent_history(results); });
    accepted([&] { summarise_sections(results); });
    if (!results.stores_members()) accepted([&] { members_left(results); });
}

void read_file(DataFile const& file, std::optional<std::uint64_t> member) {
    std::optional<ResultView> results;
    if (!accepted([&] { results.emplace(file); })) return;
    read_result(*results);
    for (char const* const name : {"y", "section_y"}) {
        StoredSeries series;
        if (accepted([&] { series = read_result_series(*results, name, member); }))
            require(series.values.size() > 1, "a series has values");
    }
}

}  // namespace
}  // namespace slideway::fuzz

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    using namespace slideway;
    fuzz::Choices choices(data, size);
    unsigned const choice = choices.byte();
    std::optional<std::uint64_t> member;
    if (choice % 4 > 0) member = choice % 4 - 1;
    MemoryFile const result = fuzz::make_result(choices);
    if (choice / 4 % 8 != 7) {
        fuzz::read_file(result, member);
        return 0;
    }
    std::string const hash = payload_hash(result);
    fuzz::require(hash.size() == 16, "a hash has 16 digits");
    std::vector<std::byte> const bytes = fuzz::classic_file(result);
    NetcdfFile const file = NetcdfFile::open_in_memory("made.nc", bytes);
    fuzz::require(payload_hash(file) == hash, "a file has the hash of what it was made of");
    fuzz::read_file(file, member);
    return 0;
}
