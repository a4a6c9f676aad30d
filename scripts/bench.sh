#!/usr/bin/env bash
# What slideway does in a second on this machine: builds bench_throughput, runs it, and makes a table and a picture of it.
# Usage: scripts/bench.sh [--quick] [OUTDIR].  OUTDIR: build/bench; --quick: right-hand sides, engine, Lorenz and relief valve on one
# thread, some three minutes.  OUTDIR/throughput.json is Google Benchmark's, for bench/compare.py.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
exec </dev/null

stop() {
    echo "bench.sh: $1" >&2
    exit 1
}
quick=false
if [[ ${1:-} == --quick ]]; then
    quick=true
    shift
fi
(($# <= 1)) && [[ ${1:-} != -* ]] || stop "cannot make sense of: $*; use [--quick] [OUTDIR]"
output=$(realpath -m "${1:-$root/build/bench}")
cd "$root"

build=build/release
bash scripts/setup.sh tests || stop "the set-up failed (see above)"
cmake --preset release --log-level=WARNING || stop "the configuration failed (see above)"
cmake --build "$build" --parallel "$(nproc)" --target bench_throughput || stop "the build failed (see above)"
environment=$(bash scripts/python_environment.sh) || stop "no Python environment (see above)"
mkdir -p "$output"

options=(--benchmark_repetitions=5 --benchmark_enable_random_interleaving=true --benchmark_out="$output/throughput.json"
    --benchmark_out_format=json)
if [[ $quick == true ]]; then
    options=("${options[@]/repetitions=5/repetitions=3}" --benchmark_min_time=0.05
        "--benchmark_filter=^(peak/.*|rhs/.*lean|lorenz/.*|valve/.*|engine/(standard|rattling,|settling|pitched|bed|creep).*)/[a-z0-9]*(/threads:1)?$")
fi
"$build/bin/bench_throughput" "${options[@]}" >/dev/null || stop "bench_throughput failed"
PYTHONPATH=$root "$environment/bin/python" bench/throughput_report.py "$output/throughput.json" "$output"
