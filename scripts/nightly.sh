#!/usr/bin/env bash
# The tests that take too long for CI, in turn: slow tests (1,000 runs killed among them), sanitizers, hostile input, clang-tidy.  For a machine at night:
# some two hours on two cores.
# Usage: scripts/nightly.sh [SECONDS of scripts/fuzz.sh, 1800 if not given].  Goes on where something fails; the last lines say what did, and the exit code.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
exec </dev/null

results=()
step() {
    echo "== $*"
    if "$@"; then results+=("passed: $*"); else results+=("FAILED: $*"); fi
}
# Slow tests of the Python package, and what they need besides.
slow_python() {
    local environment
    environment=$(bash scripts/python_environment.sh build/release)
    sed -n 's/^slow = \[\(.*\)\]$/\1/p' pyproject.toml | tr -d '",' | tr ' ' '\n' >build/python_slow.txt
    "$environment/bin/python" -m pip --disable-pip-version-check --quiet install -r build/python_slow.txt
    bash scripts/python_tests.sh build/release/bin/slideway -m slow tests
}
step bash scripts/setup.sh nightly
step bash scripts/test.sh --all-isas
step cmake --build build/release --parallel --target slow_programs
step slow_python
step ctest --test-dir build/release --label-regex '^slow$' --output-on-failure
step bash scripts/kills.sh 1000 build/release/bin/slideway
step bash scripts/sanitize.sh
step env SLIDEWAY_PROGRAM=build/release/bin/slideway bash scripts/study.sh build/study
step diff docs/tutorial/study.md build/study/study.md
step bash scripts/fuzz.sh "${1:-1800}"
step bash scripts/tidy.sh --all
printf '%s\n' "${results[@]}"
[[ "${results[*]}" != *FAILED* ]]
