#include "host/backend/module_compiler.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <istream>
#include <optional>
#include <span>
#include <sstream>
#include <system_error>
#include <thread>

#include <fmt/format.h>

#include "host/backend/kernel_sources.hpp"
#include "host/backend/module_files.hpp"
#include "host/base/bytes.hpp"
#include "host/base/child_process.hpp"
#include "host/base/durable_file.hpp"
#include "host/base/file_lock.hpp"
#include "host/base/open_file.hpp"

namespace slideway {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

std::string text_of(fs::path const& path) {
    auto const stream = file_stream(path.string());
    return {std::istreambuf_iterator<char>(*stream), {}};
}

Words words_of(std::string const& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

/// A folder that goes when nobody needs it.
class WorkFolder {
public:
    WorkFolder() {
        std::error_code none;
        std::string name = (fs::temp_directory_path(none) / "slideway-compile-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw FileError(fmt::format("{}: cannot be made ({})", name, std::strerror(errno)));
        path_ = name;
    }
    ~WorkFolder() {
        std::error_code none;
        fs::remove_all(path_, none);
    }
    WorkFolder(WorkFolder const&) = delete;
    WorkFolder& operator=(WorkFolder const&) = delete;
    fs::path const& path() const { return path_; }

private:
    fs::path path_;
};

/// What compiles modules here: folders of headers, and the compiler with its first arguments.
struct Toolchain {
    std::vector<fs::path> includes;
    Words compiler;
    Words options;  // that CXX gives it
    bool copies_wide = true;  // whether it has what g++ 12 added for copies: clang and older g++ make the same bits without
};

/// Where headers of the system and of compilers lie, which are no part of a source.
bool is_of_system(std::string const& path) {
    return std::ranges::any_of(std::array{"/usr/include", "/usr/lib"}, [&](std::string const& folder) { return path == folder || path.starts_with(folder + "/"); });
}

constexpr char const* border = "host/backend/kernel_module.cpp";

/// Whether the compiler has the flags of an instruction set for copies of structures.
bool copies_wide(Words const& compiler, fs::path const& log) {
    Words words = compiler;
    words.insert(words.end(), {"-mmove-max=256", "-mstore-max=256", "-fsyntax-only", "-x", "c++", "/dev/null"});
    return run_child(words, log.string(), CtrlC::ends_it).status == 0;
}

/// The value of a variable in a build's cache.
std::string cached(fs::path const& build, std::string_view variable) {
    std::istringstream lines(text_of(build / "CMakeCache.txt"));
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(variable) && line.size() > variable.size() && line[variable.size()] == ':') return line.substr(line.find('=') + 1);
    }
    return {};
}

Toolchain toolchain(fs::path const& work) {
    Toolchain tools;
    if (char const* const named = std::getenv("CXX"); named != nullptr) tools.compiler = words_of(named);
    if (!tools.compiler.empty()) tools.options.assign(tools.compiler.begin() + 1, tools.compiler.end());
    if (fs::path const build = build_folder(); !build.empty()) {
        try {
            // Sources may have changed since.  ninja wants its folder for itself.
            FileLock const alone((build / "kernels.lock").string(), FileLock::Kind::alone, FileLock::Wait::yes);
            run_child({"cmake", "--build", build.string(), "--target", "slideway_kernel_sources"}, (work / "sources.log").string(), CtrlC::ends_it);
        } catch (FileError const&) {  // a build of somebody else's, who looks after it
        }
        tools.includes = {cached(build, "CMAKE_HOME_DIRECTORY"), build / "generated"};
        if (tools.compiler.empty()) tools.compiler = {cached(build, "CMAKE_CXX_COMPILER")};
        if (std::string const xsimd = cached(build, "SLIDEWAY_XSIMD"); !xsimd.empty() && !is_of_system(xsimd)) tools.compiler.insert(tools.compiler.end(), {"-isystem", xsimd});
    } else {
        for (fs::path const& own : program_folders()) {
            for (char const* const place : {"../include/slideway", "include/slideway"}) {
                fs::path const folder = (own / place).lexically_normal();
                if (tools.includes.empty() && is_file((folder / border).string())) tools.includes = {folder};
            }
        }
        if (tools.includes.empty()) throw DeviceError("the headers of the kernels are not beside this program (include/slideway); install slideway as a whole");
    }
    if (tools.compiler.empty()) tools.compiler = {"g++"};
    std::string const header = text_of(tools.includes.back() / "host/backend/kernel_sources.hpp");
    if (header.find("\"" SLIDEWAY_KERNEL_BORDER "\"") == header.npos)
        throw DeviceError(fmt::format("the headers in {} are of other sources than this program; build it again", tools.includes.front().string()));
    tools.copies_wide = copies_wide(tools.compiler, work / "copies.log");
    return tools;
}

/// The flags of an instruction set that this compiler has.
Words flags_for(Toolchain const& tools, Isa isa) {
    Words flags = words_of(flags_of(isa));
    if (!tools.copies_wide) std::erase_if(flags, [](std::string const& flag) { return flag.starts_with("-mmove-max=") || flag.starts_with("-mstore-max="); });
    return flags;
}

/// Runs the compiler.  @throws CompileError with its words
void run_compiler(Toolchain const& tools, Words const& arguments, std::string const& header, fs::path const& log) {
    Words words = tools.compiler;
    words.insert(words.end(), arguments.begin(), arguments.end());
    ChildEnd const end = run_child(words, log.string(), CtrlC::ends_it);
    if (end.error != 0) throw DeviceError(fmt::format("{} does not start ({}); install a compiler with C++20, or name it in CXX", words.front(), std::strerror(end.error)));
    if (end.status == 0) return;
    throw CompileError(fmt::format("{}: {} does not compile it", header, words.front()), text_of(log));
}

/// What a header says of itself.
struct Offer {
    std::array<std::optional<std::string>, module_kinds.size()> types;  // by ModuleKind
    std::string source;  // its hash
    friend bool operator==(Offer const&, Offer const&) = default;
};

/// @return the name behind `#define WHAT`
std::optional<std::string> definition(std::string const& macros, std::string_view what) {
    std::string const begin = fmt::format("#define {} ", what);
    auto const at = macros.starts_with(begin) ? 0 : macros.find("\n" + begin);
    if (at == macros.npos) return std::nullopt;
    auto const from = macros.find(begin, at) + begin.size();
    return macros.substr(from, macros.find('\n', from) - from);
}

/// Files of a makefile rule: "out: a b \\\n c", with blanks in names as "\ ".
std::vector<fs::path> dependencies(std::string const& rule) {
    std::vector<fs::path> files;
    std::string name;
    auto const end_of_name = [&] {
        if (!name.empty()) files.emplace_back(std::exchange(name, {}));
    };
    for (auto i = rule.find(": ") + 1; i < rule.size(); ++i) {
        bool const escaped = rule[i] == '\\' && i + 1 < rule.size();
        if (escaped && rule[i + 1] == '\n') {
            ++i, end_of_name();
        } else if (escaped || (rule[i] == '$' && i + 1 < rule.size() && rule[i + 1] == '$')) {
            name += rule[++i];
        } else if (rule[i] == ' ' || rule[i] == '\n') {
            end_of_name();
        } else {
            name += rule[i];
        }
    }
    end_of_name();
    return files;
}

Words include_words(Toolchain const& tools) {
    Words words;
    for (fs::path const& folder : tools.includes) words.insert(words.end(), {"-I", folder.string()});
    return words;
}

/// Of the header, of what it includes beyond what every module has, and of options that CXX gives.
std::string hash_of(Toolchain const& tools, std::vector<fs::path> const& parts) {
    Fnv1a hash;
    for (fs::path const& part : parts) {
        std::error_code none;
        fs::path const whole = fs::weakly_canonical(part, none);
        bool const of_border = std::ranges::any_of(tools.includes, [&](fs::path const& folder) {
            std::string const name = fmt::format(";{};", whole.lexically_relative(fs::weakly_canonical(folder, none)).string());
            return std::string_view(";" SLIDEWAY_KERNEL_BORDER_FILES).find(name) != std::string_view::npos;
        });
        if (!of_border && !is_of_system(whole.string())) hash.add(text_of(whole)), hash.add(std::uint64_t{0});
    }
    for (std::string const& option : tools.options) hash.add(option), hash.add(std::uint64_t{0});
    return fmt::format("{:016x}", hash.value());
}

/// As an instruction set's compiler sees the header.
Offer offer_of(Toolchain const& tools, Isa isa, std::string const& header, fs::path const& file, fs::path const& work) {
    fs::path const rule = work / "rule", macros = work / "macros";
    Words arguments = flags_for(tools, isa);
    arguments.insert(arguments.end(), {"-std=c++20", "-x", "c++", "-E", "-dM", "-MD", "-MF", rule.string(), "-DSLIDEWAY_NO_SIMD",
                                       fmt::format("-DSLIDEWAY_ISA={}", name_of(isa)), "-w", "-o", macros.string()});
    Words const includes = include_words(tools);
    arguments.insert(arguments.end(), includes.begin(), includes.end());
    arguments.push_back(file.string());
    run_compiler(tools, arguments, header, work / "offer.log");
    std::string const defined = text_of(macros);
    Offer const offer{{definition(defined, "SLIDEWAY_LAW"), definition(defined, "SLIDEWAY_MECHANISM"), definition(defined, "SLIDEWAY_LINKAGE")},
                      hash_of(tools, dependencies(text_of(rule)))};
    if (std::ranges::none_of(offer.types, &std::optional<std::string>::has_value))
        throw SceneError(fmt::format("{}: it offers nothing; end it with `#define SLIDEWAY_LAW Type`, or `#define SLIDEWAY_MECHANISM Type`", header));
    return offer;
}

/// As all of them see it.
Offer offer_of(Toolchain const& tools, std::vector<Isa> const& isas, std::string const& header, fs::path const& file, fs::path const& work) {
    Offer const offer = offer_of(tools, isas.front(), header, file, work);
    for (Isa const isa : std::span(isas).subspan(1)) {
        if (offer_of(tools, isa, header, file, work) != offer)
            throw SceneError(fmt::format("{}: it is another source for {} than for {}; let it include the same files for all instruction sets", header, name_of(isa), name_of(isas.front())));
    }
    return offer;
}

/// What the compiler has to do for one module.
struct Task {
    ModuleKind kind;
    Isa isa;
    std::vector<Words> units;  // each by itself
    Words link;                // when they are done
    fs::path made;
};

Task task_of(Toolchain const& tools, ModuleKind kind, Isa isa, Offer const& offer, fs::path const& file, fs::path const& work) {
    std::string const stem = fmt::format("{}_{}", name_of(kind), name_of(isa));
    auto const is_law = kind == ModuleKind::law;
    Words flags = flags_for(tools, isa);
    Words const more = words_of(SLIDEWAY_MODULE_FLAGS), includes = include_words(tools);
    flags.insert(flags.end(), more.begin(), more.end());
    flags.insert(flags.end(), includes.begin(), includes.end());
    flags.insert(flags.end(), {"-std=c++20", "-fPIC", "-fvisibility=hidden", "-fvisibility-inlines-hidden", "-Wno-ignored-attributes", "-Wno-psabi",
                               fmt::format("-DSLIDEWAY_ISA={}", name_of(isa)), fmt::format("-DSLIDEWAY_LANES={}", lanes_of(isa)),
                               "-DSLIDEWAY_TABLE=own_kernels", fmt::format("-DSLIDEWAY_HEADER=\"{}\"", file.string()),
                               fmt::format("-DSLIDEWAY_SOURCE_HASH=\"{}\"", offer.source), fmt::format("-DSLIDEWAY_TABLE_OF_LAW={}", is_law ? 1 : 0)});
    Task task{kind, isa, {}, flags, work / module_file_name(kind, "new", isa)};
    task.link.insert(task.link.end(), {"-shared", "-o", task.made.string()});
    // What nobody defines is said by the linker, not by who opens the module; sanitizers define theirs in the program.
    if (std::ranges::none_of(flags, [](std::string const& flag) { return flag.starts_with("-fsanitize"); })) task.link.push_back("-Wl,-z,defs");
    auto const backend = tools.includes.front() / "host/backend";
    auto const add_unit = [&](char const* source, std::string const& suffix, Words const& definitions) {
        Words unit = flags;
        std::string const object = (work / (stem + suffix + ".o")).string();
        unit.insert(unit.end(), definitions.begin(), definitions.end());
        unit.insert(unit.end(), {"-c", (backend / source).string(), "-o", object});
        task.units.push_back(std::move(unit));
        task.link.push_back(object);
    };
    if (is_law) {
        add_unit("cpu_law.cpp", "", {});
    } else if (kind == ModuleKind::linkage) {
        add_unit("cpu_linkage.cpp", "", {"-DSLIDEWAY_SHADOWED=0"});
        add_unit("cpu_linkage.cpp", "_shadowed", {"-DSLIDEWAY_SHADOWED=1"});
    } else {
        add_unit("cpu_mechanism.cpp", "", {});
        add_unit("cpu_lanes.cpp", "_lanes", {"-DSLIDEWAY_SHADOWED=0"});
        add_unit("cpu_lanes.cpp", "_shadowed", {"-DSLIDEWAY_SHADOWED=1"});
    }
    task.link.push_back((tools.includes.front() / border).string());
    return task;
}

/// The tables of all tasks, so many at once, then their other units, which take longer and are not begun where a table is refused, then their modules.
void compile_all(Toolchain const& tools, std::vector<Task> const& tasks, int threads, std::string const& header, fs::path const& work) {
    std::vector<Words const*> tables, lanes, links;
    for (Task const& task : tasks) {
        bool const may_be_refused = task.kind != ModuleKind::linkage;
        for (Words const& unit : task.units) (may_be_refused && &unit == &task.units.front() ? tables : lanes).push_back(&unit);
        links.push_back(&task.link);
    }
    for (auto const* const commands : {&tables, &lanes, &links}) {
        std::atomic<std::size_t> next = 0;
        std::vector<std::exception_ptr> failures(commands->size());
        auto const work_off = [&] {
            for (std::size_t i = next++; i < commands->size(); i = next++) {
                try {
                    run_compiler(tools, *(*commands)[i], header, work / fmt::format("{}.log", i));
                } catch (...) {
                    failures[i] = std::current_exception();
                    next = commands->size();
                }
            }
        };
        std::vector<std::jthread> others;
        for (int i = 1; i < std::min(threads, static_cast<int>(commands->size())); ++i) others.emplace_back(work_off);
        work_off();
        others.clear();
        for (std::exception_ptr const& failure : failures) {
            if (failure) std::rethrow_exception(failure);
        }
    }
}

/// The module of this source in a folder, if it is there.
std::optional<std::string> present(fs::path const& folder, ModuleKind kind, Isa isa, std::string const& source) {
    for (std::string const& name : module_names_in(folder, kind)) {
        fs::path const path = folder / module_file_name(kind, name, isa);
        std::string why;
        if (!is_file(path.string())) continue;
        KernelModule const* const module = open_own_module(path, why);
        if (module != nullptr && module->source == source) return name;
    }
    return std::nullopt;
}

/// Before anything is compiled.
void require_writable(fs::path const& folder) {
    std::error_code failed, none;
    fs::create_directories(folder, failed);
    if (!failed && access(folder.c_str(), W_OK | X_OK) == 0) return;
    std::string why = failed ? failed.message() : std::strerror(errno);
    auto at = folder;
    while (!fs::exists(at, none) && at.has_relative_path()) at = at.parent_path();
    if (!fs::is_directory(at, none)) why = at.string() + " is no folder";
    throw FileError(fmt::format("{}: no module can be written there ({}); give another folder with -o", folder.string(), why));
}

/// Puts a module into its place; of its name no other source is left there.
void place(fs::path const& made, fs::path const& folder, ModuleKind kind, std::string const& name, Isa isa, std::string const& source) {
    fs::path const to = folder / module_file_name(kind, name, isa), beside = fmt::format("{}.{}", to.string(), getpid());
    std::error_code failed;
    fs::copy_file(made, beside, fs::copy_options::overwrite_existing, failed);
    if (!failed) fs::rename(beside, to, failed);
    if (failed) {
        std::error_code none;
        fs::remove(beside, none);
        throw FileError(fmt::format("{}: cannot be written ({}); give another folder with -o", to.string(), failed.message()));
    }
    for (Isa const other : all_isas()) {
        fs::path const file = folder / module_file_name(kind, name, other);
        std::string why;
        if (other == isa || !is_file(file.string())) continue;
        KernelModule const* const module = open_own_module(file, why);
        if (module == nullptr || module->source != source) fs::remove(file, failed);
    }
}

/// The header's file, in a work folder where there is only its text.
fs::path file_of(CompileRequest const& request, fs::path const& work) {
    if (!request.text.empty()) {
        fs::path const file = work / "header.hpp";
        write_durably(file.string(), request.text);
        return file;
    }
    require_file(request.header);
    if (!is_file(request.header)) throw SceneError(fmt::format("{}: there is no such file", request.header));
    std::error_code none;
    return fs::canonical(request.header, none);
}

}  // namespace

