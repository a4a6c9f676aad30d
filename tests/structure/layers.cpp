#include "tests/structure/layers.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string_view>

namespace slideway::structure {

namespace {

struct Layer {
    std::string_view name;  // a folder, or a file directly in kernels/
    int rank;
};

// A file may include its own layer and those of the same or a lower rank.
constexpr std::array layers = {
    Layer{"kernels/simd", 0},
    Layer{"kernels/real.hpp", 1},
    Layer{"kernels/isa_real.hpp", 2},
    Layer{"kernels/lane_copy.hpp", 2},
    Layer{"kernels/math", 2},
    Layer{"kernels/laws", 3},
    Layer{"kernels/loads", 3},
    Layer{"kernels/conditions.hpp", 4},
    Layer{"kernels/joint", 4},
    Layer{"kernels/mechanisms", 5},
    Layer{"kernels/observers", 6},
    Layer{"kernels/steppers", 6},
    Layer{"kernels/rigid", 7},
    Layer{"kernels/lanes", 7},
    Layer{"kernels/models", 8},
    Layer{"kernels/linkage", 8},
    Layer{"kernels/integrate.hpp", 8},
    Layer{"kernels/grid_thread.hpp", 8},
    Layer{"kernels/members", 9},
    Layer{"kernels/kernels.hpp", 10},
    Layer{"kernels/dispatch.hpp", 10},
    Layer{"host/backend", 10},
    Layer{"host/base", 10},
    Layer{"host/sampling", 11},
    Layer{"host/config", 12},
    Layer{"host/statistics", 12},
    Layer{"host/chaos", 12},
    Layer{"host/run", 13},
    Layer{"host/store", 14},
    Layer{"host/study", 15},
    Layer{"host/commands", 16},
    Layer{"host/library", 16},
};

// Plain data without code of any instruction set: every layer may share it, the host included.
constexpr std::array<std::string_view, 17> plain_data = {
    "kernels/key.hpp",
    "kernels/inputs.hpp",
    "kernels/status.hpp",
    "kernels/methods.hpp",
    "kernels/block.hpp",
    "kernels/grid_task.hpp",
    "kernels/joint/apex.hpp",
    "kernels/laws/law_info.hpp",
    "kernels/linkage/linkage_plan.hpp",
    "kernels/loads/drive_plan.hpp",
    "kernels/loads/load_list.hpp",
    "kernels/laws/list.hpp",
    "kernels/mechanisms/list.hpp",
    "kernels/mechanisms/mechanism_info.hpp",
    "kernels/observers/quantities.hpp",
    "kernels/observers/signals.hpp",
    "kernels/rigid/rigid_info.hpp",
};

// The kernels on cards, and what they may be made of: whole programs, and which equations these are to hold.
constexpr std::string_view kernels_of_cards = "host/backend/cuda.cu";
constexpr std::array<std::string_view, 6> programs_of_cards = {
    "kernels/grid_thread.hpp",      "kernels/integrate.hpp",
    "kernels/mechanisms/slider_crank.hpp", "kernels/models/every_law.hpp",
    "kernels/models/mechanism_model.hpp",  "kernels/models/shadowed.hpp",
};

// All laws and all mechanisms, made at configuration; who may name them all: the unit that collects what each says of itself, and who compiles what is theirs.
constexpr std::array<std::string_view, 2> collections = {"kernels/all_laws.hpp", "kernels/all_mechanisms.hpp"};
constexpr std::string_view collector = "host/config/descriptors.cpp", every_law = "kernels/models/every_law.hpp", rigid_contacts = "host/backend/cpu_rigid.cpp";
/// The kernels as a library of others, which nobody here includes.
constexpr std::string_view library_of_kernels = "kernels/kernels.hpp", library_dispatch = "kernels/dispatch.hpp", made_for_dispatch = "slideway_isas.hpp";

/// What is known of a member without integrating it: in plain numbers, for who prepares members, and not for units of an instruction set.
constexpr std::string_view closed_forms = "kernels/members";

bool is_plain_data(std::string_view path) { return std::ranges::find(plain_data, path) != plain_data.end(); }

Layer const* layer_of(std::string_view path) {
    for (Layer const& layer : layers) {
        bool const within = path.starts_with(layer.name) && path.substr(layer.name.size()).starts_with('/');
        if (path == layer.name || within) return &layer;
    }
    return nullptr;
}

bool knows_backends(std::string_view path) {
    return path == "kernels/real.hpp" || path == "kernels/isa_real.hpp" || path == library_dispatch || path.starts_with("kernels/simd/") ||
           path.starts_with("host/backend/");
}

bool knows_instructions(std::string_view path) {
    return path == "kernels/simd/x86.hpp" || path == "kernels/simd/neon.hpp";
}

std::optional<std::string> include_violation(std::string const& from, std::string const& to) {
    if (is_plain_data(from)) {
        if (is_plain_data(to)) return std::nullopt;
        return from + " is plain data and includes " + to;
    }
    Layer const* const user = layer_of(from);
    if (!user) return from + " is in no layer; give it a rank in tests/structure/layers.cpp";
    if (user->rank <= 1 && !to.starts_with("kernels/simd/"))
        return from + " includes " + to + "; it stands below everything";
    if (is_plain_data(to)) return std::nullopt;
    if (std::ranges::find(collections, to) != collections.end()) {
        if (from == collector || from == every_law || from == rigid_contacts || from == library_of_kernels) return std::nullopt;
        return from + " includes " + to + "; a unit that uses one law or mechanism includes no other";
    }
    if (from == library_dispatch && to == made_for_dispatch) return std::nullopt;
    Layer const* const used = layer_of(to);
    if (!used) return from + " includes " + to + ", which is in no layer (includes are written from the root)";
    if (used->rank > user->rank) return from + " includes upward: " + to;
    if (to == library_of_kernels || to == library_dispatch) return from + " includes " + to + ", which is for programs outside the tree";
    if (user->name == closed_forms) return from + " includes " + to + "; closed forms know plain data only";
    bool const forms = used->name == closed_forms;
    if (from.starts_with("host/") && to.starts_with("kernels/") && !forms && user->name != "host/backend") {
        return from + " includes " + to + "; above host/backend only plain data and closed forms of kernels/ are known";
    }
    return std::nullopt;
}

/// A line of the file's code that matches, for the message.
void find_in_code(SourceFile const& file, Pattern const& pattern, std::string const& why, Violations& out) {
    auto const lines = lines_of(code_only(file.text));
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (auto const match = pattern.match_in(lines[i])) {
            out.push_back(file.path + ":" + std::to_string(i + 1) + ": " + *match + ": " + why);
        }
    }
}

using Graph = std::map<std::string_view, std::set<std::string_view>>;

bool reaches(Graph const& graph, std::string_view from, std::string_view goal, std::set<std::string_view>& seen) {
    auto const node = graph.find(from);
    if (node == graph.end() || !seen.insert(from).second) return false;
    return std::ranges::any_of(node->second,
                               [&](std::string_view next) { return next == goal || reaches(graph, next, goal, seen); });
}

}  // namespace

