#include "host/output/result_writer.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <fmt/format.h>

#include "host/output/payload_hash.hpp"
#include "host/scene/error.hpp"

namespace slideway {
namespace {

using Type = NetcdfFile::Type;

constexpr std::size_t label_length = 8;  // "surface" and room for one more letter

/// Before netCDF tries: its reasons for a folder ("HDF error") tell nobody what to do.
void require_writable_place(std::string const& path) {
    namespace fs = std::filesystem;
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) throw FileError(path + ": is a folder; give a file name with -o");
    fs::path folder = fs::path(path).parent_path();
    if (folder.empty()) folder = ".";
    if (!fs::is_directory(folder, ignored)) {
        throw FileError(fmt::format("{}: cannot create: there is no folder '{}'", path, folder.string()));
    }
    // The renaming at the end would put a file in the place of /dev/null.
    if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) {
        throw FileError(path + ": is a device or a pipe; give the name of a file with -o");
    }
}

/// Removes what a killed run left.  A run that still lives shows by the lock that HDF5 holds on a file it writes;
/// without locks (some network file systems) nobody can tell, and the file is taken for a leftover.
void remove_leftover(std::string const& path, std::string const& part) {
    int const file = open(part.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) return;  // there is none, or creating it tells what is wrong
    bool const in_use = flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (!in_use) unlink(part.c_str());
    close(file);
    if (in_use) throw FileError(path + ": another run is writing it; wait for its end or give another name with -o");
}

}  // namespace

ResultWriter::ResultWriter(std::string path, ResultLayout layout, Provenance const& provenance)
    : path_(std::move(path)), part_(path_ + ".part"), layout_(std::move(layout)), study_(layout_.study) {
    constexpr std::uint64_t largest = std::numeric_limits<int>::max();
    if (layout_.members > largest || layout_.first_member > largest - layout_.members) {
        throw FileError(fmt::format("{}: cannot number members beyond {}", path_, largest));
    }
    require_writable_place(path_);
    remove_leftover(path_, part_);
    file_.emplace(NetcdfFile::create(part_));
    try {
        BuildInfo const& build = build_info();
        auto const attribute = [&](char const* name, std::string const& value) {
            file_->put_text(NetcdfFile::global, name, value);
        };
        attribute("Conventions", "CF-1.8");
        attribute("title", provenance.title);
        attribute("source", "slideway " + build.version);
        attribute("version", build.version);
        attribute("commit", build.commit);
        attribute("compiler", build.compiler);
        attribute("flags", provenance.flags);
        attribute("backend", provenance.backend);
        attribute("isa", provenance.isa);
        file_->put_number(NetcdfFile::global, "threads", provenance.threads);
        attribute("seed", fmt::format("{}", provenance.seed));  // CF-1.8 has no 64-bit integers
        attribute("created", creation_time());
        attribute("scene", provenance.scene);
        if (!layout_.sweep.empty()) attribute("sweep_parameter", layout_.sweep);
        define_coordinates();
        define_members();
        define_quantities();
        define_series();
        study_.define(*file_, member_dimension_);
        if (layout_.sections > 0) sections_.emplace().define(*file_, member_dimension_, layout_.crossings);
        file_->end_definitions();
        write_coordinates();
        study_.write_axes(*file_);
        reserve_space();
    } catch (...) {
        file_.reset();
        std::remove(part_.c_str());
        throw;
    }
}

ResultWriter::~ResultWriter() {
    if (!file_) return;
    file_.reset();
    std::remove(part_.c_str());
}

void ResultWriter::describe(int variable, std::string const& unit, std::string const& long_name) {
    file_->put_text(variable, "units", unit);
    file_->put_text(variable, "long_name", long_name);
}

int ResultWriter::member_variable(std::string const& name, std::string const& unit, std::string const& long_name) {
    int const variable = file_->add_variable(name, Type::float64, std::array{member_dimension_}, true);
    describe(variable, unit, long_name);
    return variable;
}

void ResultWriter::define_coordinates() {
    member_dimension_ = file_->add_dimension("member", layout_.members);
    member_ = file_->add_variable("member", Type::int32, std::array{member_dimension_});
    describe(member_, "1", "number of the member in the scene's ensemble");
    if (layout_.sample_times.empty()) return;
    sample_dimension_ = file_->add_dimension("sample", layout_.sample_times.size());
    time_ = file_->add_variable("time", Type::float64, std::array{sample_dimension_});
    describe(time_, "s", "time since the start of the run");
}

