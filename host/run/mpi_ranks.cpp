// Rank 0 hands out the places.  A thread of it answers the other ranks: a question of theirs is
// {wanted, finished, what}, the answer {first, count, left}.  Its own workers take from the same queue without MPI.
#include "host/run/ranks.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

// The C interface: the C++ one left the standard in 2012.
#ifndef OMPI_SKIP_MPICXX
#define OMPI_SKIP_MPICXX 1
#endif
#ifndef MPICH_SKIP_MPICXX
#define MPICH_SKIP_MPICXX 1
#endif
#include <mpi.h>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/run/rank_messages.hpp"

namespace slideway {
namespace {

using namespace std::chrono_literals;

// ---- the calls of MPI that slideway needs, each of which returns at once or sleeps between its questions ----

/// How long to sleep between two questions whether something has come: longer and longer while nothing does.
class Backoff {
public:
    using Duration = std::chrono::microseconds;
    constexpr explicit Backoff(Duration longest) : longest_(longest) {}
    void sleep() {
        std::this_thread::sleep_for(pause_);
        pause_ = std::min(2 * pause_, longest_);
    }
    void refresh() { pause_ = first; }

private:
    static constexpr Duration first{200};
    Duration const longest_;
    Duration pause_ = first;
};

/// MPI of this process, from construction to destruction.  Any thread may call: one mutex makes the calls one after the
/// other, and is held for no longer than a call of MPI that cannot block.  What MPI itself finds wrong ends the job with
/// MPI's own message.
class MpiCalls {
public:
    /// @throws SceneError if MPI allows calls by its main thread only.
    MpiCalls() {
        int provided = MPI_THREAD_SINGLE;
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
        if (provided < MPI_THREAD_SERIALIZED) {
            MPI_Finalize();
            throw SceneError(
                "slideway: this MPI lets only one thread make calls (MPI_THREAD_SERIALIZED is needed); use another MPI, or "
                "--shard");
        }
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &count_);
        // All processes start with this, and none has work yet: here they may wait for each other.
        MPI_Comm machine = MPI_COMM_NULL;
        MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &machine);
        MPI_Comm_rank(machine, &local_rank_);
        MPI_Comm_size(machine, &local_count_);
        MPI_Comm_free(&machine);
    }
    ~MpiCalls() {
        if (says_goodbye_) MPI_Finalize();
    }
    MpiCalls(MpiCalls const&) = delete;
    MpiCalls& operator=(MpiCalls const&) = delete;

    int rank() const { return rank_; }
    int count() const { return count_; }
    // Among the processes of this machine.
    int local_rank() const { return local_rank_; }
    int local_count() const { return local_count_; }

    /// Returns when `data` may be overwritten; that is not before the other has asked for it, if it is large.
    void send(int to, int tag, void const* data, std::size_t bytes, Backoff backoff) {
        finish([&](MPI_Request* request) { MPI_Isend(data, static_cast<int>(bytes), MPI_BYTE, to, tag, MPI_COMM_WORLD, request); }, backoff);
    }
    /// Waits for a message of this size.
    void receive(int from, int tag, void* data, std::size_t bytes, Backoff backoff) {
        finish([&](MPI_Request* request) { MPI_Irecv(data, static_cast<int>(bytes), MPI_BYTE, from, tag, MPI_COMM_WORLD, request); }, backoff);
    }
    /// The rank of any whose message with this tag waits to be received.
    std::optional<int> waiting(int tag) {
        int found = 0;
        MPI_Status status;
        std::lock_guard const lock(mutex_);
        MPI_Iprobe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &found, &status);
        return found != 0 ? std::optional(status.MPI_SOURCE) : std::nullopt;
    }
    /// Rank 0's `data`, at every rank.
    void broadcast(void* data, std::size_t bytes, Backoff backoff) {
        finish([&](MPI_Request* request) { MPI_Ibcast(data, static_cast<int>(bytes), MPI_BYTE, 0, MPI_COMM_WORLD, request); }, backoff);
    }

    /// The others may wait for a message that this process no longer sends.  It then ends without ending MPI, by which
    /// its launcher knows that it failed, and ends them.
    void leave_without_goodbye() { says_goodbye_ = false; }

    /// Ends all processes of the job, whatever they do and whichever launcher started them.
    [[noreturn]] void abort(int code) {
        std::lock_guard const lock(mutex_);
        MPI_Abort(MPI_COMM_WORLD, code);
        std::_Exit(code);
    }

