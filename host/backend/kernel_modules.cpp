#include "host/backend/kernel_modules.hpp"

#include <dlfcn.h>
#include <elf.h>
#include <fcntl.h>
#include <link.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <istream>
#include <map>
#include <mutex>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "host/backend/backend.hpp"
#include "host/backend/kernel_module.hpp"
#include "host/backend/kernel_sources.hpp"
#include "host/base/error.hpp"
#include "host/base/file_lock.hpp"
#include "host/base/open_file.hpp"

extern "C" char** environ;

namespace slideway {
namespace {

namespace fs = std::filesystem;

void (*told)(std::string const& line) = nullptr;

std::string target_of(std::string const& name) { return "slideway_" + name; }

/// Where this code lies: the folder of the program, or of the library or Python module that has it inside.
std::vector<fs::path> own_folders() {
    std::error_code none;
    std::vector<fs::path> folders;
    Dl_info here{};
    if (dladdr(reinterpret_cast<void const*>(&own_folders), &here) != 0 && here.dli_fname != nullptr && fs::path(here.dli_fname).is_absolute())
        folders.push_back(fs::canonical(here.dli_fname, none).parent_path());
    fs::path const program = fs::read_symlink("/proc/self/exe", none).parent_path();
    if (std::ranges::find(folders, program) == folders.end()) folders.push_back(program);
    std::erase(folders, fs::path{});
    return folders;
}

/// Those that a user names, then beside the program or library as built and as installed.
std::vector<fs::path> module_folders() {
    std::vector<fs::path> folders;
    if (char const* const named = std::getenv("SLIDEWAY_MODULES"); named != nullptr) {
        std::string_view rest = named;
        while (!rest.empty()) {
            auto const end = std::min(rest.find(':'), rest.size());
            if (end > 0) folders.emplace_back(rest.substr(0, end));
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
    }
    for (fs::path const& own : own_folders()) {
        for (char const* const place : {"kernels", "lib/slideway", "../lib/slideway", "slideway", "../slideway", "../bin/kernels"})
            folders.push_back((own / place).lexically_normal());
    }
    return folders;
}

/// Whether a folder is of a build of slideway, by ninja: programs that link the library have builds of their own.
bool is_own_build(fs::path const& folder) {
    if (!is_file((folder / "CMakeCache.txt").string()) || !is_file((folder / "build.ninja").string())) return false;
    auto const cache = file_stream((folder / "CMakeCache.txt").string());
    for (std::string line; std::getline(*cache, line);) {
        if (line == "CMAKE_PROJECT_NAME:STATIC=slideway") return true;
    }
    return false;
}

/// The folder of the build that the program lies in, if it lies in one.
fs::path build_folder() {
    for (fs::path const& own : own_folders()) {
        if (is_own_build(own.parent_path())) return own.parent_path();
    }
    return {};
}

/// Runs a program to its end, its output in a file, out of reach of a terminal's Ctrl-C, which is the run's.  @return errno where it does not start
int run_quietly(std::vector<std::string> words, fs::path const& log) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files{};
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&files, 1, 2);
    posix_spawnattr_t apart{};
    posix_spawnattr_init(&apart);
    posix_spawnattr_setflags(&apart, POSIX_SPAWN_SETPGROUP);
    pid_t child = 0;
    int const error = posix_spawnp(&child, arguments.front(), &files, &apart, arguments.data(), environ);
    posix_spawnattr_destroy(&apart);
    posix_spawn_file_actions_destroy(&files);
    if (error != 0) return error;
    // How it ended shows by what is there then; where nobody wants to hear of children the wait ends with ECHILD when it has.
    while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {}
    return 0;
}

/// Whether a file is as long as its ELF header says: dlopen maps what is missing all the same, and whoever touches it ends.
bool is_whole(fs::path const& path) {
    auto const stream = file_stream(path.string());
    std::istream& file = *stream;
    ElfW(Ehdr) header{};
    file.read(reinterpret_cast<char*>(&header), sizeof header);
    if (!file || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0 || header.e_phentsize != sizeof(ElfW(Phdr))) return false;
    std::error_code none;
    auto const size = fs::file_size(path, none);
    if (none || header.e_shoff + std::uint64_t{header.e_shnum} * header.e_shentsize > size) return false;
    file.seekg(static_cast<std::streamoff>(header.e_phoff));
    for (int i = 0; i < header.e_phnum; ++i) {
        ElfW(Phdr) segment{};
        file.read(reinterpret_cast<char*>(&segment), sizeof segment);
        if (!file || (segment.p_type == PT_LOAD && segment.p_offset + segment.p_filesz > size)) return false;
    }
    return true;
}

/// Opened and of the program's own sources; else nullptr, and why.
MechanismKernels const* opened(fs::path const& path, std::string& why) {
    bool const whole = is_whole(path);
    void* const library = whole ? dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL) : nullptr;
    if (library == nullptr) {
        why = fmt::format("{} cannot be opened ({})", path.string(), whole ? dlerror() : "it is damaged, or no shared object");
        return nullptr;
    }
    auto* const entry = reinterpret_cast<KernelModuleEntry*>(dlsym(library, kernel_module_entry));
    KernelModule const* const module = entry == nullptr ? nullptr : entry();
    if (module != nullptr && module->interface == kernel_interface && std::string_view(module->sources) == SLIDEWAY_KERNEL_SOURCES) return module->kernels;
    why = module == nullptr ? fmt::format("{} is no module of slideway", path.string())
                            : fmt::format("{} is of other sources ({}) than this program ({})", path.string(), module->sources, SLIDEWAY_KERNEL_SOURCES);
    dlclose(library);  // of this name it would be had again
    return nullptr;
}

