#!/usr/bin/env bash
# clang-tidy with the checks of .clang-tidy over units of host/.
# Usage: scripts/tidy.sh [--all | FILE...].  Units that differ from the branch `main` if not given, all of host/ with --all.
# Exit code 1 with findings.  Reads the flags of a build with clang (preset asan), which it configures and does not compile.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
exec </dev/null

stop() {
    echo "tidy.sh: $1"
    exit 1
}
bash scripts/setup.sh clang || stop "the set-up failed"
tidy=clang-tidy-14
if [[ ${1:-} == --all ]]; then
    mapfile -t units < <(git ls-files 'host/*.cpp')
elif (($# > 0)); then
    units=("$@")
else
    mapfile -t units < <(git diff --name-only --diff-filter=d "$(git merge-base main HEAD)" -- 'host/*.cpp')
fi
((${#units[@]} > 0)) || { echo "tidy.sh: no unit of host/ has changed"; exit 0; }

# Without precompiled headers, which clang-tidy would take for damaged, and without sanitizers.
build=build/tidy
cmake --preset asan -B "$build" --log-level=WARNING -DSLIDEWAY_SANITIZE= -DSLIDEWAY_TESTS=OFF -DSLIDEWAY_ISAS=scalar \
    -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON || stop "the configuration failed"
cmake --build "$build" --target slideway_commit || stop "the build failed"
# Units that this build does not compile (those for GPUs) have no flags.
listed=()
for unit in "${units[@]}"; do
    if grep -qF "\"file\": \"$root/$unit\"" "$build/compile_commands.json"; then listed+=("$unit"); fi
done
((${#listed[@]} > 0)) || { echo "tidy.sh: no unit to look at"; exit 0; }
log=$build/findings.txt
printf '%s\n' "${listed[@]}" | xargs -P "${SLIDEWAY_JOBS:-$(nproc)}" -n 1 "$tidy" -p "$build" --quiet 2>/dev/null >"$log" || true
# A header that several units include is found several times; what has no place in the sources is of the system's headers.
found=$(grep -E "^$root/.*(warning|error):" "$log" | sort -u | sed "s|^$root/||" || true)
[[ -z $found ]] || echo "$found"
echo "tidy.sh: ${#listed[@]} units, $(grep -c . <<<"$found" || true) findings"
[[ -z $found ]]
