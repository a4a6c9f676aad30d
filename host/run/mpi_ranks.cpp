// Rank 0 hands out the places.  A thread of it answers the other ranks: a question of theirs is
// {wanted, finished, what}, the answer {first, count, left}.  Its own workers take from the same queue without MPI.
#include "host/run/ranks.hpp"

#include <atomic>
#include <exception>
#include <stdexcept>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/run/mpi_calls.hpp"
#include "host/run/rank_messages.hpp"

namespace slideway {
namespace {

using namespace std::chrono_literals;

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
