// slideway as a library: scenes in, columns of numbers out, in memory or in a file.
//
//     #include <slideway/slideway.hpp>
//
//     auto const ensemble = slideway::Ensemble::read("scenes/tolerance_0.1mm.toml", {{"study.base", "64"}});
//     slideway::Result const result = ensemble.run();
//     for (double const force : result.column("peak_normal_force").numbers()) …
//
// Link with slideway::slideway (find_package(slideway)).  Numbers are SI.  A member's numbers depend on its own inputs alone: not on
// threads, instruction sets or other members.  An object may be used by one thread at a time; different ones, copies among them, by
// different threads at once.
// A process that was forked after a run must not run with more than one thread: OpenMP's threads do not survive a fork.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#define SLIDEWAY_API __attribute__((visibility("default")))

namespace slideway {

/// What cannot be done, in one line.  `code` is the exit code that the program has for it: 2 a scene or a setting that cannot be used,
/// 4 a file or a device, 1 anything else.
class SLIDEWAY_API Error : public std::runtime_error {
public:
    Error(int code, std::string const& line) : std::runtime_error(line), code_(code) {}
    int code() const noexcept { return code_; }

private:
    int code_;
};

/// Dotted keys of the scene and values for them, as `--set` takes them: {"joint.clearance", "0.2 mm"}.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// One variable of a result, as a result file has it.  Valid as long as its Result.
struct Column {
    std::string name;
    std::string unit;                     // UDUNITS; "1" of plain numbers, "" of labels and statuses
    std::string long_name;
    std::vector<std::string> dimensions;  // "member", "sample", "apex", …; slowest first
    std::vector<std::size_t> shape;       // of text the last is the longest label's length in bytes
    enum class Type { int8, int32, float64, text } type = Type::float64;
    void const* data = nullptr;           // in C order

    std::size_t size() const {
        std::size_t product = 1;
        for (std::size_t const length : shape) product *= length;
        return product;
    }
    /// All values in C order; NaN where a member failed before it had a value.  @throws Error if the type is not float64
    SLIDEWAY_API std::span<double const> numbers() const;
    /// The same of a column of any type but text, converted.
    SLIDEWAY_API std::vector<double> values() const;
    /// The labels of a column of text, one for each place of all dimensions but the last.  @throws Error if it holds numbers
    SLIDEWAY_API std::vector<std::string> texts() const;
};

/// What a run gave: the variables, groups and attributes of a result file.  Copies share the numbers.
class SLIDEWAY_API Result {
public:
    /// Names of all columns; those of groups as "sensitivity/first_order".
    std::vector<std::string> names() const;
    /// False of a run that was stopped: members that had not ended have the status not_run.
    bool is_complete() const;
    bool has(std::string const& name) const;
    /// Valid as long as this or a copy of it.  @throws Error if there is none of that name
    Column column(std::string const& name) const&;
    Column column(std::string const& name) const&& = delete;
    /// An attribute of the whole, as text: "scene", "version", "seed"; "" if there is none.
    std::string attribute(std::string const& name) const;
    /// The hash of all numbers, as `slideway info` prints it of a result file.
    std::string payload_hash() const;
    /// Writes a result file, as the program does.  @param replace a former result of slideway  @throws Error
    void write(std::string const& path, bool replace = false) const;

    struct Data;
    explicit Result(std::shared_ptr<Data const> data) : data_(std::move(data)) {}
    Data const& data() const { return *data_; }

private:
    std::shared_ptr<Data const> data_;
};

struct RunOptions {
    int threads = 0;           // 0: all that this process may use
    std::string isa = "auto";  // or one of those that `slideway list` names
    /// Some members run again with tighter tolerances and by another method; the group `verification` says what agrees.
    bool verify = false;
    bool progress = false;                    // tell on stderr how far the run is
    std::atomic<bool> const* stop = nullptr;  // read again and again during the run: true ends it
    /// Take starts that no mechanism has, such as inside the way, which are an error without it.
    bool any_start = false;
};

/// Numbers of rows by named columns: values[row * names.size() + column], SI.
struct Table {
    std::vector<std::string> names;
    std::vector<double> values;
    std::size_t rows() const { return names.empty() ? 0 : values.size() / names.size(); }
};

/// A scene that has been read, ready to run.
class SLIDEWAY_API Ensemble {
public:
    /// @throws Error with file, line and key
    static Ensemble read(std::string const& path, Settings const& settings = {});
    /// The text of a scene; `name` stands for the path in messages.
    static Ensemble parse(std::string const& text, std::string const& name = "scene", Settings const& settings = {});
    /// The same scene with other values, the same given members and the same tables: their files are not read again.
    Ensemble with(Settings const& settings) const;

    /// The same scene with members of these inputs, one a row; the columns are dotted keys, which then have no distribution.
    /// @throws Error for a sweep, whose members follow from its parameter, and for correlated keys
    Ensemble with_members(Table const& inputs) const;

    std::uint64_t members() const;
    /// What varies, as members draw it: dotted keys and a row for each member.
    Table draws() const;
    /// Names of the mechanism's state, in the order of `probe`: "y", "z", "vy", …
    std::vector<std::string> state_names() const;
    /// The equations at single states of the nominal mechanism: derivatives d_*, powers [W], penetrations [m], normal forces [N], numbers
    /// of contacts, energies [J], crank torque [N m], and `status`, which is 0 where the state can be evaluated.  Of rigid contacts penetrations
    /// and energy, all else NaN: it depends on how contacts began.
    /// @param states rows of state_names()  @param times [s] of each row, for driven mechanisms; empty: 0
    Table probe(std::span<double const> states, std::span<double const> times = {}) const;
    /// The scene with all its defaults, in SI, as TOML.
    std::string resolved() const;
    /// Keys that were given and have no effect, numbers that are likely slips of a unit, and starts inside the way, one line each.
    /// @param of_starts false: without the starts, which are evaluated for that, and of which `run` throws unless it takes them
    std::vector<std::string> warnings(bool of_starts = true) const;

    /// Bytes of the numbers of a result.
    std::uint64_t result_bytes() const;

    /// Integrates all members, or those that end before `stop` says so.  Nothing is written to disk.  @throws Error, also of
    /// starts that no mechanism has, unless `any_start` takes them
    Result run(RunOptions const& options = {}) const;

    struct State;
    State const& state() const { return *state_; }

private:
    explicit Ensemble(std::shared_ptr<State const> state) : state_(std::move(state)) {}
    std::shared_ptr<State const> state_;
};

/// "0.3.0"
SLIDEWAY_API std::string version();

}  // namespace slideway
