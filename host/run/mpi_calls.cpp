#include "host/run/mpi_calls.hpp"

#include <algorithm>
#include <cstdlib>
#include <thread>

// The C interface: the C++ one left the standard in 2012.
#ifndef OMPI_SKIP_MPICXX
#define OMPI_SKIP_MPICXX 1
#endif
#ifndef MPICH_SKIP_MPICXX
#define MPICH_SKIP_MPICXX 1
#endif
#include <mpi.h>

#include "host/base/error.hpp"

namespace slideway {

void Backoff::sleep() {
    std::this_thread::sleep_for(pause_);
    pause_ = std::min(2 * pause_, longest_);
}

MpiCalls::MpiCalls() {
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

MpiCalls::~MpiCalls() {
    if (says_goodbye_) MPI_Finalize();
}

template <class Start> void MpiCalls::finish(Start start, Backoff backoff) {
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

void MpiCalls::send(int to, int tag, void const* data, std::size_t bytes, Backoff backoff) {
    finish([&](MPI_Request* request) { MPI_Isend(data, static_cast<int>(bytes), MPI_BYTE, to, tag, MPI_COMM_WORLD, request); }, backoff);
}

void MpiCalls::receive(int from, int tag, void* data, std::size_t bytes, Backoff backoff) {
    finish([&](MPI_Request* request) { MPI_Irecv(data, static_cast<int>(bytes), MPI_BYTE, from, tag, MPI_COMM_WORLD, request); }, backoff);
}

std::optional<int> MpiCalls::waiting(int tag) {
    int found = 0;
    MPI_Status status;
    std::lock_guard const lock(mutex_);
    MPI_Iprobe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &found, &status);
    return found != 0 ? std::optional(status.MPI_SOURCE) : std::nullopt;
}

void MpiCalls::broadcast(void* data, std::size_t bytes, Backoff backoff) {
    finish([&](MPI_Request* request) { MPI_Ibcast(data, static_cast<int>(bytes), MPI_BYTE, 0, MPI_COMM_WORLD, request); }, backoff);
}

void MpiCalls::abort(int code) {
    std::lock_guard const lock(mutex_);
    MPI_Abort(MPI_COMM_WORLD, code);
    std::_Exit(code);
}

}  // namespace slideway