std::vector<CompiledModule> compile_modules(CompileRequest const& request) {
    std::error_code none;
    WorkFolder const work;
    fs::path const file = file_of(request, work.path());
    if (file.string().find_first_of("\"\\\n") != std::string::npos) throw SceneError(fmt::format("{}: a path with quotes or a backslash cannot be compiled", request.header));
    fs::path const folder = request.folder.empty() ? user_module_folder() : fs::absolute(request.folder, none);
    if (folder.empty()) throw SceneError("neither HOME nor XDG_CACHE_HOME says where modules go; give a folder with -o");
    require_writable(folder);
    std::vector<Isa> const isas = request.isas.empty() ? isas_here() : request.isas;
    Toolchain const tools = toolchain(work.path());
    Offer const offer = offer_of(tools, isas, request.header, file, work.path());

    std::vector<CompiledModule> all;
    std::vector<Task> tasks;
    for (ModuleKind const kind : module_kinds) {
        if (!offer.types[static_cast<std::size_t>(kind)]) continue;
        CompiledModule& one = all.emplace_back(CompiledModule{kind, "", offer.source, {}, true});
        for (Isa const isa : isas) {
            if (auto const name = present(folder, kind, isa, offer.source)) {
                one.name = *name;
                one.files.push_back((folder / module_file_name(kind, *name, isa)).string());
            } else {
                tasks.push_back(task_of(tools, kind, isa, offer, file, work.path()));
                one.was_there = false;
            }
        }
    }
    if (tasks.empty()) return all;
    compile_all(tools, tasks, request.threads, request.header, work.path());
    if (offer_of(tools, isas, request.header, file, work.path()) != offer)
        throw SceneError(fmt::format("{}: it changed while it was compiled; compile it again", request.header));
    // None is put in place before all can be used.
    std::vector<std::string> names;
    for (Task const& task : tasks) {
        std::string why;
        KernelModule const* const module = open_own_module(task.made, why);
        if (module == nullptr) throw DeviceError(why);
        if (std::string const objection = request.objection(task.kind, *module); !objection.empty()) throw SceneError(fmt::format("{}: {}", request.header, objection));
        names.emplace_back(name_of(task.kind, *module));
    }
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        CompiledModule& one = *std::ranges::find(all, tasks[i].kind, &CompiledModule::kind);
        place(tasks[i].made, folder, tasks[i].kind, names[i], tasks[i].isa, offer.source);
        one.name = names[i];
        one.files.push_back((folder / module_file_name(tasks[i].kind, names[i], tasks[i].isa)).string());
    }
    return all;
}

}  // namespace slideway
