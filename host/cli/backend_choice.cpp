#include "host/cli/backend_choice.hpp"

#include <fmt/format.h>

#include "host/cli/options.hpp"
#include "host/scene/error.hpp"

namespace slideway::cli {

std::string machine_text(Backend const& backend) {
    std::string const machine = backend.machine();
    return machine.empty() ? fmt::format("{}, {} lanes", backend.isa(), backend.lanes())
                           : fmt::format("{}, {}", machine, backend.isa());
}

std::string backend_text(Backend const& backend) {
    return fmt::format("{} ({})", backend.name(), machine_text(backend));
}

std::uint64_t pays_from(Isa isa, int threads) {
    // Not measured: dependent operations take a thread of a card about 16 times as long as a lane of a processor, by their clocks and
    // latencies.
    constexpr std::uint64_t slower = 16;
    return slower * static_cast<std::uint64_t>(threads) * static_cast<std::uint64_t>(lanes_of(isa));
}

BackendChoice choose_backend(BackendWords const& words, std::uint64_t members, int threads, int rank) {
    if (words.backend == "cuda") return {cuda_backend(rank), ""};
    Isa const isa = parse_isa(words.isa);
    auto const cpu = cpu_backend(isa);
    if (words.backend == "cpu") return {cpu, ""};
    if (words.isa != "auto") return {cpu, "as --isa says"};
    try {
        auto const card = cuda_backend(rank);
        // One that others have filled is no choice.
        constexpr std::uint64_t large_member = 1'000'000;
        card->largest_block(large_member, threads, 0);
        std::uint64_t const enough = pays_from(isa, threads);
        if (members >= enough) return {card, fmt::format("it pays from about {} members on", enough)};
        return {cpu, fmt::format("{} pays from about {} members on", card->machine(), enough)};
    } catch (NoDevice const&) {
        return {cpu, ""};
    } catch (DeviceError const& error) {
        return {cpu, error.what()};
    }
}

}  // namespace slideway::cli
