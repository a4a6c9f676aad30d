// Modules that `slideway compile` made, `slideway_<kind>_<name>_<isa>.so`: laws and mechanisms of one's own, found by the names that a scene says, and
// linkages, found by their plans.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/backend/backend.hpp"
#include "host/backend/kernel_module.hpp"

namespace slideway {

enum class ModuleKind { law, mechanism, linkage };
inline constexpr std::array module_kinds = {ModuleKind::law, ModuleKind::mechanism, ModuleKind::linkage};
constexpr std::string_view name_of(ModuleKind kind) { return std::array{"law", "mechanism", "linkage"}[static_cast<std::size_t>(kind)]; }

/// What a module calls its law, mechanism or linkage; "" of one that has none.
std::string name_of(ModuleKind kind, KernelModule const& module);

/// The instruction sets that this program has kernels of and this machine runs, the widest first.
std::vector<Isa> isas_here();

/// One that is open, for good.
struct OwnModule {
    std::string name;
    std::filesystem::path folder;        // where its files lie, one for each instruction set
    std::string source;                  // hash of its source
    KernelModule const* described = nullptr;  // of an instruction set of this machine: its info
};

/// The file of one.
std::string module_file_name(ModuleKind kind, std::string_view name, Isa isa);
/// Whether scenes can name it: small letters, digits and '_', a letter first.
bool is_module_name(std::string_view name);

/// Opens what the first of `module_folders(search)` has under this name.  @return its place among those of its kind, which stays; nothing where there is none
/// @param objection why a module cannot be named in scenes; "" of one that can
/// @throws DeviceError for one that this program or this machine cannot use
std::optional<std::size_t> find_own_module(ModuleKind kind, std::string_view name, std::span<std::string const> search,
                                           std::string (*objection)(ModuleKind, KernelModule const&));
/// How many places there are; another file under the same name has another one.
std::size_t own_module_count(ModuleKind kind);
/// @param place below the count
OwnModule const& own_module(ModuleKind kind, std::size_t place);
/// Whether there is a file with its kernels of an instruction set.
bool has_own_kernels(ModuleKind kind, std::size_t place, Isa isa);
/// Its kernels of an instruction set.  @throws DeviceError if there are none, or they are of another source
KernelModule const& own_kernels(ModuleKind kind, std::size_t place, Isa isa);

/// The names that files in `module_folders(search)` have, whether they can be used or not; each once, in the order of the alphabet.
std::vector<std::string> own_module_names(ModuleKind kind, std::span<std::string const> search);
/// The same of one folder.
std::vector<std::string> module_names_in(std::filesystem::path const& folder, ModuleKind kind);

}  // namespace slideway
