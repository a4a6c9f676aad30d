#include "host/run/stop.hpp"

#include <cstddef>
#include <iterator>

namespace slideway {
namespace {

std::atomic<StopRequest*> target = nullptr;

void on_signal(int) {
    if (StopRequest* const stop = target.load()) stop->request();
}

}  // namespace

void StopRequest::stop_after(std::chrono::duration<double> limit) {
    auto const now = Clock::now();
    // A limit beyond the clock's range is no limit.
    if (limit < std::chrono::duration<double>(Clock::time_point::max() - now))
        deadline_ = now + std::chrono::duration_cast<Clock::duration>(limit);
}

StopReason StopRequest::reason() const noexcept {
    if (requested_.load(std::memory_order_relaxed)) return StopReason::signal;
    if (flag_ != nullptr && flag_->load(std::memory_order_relaxed)) return StopReason::signal;
    return Clock::now() >= deadline_ ? StopReason::time_limit : StopReason::none;
}

SignalScope::SignalScope(StopRequest& stop) {
    target.store(&stop);
    for (std::size_t i = 0; i < std::size(stop_signals); ++i) {
        auto const [number, repeats] = stop_signals[i];
        sigaction(number, nullptr, &former_[i]);
        if (former_[i].sa_handler == SIG_IGN) continue;
        struct sigaction action = {};
        action.sa_handler = on_signal;
        sigemptyset(&action.sa_mask);
        action.sa_flags = static_cast<int>((repeats ? 0u : SA_RESETHAND) | SA_RESTART);
        sigaction(number, &action, nullptr);
    }
}

SignalScope::~SignalScope() {
    for (std::size_t i = 0; i < std::size(stop_signals); ++i) sigaction(stop_signals[i].number, &former_[i], nullptr);
    target.store(nullptr);
}

}  // namespace slideway