Violations include_violations(SourceFile const& file) {
    Violations out;
    if (!is_plain_data(file.path) && !layer_of(file.path)) {
        out.push_back(file.path + " is in no layer; give it a rank in tests/structure/layers.cpp");
        return out;
    }
    for (std::string const& included : quoted_includes(file.text)) {
        if (auto violation = include_violation(file.path, included)) out.push_back(*violation);
    }
    return out;
}

Violations circle_violations(std::vector<SourceFile> const& files) {
    Graph graph;
    for (SourceFile const& file : files) {
        Layer const* const user = layer_of(file.path);
        if (!user || is_plain_data(file.path)) continue;
        for (std::string const& included : quoted_includes(file.text)) {
            Layer const* const used = layer_of(included);
            if (used && used != user && !is_plain_data(included)) graph[user->name].insert(used->name);
        }
    }
    Violations out;
    for (auto const& [folder, used] : graph) {
        if (std::set<std::string_view> seen; reaches(graph, folder, folder, seen)) {
            out.push_back(std::string(folder) + " includes itself through other folders");
        }
    }
    return out;
}

Violations backend_violations(SourceFile const& file) {
    Violations out;
    static Pattern const intrinsic(
        R"(\b_mm\d*_\w+|\w*intrin\.h\b|\barm_neon\.h\b|\b__m(128|256|512)\w*|__AVX\w*|__SSE\w*|__FMA\w*|\bv\w+q_[fu]64\b)");
    if (!knows_instructions(file.path)) find_in_code(file, intrinsic, "only kernels/simd knows instructions", out);
    if (knows_backends(file.path)) return out;
    static Pattern const instruction_set(R"(\bxsimd\b|__x86_64__|__aarch64__)");
    static Pattern const cuda(R"(__CUDA\w*|\b__(host|device|global)__)");
    find_in_code(file, instruction_set, "only kernels/real.hpp, kernels/simd and host/backend know instruction sets",
                 out);
    find_in_code(file, cuda, "only kernels/real.hpp, kernels/simd and host/backend know CUDA", out);
    return out;
}

Violations kernel_violations(SourceFile const& file) {
    Violations out;
    if (!file.path.ends_with(".hpp")) out.push_back(file.path + ": kernels/ holds headers only");
    static Pattern const exception(R"(\b(throw|try|catch)\b)");
    static Pattern const allocation(
        R"(\bnew\b|\bdelete\b(?!;)|\b(malloc|free)\s*\(|\bstd::(vector|string|map|function|\w+_ptr)\b)");
    find_in_code(file, exception, "kernels report a status, they do not throw", out);
    find_in_code(file, allocation, "kernels do not allocate", out);
    return out;
}

/// What code says if it computes or decides anything itself.
constexpr char const* computation =
    R"([\w)\]] [-+*/%]=? [\w(.]|\b\d+\.\d|\b(if|for|while|switch)\b|\b(fma|sqrt|select)\s*\()";

Violations card_violations(SourceFile const& file) {
    Violations out;
    bool const kernels = file.path == kernels_of_cards;
    if (file.path.ends_with(".cu") && !kernels) {
        out.push_back(file.path + ": the one file for nvcc is " + std::string(kernels_of_cards));
    }
    if (!kernels && !file.path.starts_with("host/backend/cuda_")) return out;
    for (std::string const& included : quoted_includes(file.text)) {
        if (!included.starts_with("kernels/") || is_plain_data(included)) continue;
        if (!kernels || std::ranges::find(programs_of_cards, included) == programs_of_cards.end()) {
            out.push_back(file.path + " includes " + included + "; the physics is in the programs that it launches");
        }
    }
    if (!kernels) return out;
    static Pattern const computed(computation), definition(R"(^\w.*\) (const )?\{|^(struct|class|union|enum)\b)"),
        launched(R"(\b__global__ void\b|^CudaKernels cuda_kernels\(\))");
    find_in_code(file, computed, "kernels on cards call the processor's programs and compute nothing", out);
    for (std::string const& line : lines_of(code_only(file.text))) {
        if (definition.match_in(line) && !launched.match_in(line)) {
            out.push_back(file.path + ": " + line + ": only kernels and the list of them are defined here");
        }
    }
    return out;
}

}  // namespace slideway::structure
