#include "host/backend/module_files.hpp"

#include <dlfcn.h>
#include <elf.h>
#include <link.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <istream>
#include <map>
#include <mutex>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "host/backend/kernel_sources.hpp"
#include "host/base/error.hpp"
#include "host/base/open_file.hpp"

namespace slideway {
namespace {

namespace fs = std::filesystem;

bool is_own_build(fs::path const& folder) {
    if (!is_file((folder / "CMakeCache.txt").string()) || !is_file((folder / "build.ninja").string())) return false;
    auto const cache = file_stream((folder / "CMakeCache.txt").string());
    for (std::string line; std::getline(*cache, line);) {
        if (line == "CMAKE_PROJECT_NAME:STATIC=slideway") return true;
    }
    return false;
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

/// The name by which dlopen is to know a file: it takes one of the same name for the same file, which another may have replaced.
std::string fresh_name(fs::path const& path) {
    struct Known {
        dev_t device;
        ino_t inode;
        int replaced;
    };
    static std::map<std::string, Known> known;
    struct stat now {};
    if (stat(path.c_str(), &now) != 0) return path.string();
    auto const [at, is_new] = known.try_emplace(path.string(), Known{now.st_dev, now.st_ino, 0});
    Known& was = at->second;
    if (!is_new && (was.device != now.st_dev || was.inode != now.st_ino)) was = {now.st_dev, now.st_ino, was.replaced + 1};
    std::string folder = path.parent_path().string() + "/";
    for (int i = 0; i < was.replaced; ++i) folder += "./";
    return folder + path.filename().string();
}

}  // namespace

std::vector<fs::path> program_folders() {
    std::error_code none;
    std::vector<fs::path> folders;
    Dl_info here{};
    if (dladdr(reinterpret_cast<void const*>(&program_folders), &here) != 0 && here.dli_fname != nullptr && fs::path(here.dli_fname).is_absolute())
        folders.push_back(fs::canonical(here.dli_fname, none).parent_path());
    fs::path const program = fs::read_symlink("/proc/self/exe", none).parent_path();
    if (std::ranges::find(folders, program) == folders.end()) folders.push_back(program);
    std::erase(folders, fs::path{});
    return folders;
}

fs::path build_folder() {
    for (fs::path const& own : program_folders()) {
        if (is_own_build(own.parent_path())) return own.parent_path();
    }
    return {};
}

fs::path user_module_folder() {
    for (auto const& [variable, below] : {std::pair{"XDG_CACHE_HOME", "slideway/modules"}, {"HOME", ".cache/slideway/modules"}}) {
        char const* const folder = std::getenv(variable);
        if (folder != nullptr && fs::path(folder).is_absolute()) return fs::path(folder) / below / SLIDEWAY_KERNEL_BORDER;
    }
    return {};
}

std::vector<fs::path> module_folders(std::span<std::string const> search) {
    std::vector<fs::path> folders(search.begin(), search.end());
    if (char const* const named = std::getenv("SLIDEWAY_MODULES"); named != nullptr) {
        std::string_view rest = named;
        while (!rest.empty()) {
            auto const end = std::min(rest.find(':'), rest.size());
            if (end > 0) folders.emplace_back(rest.substr(0, end));
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
    }
    if (fs::path const users = user_module_folder(); !users.empty()) folders.push_back(users);
    for (fs::path const& own : program_folders()) {
        for (char const* const place : {"kernels", "lib/slideway", "../lib/slideway", "slideway", "../slideway", "../bin/kernels"})
            folders.push_back((own / place).lexically_normal());
    }
    return folders;
}

void* open_library(fs::path const& path, std::string& why) {
    static std::mutex one_at_a_time;
    std::lock_guard const lock(one_at_a_time);
    std::error_code none;
    fs::path const whole_path = fs::absolute(path, none);
    bool whole = false;
    try {
        whole = is_whole(whole_path);
    } catch (FileError const& error) {
        why = error.what();
        return nullptr;
    }
    void* const library = whole ? dlopen(fresh_name(whole_path).c_str(), RTLD_NOW | RTLD_LOCAL) : nullptr;
    if (library == nullptr) why = fmt::format("{} cannot be opened ({})", path.string(), whole ? dlerror() : "it is damaged, or no shared object");
    return library;
}

namespace {

/// @param sources what it must have in common with this program
KernelModule const* open_module(fs::path const& path, std::string_view sources, std::string& why) {
    void* const library = open_library(path, why);
    if (library == nullptr) return nullptr;
    auto* const entry = reinterpret_cast<KernelModuleEntry*>(dlsym(library, kernel_module_entry));
    KernelModule const* const module = entry == nullptr ? nullptr : entry();
    if (module == nullptr) {
        why = fmt::format("{} is no module of slideway", path.string());
    } else if (module->interface != kernel_interface || module->sources != sources) {
        why = fmt::format("{} is of another version of slideway's kernels ({}) than this program ({})", path.string(), module->sources, sources);
    } else if (!path.filename().string().ends_with(fmt::format("_{}.so", module->isa))) {
        // The name says whose packs it takes, and whoever renames it knows no better.
        why = fmt::format("{} is compiled for {}", path.string(), module->isa);
    } else {
        return module;
    }
    dlclose(library);
    return nullptr;
}

}  // namespace

KernelModule const* open_tree_module(fs::path const& path, std::string& why) { return open_module(path, SLIDEWAY_KERNEL_SOURCES, why); }
KernelModule const* open_own_module(fs::path const& path, std::string& why) { return open_module(path, SLIDEWAY_KERNEL_BORDER, why); }

}  // namespace slideway
