// Where modules lie, and what opening one takes: of kernels, of a law or mechanism of one's own, of cards.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/backend/kernel_module.hpp"

namespace slideway {

/// The folder of the program, or of the library or Python module that has this code inside; then that of the process.
std::vector<std::filesystem::path> program_folders();

/// The folder of the build that the program lies in, if it lies in one of slideway by ninja: programs that link the library have builds of their own.
std::filesystem::path build_folder();

/// Where `slideway compile` puts modules that it is told no folder for, one for each version of the border: $XDG_CACHE_HOME/slideway/modules/…, or
/// that of ~/.cache.  Empty without a home.
std::filesystem::path user_module_folder();

/// Those of `search`, those of SLIDEWAY_MODULES (':' between them), the user's, then beside the program or library as built and as installed.
std::vector<std::filesystem::path> module_folders(std::span<std::string const> search = {});

/// A shared object.  A file that has been replaced since is another one.  @return nullptr, and why
void* open_library(std::filesystem::path const& path, std::string& why);

/// A module that this program can use: of the tree's own kernels, or of a law or mechanism of one's own.  @return nullptr, and why
KernelModule const* open_tree_module(std::filesystem::path const& path, std::string& why);
KernelModule const* open_own_module(std::filesystem::path const& path, std::string& why);

}  // namespace slideway
