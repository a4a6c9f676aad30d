// Where the program finds the kernels for cards, and whether they are its own.
#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "host/backend/commit.hpp"
#include "host/backend/cuda_module.hpp"
#include "host/backend/module_files.hpp"

namespace slideway {
namespace {

namespace fs = std::filesystem;

/// The module that the user names, else what lies beside the program, else where it is installed.
fs::path module_path() {
    std::error_code none;
    if (char const* const named = std::getenv("SLIDEWAY_CUDA_MODULE"); named != nullptr && *named != '\0') {
        if (fs::is_regular_file(named, none)) return fs::absolute(named, none);
        throw DeviceError(
            fmt::format("cuda: SLIDEWAY_CUDA_MODULE is {}, and that is no file; unset it, or use --backend cpu", named));
    }
    fs::path const beside = fs::read_symlink("/proc/self/exe", none).parent_path();
    fs::path const installed = (beside / "../lib/slideway").lexically_normal();
    for (fs::path const& folder : {beside, installed}) {
        if (fs::is_regular_file(folder / cuda_module_name, none)) return folder / cuda_module_name;
    }
    throw NoDevice(
        fmt::format("cuda: no {} beside the program in {}, nor in {}; build it (-DSLIDEWAY_CUDA=ON), or use --backend cpu",
                    cuda_module_name, beside.string(), installed.string()));
}

/// Opened as often as asked for, which costs nothing after the first time, and never closed.
CudaModule const& opened(fs::path const& path) {
    std::string why;
    void* const library = open_library(path, why);
    if (library == nullptr) throw DeviceError(fmt::format("cuda: {}; use --backend cpu", why));
    auto* const entry = reinterpret_cast<CudaModuleEntry*>(dlsym(library, cuda_module_entry));
    CudaModule const* const module = entry == nullptr ? nullptr : entry();
    if (module == nullptr) {
        throw DeviceError(fmt::format("cuda: {} is no module of slideway; use --backend cpu", path.string()));
    }
    return *module;
}

void require_same_build(CudaModule const& module, fs::path const& path) {
    std::string_view const build = module.build;
    char const* const what_to_do = "build both from the same sources, or use --backend cpu";
    if (module.interface != cuda_interface || build != SLIDEWAY_BUILD) {
        throw DeviceError(
            fmt::format("cuda: {} is of {}, this program of {}; {}", path.string(), build, SLIDEWAY_BUILD, what_to_do));
    }
    if (module.layout != border_layout()) {
        throw DeviceError(
            fmt::format("cuda: {} is of other sources than this program, both of {}; {}", path.string(), build, what_to_do));
    }
}

}  // namespace

std::shared_ptr<Backend const> cuda_backend(CardShare const& share) {
    fs::path const path = module_path();
    CudaModule const& module = opened(path);
    require_same_build(module, path);
    return module.open_card(share);
}

}  // namespace slideway
