#include "host/library/slideway.hpp"

#include <algorithm>
#include <cstring>
#include <mutex>

#include <fmt/format.h>

#include "host/backend/backend.hpp"
#include "host/config/document.hpp"
#include "host/config/scene.hpp"
#include "host/library/state.hpp"
#include "host/run/ensemble.hpp"
#include "host/store/memory_file.hpp"
#include "host/store/netcdf_file.hpp"
#include "host/store/output_target.hpp"
#include "host/store/run_identity.hpp"
#include "host/store/result_merge.hpp"
#include "host/store/result_seal.hpp"
#include "host/study/admission.hpp"
#include "host/study/backend_choice.hpp"
#include "host/study/probe.hpp"
#include "host/study/state_table.hpp"
#include "host/study/study_run.hpp"

namespace slideway {
namespace {

/// The exceptions of the layers below as the one that the library has.
template <class Call> auto told(Call&& call) -> decltype(call()) {
    try {
        return call();
    } catch (SceneError const& error) {
        throw Error(2, error.what());
    } catch (FileError const& error) {
        throw Error(4, error.what());
    } catch (DeviceError const& error) {
        throw Error(4, error.what());
    } catch (Error const&) {
        throw;
    } catch (std::exception const& error) {
        throw Error(1, error.what());
    }
}

/// netCDF and HDF5 are not thread-safe.
std::mutex files;

/// Whether a file is a result.  In this process: a host with threads must not be forked.
bool is_result(std::string const& path) {
    try {
        return NetcdfFile::open(path).text(DataFile::global, "source").starts_with("slideway");
    } catch (FileError const&) {
        return false;
    }
}

Column column_of(MemoryFile const& file, DataFile::Variable const& variable, std::string const& name) {
    Column column{name, file.text(variable.id, "units"), file.text(variable.id, "long_name"), variable.dimensions, variable.shape,
                  static_cast<Column::Type>(variable.type), file.data(variable.id)};
    return column;
}

/// Calls visit(file or group, variable, "group/name") for every variable.
template <class Visit> void for_each_variable(MemoryFile const& file, std::string const& prefix, Visit const& visit) {
    for (DataFile::Variable const& variable : file.variables()) visit(file, variable, prefix + variable.name);
    for (std::string const& name : file.groups()) for_each_variable(file.inner(name), prefix + name + "/", visit);
}

BackendRequest request_of(RunOptions const& options) {
    constexpr int most_threads = 4096;  // beyond it the OpenMP runtime ends the process
    if (options.threads < 0 || options.threads > most_threads) {
        throw SceneError(fmt::format("threads is {}; use 0 for all that this process may use, or 1 to {}", options.threads, most_threads));
    }
    BackendRequest request;
    request.kind = BackendRequest::Kind::cpu;
    request.threads = options.threads > 0 ? options.threads : default_threads();
    if (options.isa == "auto") return request;
    for (Isa const isa : all_isas()) {
        if (name_of(isa) == options.isa) request.isa = isa;
    }
    if (!request.isa) throw SceneError(options.isa + ": is no instruction set; see `slideway list`");
    return request;
}

}  // namespace

std::string version() { return build_info().version; }

// ---- columns --------------------------------------------------------------------------------------------------

std::span<double const> Column::numbers() const {
    if (type != Type::float64) throw Error(2, name + ": is not of type float64; take values() for numbers of other types");
    return {static_cast<double const*>(data), size()};
}

std::vector<double> Column::values() const {
    auto const converted = [this]<class T>(T const* from) { return std::vector<double>(from, from + size()); };
    switch (type) {
        case Type::int8:
            return converted(static_cast<signed char const*>(data));
        case Type::int32:
            return converted(static_cast<int const*>(data));
        case Type::float64:
            return converted(static_cast<double const*>(data));
        case Type::text:
            break;
    }
    throw Error(2, name + ": holds text; take texts()");
}

std::vector<std::string> Column::texts() const {
    if (type != Type::text) throw Error(2, name + ": holds numbers; take values()");
    std::size_t const width = shape.empty() ? 1 : shape.back();
    std::vector<std::string> texts;
    for (std::size_t at = 0; at < size(); at += width) {
        std::string_view const padded(static_cast<char const*>(data) + at, width);
        texts.emplace_back(padded.substr(0, padded.find('\0')));
    }
    return texts;
}

// ---- result ---------------------------------------------------------------------------------------------------

std::vector<std::string> Result::names() const {
    std::vector<std::string> names;
    for_each_variable(data_->file, "", [&](auto const&, auto const&, std::string const& name) { names.push_back(name); });
    return names;
}

bool Result::is_complete() const { return attribute("completeness") == "complete"; }

bool Result::has(std::string const& name) const { return std::ranges::count(names(), name) > 0; }

Column Result::column(std::string const& name) const& {
    std::optional<Column> found;
    for_each_variable(data_->file, "", [&](MemoryFile const& file, DataFile::Variable const& variable, std::string const& one) {
        if (one == name) found = column_of(file, variable, one);
    });
    if (!found) throw Error(2, name + ": is no column of this result; names() has them all, and study.quantities of the scene says which there are");
    return *found;
}

std::string Result::attribute(std::string const& name) const { return data_->file.text(DataFile::global, name); }

std::string Result::payload_hash() const { return slideway::payload_hash(data_->file); }

void Result::write(std::string const& path, bool replace) const {
    told([&] {
        std::lock_guard const lock(files);
        OutputTarget const target(path, {{}, replace, is_result, "allow to replace it, or give another name"});
        write_result(target.path(), attribute("completeness"), [&](NetcdfFile& file) { data_->file.copy_to(file); }, target.existing());
    });
}

// ---- ensemble -------------------------------------------------------------------------------------------------

Ensemble Ensemble::read(std::string const& path, Settings const& settings) {
    return told([&] {
        std::string text = read_scene_text(path);
        Scene scene = parse_scene(text, path, settings);
        return Ensemble(std::make_shared<State>(State{std::move(text), path, settings, std::move(scene), {}}));
    });
}

Ensemble Ensemble::parse(std::string const& text, std::string const& name, Settings const& settings) {
    return told([&] { return Ensemble(std::make_shared<State>(State{text, name, settings, parse_scene(text, name, settings), {}})); });
}

Ensemble Ensemble::with(Settings const& settings) const {
    auto const& [text, name, before, scene, given] = *state_;
    Settings all = before;
    all.insert(all.end(), settings.begin(), settings.end());
    Ensemble const other = told([&] { return Ensemble(std::make_shared<State>(State{text, name, all, parse_scene(text, name, all, &scene), {}})); });
    return given.names.empty() ? other : other.with_members(given);
}

Ensemble Ensemble::with_members(Table const& inputs) const {
    return told([&] {
        auto state = std::make_shared<State>(*state_);
        take_members(state->scene, inputs.names, inputs.values);
        state->given = inputs;
        return Ensemble(std::move(state));
    });
}

Table Ensemble::draws() const {
    return told([&] {
        Scene const& scene = state_->scene;
        Table table;
        for (Variation const& variation : scene.variations) table.names.emplace_back(variation.key->name);
        for (std::uint64_t member = 0; member < member_count(scene) && !table.names.empty(); ++member) {
            for (Variation const& variation : scene.variations) table.values.push_back(draw(scene, variation, member));
        }
        return table;
    });
}

std::vector<std::string> Ensemble::state_names() const {
    MechanismInfo const& mechanism = info(state_->scene.parts.mechanism);
    std::vector<std::string> names;
    names.reserve(static_cast<std::size_t>(mechanism.states));
    for (int i = 0; i < mechanism.states; ++i) names.emplace_back(state_info(mechanism, i).name);
    return names;
}

Table Ensemble::probe(std::span<double const> states, std::span<double const> times) const {
    return told([&] {
        StateTable const table = state_table(state_->scene, states, times);
        std::vector<ProbeResult> const results = slideway::probe(table, best_isa(state_->scene.parts));
        Table columns;
        for (ProbeResult const& result : results) {
            auto const row = result_columns(table, result);
            if (columns.names.empty()) {
                for (auto const& [name, value] : row) columns.names.push_back(name);
                columns.names.emplace_back("status");
            }
            for (auto const& [name, value] : row) columns.values.push_back(value);
            columns.values.push_back(static_cast<double>(result.status));
        }
        return columns;
    });
}

std::uint64_t Ensemble::members() const { return member_count(state_->scene); }
std::string Ensemble::resolved() const { return resolved_toml(state_->scene); }
std::vector<std::string> Ensemble::warnings(bool of_starts) const {
    return told([&] {
        std::vector<std::string> warnings = state_->scene.warnings;
        if (!of_starts) return warnings;
        if (auto wrong = impossible_starts(state_->scene, best_isa(state_->scene.parts))) warnings.push_back(*std::move(wrong));
        return warnings;
    });
}

std::uint64_t Ensemble::result_bytes() const { return memory_bytes(state_->scene); }

Result Ensemble::run(RunOptions const& options) const {
    return told([&] {
        BackendRequest const request = request_of(options);
        admit(state_->scene, options.any_start);
        MemoryRun run;
        run.backend = choose_backend(request, state_->scene, members()).backend;
        run.threads = request.threads;
        run.verify = options.verify;
        run.stop.watch(options.stop);
        if (options.progress) run.progress = Progress::style_for(stderr, false);
        return Result(std::make_shared<Result::Data>(Result::Data{run_in_memory(state_->scene, run)}));
    });
}

}  // namespace slideway
