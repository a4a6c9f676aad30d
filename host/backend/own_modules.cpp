#include "host/backend/own_modules.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <deque>
#include <map>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/backend/linkage_modules.hpp"
#include "host/backend/module_files.hpp"
#include "host/base/open_file.hpp"

namespace slideway {
namespace {

namespace fs = std::filesystem;

/// What is open, for good: who has a place has it as long as the process lives.
struct Opened {
    std::mutex access;
    std::array<std::deque<OwnModule>, module_kinds.size()> modules;
    std::array<std::atomic<std::size_t>, module_kinds.size()> counts;  // of them, for who does not wait
    std::map<std::pair<OwnModule const*, Isa>, KernelModule const*> kernels;
};
Opened& opened() {
    static Opened all;
    return all;
}

std::deque<OwnModule>& of_kind(ModuleKind kind) { return opened().modules[static_cast<std::size_t>(kind)]; }

}  // namespace

std::vector<Isa> isas_here() {
    std::vector<Isa> isas;
    for (Isa const isa : built_isas()) {
        if (processor_has(isa)) isas.push_back(isa);
    }
    std::ranges::stable_sort(isas, std::greater{}, lanes_of);
    return isas;
}

namespace {

constexpr char const* compile_again = "compile it again with slideway compile";

KernelModule const& open_own(ModuleKind kind, std::string_view name, fs::path const& path) {
    std::string why;
    KernelModule const* const module = open_own_module(path, why);
    if (module == nullptr) throw DeviceError(fmt::format("{} {}: {}; {}", name_of(kind), name, why, compile_again));
    if (name_of(kind, *module) != name) throw DeviceError(fmt::format("{} {}: {} is a module of something else; {}", name_of(kind), name, path.string(), compile_again));
    return *module;
}

/// Instruction sets that a folder has files for under this name.
std::vector<std::string_view> isas_in(fs::path const& folder, ModuleKind kind, std::string_view name) {
    std::vector<std::string_view> isas;
    for (Isa const isa : all_isas()) {
        if (is_file((folder / module_file_name(kind, name, isa)).string())) isas.push_back(name_of(isa));
    }
    return isas;
}

}  // namespace

std::string name_of(ModuleKind kind, KernelModule const& module) {
    if (kind == ModuleKind::law) return module.law != nullptr ? std::string(module.law->info->name) : "";
    MechanismKernels const* const kernels = module.mechanism;
    if (kernels == nullptr) return "";
    if (kind == ModuleKind::linkage) return kernels->linkage != nullptr ? linkage_module_name(*kernels->linkage) : "";
    return kernels->info != nullptr && kernels->info->name != nullptr ? kernels->info->name : "";
}

std::string module_file_name(ModuleKind kind, std::string_view name, Isa isa) { return fmt::format("slideway_{}_{}_{}.so", name_of(kind), name, name_of(isa)); }

bool is_module_name(std::string_view name) {
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz", all = "abcdefghijklmnopqrstuvwxyz0123456789_";
    constexpr std::size_t longest = 60;
    return !name.empty() && name.size() <= longest && letters.find(name.front()) != letters.npos && name.find_first_not_of(all) == name.npos;
}

std::optional<std::size_t> find_own_module(ModuleKind kind, std::string_view name, std::span<std::string const> search,
                                           std::string (*objection)(ModuleKind, KernelModule const&)) {
    if (!is_module_name(name)) return std::nullopt;
    for (fs::path const& folder : module_folders(search)) {
        for (Isa const isa : isas_here()) {
            fs::path const path = folder / module_file_name(kind, name, isa);
            if (!is_file(path.string())) continue;
            KernelModule const& module = open_own(kind, name, path);
            auto& known = of_kind(kind);
            auto const place = [&]() -> std::optional<std::size_t> {
                auto const same = std::ranges::find(known, &module, &OwnModule::described);
                return same == known.end() ? std::nullopt : std::optional(static_cast<std::size_t>(same - known.begin()));
            };
            {
                std::lock_guard const lock(opened().access);
                if (auto const at = place()) return at;
            }
            // Who objects looks at what is known: one after the other.
            static std::mutex registering;
            std::lock_guard const one_at_a_time(registering);
            if (std::string const why = objection(kind, module); !why.empty()) throw DeviceError(fmt::format("{} {}: {}: {}", name_of(kind), name, path.string(), why));
            std::lock_guard const lock(opened().access);
            if (auto const at = place()) return at;
            std::error_code none;
            known.push_back({std::string(name), fs::absolute(folder, none), module.source, &module});
            opened().kernels[{&known.back(), isa}] = &module;
            return opened().counts[static_cast<std::size_t>(kind)]++;
        }
        if (auto const isas = isas_in(folder, kind, name); !isas.empty()) {
            throw DeviceError(fmt::format("{} {}: in {} it is compiled for {} alone, which this program or this machine does not have; {}", name_of(kind), name,
                                          folder.string(), fmt::join(isas, " and "), compile_again));
        }
    }
    return std::nullopt;
}

std::size_t own_module_count(ModuleKind kind) {
    return opened().counts[static_cast<std::size_t>(kind)];
}

OwnModule const& own_module(ModuleKind kind, std::size_t place) {
    std::lock_guard const lock(opened().access);
    return of_kind(kind).at(place);
}

bool has_own_kernels(ModuleKind kind, std::size_t place, Isa isa) {
    OwnModule const& own = own_module(kind, place);
    return is_file((own.folder / module_file_name(kind, own.name, isa)).string());
}

KernelModule const& own_kernels(ModuleKind kind, std::size_t place, Isa isa) {
    std::lock_guard const lock(opened().access);
    OwnModule const& own = of_kind(kind).at(place);
    KernelModule const*& kernels = opened().kernels[{&own, isa}];
    if (kernels != nullptr) return *kernels;
    fs::path const path = own.folder / module_file_name(kind, own.name, isa);
    if (!is_file(path.string())) {
        throw DeviceError(fmt::format("{0} {1}: there is no {2}; compile it with slideway compile --isa {3}", name_of(kind), own.name, path.string(), name_of(isa)));
    }
    KernelModule const& found = open_own(kind, own.name, path);
    if (found.source != own.source) throw DeviceError(fmt::format("{} {}: {} is of another source than the module for other instruction sets; {}", name_of(kind), own.name, path.string(), compile_again));
    return *(kernels = &found);
}

std::vector<std::string> module_names_in(fs::path const& folder, ModuleKind kind) {
    std::set<std::string> names;
    std::string const begin = fmt::format("slideway_{}_", name_of(kind));
    std::error_code none;
    for (auto const& entry : fs::directory_iterator(folder, none)) {
        std::string const file = entry.path().filename().string();
        for (Isa const isa : all_isas()) {
            std::string const end = fmt::format("_{}.so", name_of(isa));
            if (!file.starts_with(begin) || !file.ends_with(end) || file.size() <= begin.size() + end.size()) continue;
            std::string const name = file.substr(begin.size(), file.size() - begin.size() - end.size());
            if (is_module_name(name)) names.insert(name);
        }
    }
    return {names.begin(), names.end()};
}

std::vector<std::string> own_module_names(ModuleKind kind, std::span<std::string const> search) {
    std::set<std::string> names;
    for (fs::path const& folder : module_folders(search)) {
        auto const more = module_names_in(folder, kind);
        names.insert(more.begin(), more.end());
    }
    return {names.begin(), names.end()};
}

}  // namespace slideway
