// Apart from ranks.cpp: the library asks what launched it, and links no MPI for that.
#include "host/base/numbers.hpp"
#include "host/run/ranks.hpp"

namespace slideway {
namespace {

std::optional<int> whole_number(char const* text) {
    if (text == nullptr) return std::nullopt;
    auto const value = parse_number<int>(text);
    return value && *value >= 0 ? value : std::nullopt;
}

}  // namespace

std::optional<Launch> find_launch(Environment const& environment) {
    struct Names {
        char const *count, *rank;
    };
    for (Names const names : {Names{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"}, Names{"PMI_SIZE", "PMI_RANK"},
                              Names{"MV2_COMM_WORLD_SIZE", "MV2_COMM_WORLD_RANK"}}) {
        auto const count = whole_number(environment(names.count));
        if (count && *count > 0)
            return Launch{names.count, *count, whole_number(environment(names.rank)).value_or(0) == 0};
    }
    // PMIx tells a process its rank; the number of all takes a connection to its server.
    auto const rank = whole_number(environment("PMIX_RANK"));
    if (!rank) return std::nullopt;
    auto const tasks = whole_number(environment("SLURM_STEP_NUM_TASKS"));
    return Launch{"PMIX_RANK", tasks.value_or(0), *rank == 0};
}

}  // namespace slideway
