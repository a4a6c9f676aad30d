// slideway._native: the library in Python's process.  slideway/ensemble.py is what users see of it.
#include <atomic>
#include <csignal>
#include <optional>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "host/base/bytes.hpp"
#include "host/config/outputs.hpp"
#include "host/library/state.hpp"

namespace nb = nanobind;

namespace slideway {
namespace {

std::atomic<bool> interrupted = false;

/// While it lives, Ctrl-C is noted instead of handled by Python, which cannot while the numbers are computed.
class InterruptScope {
public:
    explicit InterruptScope(bool active) : active_(active) {
        if (!active_) return;
        interrupted = false;
        struct sigaction action = {};
        action.sa_handler = [](int) { interrupted = true; };
        sigemptyset(&action.sa_mask);
        sigaction(SIGINT, &action, &former_);
    }
    ~InterruptScope() {
        if (active_) sigaction(SIGINT, &former_, nullptr);
    }
    InterruptScope(InterruptScope const&) = delete;

private:
    bool const active_;
    struct sigaction former_ = {};
};

nb::dict attributes_of(MemoryFile const& file, int variable) {
    struct Cast {
        nb::object operator()(std::string const& text) const { return nb::str(text.c_str(), text.size()); }
        nb::object operator()(double number) const { return nb::float_(number); }
        nb::object operator()(int number) const { return nb::int_(number); }
        nb::object operator()(std::vector<signed char> const& bytes) const {
            nb::list numbers;
            for (signed char const byte : bytes) numbers.append(static_cast<int>(byte));
            return numbers;
        }
    };
    nb::dict attributes;
    for (auto const& attribute : file.attributes(variable)) attributes[attribute.name.c_str()] = std::visit(Cast{}, attribute.value);
    return attributes;
}

/// The values as a NumPy array that keeps the result alive.
nb::object array_of(Result const& result, MemoryFile const& file, DataFile::Variable const& variable) {
    nb::capsule owner(new Result(result), [](void* held) noexcept { delete static_cast<Result*>(held); });
    auto const array = [&]<class T>(T const*) {
        // Read-only: copies and the file that is written later share them.
        auto const* const data = reinterpret_cast<T const*>(file.data(variable.id));
        return nb::ndarray<nb::numpy, T const>(data, variable.shape.size(), variable.shape.data(), owner).cast();
    };
    switch (variable.type) {
        case DataFile::Type::float64:
            return array(static_cast<double const*>(nullptr));
        case DataFile::Type::int32:
            return array(static_cast<int const*>(nullptr));
        case DataFile::Type::int8:
            return array(static_cast<signed char const*>(nullptr));
        case DataFile::Type::text:
            break;
    }
    // Rows of characters.
    std::size_t const rows = variable.shape.empty() ? 0 : variable.shape.front(), width = rows == 0 ? 0 : variable.size() / rows;
    nb::list texts;
    for (std::size_t row = 0; row < rows; ++row) {
        std::string text(reinterpret_cast<char const*>(file.data(variable.id)) + row * width, width);
        text.resize(std::min(text.find('\0'), text.size()));
        texts.append(nb::str(text.c_str(), text.size()));
    }
    return texts;
}

/// Whether a variable says where the values of others lie, and is the same in all runs of the same form.
bool is_coordinate(DataFile::Variable const& variable) {
    if (variable.type == DataFile::Type::text) return true;
    return variable.dimensions.size() == 1 && (variable.dimensions.front() == variable.name || variable.dimensions.front() == "sample");
}

/// Of two results of one number the variables differ in values alone, and those of the coordinates are the same.
std::uint64_t form_of(MemoryFile const& file) {
    Fnv1a hash;
    for (DataFile::Variable const& variable : file.variables()) {
        hash.add(variable.name);
        for (std::size_t const length : variable.shape) hash.add(std::uint64_t{length});
        if (is_coordinate(variable)) hash.add(std::span(file.data(variable.id), variable.size() * DataFile::size_of(variable.type)));
    }
    return hash.value();
}

/// (name, dimensions, values, attributes) of each variable.
nb::list variables_of(Result const& result, MemoryFile const& file) {
    nb::list variables;
    for (DataFile::Variable const& variable : file.variables()) {
        auto dimensions = variable.dimensions;
        if (variable.type == DataFile::Type::text && dimensions.size() > 1) dimensions.pop_back();
        variables.append(nb::make_tuple(variable.name, nb::tuple(nb::cast(dimensions)), array_of(result, file, variable),
                                        attributes_of(file, variable.id)));
    }
    return variables;
}

/// By name, without coordinates.
nb::dict arrays_of(Result const& result) {
    MemoryFile const& file = result.data().file;
    nb::dict arrays;
    for (DataFile::Variable const& variable : file.variables()) {
        if (!is_coordinate(variable)) arrays[variable.name.c_str()] = array_of(result, file, variable);
    }
    return arrays;
}

/// @param is_main_thread whose Ctrl-C ends the run
Result run(Ensemble const& ensemble, int threads, std::string const& isa, bool verify, bool progress, bool any_start, bool is_main_thread) {
    InterruptScope const scope(is_main_thread);
    Result result = [&] {
        nb::gil_scoped_release const released;
        return ensemble.run({threads, isa, verify, progress, is_main_thread ? &interrupted : nullptr, any_start});
    }();
    // One that came too late to end the run is Python's to raise.
    if (is_main_thread && interrupted && result.is_complete()) PyErr_SetInterrupt();
    return result;
}

using Numbers = nb::ndarray<double const, nb::c_contig, nb::device::cpu>;

std::pair<std::vector<std::string>, nb::object> to_python(Table table) {
    auto* const held = new std::vector<double>(std::move(table.values));
    nb::capsule owner(held, [](void* values) noexcept { delete static_cast<std::vector<double>*>(values); });
    std::size_t const columns = table.names.size(), shape[2] = {columns == 0 ? 0 : held->size() / columns, columns};
    return {table.names, nb::ndarray<nb::numpy, double>(held->data(), 2, shape, owner).cast()};
}

}  // namespace
}  // namespace slideway

