#include "host/study/prediction.hpp"

#include <algorithm>

#include "host/study/ensemble_study.hpp"

namespace slideway {
namespace {

constexpr double contact_step = 5e-6;  // [s]

/// One step of one member on one core of a server of the 2020s [s], full packs, rejected steps and events shared out.
double seconds_per_member_step(Isa isa) {
    switch (isa) {
        case Isa::scalar:
            return 1.2e-6;
        case Isa::sse2:
            return 0.9e-6;
        case Isa::avx2:
            return 0.7e-6;
        case Isa::avx512:
            return 0.5e-6;
    }
    return 1e-6;
}

/// Statuses, the widest quantity, one of its columns and that column sorted: what the statistics hold at once.
std::uint64_t summary_bytes(Scene const& scene) {
    int widest = 0;
    for (int q = 0; q < quantity_count; ++q) {
        if (selects(scene.quantities, static_cast<Quantity>(q))) widest = std::max(widest, quantity_table[q].columns);
    }
    return scene.members * sizeof(double) * (1 + (widest > 0 ? static_cast<std::uint64_t>(widest) + 2 : 0));
}

}  // namespace

Prediction predict(Scene const& scene, Isa isa, int threads) {
    MemberRange const all{0, scene.members};
    EnsemblePlan const plan = ensemble_plan(scene, all, isa, threads);
    auto const members = static_cast<double>(scene.members);
    std::uint64_t const blocks = (plan.members + plan.block_members - 1) / plan.block_members;
    std::uint64_t const busy = std::min<std::uint64_t>(static_cast<std::uint64_t>(threads), blocks);

    Prediction prediction{};
    prediction.block_members = plan.block_members;
    prediction.buffer_bytes =
        busy *
        block_bytes(plan.request, static_cast<std::size_t>(std::min<std::uint64_t>(plan.block_members, scene.members)));
    prediction.summary_bytes = summary_bytes(scene);
    prediction.output_bytes = payload_bytes(result_layout(scene, all));
    double const end = scene.integrator.end_time;
    prediction.least_steps = members * end / scene.integrator.max_step;
    prediction.most_steps = members * end / std::min(contact_step, scene.integrator.max_step);
    // Packs are full except where a block has fewer members than lanes.
    double const filled = std::min(1.0, members / lanes_of(isa));
    double const seconds_per_step =
        seconds_per_member_step(isa) / filled / static_cast<double>(std::max<std::uint64_t>(busy, 1));
    prediction.least_seconds = prediction.least_steps * seconds_per_step;
    prediction.most_seconds = prediction.most_steps * seconds_per_step;
    return prediction;
}

}  // namespace slideway
