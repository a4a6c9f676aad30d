// Whether mpirun, mpiexec or srun started this process, by the variables that they set for the processes they start.
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace slideway {

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

}  // namespace slideway
