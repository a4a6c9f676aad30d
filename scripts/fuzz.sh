#!/usr/bin/env bash
# Hostile input for what reads files, scenes and command lines: builds the targets of tests/fuzz (libFuzzer, address and undefined-behaviour
# sanitizers, leaks) and runs each with its corpus.
# Usage: scripts/fuzz.sh [SECONDS | --runs N] [TARGET...].  SECONDS for all of them together, 60 if not given; N: executions of each, from
# its start, however long they take.
# A line for each target: executions, per second, findings.  The exit code is 0 without findings; an input that led to one is kept, its name is
# printed.  Inputs that reached new code are kept in build/fuzz/corpus, so that a later run goes on from there.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
exec </dev/null

stop() {
    echo "fuzz.sh: $1"
    exit 1
}
all=(scene table shards statistics result units words library ranks states)
targets=() seconds=60 runs=
while (($# > 0)); do
    case $1 in
        --runs)
            [[ ${2:-} =~ ^[0-9]+$ ]] || stop "--runs takes a number"
            runs=$2
            shift
            ;;
        *[!0-9]*)
            [[ " ${all[*]} " == *" $1 "* ]] || stop "there is no target $1; use ${all[*]}"
            targets+=("$1")
            ;;
        *) seconds=$1 ;;
    esac
    shift
done
((${#targets[@]} > 0)) || targets=("${all[@]}")
bash scripts/setup.sh clang || stop "the set-up failed"

build=build/fuzz
cmake --preset fuzz --log-level=WARNING -DSLIDEWAY_UNITY=ON || stop "the configuration failed"
cmake --build "$build" --parallel "${SLIDEWAY_JOBS:-$(nproc)}" --target fuzz_dictionary "${targets[@]/#/fuzz_}" || stop "the build failed"
"$build/bin/fuzz_dictionary" >"$build/words.dict"

limit=(-max_total_time=$(((seconds + ${#targets[@]} - 1) / ${#targets[@]})))
[[ -z $runs ]] || limit=(-runs="$runs")
# netCDF and HDF5 keep what they allocated once; leaks are looked for in what is ours.
export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
# What an execution has freed is watched until its end, and not until 256 MiB more were: new memory, and who asked for it to 30 calls up, took a
# third of the time.  Who asked is told where a finding is run again without these options.
export ASAN_OPTIONS=quarantine_size_mb=2:thread_local_quarantine_size_kb=128:malloc_context_size=1
base=${TMPDIR:-/tmp}
[[ -n ${TMPDIR:-} || ! -w /dev/shm ]] || base=/dev/shm
TMPDIR=$(mktemp -d "$base/slideway_fuzz.XXXXXX")
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT
found=0
for target in "${targets[@]}"; do
    mkdir -p "$build/corpus/$target" "$build/findings"
    # Command lines, tables and plans of results say what they have to say in few bytes.  Which input is changed next is drawn evenly: to count how
    # rare each one's ways are (entropic) took up to a sixth of the time.
    length=4096
    [[ $target != words && $target != table && $target != result ]] || length=512
    options=("${limit[@]}" -rss_limit_mb=2048 -timeout=20 "-max_len=$length" -entropic=0 -print_final_stats=1 "-artifact_prefix=$build/findings/$target-")
    [[ $target != scene && $target != words && $target != units && $target != table ]] || options+=("-dict=$build/words.dict")
    log=$build/$target.log
    code=0
    "$build/bin/fuzz_$target" "${options[@]}" "$build/corpus/$target" "tests/fuzz/corpus/$target" >"$log" 2>&1 || code=$?
    stat() { sed -n "s/^stat::$1: *//p" "$log"; }
    printf '%-10s %10s executions, %6s a second, findings: %d\n' "$target" "$(stat number_of_executed_units)" "$(stat average_exec_per_sec)" $((code != 0))
    if ((code != 0)); then
        found=$((found + 1))
        grep -E '^(SUMMARY|does not hold|artifact_prefix)|Test unit written' "$log" | sed 's/^/    /' || true
        echo "    see $log"
    fi
done
((found == 0)) || stop "$found targets have findings"