private:
    template <class Start> void finish(Start start, Backoff backoff) {
        MPI_Request request = MPI_REQUEST_NULL;
        int done = 0;
        {
            std::lock_guard const lock(mutex_);
            start(&request);
            MPI_Test(&request, &done, MPI_STATUS_IGNORE);
        }
        while (done == 0) {
            backoff.sleep();
            std::lock_guard const lock(mutex_);
            MPI_Test(&request, &done, MPI_STATUS_IGNORE);
        }
    }

    std::mutex mutex_;
    int rank_ = 0, count_ = 1, local_rank_ = 0, local_count_ = 1;
    bool says_goodbye_ = true;
};

// ---- ranks ----

struct Answer {
    std::uint64_t first = 0, count = 0, left = 0;
};

constexpr Backoff soon{1000us}, later{5000us};

/// Tags of a round, from one `share` to its `gather`: a rank that is ahead, in the next one, is not heard too early.
struct Tags {
    int question, answer, bytes;
    explicit Tags(int round) : question(3 * (round % 1000)), answer(question + 1), bytes(question + 2) {}
};

void require_message(std::size_t bytes, char const* what) {
    if (bytes <= message_limit) return;
    throw std::length_error(fmt::format("{} of {} bytes between ranks (2 GiB is the most)", what, bytes));
}

/// Rank 0's end: the thread that answers until all others have ended.
class Server {
public:
    Server(MpiCalls& calls, Tags tags, std::uint64_t places, std::function<void(std::uint64_t)> on_finished)
        : calls_(calls),
          tags_(tags),
          queue_(std::make_shared<LocalQueue>(places)),
          on_finished_(std::move(on_finished)),
          given_(static_cast<std::size_t>(calls.count())),
          thread_([this] { serve(); }) {}
    ~Server() {
        is_left_ = true;
        if (thread_.joinable()) thread_.join();
    }

    /// For workers of rank 0, who may live longer than the server.
    std::shared_ptr<LocalQueue> const& queue() const { return queue_; }

    /// What the others gave with their end; the place of rank 0 is empty.
    std::vector<std::string> wait() {
        thread_.join();
        if (failure_) std::rethrow_exception(failure_);
        return std::move(given_);
    }

private:
    void serve() {
        try {
            Backoff backoff = soon;
            for (int at_work = calls_.count() - 1; at_work > 0 && !is_left_;) {
                if (auto const rank = calls_.waiting(tags_.question)) {
                    if (answer(*rank) == Ask::end) --at_work;
                    backoff.refresh();
                } else {
                    backoff.sleep();
                }
            }
        } catch (...) {
            failure_ = std::current_exception();
            queue_->abandon();
        }
    }

    Ask answer(int rank) {
        Question question;
        calls_.receive(rank, tags_.question, &question, sizeof question, soon);
        require_sound(question);
        if (question.ask == Ask::end) {
            std::string& bytes = given_[static_cast<std::size_t>(rank)];
            bytes.resize(question.finished);
            calls_.receive(rank, tags_.bytes, bytes.data(), bytes.size(), soon);
            return question.ask;
        }
        if (question.ask == Ask::abandon) queue_->abandon();
        if (question.finished > 0 && on_finished_) on_finished_(question.finished);
        Stretch const stretch = question.wanted > 0 ? queue_->take(question.wanted, 0) : Stretch{};
        Answer const answer{stretch.first, stretch.count, queue_->left()};
        calls_.send(rank, tags_.answer, &answer, sizeof answer, soon);
        return question.ask;
    }

    MpiCalls& calls_;
    Tags const tags_;
    std::shared_ptr<LocalQueue> const queue_;
    std::function<void(std::uint64_t)> const on_finished_;
    std::vector<std::string> given_;
    std::exception_ptr failure_;
    std::atomic<bool> is_left_ = false;
    std::thread thread_;  // last: it uses the others
};

