#!/usr/bin/env bash
# Unit and integration tests under sanitizers: address and undefined behaviour for all of them, threads for the queue, the runs and the stores, for a run
# of the program, and for the Python module that several threads of Python use.
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
failed=0 options=()
check() {
    local preset=$1 filter=$2
    shift 2
    cmake --preset "$preset" --log-level=WARNING -DSLIDEWAY_UNITY=ON "-DSLIDEWAY_ISAS=${SLIDEWAY_ISAS:-native}" "${options[@]}" || stop "the configuration of $preset failed"
    cmake --build "build/$preset" --parallel "${SLIDEWAY_JOBS:-$(nproc)}" --target "$@" || stop "the build of $preset failed"
    local program
    for program in "$@"; do
        echo "== $program, $preset"
        "build/$preset/bin/$program" --gtest_brief=1 "--gtest_filter=$filter" || failed=$((failed + 1))
    done
}
check_program() {
    cmake --build build/tsan --parallel "${SLIDEWAY_JOBS:-$(nproc)}" --target slideway || stop "the build of the program failed"
    echo "== slideway run and info, tsan"
    local folder
    folder=$(mktemp -d)
    build/tsan/bin/slideway run scenes/tolerance_0.1mm.toml --set study.base=4 --set study.duration=1e-3 --threads 4 --quiet -o "$folder/a.nc" &&
        build/tsan/bin/slideway info --check "$folder/a.nc" >/dev/null || failed=$((failed + 1))
    rm -rf "$folder"
}
# A Python of our own main function, whose runtime of the sanitizer the module shares; the interpreter's library is not compiled for it.
check_module() {
    cmake --build build/tsan --parallel "${SLIDEWAY_JOBS:-$(nproc)}" --target slideway_python || stop "the build of the Python module failed"
    echo "== python/tests/threads_in_one_process.py, tsan"
    local package=build/tsan/package/slideway main=build/tsan/bin/python_main libraries
    rm -rf "$package"
    mkdir -p "$package"
    cp -r python/slideway/. build/tsan/python/_native*.so "$package"
    says() { "$python" -c "import sys, sysconfig; print($1)"; }
    libraries=$(says 'sysconfig.get_config_var("LIBDIR")')
    printf '#include <Python.h>\nint main(int argc, char** argv) { return Py_BytesMain(argc, argv); }\n' >"$main.c"
    clang-14 -fsanitize=thread "-I$(says 'sysconfig.get_path("include")')" "$main.c" -o "$main" "-L$libraries" "-Wl,-rpath,$libraries" \
        "-lpython$(says 'sysconfig.get_config_var("LDVERSION")')" || stop "the build of a Python for the sanitizer failed"
    unset PYTHONDONTWRITEBYTECODE
    PYTHONHOME=$(says sys.base_prefix) PYTHONPATH=build/tsan/package:$(says 'sysconfig.get_path("purelib")') PYTHONPYCACHEPREFIX=build/tsan/pycache \
        "$main" python/tests/threads_in_one_process.py || failed=$((failed + 1))
}
[[ ${1:-asan} != asan ]] || check asan '-*Kernel*:*Parity*' unit_tests integration_tests
# What several threads of this program share.
if [[ ${1:-tsan} == tsan ]]; then
    bash scripts/setup.sh python || stop "the set-up failed"
    python=$(bash scripts/python_environment.sh --without-package)/bin/python || stop "no Python environment (see above)"
    options=(-DSLIDEWAY_PYTHON=ON "-DPython_EXECUTABLE=$python")
    check tsan 'MemberQueue*:*Ensemble*:*Shard*:*Progress*:*Stop*:*Rank*:*SharedRun*:Units.*' unit_tests integration_tests
    check_program
    check_module
fi
((failed == 0)) || stop "$failed programs have findings"
echo "sanitize.sh: nothing was found"
