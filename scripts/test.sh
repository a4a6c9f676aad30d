#!/usr/bin/env bash
# Sets up, builds and runs all tests but those labelled slow.  Exit code 0 only when everything passed.
# Usage: scripts/test.sh [--cuda] [--all-isas | --isas scalar,avx2].  The GPU module and its tests are built where a GPU is found (not with
# CI=true) or with --cuda; without a GPU for sm_90, and tested on a simulated one.  With less than four cores the instruction sets are
# scalar, at -O1, and the widest of this machine, headers are not compiled one by one, and host and tests are compiled several files at once; all
# of that apart with --all-isas: before a release.  --isas names the instruction sets: `scalar,avx2` tests what a machine without AVX-512 would.
# With CI=true on a machine with AVX-512, what depends on the instruction set runs once more as on one without.
# The last line is `N passed, N failed`, with `, N skipped` when tests were skipped.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
exec </dev/null

build=build/release
jobs=$(nproc)
log=$build/ctest.log
# Threads of tests that share the cores must sleep, not spin, while they wait for each other.
export OMP_WAIT_POLICY=passive

# Runs write each block through to the disk; in memory that takes no time.
if [[ -z ${TMPDIR:-} && -w /dev/shm ]] && (($(df --output=avail /dev/shm | tail -1) > 4000000)); then
    export TMPDIR=/dev/shm
fi

# A failure before the first test counts as one failed test, so that the last line is always right.
stop() {
    wait  # for packages that are still being installed
    echo "test.sh: $1"
    echo "0 passed, 1 failed"
    exit 1
}

cuda=OFF all_isas=false isas=
((jobs < 4)) || all_isas=true
while (($# > 0)); do
    case $1 in
        --cuda) cuda=ON ;;
        --all-isas) all_isas=true ;;
        --isas)
            [[ -n ${2:-} ]] || stop "--isas wants names with commas between them, as in --isas scalar,avx2, no test ran"
            all_isas=false isas=${2//,/;}
            shift
            ;;
        *) stop "cannot make sense of: $1; use --cuda, --all-isas, --isas scalar,avx2 or nothing, no test ran" ;;
    esac
    shift
done
bash scripts/setup.sh || stop "the set-up failed, no test ran"

if nvidia-smi -L >/dev/null 2>&1; then
    [[ ${CI:-false} == true ]] || cuda=ON
else
    # Without a GPU one architecture checks the kernels as well as two, in half the time.
    export CUDAARCHS=90-real
fi
unity=OFF
# Two cores would compile and test them for minutes; a file by itself takes twice the time that it takes among others.
if [[ $all_isas == true ]]; then
    isas=all
else
    unity=ON
    [[ -n $isas ]] || echo "test.sh: less than four cores: instruction sets but scalar and the widest, and headers and files alone," \
        "are left to scripts/test.sh --all-isas"
fi
without_avx512=false
[[ ${CI:-false} == true && -z $isas ]] && grep -qw avx512f /proc/cpuinfo && without_avx512=true
isas=${isas:-native}
options=("-DSLIDEWAY_CUDA=$cuda" "-DSLIDEWAY_ISAS=$isas" "-DSLIDEWAY_UNITY=$unity" "-DSLIDEWAY_SCALAR_O1=$unity")

SECONDS=0
# What the tests need besides, and a new Python environment, wait for packages most of the time: the program is compiled meanwhile.
if [[ ! -e build/python/requirements.txt ]]; then
    mkdir -p build
    { bash scripts/setup.sh tests && bash scripts/python_environment.sh --without-package; } &>build/packages.log &
    cmake --preset release --log-level=WARNING "${options[@]}" -DSLIDEWAY_PYTHON=OFF || stop "the configuration failed, no test ran"
    cmake --build "$build" --parallel "$jobs" --target slideway || stop "the build failed, no test ran"
    wait $! || { cat build/packages.log && stop "no packages or no Python environment for the tests (see above), no test ran"; }
fi
bash scripts/setup.sh tests || stop "the set-up failed, no test ran"
environment=$(bash scripts/python_environment.sh --without-package) || stop "no Python environment, no test ran"
options+=(-DSLIDEWAY_PYTHON=ON "-DPython_EXECUTABLE=$environment/bin/python")
cmake --preset release --log-level=WARNING "${options[@]}" || stop "the configuration failed, no test ran"
cmake --build "$build" --parallel "$jobs" || stop "the build failed, no test ran"
[[ $all_isas == false ]] || cmake --build "$build" --parallel "$jobs" --target header_check || stop "a header does not compile alone, no test ran"
# The wheel, before tests run in this build.
bash scripts/python_environment.sh "$build" >/dev/null || stop "the Python package could not be made, no test ran"
echo "build: $SECONDS s"

