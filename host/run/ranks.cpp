#include "host/run/ranks.hpp"

#include <cstdlib>

#include <fmt/format.h>

#include "host/base/error.hpp"

namespace slideway {
namespace {

class OneRank final : public Ranks {
public:
    int rank() const override { return 0; }
    int count() const override { return 1; }
    int local_rank() const override { return 0; }
    int local_count() const override { return 1; }
    std::string broadcast(std::string bytes) override { return bytes; }
    std::shared_ptr<MemberQueue> share(std::uint64_t places, std::function<void(std::uint64_t)>) override {
        return std::make_shared<LocalQueue>(places);
    }
    std::vector<std::string> gather(std::string bytes) override { return {std::move(bytes)}; }
    int agree(int code) override { return code; }
    bool is_in_round() const override { return false; }  // there is nobody who waits
    [[noreturn]] void abort(int code) override { std::_Exit(code); }
};

}  // namespace

std::unique_ptr<Ranks> Ranks::join() {
    auto const launch = find_launch([](char const* name) -> char const* { return std::getenv(name); });
    // A job of one process has nobody to talk to.
    if (!launch || launch->count == 1) return std::make_unique<OneRank>();
#ifdef SLIDEWAY_HAS_MPI
    return join_mpi(*launch);
#else
    if (launch->count == 0 && launch->first) return std::make_unique<OneRank>();
    throw SceneError(fmt::format(
        "slideway: {} says that this is one of {} processes, but this slideway was built without MPI, and "
        "each of them would run everything; install an MPI (Debian: libopenmpi-dev) and build again, or use "
        "--shard",
        launch->told_by, launch->count == 0 ? "several" : std::to_string(launch->count)));
#endif
}

}  // namespace slideway