void ResultWriter::define_members() {
    status_ = file_->add_variable("status", Type::int8, std::array{member_dimension_});
    file_->put_text(status_, "long_name", "how the member ended");
    std::vector<signed char> values{static_cast<signed char>(Status::not_run)};
    std::string meanings = "not_run";
    for (int status = 0; status < status_count; ++status) {
        values.push_back(static_cast<signed char>(status));
        meanings += fmt::format(" {}", status_names[status]);
    }
    file_->put_bytes(status_, "flag_values", values);
    file_->put_text(status_, "flag_meanings", meanings);

    // Counts can pass 2^31 and CF-1.8 has no wider integers; a double holds them exactly up to 2^53.
    steps_accepted_ = member_variable("steps_accepted", "1", "accepted steps");
    steps_rejected_ = member_variable("steps_rejected", "1", "rejected steps");
    rhs_evaluations_ = member_variable("rhs_evaluations", "1", "evaluations of the right-hand side");
    jacobian_evaluations_ = member_variable("jacobian_evaluations", "1", "evaluations of the Jacobian");
    stiff_steps_ = member_variable("stiff_steps", "1", "accepted steps of the stiff method");
    end_time_ = member_variable("end_time", "s", "time at which the member ended");
    for (int i = 0; i < state_size; ++i) {
        final_states_.push_back(member_variable(fmt::format("final_{}", series_table[i].name), series_table[i].unit,
                                                fmt::format("{} at end_time", series_table[i].long_name)));
    }
    for (ParameterColumn const& parameter : layout_.parameters) {
        parameters_.push_back(member_variable(parameter.name, parameter.unit, parameter.long_name));
    }
}

void ResultWriter::define_quantities() {
    struct Axis {
        int dimension;
        std::string label_name;
    };
    std::map<std::string, Axis> axes;
    int label_dimension = -1;
    auto const axis_of = [&](std::string const& name) -> Axis const& {
        auto const [found, is_new] = axes.try_emplace(name);
        if (is_new) {
            if (label_dimension < 0) label_dimension = file_->add_dimension("label_length", label_length);
            std::vector<std::string> labels = labels_of(name);
            found->second = {file_->add_dimension(name, labels.size()), name + "_name"};
            int const variable = file_->add_variable(found->second.label_name, Type::text,
                                                     std::array{found->second.dimension, label_dimension});
            file_->put_text(variable, "long_name", fmt::format("label along {}", name));
            file_->put_text(variable, "_Encoding", "utf-8");  // readers then give strings, not bytes
            labels_.push_back({variable, std::move(labels)});
        }
        return found->second;
    };
    for (int q = 0; q < quantity_count; ++q) {
        if (!selects(layout_.quantities, static_cast<Quantity>(q))) continue;
        QuantityInfo const& info = quantity_table[q];
        int const first_column = quantity_column(static_cast<Quantity>(q));
        if (info.dimension == nullptr) {
            quantities_.push_back({member_variable(info.name, info.unit, info.long_name), first_column, 1});
            continue;
        }
        Axis const& axis = axis_of(info.dimension);
        int const variable =
            file_->add_variable(info.name, Type::float64, std::array{member_dimension_, axis.dimension}, true);
        describe(variable, info.unit, info.long_name);
        file_->put_text(variable, "coordinates", axis.label_name);
        quantities_.push_back({variable, first_column, info.columns});
    }
}

void ResultWriter::define_series() {
    if (layout_.sample_times.empty()) return;
    for (int s = 0; s < series_count; ++s) {
        if (!selects(layout_.series, static_cast<Series>(s))) continue;
        int const variable = file_->add_variable(series_table[s].name, Type::float64,
                                                 std::array{member_dimension_, sample_dimension_}, true);
        describe(variable, series_table[s].unit, series_table[s].long_name);
        file_->put_text(variable, "coordinates", "time");
        series_.push_back(variable);
    }
}

void ResultWriter::write_coordinates() {
    auto const members = static_cast<std::size_t>(layout_.members);
    std::vector<int> numbers(members);
    for (std::size_t i = 0; i < members; ++i) numbers[i] = static_cast<int>(layout_.first_member + i);
    std::vector<signed char> const not_run(members, static_cast<signed char>(Status::not_run));
    std::size_t const origin[2] = {0, 0};
    std::size_t const all_members[1] = {members};
    file_->write(member_, {origin, 1}, all_members, numbers.data());
    file_->write(status_, {origin, 1}, all_members, not_run.data());
    if (!layout_.sample_times.empty()) {
        std::size_t const all_samples[1] = {layout_.sample_times.size()};
        file_->write(time_, {origin, 1}, all_samples, layout_.sample_times.data());
    }
    for (LabelVariable const& variable : labels_) {
        std::vector<char> text(variable.labels.size() * label_length, '\0');
        for (std::size_t i = 0; i < variable.labels.size(); ++i) {
            variable.labels[i].copy(text.data() + i * label_length, label_length);
        }
        std::size_t const all_labels[2] = {variable.labels.size(), label_length};
        file_->write(variable.id, origin, all_labels, text.data());
    }
}

