#include <sstream>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "host/backend/linkage_modules.hpp"
#include "host/backend/module_compiler.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/text.hpp"
#include "host/config/descriptors.hpp"
#include "host/run/stop.hpp"

namespace slideway::cli {
namespace {

CompileRequest request_of(CompileArguments const& arguments) {
    CompileRequest request{arguments.source, "", arguments.folder, arguments.isas, arguments.threads, &objection_to};
    if (!arguments.source.ends_with(".toml")) return request;
    Scene const scene = load_scene({arguments.source, {}});
    if (scene.parts.linkage == nullptr)
        throw SceneError(fmt::format("{}: its mechanism is compiled already; give a scene with mechanism.kind = \"linkage\", or a header", arguments.source));
    request.text = linkage_header(scene.parts);
    return request;
}

}  // namespace

int execute(CompileArguments const& arguments) {
    std::vector<CompiledModule> modules;
    // A signal ends the compilers, or waits for their end: nothing stays behind.
    StopRequest stop;
    SignalScope const signals(stop);
    try {
        modules = compile_modules(request_of(arguments));
    } catch (CompileError const& error) {
        if (stop.reason() != StopReason::none) {
            tell("slideway: stopped early (signal): no module was made\n");
            return exit_code::stopped_early;
        }
        std::istringstream lines(error.words);
        for (std::string line; std::getline(lines, line);) tell("{}\n", line);
        throw;
    }
    if (arguments.json) {
        auto list = nlohmann::ordered_json::array();
        for (CompiledModule const& one : modules) {
            list.push_back({{"kind", name_of(one.kind)}, {"name", one.name}, {"source", one.source}, {"files", one.files}, {"was_there", one.was_there}});
        }
        print_out("{}\n", nlohmann::ordered_json{{"schema_version", 1}, {"modules", std::move(list)}}.dump(2));
        return exit_code::done;
    }
    for (CompiledModule const& one : modules) {
        print_out("{} {}: source {}{}\n", name_of(one.kind), one.name, one.source, one.was_there ? ", which was there already" : "");
        for (std::string const& file : one.files) print_out("  {}\n", file);
    }
    return exit_code::done;
}

}  // namespace slideway::cli
