// Result files as the readers find them: whole NetCDF files whose variables, shapes, types and values are anything.
// The input says what is in the file, and is not the file: the libraries themselves crash on files with damaged bytes, and would hide what
// our readers do.  Of such files `payload_hash` and the checksums of shards are to tell.  The files are of netCDF's classic format, which the
// readers take as well and which is made in a fiftieth of the time of one of HDF5.
#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <netcdf.h>
#include <netcdf_mem.h>

#include "host/store/netcdf_file.hpp"
#include "host/store/result_seal.hpp"
#include "host/store/statistics_merge.hpp"
#include "host/study/orbit_summary.hpp"
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
                              "grown_offsets"};
constexpr std::array dimensions = {"member", "sample", "section", "mode_class"};
constexpr unsigned growing = 0;
constexpr std::array types = {NC_BYTE, NC_INT, NC_DOUBLE, NC_CHAR};

struct Planned {
    nc_type type;
    std::vector<std::size_t> shape;
    int id;
};

void check(int code) { require(code == NC_NOERR, nc_strerror(code)); }

void put(int file, int variable, char const* name, std::string_view value) {
    check(nc_put_att_text(file, variable, name, value.size(), value.data()));
}

void write_values(int file, Planned const& planned, Choices& choices) {
    std::vector<std::size_t> const start(planned.shape.size(), 0);
    std::size_t count = 1;
    for (std::size_t const length : planned.shape) count *= length;
    std::vector<std::byte> bytes(count * sizeof(double));
    for (std::size_t i = 0; i < count; ++i) {
        if (planned.type == NC_DOUBLE) {
            double const value = choices.real();
            std::memcpy(bytes.data() + i * sizeof value, &value, sizeof value);
        } else if (planned.type == NC_INT) {
            int const value = static_cast<signed char>(choices.byte()) * (choices.byte() < 128 ? 1 : 1 << 20);
            std::memcpy(bytes.data() + i * sizeof value, &value, sizeof value);
        } else {
            bytes[i] = std::byte{choices.byte()};
        }
    }
    check(nc_put_vara(file, planned.id, start.data(), planned.shape.data(), bytes.data()));
}

int new_file() {
    int file = -1;
    check(nc_create_mem("made.nc", 0, 1 << 12, &file));
    return file;
}

std::vector<std::byte> make_file(Choices& choices) {
    // netCDF's list of open files has 512 KiB, which it makes for the first file and frees after the last one.
    static int const kept_open = new_file();
    static_cast<void>(kept_open);
    int const file = new_file();
    std::array<std::size_t, dimensions.size()> lengths{};
    std::array<int, dimensions.size()> ids{};
    for (std::size_t i = 0; i < dimensions.size(); ++i) {
        // The first may have no entry: the classic format has one dimension that grows.
        lengths[i] = i == growing ? choices.below(6) : 1 + choices.below(5);
        check(nc_def_dim(file, dimensions[i], lengths[i] == 0 ? NC_UNLIMITED : lengths[i], &ids[i]));
    }
    if (choices.below(2) == 1) put(file, NC_GLOBAL, "store", "statistics");
    if (choices.below(4) == 1) put(file, NC_GLOBAL, "sweep_parameter", "mode_time");
    if (choices.below(8) > 0) put(file, NC_GLOBAL, "payload_hash", "0123456789abcdef");
    put(file, NC_GLOBAL, "quantities", "peak_normal_force mode_time");
    std::vector<Planned> all;
    for (char const* const name : names) {
        if (choices.below(4) == 0) continue;
        Planned planned{types[choices.below(8) == 0 ? choices.below(4) : 2], {}, 0};
        std::vector<int> used;
        for (unsigned rank = choices.below(8) == 0 ? 0 : 1 + choices.below(3); rank > 0; --rank) {
            unsigned dimension = choices.below(dimensions.size());
            if (!used.empty() && dimension == growing) dimension = growing + 1;  // which is the first of a variable, or none of its
            used.push_back(ids[dimension]);
            planned.shape.push_back(lengths[dimension]);
        }
        check(nc_def_var(file, name, planned.type, static_cast<int>(used.size()), used.data(), &planned.id));
        if (choices.below(2) == 1) put(file, planned.id, "units", "m");
        all.push_back(planned);
    }
    check(nc_enddef(file));
    for (Planned const& planned : all) write_values(file, planned, choices);
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
        accepted([&] { results.column(name, 1); });
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

}  // namespace
}  // namespace slideway::fuzz

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    using namespace slideway;
    fuzz::Choices choices(data, size);
    std::optional<std::uint64_t> member;
    if (unsigned const choice = choices.below(4); choice > 0) member = choice - 1;
    std::vector<std::byte> const bytes = fuzz::make_file(choices);
    NetcdfFile const file = NetcdfFile::open_in_memory("made.nc", bytes);
    std::optional<ResultView> results;
    bool const readable = fuzz::accepted([&] {
        fuzz::require(payload_hash(file).size() == 16, "a hash has 16 digits");
        results.emplace(file);
    });
    if (!readable) return 0;
    fuzz::read_result(*results);
    for (char const* const name : {"y", "section_y"}) {
        StoredSeries series;
        if (fuzz::accepted([&] { series = read_result_series(*results, name, member); })) {
            fuzz::require(series.values.size() > 1, "a series has values");
        }
    }
    return 0;
}
