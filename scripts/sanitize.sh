#!/usr/bin/env bash
# Unit and integration tests under sanitizers: address and undefined behaviour for all of them, threads for the queue, the runs and the stores.
# Usage: scripts/sanitize.sh [asan|tsan].  Both if not given.  Kernels are compiled for `scalar` and the widest instruction set of this machine.
# Takes long the first time.  The exit code is 0 when nothing was found.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
exec </dev/null

stop() {
    echo "sanitize.sh: $1"
    exit 1
}
bash scripts/setup.sh clang || stop "the set-up failed"
export OMP_WAIT_POLICY=passive UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
# Neither LLVM's OpenMP nor MPI, HDF5 and netCDF were compiled for the sanitizer of threads.
export TSAN_OPTIONS=ignore_noninstrumented_modules=1:second_deadlock_stack=1
# LLVM's OpenMP does not free what it keeps of a team of threads.
mkdir -p build
echo "leak:libomp.so" >build/leaks_of_libraries.txt
export LSAN_OPTIONS="suppressions=$root/build/leaks_of_libraries.txt:print_suppressions=0"
failed=0
check() {
    local preset=$1 filter=$2
    shift 2
    cmake --preset "$preset" --log-level=WARNING -DSLIDEWAY_UNITY=ON "-DSLIDEWAY_ISAS=${SLIDEWAY_ISAS:-native}" || stop "the configuration of $preset failed"
    cmake --build "build/$preset" --parallel "${SLIDEWAY_JOBS:-$(nproc)}" --target "$@" || stop "the build of $preset failed"
    local program
    for program in "$@"; do
        echo "== $program, $preset"
        "build/$preset/bin/$program" --gtest_brief=1 "--gtest_filter=$filter" || failed=$((failed + 1))
    done
}
[[ ${1:-asan} != asan ]] || check asan '-*Kernel*:*Parity*' unit_tests integration_tests
# What several threads of this program share.
[[ ${1:-tsan} != tsan ]] || check tsan 'MemberQueue*:*Ensemble*:*Shard*:*Progress*:*Stop*:*Rank*:*SharedRun*:Units.*' unit_tests integration_tests
((failed == 0)) || stop "$failed programs have findings"
echo "sanitize.sh: nothing was found"
