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
command -v python3 >/dev/null || stop "no python3; install it (Debian: python3 python3-venv python3-pip)"

environment=build/python
stamp=$environment/requirements.txt
pip=("$environment/bin/python" -m pip --disable-pip-version-check --quiet)
mkdir -p build
# One at a time: builds of several presets share the environment.
exec 9>build/python.lock
flock 9
needs=$(python3 --version && cat python/pyproject.toml)
if [[ $(cat "$stamp" 2>/dev/null) != "$needs" ]]; then
    rm -rf "$environment"
    python3 -m venv "$environment" || stop "python3 -m venv failed; install it (Debian: python3-venv)"
    "${pip[@]}" install hatchling "./python[test]" || stop "pip could not install the package (see above)"
    echo "$needs" >"$stamp"
else
    "${pip[@]}" install --no-deps --no-build-isolation --force-reinstall ./python || stop "pip could not install the package (see above)"
fi

report=$environment/report.xml
rm -f "$report"
code=0
# Neither caches nor byte code: the sources are those of the repository.
(cd python && SLIDEWAY_PROGRAM=$program PYTHONDONTWRITEBYTECODE=1 "$root/$environment/bin/pytest" -q -rs -p no:cacheprovider \
    --junitxml="$root/$report" "$@") || code=$?

count() { sed -n "s/.*<testsuite [^>]*\b$1=\"\([0-9]*\)\".*/\1/p" "$report" 2>/dev/null | head -n 1; }
total=$(count tests)
[[ -n $total ]] || stop "pytest ended with code $code and without a report"
failed=$(($(count failures) + $(count errors)))
skipped=$(count skipped)
line="$((total - failed - skipped)) passed, $failed failed"
((skipped > 0)) && line+=", $skipped skipped"
echo "$line"
exit "$code"
