// Streams, each with a thread that does its operations in order and late, and events.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "tests/support/simulated_cuda/simulation.hpp"

struct CUstream_st {
    CUstream_st(int on, std::uint64_t number) : device(on), noise_(number) {}

    void enqueue(std::function<void()> operation) {
        std::lock_guard const lock(mutex_);
        queue_.push_back(std::move(operation));
        ++enqueued_;
        changed_.notify_all();
    }

    bool is_idle() {
        std::lock_guard const lock(mutex_);
        return done_ == enqueued_;
    }

    /// Until what is enqueued now is done; the thread of the stream itself has no reason to wait.
    void wait() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this, until = enqueued_] { return done_ >= until; });
    }

    /// No operation comes any more; those that are there are still done.
    void end() {
        std::lock_guard const lock(mutex_);
        ended_ = true;
        changed_.notify_all();
    }

    void work() {
        std::unique_lock lock(mutex_);
        for (;;) {
            changed_.wait(lock, [this] { return ended_ || !queue_.empty(); });
            if (queue_.empty()) return;
            auto const operation = std::move(queue_.front());
            queue_.pop_front();
            lock.unlock();
            delay();
            operation();
            lock.lock();
            ++done_;
            changed_.notify_all();
        }
    }

    int const device;
    std::atomic<bool> destroyed = false;

private:
    /// The same in every run, and different from operation to operation and stream to stream.
    void delay() {
        std::uint64_t const most = slideway::simulated_cuda::settings().delay;
        noise_ = noise_ * 6364136223846793005u + 1442695040888963407u;  // Knuth's generator
        if (most > 0) std::this_thread::sleep_for(std::chrono::microseconds((noise_ >> 33) % (most + 1)));
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> queue_;
    std::uint64_t enqueued_ = 0, done_ = 0, noise_;
    bool ended_ = false;
};

struct CUevent_st {
    explicit CUevent_st(int on) : device(on) {}

    int const device;
    std::atomic<std::uint64_t> recorded = 0, reached = 0;
};

namespace slideway::simulated_cuda {

namespace {

struct Handles {
    std::mutex mutex;
    std::map<cudaStream_t, std::shared_ptr<CUstream_st>> streams;  // destroyed ones too, until they are done
    std::map<cudaEvent_t, std::shared_ptr<CUevent_st>> events;
    std::uint64_t streams_made = 0;
};

Handles& handles() {
    static auto& h = *new Handles;
    return h;
}

std::shared_ptr<CUstream_st> stream_of(cudaStream_t handle) {
    std::lock_guard const lock(handles().mutex);
    auto const found = handles().streams.find(handle);
    if (handle == nullptr) misuse("the default stream is not simulated: it waits for all others");
    if (found == handles().streams.end() || found->second->destroyed) misuse("this stream is none, or is destroyed");
    return found->second;
}

std::shared_ptr<CUevent_st> event_of(cudaEvent_t handle) {
    std::lock_guard const lock(handles().mutex);
    auto const found = handles().events.find(handle);
    if (found == handles().events.end()) misuse("this event is none, or is destroyed");
    return found->second;
}

void forget(cudaStream_t handle) {
    std::lock_guard const lock(handles().mutex);
    handles().streams.erase(handle);
}

}  // namespace

cudaError_t enqueue(cudaStream_t handle, int device, std::function<void()> operation) {
    auto const stream = stream_of(handle);
    if (device != any_device && stream->device != device) return cudaErrorInvalidResourceHandle;
    stream->enqueue(std::move(operation));
    return cudaSuccess;
}

void finish_work() {
    std::vector<std::shared_ptr<CUstream_st>> streams;
    {
        std::lock_guard const lock(handles().mutex);
        for (auto const& [handle, stream] : handles().streams) streams.push_back(stream);
    }
    for (auto const& stream : streams) stream->wait();
}

void tell_stream_leaks() {
    std::lock_guard const lock(handles().mutex);
    auto const streams =
        std::ranges::count_if(handles().streams, [](auto const& entry) { return !entry.second->destroyed; });
    if (streams > 0) std::fprintf(stderr, "simulated CUDA: %zu streams not destroyed\n", std::size_t(streams));
    std::size_t const events = handles().events.size();
    if (events > 0) std::fprintf(stderr, "simulated CUDA: %zu events not destroyed\n", events);
}

}  // namespace slideway::simulated_cuda

using namespace slideway::simulated_cuda;

cudaError_t cudaStreamCreateWithFlags(cudaStream_t* out, unsigned) {
    return call("cudaStreamCreateWithFlags", [&] {
        std::lock_guard const lock(handles().mutex);
        auto const stream = std::make_shared<CUstream_st>(current_device(), handles().streams_made++);
        *out = stream.get();
        handles().streams.emplace(*out, stream);
        std::thread([stream] {
            stream->work();
            forget(stream.get());
        }).detach();
        return cudaSuccess;
    });
}

cudaError_t cudaStreamDestroy(cudaStream_t handle) {
    return give_back("cudaStreamDestroy", [&] {
        auto const stream = stream_of(handle);
        stream->destroyed = true;
        stream->end();
        return cudaSuccess;
    });
}

cudaError_t cudaStreamSynchronize(cudaStream_t handle) {
    return call("cudaStreamSynchronize", [&] { return stream_of(handle)->wait(), card_error(); });
}

cudaError_t cudaStreamQuery(cudaStream_t handle) {
    return call("cudaStreamQuery", [&] {
        bool const idle = stream_of(handle)->is_idle();
        cudaError_t const lost = card_error();
        return lost != cudaSuccess || idle ? lost : cudaErrorNotReady;
    });
}

cudaError_t cudaEventCreateWithFlags(cudaEvent_t* out, unsigned) {
    return call("cudaEventCreateWithFlags", [&] {
        std::lock_guard const lock(handles().mutex);
        auto const event = std::make_shared<CUevent_st>(current_device());
        *out = event.get();
        handles().events.emplace(*out, event);
        return cudaSuccess;
    });
}

cudaError_t cudaEventDestroy(cudaEvent_t handle) {
    return give_back("cudaEventDestroy", [&] {
        event_of(handle);
        std::lock_guard const lock(handles().mutex);
        handles().events.erase(handle);
        return cudaSuccess;
    });
}

cudaError_t cudaEventRecord(cudaEvent_t handle, cudaStream_t stream) {
    return call("cudaEventRecord", [&] {
        auto const event = event_of(handle);
        std::uint64_t const number = event->recorded + 1;
        cudaError_t const code = enqueue(stream, event->device, [event, number] {
            // An earlier record may be reached later, in another stream.
            std::uint64_t before = event->reached;
            while (before < number && !event->reached.compare_exchange_weak(before, number)) continue;
        });
        if (code == cudaSuccess) event->recorded = number;
        return code;
    });
}

cudaError_t cudaEventQuery(cudaEvent_t handle) {
    return call("cudaEventQuery", [&] {
        auto const event = event_of(handle);
        bool const is_reached = event->reached >= event->recorded;
        cudaError_t const lost = card_error();
        return lost != cudaSuccess || is_reached ? lost : cudaErrorNotReady;
    });
}