/// The queue as another rank sees it.  One question is under way at a time; a thread that waits for its turn sleeps.
class DistantQueue final : public MemberQueue {
public:
    DistantQueue(std::shared_ptr<MpiCalls> calls, Tags tags, std::uint64_t places)
        : calls_(std::move(calls)), tags_(tags), left_(places) {}
    Stretch take(std::uint64_t wanted, std::uint64_t finished) override { return ask({wanted, finished, Ask::places}); }
    void abandon() override { ask({0, 0, Ask::abandon}); }
    std::uint64_t left() const override { return left_; }

private:
    Stretch ask(Question const& question) {
        std::lock_guard const lock(turn_);
        calls_->send(0, tags_.question, &question, sizeof question, soon);
        Answer answer;
        calls_->receive(0, tags_.answer, &answer, sizeof answer, soon);
        left_ = answer.left;
        return {answer.first, answer.count};
    }

    std::shared_ptr<MpiCalls> const calls_;
    Tags const tags_;
    std::mutex turn_;
    std::atomic<std::uint64_t> left_;
};

class MpiRanks final : public Ranks {
public:
    explicit MpiRanks(std::shared_ptr<MpiCalls> calls) : calls_(std::move(calls)) {}
    ~MpiRanks() override {
        server_.reset();
        if (is_under_way_ && std::uncaught_exceptions() > exceptions_at_start_) calls_->leave_without_goodbye();
    }

    int rank() const override { return calls_->rank(); }
    int count() const override { return calls_->count(); }
    int local_rank() const override { return calls_->local_rank(); }
    int local_count() const override { return calls_->local_count(); }

    std::string broadcast(std::string bytes) override {
        is_under_way_ = true;
        if (!bytes.empty()) is_in_round_ = true;
        std::uint64_t size = bytes.size();
        calls_->broadcast(&size, sizeof size, soon);
        require_message(size, "a broadcast");  // at every rank alike
        bytes.resize(size);
        calls_->broadcast(bytes.data(), bytes.size(), soon);
        is_in_round_ = !bytes.empty();
        return bytes;
    }

    std::shared_ptr<MemberQueue> share(std::uint64_t places, std::function<void(std::uint64_t)> on_finished) override {
        is_under_way_ = is_in_round_ = true;
        if (rank() != 0) return std::make_shared<DistantQueue>(calls_, Tags(round_), places);
        server_ = std::make_unique<Server>(*calls_, Tags(round_), places, std::move(on_finished));
        return server_->queue();
    }

    std::vector<std::string> gather(std::string bytes) override {
        is_under_way_ = is_in_round_ = true;
        require_message(bytes.size(), "results");
        Tags const tags(round_++);
        if (rank() != 0) {
            Question const end{0, bytes.size(), Ask::end};
            calls_->send(0, tags.question, &end, sizeof end, soon);
            calls_->send(0, tags.bytes, bytes.data(), bytes.size(), later);
            is_in_round_ = false;
            return {};
        }
        if (!server_) server_ = std::make_unique<Server>(*calls_, tags, 0, nullptr);
        auto given = server_->wait();
        server_.reset();
        is_in_round_ = false;
        given[0] = std::move(bytes);
        return given;
    }

    int agree(int code) override {
        is_under_way_ = true;
        calls_->broadcast(&code, sizeof code, later);
        // In a round the others are not here: this process may not leave as if it had come to its end.
        is_under_way_ = is_in_round_;
        return code;
    }

    bool is_in_round() const override { return is_in_round_; }
    [[noreturn]] void abort(int code) override { calls_->abort(code); }

private:
    std::shared_ptr<MpiCalls> const calls_;
    std::unique_ptr<Server> server_;  // at rank 0, between `share` and `gather`
    int round_ = 0;
    int const exceptions_at_start_ = std::uncaught_exceptions();
    bool is_under_way_ = false;  // others may wait for what this rank says
    bool is_in_round_ = false;   // they may be at work
};

}  // namespace

std::unique_ptr<Ranks> join_mpi(Launch const& launch) {
    auto calls = std::make_shared<MpiCalls>();
    // With another MPI's launcher every process believes that it is alone.
    if (launch.count != 0 && launch.count != calls->count()) {
        throw SceneError(fmt::format(
            "slideway: {} says that this is one of {} processes, but this slideway's MPI sees {}; start it with the "
            "mpirun of the MPI that it was built with",
            launch.told_by, launch.count, calls->count()));
    }
    return std::make_unique<MpiRanks>(std::move(calls));
}

}  // namespace slideway
