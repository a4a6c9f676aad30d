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

/// What a scene has and the kernels for cards have not.
struct CardLack {
    std::string given;
    char const* why;
};
std::optional<CardLack> lack_of_cards(Scene const& scene) {
    Parts const& parts = scene.parts;
    auto const law = [&](char const* why) { return CardLack{fmt::format("contact.law is \"{}\"", contact_info(parts).name), why}; };
    if (parts.drive.by != DriveBy::speed) return CardLack{"drive.kind is given", "the kernels for cards know no drive but constant speed"};
    if (MechanismInfo const& mechanism = info(parts.mechanism); !mechanism.on_cards)
        return CardLack{fmt::format("mechanism.kind is \"{}\"", mechanism.name), "the kernels for cards are of slider_crank alone"};
    if (parts.rigid) return law("the kernels for cards have no rigid contacts");
    if ((scene.quantities & selections::force_quantities) != 0 || (scene.series & force_series) != 0)
        return CardLack{"study.quantities asks for forces of faces or pins", "the kernels for cards do not tell them"};
    if (parts.offset_slider) return CardLack{"a slider.* key is given", "the kernels for cards have mass centre and pin in the hole's centre"};
    if (parts.loads.count > 0) return CardLack{fmt::format("{} is given", parts.loads.loads[0].name), "the kernels for cards have no loads, no film, and a straight way without ends"};
    if (module_of(parts.law) != nullptr) return law("the kernels for cards have no laws of modules");
    return {};
}

}  // namespace

std::string backend_text(Backend const& backend) { return fmt::format("{} ({})", backend.name(), backend.machine()); }

std::uint64_t pays_from(Isa isa, int threads) {
    return slower_than_a_lane * static_cast<std::uint64_t>(threads) * static_cast<std::uint64_t>(lanes_of(isa));
}

BackendChoice choose_backend(BackendRequest const& request, Scene const& scene, std::uint64_t members) {
    using Kind = BackendRequest::Kind;
    auto const lack = lack_of_cards(scene);
    if (request.kind == Kind::cuda) {
        if (!lack) return {cuda_backend(request.share), ""};
        throw SceneError(fmt::format("{}: {} ({}); use --backend cpu", scene.path, lack->given, lack->why));
    }
    Isa const isa = request.isa.value_or(best_isa(scene.parts));
    auto const cpu = cpu_backend(isa);
    if (request.kind == Kind::cpu) return {cpu, ""};
    if (request.isa) return {cpu, "as --isa says"};
    if (lack) return {cpu, lack->why};
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