# run_tests [OPTIONS of ctest]: adds what they come to, to passed, failed and skipped.
passed_in_all=0 failed_in_all=0 skipped_in_all=0 code=0
run_tests() {
    SECONDS=0
    local code_here=0
    rm -rf "$build/gtest"
    mkdir "$build/gtest"  # also where no test writes there
    ctest --test-dir "$build" "$@" --parallel "$((jobs + 1))" --timeout 300 --no-tests=error \
        --output-on-failure | tee "$log" || code_here=$?
    echo "tests: $SECONDS s on $jobs cores"

    # ctest's summary: `P% tests passed, F tests failed out of N`, where N leaves out the disabled tests and counts the
    # skipped ones as passed; after it both are listed by name.
    # shellcheck disable=SC2016  # sed's own $
    summary=$(sed -n '/^[0-9]*% tests passed, /h; /^[0-9]*% tests passed, /!H; ${x;p}' "$log")
    [[ $summary =~ ^[0-9]+%\ tests\ passed,\ ([0-9]+)\ tests\ failed\ out\ of\ ([0-9]+) ]] ||
        stop "ctest ended with code $code_here and without a summary"
    failed=${BASH_REMATCH[1]}
    total=${BASH_REMATCH[2]}
    skipped=$(grep -c '(Skipped)$' <<<"$summary" || true)
    disabled=$(grep -c '(Disabled)$' <<<"$summary" || true)
    # A suite that ctest has as one test counts as the tests in it, which are in its XML file; without one, it ended in the middle, it stays one.
    # shellcheck disable=SC2016  # awk's own $
    counts=$(find "$build/gtest" -name '*.xml' -exec cat {} + 2>/dev/null | awk -F'"' '
        /<testsuite / { ++suites; tests += $4; failures += $6; disabled += $8; skipped += $10; bad += $6 > 0 }
        END { print tests - suites, failures - bad, disabled + 0, skipped + 0 }')
    read -r more more_failed more_disabled more_skipped <<<"$counts"
    ((total += more - more_disabled, failed += more_failed, disabled += more_disabled, skipped += more_skipped, 1))
    sed -n 's/^\[  FAILED  \] \([^ ,]*\).* ([0-9]* ms)$/failed: \1/p' "$log"

    # Why: what ctest hides of a skipped test, from GTEST_SKIP, or from a command that says "skipped: <reason>".
    if ((skipped > 0)); then
        awk 'follows { ++count[NF ? $0 : "no reason is given"]; follows = 0 }
             /: Skipped$/ { follows = 1 }
             sub(/^skipped: /, "") { ++count[$0] }
             END { for (reason in count) printf "skipped: %s (%d test%s)\n", reason, count[reason], count[reason] == 1 ? "" : "s" }
            ' "$build/Testing/Temporary/LastTest.log" | sort || true
    fi
    ((passed_in_all += total - failed - skipped, failed_in_all += failed, skipped_in_all += skipped + disabled, 1))
    ((code_here == 0)) || code=$code_here
}

run_tests --label-exclude '^slow$'
if [[ $without_avx512 == true ]]; then
    # In the same folder: kernels of AVX2 are compiled, and the program that chooses among instruction sets is linked anew.  A study
    # of each mechanism with each of its laws has to have one hash on all of them; rigid contacts, which are modules, and parity of single functions
    # are left to --isas scalar,avx2.
    SECONDS=0
    cmake --preset release --log-level=WARNING "${options[@]}" "-DSLIDEWAY_ISAS=scalar;avx2" || stop "the configuration failed"
    cmake --build "$build" --parallel "$jobs" --target slideway system_tests costs ||
        stop "the build without AVX-512 failed"
    echo "build without AVX-512: $SECONDS s"
    run_tests --tests-regex '^(Costs.AreThoseOfTheRecord_avx2|InstructionSets.HaveOneHashWithEachLaw)$'
fi

line="$passed_in_all passed, $failed_in_all failed"
((skipped_in_all > 0)) && line+=", $skipped_in_all skipped"
echo "$line"
exit "$code"
