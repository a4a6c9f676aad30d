#include "host/store/result_definition.hpp"

#include <array>
#include <limits>
#include <map>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/base/error.hpp"
#include "host/store/group_writer.hpp"

namespace slideway {

using Type = DataFile::Type;

void put_provenance(DataFile& file, Provenance const& provenance) {
    BuildInfo const& build = build_info();
    auto const attribute = [&](char const* name, std::string const& value) { file.put(DataFile::global, name, value); };
    attribute("Conventions", "CF-1.8");
    attribute("title", provenance.title);
    attribute("source", "slideway " + build.version);
    attribute("version", build.version);
    attribute("commit", build.commit);
    attribute("compiler", build.compiler);
    attribute("flags", provenance.maker.flags);
    attribute("backend", provenance.maker.backend);
    attribute("isa", provenance.maker.isa);
    attribute("machine", machine_name());
    file.put(DataFile::global, "threads", provenance.maker.threads);
    attribute("seed", fmt::format("{}", provenance.seed));  // CF-1.8 has no 64-bit integers
    attribute("created", creation_time());
    attribute("scene", provenance.scene);
    if (!provenance.modules.empty()) attribute("modules", provenance.modules);
    // For readers that know no mechanism or law by its name.
    attribute("mechanism_meaning", provenance.mechanism);
    if (provenance.law.empty()) return;
    attribute("contact_law_meaning", provenance.law);
    file.put(DataFile::global, "contact_law_switches", provenance.law_switches ? 1 : 0);
}

void put_status_flags(DataFile& file, int variable) {
    std::vector<signed char> values{static_cast<signed char>(Status::not_run)};
    std::string meanings = "not_run";
    for (int status = 0; status < status_count; ++status) {
        values.push_back(static_cast<signed char>(status));
        meanings += fmt::format(" {}", status_names[status]);
    }
    file.put(variable, "flag_values", values);
    file.put(variable, "flag_meanings", meanings);
}

namespace {

/// Defines what a layout has, in an order that never changes: files of the same numbers have the same bytes.
class ResultDefiner {
public:
    ResultDefiner(DataFile& file, ResultLayout const& layout) : file_(file), layout_(layout), labels_(file) {}
    ResultVariables define();

private:
    void define_coordinates();
    void define_members();
    void define_quantities();
    void define_series();
    void define_study();
    void define_sections();
    int add(Type type, std::span<int const> dimensions, std::string const& name, std::string const& unit, std::string const& long_name);
    int member_variable(std::string const& name, std::string const& unit, std::string const& long_name);
    void write_coordinates();
    void write_labels(std::vector<std::uint64_t> const& members, std::size_t first);

