#include "host/backend/kernel_modules.hpp"

#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "host/backend/backend.hpp"
#include "host/backend/module_files.hpp"
#include "host/base/child_process.hpp"
#include "host/base/error.hpp"
#include "host/base/file_lock.hpp"
#include "host/base/open_file.hpp"

namespace slideway {
namespace {

namespace fs = std::filesystem;

void (*told)(std::string const& line) = nullptr;

std::string target_of(std::string const& name) { return "slideway_" + name; }

MechanismKernels const* found(std::string const& name, std::string& why) {
    for (fs::path const& folder : module_folders()) {
        fs::path const path = folder / (target_of(name) + ".so");
        if (!is_file(path.string())) continue;
        KernelModule const* const module = open_tree_module(path, why);
        return module == nullptr ? nullptr : module->mechanism;
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
        // How it ended shows by what is there then.
        if (ChildEnd const end = run_child({"cmake", "--build", build.string(), "--target", target}, log.string(), CtrlC::is_not_for_it); end.error != 0)
            throw fail(fmt::format("they are not compiled yet, and cmake does not start ({})", std::strerror(end.error)));
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
