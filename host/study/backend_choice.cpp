#include "host/study/backend_choice.hpp"

#include <fmt/format.h>

#include "host/config/descriptors.hpp"
#include "host/study/ensemble_plan.hpp"

namespace slideway {
namespace {

// None of these is measured.  Dependent operations take a thread of a card about 16 times as long as a lane of a processor, by their clocks
// and latencies; a lane does two fused multiply-adds at some 2.5 GHz.
constexpr std::uint64_t slower_than_a_lane = 16;
constexpr double peak_of_a_lane = 1e10, worth_the_trouble = 2;

/// Why not the card; "" if it is to be taken.
std::string objection_to(Backend const& card, BackendRequest const& request, Isa isa, Scene const& scene,
                         std::uint64_t members) {
    int const threads = request.threads * request.share.ranks;
    std::uint64_t const enough = pays_from(isa, threads);
    if (members < enough) return fmt::format("{} pays from about {} members on", card.machine(), enough);
    if (std::string objection = card.objection(); !objection.empty()) return objection;
    if (card.peak() < worth_the_trouble * peak_of_a_lane * threads * lanes_of(isa)) {
        return card.machine() + " is not made for double precision";
    }
    card.bounds(block_demand(scene, card, request.threads, request.block_members));
    return {};
}

}  // namespace

std::string backend_text(Backend const& backend) { return fmt::format("{} ({})", backend.name(), backend.machine()); }

std::uint64_t pays_from(Isa isa, int threads) {
    return slower_than_a_lane * static_cast<std::uint64_t>(threads) * static_cast<std::uint64_t>(lanes_of(isa));
}

BackendChoice choose_backend(BackendRequest const& request, Scene const& scene, std::uint64_t members) {
    using Kind = BackendRequest::Kind;
    MechanismInfo const& mechanism = info(scene.parts.mechanism);
    bool const steady = scene.parts.drive.by == DriveBy::speed;
    char const* const lack = !steady                ? "the kernels for cards know no drive but constant speed"
                             : !mechanism.on_cards   ? "the kernels for cards are of slider_crank alone"
                             : scene.parts.rigid ? "the kernels for cards have no rigid contacts"
                             : scene.parts.loads.count > 0 ? "the kernels for cards have no loads"
                             : module_of(scene.parts.law) != nullptr ? "the kernels for cards have no laws of modules"
                                                 : nullptr;
    if (request.kind == Kind::cuda) {
        if (lack == nullptr) return {cuda_backend(request.share), ""};
        bool const of_loads = mechanism.on_cards && !scene.parts.rigid && scene.parts.loads.count > 0;
        std::string const what = !steady               ? std::string("drive.kind is given")
                                 : !mechanism.on_cards ? fmt::format("mechanism.kind is \"{}\"", mechanism.name)
                                 : of_loads          ? fmt::format("{} is given", scene.parts.loads.loads[0].name)
                                                     : fmt::format("contact.law is \"{}\"", contact_info(scene.parts).name);
        throw SceneError(fmt::format("{}: {} ({}); use --backend cpu", scene.path, what, lack));
    }
    Isa const isa = request.isa.value_or(best_isa(scene.parts));
    auto const cpu = cpu_backend(isa);
    if (request.kind == Kind::cpu) return {cpu, ""};
    if (request.isa) return {cpu, "as --isa says"};
    if (lack != nullptr) return {cpu, lack};
    try {
        auto const card = cuda_backend(request.share);
        std::string const objection = objection_to(*card, request, isa, scene, members);
        if (!objection.empty()) return {cpu, objection};
        return {card,
                fmt::format("it pays from about {} members on", pays_from(isa, request.threads * request.share.ranks))};
    } catch (NoDevice const&) {
        return {cpu, ""};
    } catch (DeviceError const& error) {
        // What there is to do about it is for those who want the card.
        std::string const why = error.what();
        return {cpu, why.substr(0, why.find(';'))};
    }
}

}  // namespace slideway
