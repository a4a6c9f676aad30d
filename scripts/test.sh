#!/usr/bin/env bash
# Sets up, builds and runs all tests but those labelled slow.  Exit code 0 only when everything passed.
# Usage: scripts/test.sh [--cuda] [--all-isas].  The GPU module and its tests are built where a GPU is found (not with CI=true) or with
# --cuda; without a GPU for sm_90, and tested on a simulated one.  With less than four cores the instruction sets are
# scalar and the widest of this machine, headers are not compiled one by one, and host and tests are compiled several files at once; all of that
# apart with --all-isas: before a release.
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
    echo "test.sh: $1"
    echo "0 passed, 1 failed"
    exit 1
}

cuda=OFF all_isas=false
((jobs < 4)) || all_isas=true
for word in "$@"; do
    case $word in
        --cuda) cuda=ON ;;
        --all-isas) all_isas=true ;;
        *) stop "cannot make sense of: $word; use --cuda, --all-isas or nothing, no test ran" ;;
    esac
done
bash scripts/setup.sh tests || stop "the set-up failed, no test ran"

if nvidia-smi -L >/dev/null 2>&1; then
    [[ ${CI:-false} == true ]] || cuda=ON
else
    # Without a GPU one architecture checks the kernels as well as two, in half the time.
    export CUDAARCHS=90-real
fi
isas=all unity=OFF
# Two cores would compile and test them for minutes; a file by itself takes twice the time that it takes among others.
if [[ $all_isas == false ]]; then
    isas=native unity=ON
    echo "test.sh: less than four cores: instruction sets but scalar and the widest, and headers and files alone," \
        "are left to scripts/test.sh --all-isas"
fi
options=("-DSLIDEWAY_CUDA=$cuda" "-DSLIDEWAY_ISAS=$isas" "-DSLIDEWAY_UNITY=$unity")

SECONDS=0
# A new Python environment waits for its packages most of the time: the program is compiled meanwhile.
if [[ ! -e build/python/requirements.txt ]]; then
    bash scripts/python_environment.sh --without-package >/dev/null &
    cmake --preset release --log-level=WARNING "${options[@]}" -DSLIDEWAY_PYTHON=OFF || stop "the configuration failed, no test ran"
    cmake --build "$build" --parallel "$jobs" --target slideway || stop "the build failed, no test ran"
    wait $! || stop "no Python environment, no test ran"
fi
environment=$(bash scripts/python_environment.sh --without-package) || stop "no Python environment, no test ran"
options+=(-DSLIDEWAY_PYTHON=ON "-DPython_EXECUTABLE=$environment/bin/python")
cmake --preset release --log-level=WARNING "${options[@]}" || stop "the configuration failed, no test ran"
cmake --build "$build" --parallel "$jobs" || stop "the build failed, no test ran"
[[ $all_isas == false ]] || cmake --build "$build" --parallel "$jobs" --target header_check || stop "a header does not compile alone, no test ran"
# The wheel, before tests run in this build.
bash scripts/python_environment.sh "$build" >/dev/null || stop "the Python package could not be made, no test ran"
echo "build: $SECONDS s"

SECONDS=0
code=0
rm -rf "$build/gtest"
ctest --test-dir "$build" --label-exclude '^slow$' --parallel "$((jobs + 1))" --timeout 300 --no-tests=error \
    --output-on-failure | tee "$log" || code=$?
echo "tests: $SECONDS s on $jobs cores"

# ctest's summary: `P% tests passed, F tests failed out of N`, where N leaves out the disabled tests and counts the
# skipped ones as passed; after it both are listed by name.
# shellcheck disable=SC2016  # sed's own $
summary=$(sed -n '/^[0-9]*% tests passed, /h; /^[0-9]*% tests passed, /!H; ${x;p}' "$log")
[[ $summary =~ ^[0-9]+%\ tests\ passed,\ ([0-9]+)\ tests\ failed\ out\ of\ ([0-9]+) ]] ||
    stop "ctest ended with code $code and without a summary"
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

line="$((total - failed - skipped)) passed, $failed failed"
((skipped + disabled > 0)) && line+=", $((skipped + disabled)) skipped"
echo "$line"
exit "$code"
