// The processes that share a run: one, or those that mpirun started, if MPI was there when slideway was configured.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/run/member_queue.hpp"

namespace slideway {

/// Calls are made by one thread; `share`'s queue may be used by any.
class Ranks {
public:
    /// Joins the others where mpirun or srun started this process; alone otherwise, without a call of MPI.
    static std::unique_ptr<Ranks> join();
    virtual ~Ranks() = default;

    virtual int rank() const = 0;
    virtual int count() const = 0;
    /// Among those of this machine.
    virtual int local_rank() const = 0;
    virtual int local_count() const = 0;
    /// What rank 0 gives, at every rank.
    virtual std::string broadcast(std::string bytes) = 0;
    /// One queue for all ranks.  @param on_finished at rank 0: members that other ranks report as finished; from another thread.
    virtual std::shared_ptr<MemberQueue> share(std::uint64_t places, std::function<void(std::uint64_t)> on_finished) = 0;
    /// What every rank gives, by rank, at rank 0; nothing elsewhere.  Ends the queue of `share`: it waits, without load, for the
    /// ranks that still work.
    virtual std::vector<std::string> gather(std::string bytes) = 0;
    /// The exit code that rank 0 gives, at every rank, waiting without load.
    virtual int agree(int code) = 0;
    /// Whether others may be at work, from a `broadcast` that says something, or `share`, to the end of `gather`: a rank that fails
    /// then cannot `agree` with them, for they wait for other words.
    virtual bool is_in_round() const = 0;
    /// Ends the processes of all ranks, with this exit code where the launcher passes it on.  Does not return.
    [[noreturn]] virtual void abort(int code) = 0;
};

/// What a launcher says of this process.
struct Launch {
    std::string told_by;  // the variable that says so
    int count = 0;        // processes of the job; 0 where the launcher does not say
    bool first = true;    // this one is rank 0, or the launcher does not say
};

/// Value of an environment variable; nullptr without it.
using Environment = std::function<char const*(char const* name)>;

/// Only variables that mean MPI are asked: OMPI_COMM_WORLD_SIZE (Open MPI), PMI_SIZE (MPICH, Intel MPI,
/// `srun --mpi=pmi2`), MV2_COMM_WORLD_SIZE (MVAPICH2), PMIX_RANK (`srun --mpi=pmix`; SLURM then says how many).
/// SLURM's own variables are set in plain batch jobs too, where each process is alone.
/// @return nothing for a process that nobody started as one of a job.
std::optional<Launch> find_launch(Environment const& environment);

/// Of a build with MPI: starts it; the returned object ends it.
/// @throws SceneError if MPI lets only its main thread make calls, or sees other processes than the launcher started.
std::unique_ptr<Ranks> join_mpi(Launch const& launch);

}  // namespace slideway