void ResultWriter::reserve_space() {
    // The first value makes HDF5 allocate a variable's storage and fill it with NaN.  A full disk so shows before the
    // work instead of after it, and the storage lies in the order of definition whichever block comes first.
    double const nan = std::numeric_limits<double>::quiet_NaN();
    std::size_t const origin[3] = {0, 0, 0}, one[3] = {1, 1, 1};
    for (NetcdfFile::Variable const& variable : file_->variables()) {
        if (variable.type != Type::float64 || variable.id == time_ || variable.size() == 0) continue;
        if (study_.is_axis(variable.id)) continue;
        file_->write(variable.id, {origin, variable.shape.size()}, {one, variable.shape.size()}, &nan);
    }
}

void ResultWriter::write_column(int variable, BlockResult const& block, std::vector<double> const& values) {
    std::size_t const start[1] = {static_cast<std::size_t>(block.first)};
    std::size_t const count[1] = {values.size()};
    file_->write(variable, start, count, values.data());
}

void ResultWriter::write(BlockResult const& block, StudyValues const& study) {
    std::size_t const members = block.records.size();
    std::size_t const start[2] = {static_cast<std::size_t>(block.first), 0};
    std::vector<double> column(members);
    auto const put = [&](int variable, auto&& value_of) {
        for (std::size_t i = 0; i < members; ++i) column[i] = static_cast<double>(value_of(i));
        write_column(variable, block, column);
    };

    std::vector<signed char> statuses(members);
    for (std::size_t i = 0; i < members; ++i) statuses[i] = static_cast<signed char>(block.records[i].status);
    std::size_t const all_members[1] = {members};
    file_->write(status_, {start, 1}, all_members, statuses.data());
    put(steps_accepted_, [&](std::size_t i) { return block.records[i].steps_accepted; });
    put(steps_rejected_, [&](std::size_t i) { return block.records[i].steps_rejected; });
    put(rhs_evaluations_, [&](std::size_t i) { return block.records[i].rhs_evaluations; });
    put(jacobian_evaluations_, [&](std::size_t i) { return block.records[i].jacobian_evaluations; });
    put(stiff_steps_, [&](std::size_t i) { return block.records[i].stiff_steps; });
    put(end_time_, [&](std::size_t i) { return block.records[i].time; });
    for (std::size_t k = 0; k < final_states_.size(); ++k) {
        put(final_states_[k], [&](std::size_t i) { return block.final_states[i * state_size + k]; });
    }
    for (std::size_t k = 0; k < parameters_.size(); ++k) {
        put(parameters_[k], [&](std::size_t i) { return block.inputs[i].*layout_.parameters[k].member; });
    }
    for (QuantityVariable const& quantity : quantities_) {
        auto const columns = static_cast<std::size_t>(quantity.columns);
        std::vector<double> values;
        values.reserve(members * columns);
        for (std::size_t i = 0; i < members; ++i) {
            auto const row = block.quantities.subspan(i * quantity_columns + quantity.first_column, columns);
            values.insert(values.end(), row.begin(), row.end());
        }
        std::size_t const count[2] = {members, columns};
        file_->write(quantity.id, {start, columns > 1 ? 2u : 1u}, {count, columns > 1 ? 2u : 1u}, values.data());
    }
    std::size_t const samples = layout_.sample_times.size();
    for (std::size_t k = 0; k < series_.size(); ++k) {
        std::size_t const count[2] = {members, samples};
        file_->write(series_[k], start, count, block.series.data() + k * members * samples);
    }
    study_.write(*file_, start[0], members, study);
    if (sections_) sections_->write(*file_, block);
}

void ResultWriter::finish(double lane_utilisation, StopReason stopped) {
    if (sections_) sections_->finish(*file_, layout_.members);
    file_->put_number(NetcdfFile::global, "lane_utilisation", lane_utilisation);
    char const* const end = stopped == StopReason::none     ? "complete"
                            : stopped == StopReason::signal ? "stopped by a signal"
                                                            : "stopped by the time limit";
    file_->put_text(NetcdfFile::global, "completeness", end);
    file_->flush();
    file_->put_text(NetcdfFile::global, "payload_hash", payload_hash(*file_));
    file_->close();
    file_.reset();
    if (std::rename(part_.c_str(), path_.c_str()) != 0) {
        throw FileError(
            fmt::format("{}: cannot replace: {}; the results are in {}", path_, std::strerror(errno), part_));
    }
}

}  // namespace slideway