    DataFile& file_;
    ResultLayout const& layout_;
    ResultVariables ids_;
    int member_dimension_ = 0, sample_dimension_ = 0;
    LabelAxes labels_;
    std::vector<int> axes_;  // of the study
};

/// Whatever goes by members reads as NaN where nothing was written, if it is a number that can be.
int ResultDefiner::add(Type type, std::span<int const> dimensions, std::string const& name, std::string const& unit, std::string const& long_name) {
    bool const fill = type == Type::float64 && dimensions[0] == member_dimension_;
    int const variable = file_.add_variable(name, type, dimensions, fill);
    file_.put(variable, "units", unit);
    file_.put(variable, "long_name", long_name);
    return variable;
}

int ResultDefiner::member_variable(std::string const& name, std::string const& unit, std::string const& long_name) {
    return add(Type::float64, std::array{member_dimension_}, name, unit, long_name);
}

void ResultDefiner::define_coordinates() {
    member_dimension_ = file_.add_dimension("member", static_cast<std::size_t>(layout_.members.count()));
    ids_.member = add(Type::int32, std::array{member_dimension_}, "member", "1", "number of the member in the scene's ensemble");
    if (std::size_t const width = layout_.label_width(); width > 0) {
        int const letters = file_.add_dimension("member_label_length", width);
        ids_.label = define_texts(file_, "member_label", {member_dimension_, letters}, fmt::format("{} of study.table", layout_.labelled->labelled));
    }
    if (layout_.sample_times.empty()) return;
    sample_dimension_ = file_.add_dimension("sample", layout_.sample_times.size());
    ids_.time = add(Type::float64, std::array{sample_dimension_}, "time", "s", "time since the start of the run");
}

void ResultDefiner::define_members() {
    ids_.status = file_.add_variable("status", Type::int8, std::array{member_dimension_});
    file_.put(ids_.status, "long_name", "how the member ended");
    put_status_flags(file_, ids_.status);

    // Counts can pass 2^31 and CF-1.8 has no wider integers; a double holds them exactly up to 2^53.
    for (WorkCounter const& counter : work_table) ids_.work.push_back(member_variable(counter.name, "1", counter.meaning));
    ids_.end_time = member_variable("end_time", "s", "time at which the member ended");
    for (std::size_t i = 0; i < layout_.states(); ++i) {
        SeriesInfo const& state = state_info(info(layout_.mechanism), i);
        ids_.final_states.push_back(member_variable(fmt::format("final_{}", state.name), state.unit, fmt::format("{} at end_time", state.long_name)));
    }
    for (ParameterColumn const& parameter : layout_.parameters) {
        ids_.parameters.push_back(member_variable(parameter.name, parameter.unit, parameter.long_name));
    }
}

void ResultDefiner::define_quantities() {
    for (OutputQuantity const& quantity : selected(outputs_of(layout_.mechanism).quantities, layout_.quantities)) {
        if (quantity.dimension == nullptr) {
            ids_.quantities.push_back({member_variable(quantity.name, quantity.unit, quantity.long_name), quantity.place, 1});
            continue;
        }
        LabelAxes::Axis const& axis = labels_.axis(quantity.dimension);
        int const variable = add(Type::float64, std::array{member_dimension_, axis.dimension}, quantity.name, quantity.unit, quantity.long_name);
        file_.put(variable, "coordinates", axis.label_name);
        ids_.quantities.push_back({variable, quantity.place, static_cast<std::size_t>(quantity.columns)});
    }
}

void ResultDefiner::define_series() {
    if (layout_.sample_times.empty()) return;
    for (SeriesInfo const& series : selected(outputs_of(layout_.mechanism).series, layout_.series)) {
        ids_.series.push_back(add(Type::float64, std::array{member_dimension_, sample_dimension_}, series.name, series.unit, series.long_name));
        file_.put(ids_.series.back(), "coordinates", "time");
    }
}

void ResultDefiner::define_study() {
    std::map<std::string, int> dimensions;
    for (StudyAxis const& axis : layout_.study.axes) {
        int const dimension = file_.add_dimension(axis.name, axis.values.size());
        dimensions[axis.name] = dimension;
        axes_.push_back(add(Type::float64, std::array{dimension}, axis.name, axis.unit, axis.long_name));
    }
    for (StudyColumn const& column : layout_.study.columns) {
        std::vector<int> shape{member_dimension_};
        for (std::string const& axis : column.axes) shape.push_back(dimensions.at(axis));
        ids_.study.push_back(add(Type::float64, shape, column.name, column.unit, column.long_name));
    }
}

/// CF-1.8, 9.3.3: contiguous ragged arrays.
void ResultDefiner::define_sections() {
    if (layout_.sections == 0) return;
    // A dimension of no length is one without limit to netCDF.
    int const dimension = file_.add_dimension("section", static_cast<std::size_t>(layout_.section_rows));
    ids_.section_count = add(Type::int32, std::array{member_dimension_}, "section_count", "1", "sections of the member");
    file_.put(ids_.section_count, "sample_dimension", "section");
    if (layout_.crossings) {
        ids_.section_crossings = add(Type::int32, std::array{member_dimension_}, "section_crossings", "1",
                                     "crossings of the section, also those beyond study.max_crossings");
    }
    auto const add_column = [&](std::string const& name, std::string const& unit, std::string const& long_name) {
        ids_.section_columns.push_back(add(Type::float64, std::array{dimension}, name, unit, long_name));
    };
    add_column("section_time", "s", "time of the section since the start of the run");
    for (std::size_t i = 0; i < layout_.states(); ++i) {
        SeriesInfo const& state = state_info(info(layout_.mechanism), i);
        add_column(std::string("section_") + state.name, state.unit, std::string(state.long_name) + " at the section");
    }
}

/// @param first place of the first of the members
void ResultDefiner::write_labels(std::vector<std::uint64_t> const& members, std::size_t first) {
    std::size_t const width = layout_.label_width();
    std::vector<char> letters(members.size() * width, '\0');
    for (std::size_t i = 0; i < members.size(); ++i) layout_.labelled->labels[static_cast<std::size_t>(members[i])].copy(letters.data() + i * width, width);
    std::size_t const start[2] = {first, 0}, count[2] = {members.size(), width};
    file_.write(ids_.label, start, count, letters.data());
}

void ResultDefiner::write_coordinates() {
    constexpr std::uint64_t at_once = 1 << 18;
    for (std::uint64_t first = 0; first < layout_.members.count(); first += at_once) {
        std::vector<std::uint64_t> const members = layout_.members.members(first, at_once);
        std::vector<int> const numbers(members.begin(), members.end()), none(members.size(), 0);
        std::vector<signed char> const not_run(members.size(), static_cast<signed char>(Status::not_run));
        std::size_t const start[1] = {static_cast<std::size_t>(first)}, count[1] = {members.size()};
        file_.write(ids_.member, start, count, numbers.data());
        file_.write(ids_.status, start, count, not_run.data());
        if (ids_.label >= 0) write_labels(members, static_cast<std::size_t>(first));
        for (int const variable : {ids_.section_count, ids_.section_crossings}) {
            if (variable >= 0) file_.write(variable, start, count, none.data());
        }
    }
    if (!layout_.sample_times.empty()) file_.write(ids_.time, layout_.sample_times.data());
    labels_.write();
    for (std::size_t i = 0; i < axes_.size(); ++i) file_.write(axes_[i], layout_.study.axes[i].values.data());
}

ResultVariables ResultDefiner::define() {
    define_coordinates();
    define_members();
    define_quantities();
    define_series();
    define_study();
    define_sections();
    file_.end_definitions();
    write_coordinates();
    return ids_;
}

}  // namespace

void put_quantity_names(DataFile& file, ResultLayout const& layout) {
    std::vector<char const*> names;
    for (OutputQuantity const& quantity : selected(outputs_of(layout.mechanism).quantities, layout.quantities)) names.push_back(quantity.name);
    if (!names.empty()) file.put(DataFile::global, "quantities", fmt::format("{}", fmt::join(names, " ")));
}

ResultVariables define_variables(DataFile& file, ResultLayout const& layout) {
    constexpr std::uint64_t largest = std::numeric_limits<int>::max();
    if (!layout.members.empty() && layout.members.ranges().back().end() > largest) {
        throw FileError(fmt::format("{}: cannot number members beyond {}", file.path(), largest));
    }
    if (!layout.sweep.empty()) file.put(DataFile::global, "sweep_parameter", layout.sweep);
    put_quantity_names(file, layout);
    return ResultDefiner(file, layout).define();
}

ResultVariables define_result(DataFile& file, ResultLayout const& layout, Provenance const& provenance) {
    put_provenance(file, provenance);
    return define_variables(file, layout);
}

}  // namespace slideway
