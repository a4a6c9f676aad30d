#include "host/run/progress.hpp"

#include <unistd.h>

#include <algorithm>
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

std::string progress_line(ProgressTask const& task, std::uint64_t ended, double share, double rate, double left) {
    std::string const eta = clock_text(left);
    if (task.is_check) return fmt::format("checking: {:5.1f} % of {} members  ETA {}", 100 * share, task.members, eta);
    return fmt::format("{:5.1f} %  {} of {} members  {:.3g} members/s  ETA {}{}", 100 * share, ended, task.members, rate, eta,
                       task.check_follows ? ", then a check" : "");
}

Progress::Style Progress::style_for(std::FILE* out, bool quiet) {
    if (quiet) return Style::none;
    return isatty(fileno(out)) ? Style::terminal : Style::lines;
}

Progress::Progress(ProgressTask const& task, Style style, std::FILE* out, StopRequest const& stop)
    : task_(task), work_(task.work > 0 ? task.work : static_cast<double>(task.members)), style_(style), out_(out), stop_(stop) {
    if (style_ != Style::none) reporter_ = std::thread([this] { report(); });
}

Progress::~Progress() {
    if (!reporter_.joinable()) return;
    {
        std::lock_guard const lock(mutex_);
        ended_reporting_ = true;
    }
    changed_.notify_one();
    reporter_.join();
    if (style_ == Style::terminal) {
        print(look());
        std::fputc('\n', out_);
    }
}

Progress::Worker& Progress::worker(double weight) {
    std::lock_guard const lock(workers_mutex_);
    Worker& worker = workers_.emplace_back();
    worker.weight = weight;
    return worker;
}

void Progress::add_distant(std::uint64_t members) {
    std::lock_guard const lock(workers_mutex_);
    distant_ += members;
}

std::uint64_t Progress::ended() {
    std::lock_guard const lock(workers_mutex_);
    std::uint64_t ended = task_.before + distant_;
    for (Worker const& worker : workers_) ended += worker.ended.load(std::memory_order_relaxed);
    // A block that is given up and cut is begun again.
    told_ended_ = std::clamp(ended, told_ended_, std::max(task_.members, told_ended_));
    return told_ended_;
}

double Progress::share() {
    std::lock_guard const lock(workers_mutex_);
    double done = static_cast<double>(task_.before + distant_);
    for (Worker const& worker : workers_) done += worker.weight * worker.covered.load(std::memory_order_relaxed);
    share_ = std::clamp(work_ > 0 ? done / work_ : 1, share_, 1.0);
    return share_;
}

/// @return the line of now
std::string Progress::look() {
    std::chrono::duration<double> const elapsed = std::chrono::steady_clock::now() - start_;
    double const share = this->share(), done = share * work_ - static_cast<double>(task_.before);
    time_left_.note(elapsed.count(), done);
    double const left = time_left_.seconds((1 - share) * work_ + task_.after);
    return progress_line(task_, ended(), share, done / elapsed.count(), left);
}

void Progress::print(std::string const& line) {
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
    constexpr int first_line = 8, ticks_per_line = 40;
    bool told_stop = false;
    std::unique_lock lock(mutex_);
    for (int tick = 1; !changed_.wait_for(lock, 250ms, [this] { return ended_reporting_; }); ++tick) {
        if (!told_stop && stop_.reason() != StopReason::none) {
            told_stop = true;
            tell(fmt::format("{}stopping ({}): members under way are given up, those that ended are written\n",
                             style_ == Style::terminal ? "\r\x1b[K" : "",
                             stop_.reason() == StopReason::signal ? "signal" : "--max-hours"));
        }
        std::string const line = look();
        if (style_ == Style::terminal || tick == first_line || tick % ticks_per_line == 0) print(line);
    }
}

}  // namespace slideway
