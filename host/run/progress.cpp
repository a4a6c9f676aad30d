#include "host/run/progress.hpp"

#include <unistd.h>

#include <cmath>

#include <fmt/format.h>

namespace slideway {
namespace {

std::string clock_text(double seconds) {
    if (!(seconds < 1e9)) return "--";
    auto const whole = static_cast<long long>(std::ceil(seconds));
    if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
    return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

std::string progress_line(std::uint64_t done, std::uint64_t members, double seconds, std::uint64_t before) {
    double const rate = seconds > 0 ? static_cast<double>(done - before) / seconds : 0;
    double const percent = members > 0 ? 100.0 * static_cast<double>(done) / static_cast<double>(members) : 100.0;
    std::string const left = rate > 0 ? clock_text(static_cast<double>(members - done) / rate) : "--";
    return fmt::format("{:5.1f} %  {} of {} members  {:.3g} members/s  ETA {}", percent, done, members, rate, left);
}

Progress::Style Progress::style_for(std::FILE* out, bool quiet) {
    if (quiet) return Style::none;
    return isatty(fileno(out)) ? Style::terminal : Style::lines;
}

Progress::Progress(std::uint64_t members, std::uint64_t before, Style style, std::FILE* out, StopRequest const& stop)
    : members_(members), before_(before), style_(style), out_(out), stop_(stop) {
    if (style_ != Style::none) reporter_ = std::thread([this] { report(); });
}

Progress::~Progress() {
    if (!reporter_.joinable()) return;
    {
        std::lock_guard const lock(mutex_);
        ended_ = true;
    }
    changed_.notify_one();
    reporter_.join();
    if (style_ == Style::terminal) {
        print_line();
        std::fputc('\n', out_);
    }
}

void Progress::print_line() {
    std::chrono::duration<double> const elapsed = std::chrono::steady_clock::now() - start_;
    std::string const line =
        progress_line(before_ + done_.load(std::memory_order_relaxed), members_, elapsed.count(), before_);
    // Erase to the end of the line: the next one may be shorter.
    tell(style_ == Style::terminal ? fmt::format("\r{}\x1b[K", line) : line + '\n');
}

/// A stream that cannot be written is no reason to stop.
void Progress::tell(std::string const& text) {
    std::fwrite(text.data(), 1, text.size(), out_);
    std::fflush(out_);
}

void Progress::report() {
    using namespace std::chrono_literals;
    int const ticks_per_line = style_ == Style::terminal ? 1 : 40;
    bool told_stop = false;
    std::unique_lock lock(mutex_);
    for (int tick = 1; !changed_.wait_for(lock, 250ms, [this] { return ended_; }); ++tick) {
        if (!told_stop && stop_.reason() != StopReason::none) {
            told_stop = true;
            tell(fmt::format("{}stopping ({}): members under way are given up, those that ended are written\n",
                             style_ == Style::terminal ? "\r\x1b[K" : "",
                             stop_.reason() == StopReason::signal ? "signal" : "--max-hours"));
        }
        if (tick % ticks_per_line == 0) print_line();
    }
}

}  // namespace slideway
