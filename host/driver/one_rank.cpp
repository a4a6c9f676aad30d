#include "host/driver/ranks.hpp"

namespace slideway {
namespace {

class OneRank final : public Ranks {
public:
    int rank() const override { return 0; }
    int count() const override { return 1; }
    std::string broadcast(std::string bytes) override { return bytes; }
    std::unique_ptr<MemberQueue> share(std::uint64_t places, std::function<void(std::uint64_t)>) override {
        return std::make_unique<LocalQueue>(places);
    }
    std::vector<std::string> gather(std::string bytes) override { return {std::move(bytes)}; }
    int agree(int code) override { return code; }
};

}  // namespace

std::unique_ptr<Ranks> Ranks::join() { return std::make_unique<OneRank>(); }

}  // namespace slideway