MechanismKernels const* found(std::string const& name, std::string& why) {
    for (fs::path const& folder : module_folders()) {
        fs::path const path = folder / (target_of(name) + ".so");
        if (!is_file(path.string())) continue;
        return opened(path, why);
    }
    why = fmt::format("there is no {}.so", target_of(name));
    char const* word = " in ";
    for (fs::path const& folder : module_folders()) why += std::exchange(word, ", ") + folder.string();
    return nullptr;
}

MechanismKernels const& find(std::string const& name) {
    std::string why;
    if (auto const* const kernels = found(name, why)) return *kernels;
    fs::path const build = build_folder();
    if (build.empty()) throw DeviceError(fmt::format("kernels {}: {}; install slideway as a whole", name, why));
    std::string const target = target_of(name), by_hand = fmt::format("cmake --build {} --target {}", build.string(), target);
    auto const fail = [&](std::string const& reason) -> DeviceError { return DeviceError(fmt::format("kernels {}: {}; try {}", name, reason, by_hand)); };
    try {
        FileLock const alone((build / "kernels.lock").string(), FileLock::Kind::alone, FileLock::Wait::yes);
        // Another process may have made it meanwhile.
        if (auto const* const kernels = found(name, why)) return *kernels;
        if (told != nullptr) told(fmt::format("slideway: compiles the kernels {}, once: some half a minute", name));
        fs::path const log = build / (target + ".log");
        if (int const error = run_quietly({"cmake", "--build", build.string(), "--target", target}, log); error != 0)
            throw fail(fmt::format("they are not compiled yet, and cmake does not start ({})", std::strerror(error)));
        if (auto const* const kernels = found(name, why)) {
            std::error_code none;
            fs::remove(log, none);
            return *kernels;
        }
        throw fail(fmt::format("they could not be compiled: {} ({} has the compiler's words)", why, log.string()));
    } catch (FileError const& error) {
        throw fail(fmt::format("they are not compiled yet, and {}", error.what()));
    }
}

}  // namespace

void on_compiling(void (*tell)(std::string const& line)) { told = tell; }

MechanismKernels const& module_kernels(std::string const& name) {
    static std::mutex one_at_a_time;
    static std::map<std::string, MechanismKernels const*> known;
    std::lock_guard const lock(one_at_a_time);
    MechanismKernels const*& kernels = known[name];
    if (kernels == nullptr) kernels = &find(name);
    return *kernels;
}

}  // namespace slideway
