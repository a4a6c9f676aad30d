#!/usr/bin/env bash
# Installs the Python package into an environment of its own, build/python, and runs its tests against a built program.
# Usage: scripts/python_tests.sh [PROGRAM [arguments of pytest]]; PROGRAM: build/release/bin/slideway, or where SLIDEWAY_PROGRAM says.
# The environment is made anew when what the package needs has changed; making it takes a package index, using it does not.
# The last line is `N passed, N failed`; the exit code is 0 only when everything passed.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
exec </dev/null

stop() {
    echo "python_tests.sh: $1"
    echo "0 passed, 1 failed"
    exit 1
}

program=$(realpath -m "${1:-${SLIDEWAY_PROGRAM:-build/release/bin/slideway}}")
shift $(($# > 0))
[[ -x $program ]] || stop "no $program; build it first, with scripts/test.sh or scripts/demo.sh"
build=$(dirname "$(dirname "$program")")
[[ -f $build/CMakeCache.txt ]] || build=build/release
environment=$(bash scripts/python_environment.sh "$build") || stop "no Python environment (see above)"
report=$(mktemp)
trap 'rm -f "$report"' EXIT
code=0
# Neither caches nor byte code beside the sources, which are those of the repository.
unset PYTHONDONTWRITEBYTECODE
(cd python && SLIDEWAY_PROGRAM=$program PYTHONPYCACHEPREFIX=$root/build/pycache "$environment/bin/pytest" -q -rs -p no:cacheprovider \
    --junitxml="$report" "$@") || code=$?

count() { sed -n "s/.*<testsuite [^>]*\b$1=\"\([0-9]*\)\".*/\1/p" "$report" 2>/dev/null | head -n 1; }
total=$(count tests)
[[ -n $total ]] || stop "pytest ended with code $code and without a report"
failed=$(($(count failures) + $(count errors)))
skipped=$(count skipped)
line="$((total - failed - skipped)) passed, $failed failed"
((skipped > 0)) && line+=", $skipped skipped"
echo "$line"
exit "$code"