NB_MODULE(_native, module) {
    using namespace slideway;
    nb::exception<Error> const exception(module, "Error");
    nb::register_exception_translator(
        [](std::exception_ptr const& thrown, void* type) {
            try {
                std::rethrow_exception(thrown);
            } catch (Error const& error) {
                PyErr_SetObject(static_cast<PyObject*>(type), nb::make_tuple(error.code(), error.what()).ptr());
            }
        },
        exception.ptr());

    nb::class_<Result>(module, "Result")
        .def_prop_ro("is_complete", &Result::is_complete)
        .def_prop_ro("form", [](Result const& result) { return form_of(result.data().file); })
        .def("arrays", &arrays_of)
        .def("variables", [](Result const& result) { return variables_of(result, result.data().file); })
        .def("attributes", [](Result const& result) { return attributes_of(result.data().file, DataFile::global); })
        .def("groups", [](Result const& result) { return result.data().file.groups(); })
        .def("group_variables", [](Result const& result, std::string const& name) { return variables_of(result, result.data().file.inner(name)); })
        .def("group_attributes",
             [](Result const& result, std::string const& name) { return attributes_of(result.data().file.inner(name), DataFile::global); })
        .def("payload_hash", &Result::payload_hash)
        // Another thread may wait for the files, and this one for it.
        .def("write", &Result::write, nb::arg("path"), nb::arg("replace"), nb::call_guard<nb::gil_scoped_release>());

    nb::class_<Ensemble>(module, "Ensemble")
        .def_static("read", &Ensemble::read)
        .def_static("parse", &Ensemble::parse)
        .def("with_settings", &Ensemble::with)
        .def("with_members",
             [](Ensemble const& ensemble, std::vector<std::string> const& names, Numbers const& values) {
                 return ensemble.with_members({names, {values.data(), values.data() + values.size()}});
             })
        .def_prop_ro("members", &Ensemble::members)
        .def_prop_ro("result_bytes", &Ensemble::result_bytes)
        .def_prop_ro("resolved", &Ensemble::resolved)
        .def("warnings", &Ensemble::warnings)
        .def_prop_ro("state_names", &Ensemble::state_names)
        .def("draws", [](Ensemble const& ensemble) { return to_python(ensemble.draws()); })
        .def("probe",
             [](Ensemble const& ensemble, Numbers const& states, Numbers const& times) {
                 return to_python(ensemble.probe({states.data(), states.size()}, {times.data(), times.size()}));
             })
        .def("run", &run);
    module.def("version", &version);
    module.def("former_names", [] {
        nb::dict names;
        for (FormerName const& name : former_names) names[nb::str(name.then.data(), name.then.size())] = nb::str(name.now.data(), name.now.size());
        return names;
    });
}
