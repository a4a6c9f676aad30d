// The calls of MPI that slideway needs, each of which returns at once or sleeps between its questions.  Compiled where
// MPI was found.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>

namespace slideway {

/// How long to sleep between two questions whether something has come: longer and longer while nothing does.
class Backoff {
public:
    using Duration = std::chrono::microseconds;
    constexpr explicit Backoff(Duration longest) : longest_(longest) {}
    void sleep();
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
    MpiCalls();
    ~MpiCalls();
    MpiCalls(MpiCalls const&) = delete;
    MpiCalls& operator=(MpiCalls const&) = delete;

    int rank() const { return rank_; }
    int count() const { return count_; }
    // Among the processes of this machine.
    int local_rank() const { return local_rank_; }
    int local_count() const { return local_count_; }

    /// Returns when `data` may be overwritten; that is not before the other has asked for it, if it is large.
    void send(int to, int tag, void const* data, std::size_t bytes, Backoff backoff);
    /// Waits for a message of this size.
    void receive(int from, int tag, void* data, std::size_t bytes, Backoff backoff);
    /// The rank of any whose message with this tag waits to be received.
    std::optional<int> waiting(int tag);
    /// Rank 0's `data`, at every rank.
    void broadcast(void* data, std::size_t bytes, Backoff backoff);

    /// The others may wait for a message that this process no longer sends.  It then ends without ending MPI, by which
    /// its launcher knows that it failed, and ends them.
    void leave_without_goodbye() { says_goodbye_ = false; }

    /// Ends all processes of the job, whatever they do and whichever launcher started them.
    [[noreturn]] void abort(int code);

private:
    template <class Start> void finish(Start start, Backoff backoff);

    std::mutex mutex_;
    int rank_ = 0, count_ = 1, local_rank_ = 0, local_count_ = 1;
    bool says_goodbye_ = true;
};

}  // namespace slideway
