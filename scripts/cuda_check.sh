#!/usr/bin/env bash
# The checks that need a GPU: builds the GPU module, runs the tests labelled cuda, compares results with the processor's, runs
# compute-sanitizer, and measures.
# Usage: scripts/cuda_check.sh [arguments of bench_cuda], e.g. --rounds 5.  Result: bench/results/cuda_<card>.md.
#
# Exit code 0 only when every step passed; 1 after the first one that failed; 4 without a usable GPU, when nothing was checked.
# The last line says which.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
exec </dev/null

build=build/cuda
slideway=$build/bin/slideway
results=$build/check

stop() {
    echo "cuda_check.sh: $1"
    exit "${2:-1}"
}
step() {
    echo
    echo "== $1"
}

# The driver's tool is not in every container; the driver itself is.
has_card() {
    if command -v nvidia-smi >/dev/null; then
        nvidia-smi -L 2>/dev/null | grep '^GPU '
    else
        [[ -e /dev/nvidiactl ]]
    fi
}
step "the card"
has_card || stop "no card was found, nothing was checked" 4

step "set-up and build, preset cuda"
bash scripts/setup.sh || stop "the set-up failed"
cmake --preset cuda --log-level=WARNING || stop "the configuration failed"
cmake --build "$build" --parallel "$(nproc)" --target all bench_cuda || stop "the build failed"
rm -rf "$results"
mkdir -p "$results"

# run <result> <scene> [options]: what it says goes beside its result, and is shown if it fails.
run() {
    local result=$results/$1 scene=$2 code=0
    shift 2
    "$slideway" run "scenes/$scene" --no-progress -o "$result" "$@" >"${result%.nc}.txt" 2>&1 || code=$?
    ((code == 0)) || cat "${result%.nc}.txt"
    return "$code"
}

# The runtime may find less than the driver's tool: the driver may be too old, or this build may have no kernels for the GPU.
step "the card, as slideway finds it"
found=$("$slideway" list | sed -n 's/^  cuda  *//p') || stop "slideway cannot say"
echo "$found"
[[ $found == "cuda ("* ]] || stop "no card can be used (see above), nothing was checked" 4

small=(ensemble_starts.toml --set study.members=96 --set 'study.duration=2 ms' --backend cuda)
step "a first run on the card"
run first.nc "${small[@]}" || stop "it failed"

step "tests labelled cuda"
ctest --test-dir "$build" --label-regex '^cuda$' --no-tests=error --output-on-failure | tee "$results/ctest.log" ||
    stop "a test failed"
if grep -q '(Skipped)$' "$results/ctest.log"; then stop "tests found no card"; fi

payload() {
    "$slideway" info "$results/$1" | sed -n 's/^payload  *\([0-9a-f]*\): matches the data$/\1/p'
}
# same <name> <scene> [options]: on the processor, on the GPU, and there in other blocks.
same() {
    local name=$1
    shift
    run "$name.cpu.nc" "$@" --backend cpu || stop "$name: the processor's run failed"
    run "$name.cuda.nc" "$@" --backend cuda || stop "$name: the card's run failed"
    run "$name.blocks.nc" "$@" --backend cuda --threads 2 --block-members 37 || stop "$name: the card's run in blocks of 37 failed"
    local cpu cuda blocks
    cpu=$(payload "$name.cpu.nc") cuda=$(payload "$name.cuda.nc") blocks=$(payload "$name.blocks.nc")
    printf '%-24s %-17s %-17s %s\n' "$name" "$cpu" "$cuda" "$blocks"
    [[ -n $cpu ]] || stop "$name: the processor's result is damaged"
    [[ $cuda == "$cpu" && $blocks == "$cpu" ]] || stop "$name: the card's result is not the processor's"
}
step "payloads: processor, card, card in blocks of 37 members"
for law in paper conservative; do
    set_law=(--set "contact.law=$law")
    same "starts_$law" ensemble_starts.toml "${set_law[@]}" --set study.members=512 --set 'study.duration=20 ms'
    same "series_$law" slider_crank_0.1mm.toml "${set_law[@]}" --set study.revolutions=1
    same "exponents_$law" lyapunov_0.1mm.toml "${set_law[@]}" --set study.members=40 --set study.transient_revolutions=0 \
        --set study.revolutions=1
    same "crossings_$law" poincare_0.1mm.toml "${set_law[@]}" --set study.transient_revolutions=0 \
        --set study.revolutions=1 --set 'study.section={on="vy"}'
    same "sweep_$law" sweep_clearance.toml "${set_law[@]}" --set study.members=1 --set study.transient_revolutions=1 \
        --set study.revolutions=1
    same "tolerance_$law" tolerance_0.1mm.toml "${set_law[@]}" --set study.base=8 --set 'study.duration=20 ms'
done
# The scenes have keys that this law does not know.
cat >"$results/kelvin_voigt.toml" <<'END'
schema = 1
[contact]
law = "kelvin_voigt"
apex_damping = 40
[friction]
[study]
members = 512
duration = "20 ms"
samples = 5
quantities = ["energy_residual", "peak_normal_force"]
[study.vary]
"initial.y" = { dist = "unif", low = "-0.09 mm", high = "0.09 mm" }
"initial.vy" = { dist = "unif", low = -0.05, high = 0.05 }
END
same kelvin_voigt "../$results/kelvin_voigt.toml"
same restitution ensemble_starts.toml --set contact.restitution=0.8 --set study.members=512 --set 'study.duration=20 ms'

sanitizer=$(PATH=$PATH:${CUDA_HOME:-/usr/local/cuda}/bin command -v compute-sanitizer || true)
if [[ -n $sanitizer ]]; then
    device_tests=$build/bin/cuda_device_tests
    for tool in memcheck racecheck initcheck synccheck; do
        watched=("$sanitizer" --tool "$tool" --error-exitcode 86)
        step "compute-sanitizer, $tool: a short run"
        "${watched[@]}" "$slideway" run "scenes/${small[0]}" --no-progress -o "$results/$tool.nc" "${small[@]:1}" >"$results/$tool.txt" 2>&1 ||
            { tail -n 40 "$results/$tool.txt" && stop "$tool complains of a run (all of it: $results/$tool.txt)"; }
        tail -n 1 "$results/$tool.txt"
        step "compute-sanitizer, $tool: the device tests"
        "${watched[@]}" "$device_tests" >"$results/$tool.tests.txt" 2>&1 ||
            { tail -n 40 "$results/$tool.tests.txt" && stop "$tool complains of a test (all of it: $results/$tool.tests.txt)"; }
        tail -n 1 "$results/$tool.tests.txt"
    done
else
    step "compute-sanitizer was not found: left out"
fi

step "bench_cuda"
"$build/bin/bench_cuda" "$@" >"$results/table.md" || stop "bench_cuda ended with code $? (see $results/table.md)"
card=$(sed -n 's/^- card: \(.*\), sm_[0-9].*/\1/p' "$results/table.md" | tr '[:upper:]' '[:lower:]' | tr -cs '[:alnum:]\n' _)
[[ -n $card ]] || stop "bench_cuda did not name its card (see $results/table.md)"
table=bench/results/cuda_$card.md
cp "$results/table.md" "$table"
cat "$table"

echo
if [[ -n $sanitizer ]]; then
    stop "every step passed; the table is $table" 0
else
    stop "every step passed but compute-sanitizer, which was not found; the table is $table" 0
fi
