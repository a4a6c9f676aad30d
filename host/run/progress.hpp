// How far a run has come, on stderr.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <limits>
#include <mutex>
#include <string>
#include <thread>

#include "host/run/stop.hpp"

namespace slideway {

/// Told now and then how much work is done, says how long the rest will take.  Members rattle and come to rest, and cost more then than now: half of
/// its word is the rate since the start, half that of the later half of the time so far, so that it follows without jumping.
class TimeLeft {
public:
    /// @param seconds since the start, later than those of the last call  @param done work since the start, no less than then
    void note(double seconds, double done) {
        constexpr double window = 0.5, spacing = 0.01;  // of the time so far
        now_ = {seconds, done};
        if (seconds - window_.back().seconds >= spacing * seconds) window_.push_back(now_);
        while (window_.size() > 1 && window_[1].seconds <= (1 - window) * seconds) window_.pop_front();
    }
    /// @param left work still to do, >= 0  @return [s]; NaN as long as nothing is done, and something left
    double seconds(double left) const {
        if (left <= 0) return 0;
        if (!(now_.done > 0)) return std::numeric_limits<double>::quiet_NaN();
        double const so_far = now_.seconds / now_.done;
        Point const& from = window_.front();
        double const of_late = now_.done > from.done ? (now_.seconds - from.seconds) / (now_.done - from.done) : so_far;
        return left * (so_far + of_late) / 2;
    }

private:
    struct Point {
        double seconds = 0, done = 0;
    };
    Point now_;
    std::deque<Point> window_{Point{}};  // from half the time so far on, or just before; some seventy at most
};

/// What is to be done, in members: how much of it is done is a matter of their simulated time.
struct ProgressTask {
    std::uint64_t members = 0;
    std::uint64_t before = 0;  // of them were done before the start: they count, but not towards the rate
    double after = 0;          // what follows and is told for itself, in members' work: it counts towards the time left
    double work = 0;           // what the members come to, where those of some parts weigh more; 0: one each
    bool is_check = false;     // members run again, and the line says so
    bool check_follows = false;  // that nobody can foresee: the line says that it is not in the time left
};

/// ` 37.5 %  384 of 1024 members  12.3 members/s  ETA 0:52`, `checking:  37.5 % of 16 members  ETA 0:05`.
/// @param ended members, well or not  @param share of the work [0, 1]  @param rate [members/s]  @param left [s], NaN: nothing to say
std::string progress_line(ProgressTask const& task, std::uint64_t ended, double share, double rate, double left);

/// Writes from a thread of its own: a line redrawn four times a second on a terminal, else a line after two seconds and one every ten.
class Progress {
public:
    enum class Style { none, lines, terminal };
    /// terminal if `out` is one, lines if not, none if quiet.
    static Style style_for(std::FILE* out, bool quiet);

    Progress(ProgressTask const& task, Style style, std::FILE* out, StopRequest const& stop);
    ~Progress();
    Progress(Progress const&) = delete;
    Progress& operator=(Progress const&) = delete;

    /// What a worker has done, who alone writes it.
    struct alignas(64) Worker {
        std::atomic<double> covered = 0;       // members' work, and shares of members under way; never less than before
        std::atomic<std::uint64_t> ended = 0;  // members, also of a block that it has not finished
        double weight = 1;
    };
    /// A worker's own, for as long as this lives.  @param weight of each of its members  From any thread, as what follows.
    Worker& worker(double weight = 1);
    /// Members that have ended, and none of these workers had.
    void add_distant(std::uint64_t members);
    /// [0, 1], never less than before.
    double share();
    /// Members that have ended, of the task, never less than before.
    std::uint64_t ended();

private:
    void report();
    std::string look();
    void print(std::string const& line);
    void tell(std::string const& text);

    ProgressTask const task_;
    double const work_;
    Style const style_;
    std::FILE* const out_;
    StopRequest const& stop_;
    std::chrono::steady_clock::time_point const start_ = std::chrono::steady_clock::now();
    std::mutex workers_mutex_;  // guards the four below
    std::deque<Worker> workers_;
    std::uint64_t distant_ = 0, told_ended_ = 0;
    double share_ = 0;
    TimeLeft time_left_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool ended_reporting_ = false;
    std::thread reporter_;
};

}  // namespace slideway
