#!/usr/bin/env bash
# Kills runs at random moments and resumes them, until N were killed; every study must end with the payload hash of one that nothing disturbed.
# Usage: scripts/kills.sh [N] [--seed S] [PROGRAM].  N: 1000 if not given; PROGRAM: build/release/bin/slideway.
# Threads (1, 2), ranks (1, 2 where mpiexec is found) and instruction set (all that the build and this machine have) change from resume to
# resume.  Kills (-9) are of the whole job: with ranks, of mpiexec and all that it started.  The same seed gives the same choices, not the same moments.
# The last line says kills, resumes, studies and time; the exit code is 0 only when all hashes agree.  What went wrong is kept.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
exec </dev/null

kills=1000 seed=1 program=build/release/bin/slideway
stop() {
    echo "kills.sh: $1"
    exit 1
}
while (($# > 0)); do
    case $1 in
        --seed)
            [[ ${2:-} =~ ^[0-9]+$ ]] || stop "--seed takes a number"
            seed=$2
            shift
            ;;
        *[!0-9]*) program=$1 ;;
        *) kills=$1 ;;
    esac
    shift
done
program=$(realpath -m "$program")
command -v pgrep >/dev/null || stop "there is no pgrep; install procps"
[[ -x $program ]] || stop "no $program; build it first, with scripts/test.sh or scripts/demo.sh"
# Asleep they leave the cores to others, and so the moments of kills to chance.
export OMP_WAIT_POLICY=passive OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

base=${TMPDIR:-/tmp}
[[ -n ${TMPDIR:-} || ! -w /dev/shm ]] || base=/dev/shm
folder=$(mktemp -d "$base/slideway_kills.XXXXXX")
cd "$folder"
failed=false
# Ranks are no children of this script, and not of one group with mpiexec: all have the path of the result in their words.
end_job() {
    local ids
    while mapfile -t ids < <(pgrep -f -- "-o $folder/o.nc") && ((${#ids[@]} > 0)); do kill -9 "${ids[@]}" 2>/dev/null || true; done
}
clean() {
    end_job
    if [[ $failed == true ]]; then echo "kills.sh: $folder is kept"; else rm -rf "$folder"; fi
}
trap clean EXIT
fail() {
    failed=true
    stop "$1"
}

cat >s.toml <<'SCENE'
schema = 1
title = "Killed and resumed"
[friction]
[study]
members = 400
duration = "0.1 s"
samples = 4
quantities = ["energy_residual", "mode_time"]
[study.vary]
"initial.y" = { dist = "unif", low = "-0.09 mm", high = "0.09 mm" }
SCENE
hash_of() { "$program" info "$1" | sed -n 's/^payload  *\([0-9a-f]*\): matches the data$/\1/p'; }

isas=()
for isa in scalar avx2 avx512 neon; do
    "$program" check s.toml --isa $isa >/dev/null 2>&1 && isas+=("$isa")
done
((${#isas[@]} > 0)) || stop "the program has no instruction set for this machine"
# Whether its ranks share a run, the run tells.
rank_counts=(1)
if command -v mpiexec >/dev/null && mpiexec --oversubscribe -n 2 "$program" run s.toml -o ranks.nc --quiet --set study.members=2 2>err; then
    rank_counts+=(2)
fi
"$program" run s.toml -o whole.nc --quiet --isa "${isas[0]}" || fail "the undisturbed run failed"
expected=$(hash_of whole.nc)
[[ -n $expected ]] || fail "the undisturbed run has no hash"
echo "kills.sh: $kills kills, seed $seed, instruction sets ${isas[*]}, ranks ${rank_counts[*]}; undisturbed hash $expected"

RANDOM=$seed
export OMPI_MCA_hwloc_base_binding_policy=none
start=$(date +%s) done=0 resumes=0 studies=0 lives=0 longest=800  # [ms] lives are shorter
declare -A killed_with=()
# One run, killed after `life` ms unless it has ended; sets `code`.
run_once() {
    local life=$1
    shift
    # The shell within says to nobody that its program was killed.
    { "$@" >out 2>err || exit $?; } 2>/dev/null &
    local job=$!
    if [[ $life != none ]]; then
        sleep "$(printf '%d.%03d' $((life / 1000)) $((life % 1000)))"
        end_job
    fi
    code=0
    wait "$job" 2>/dev/null || code=$?
}
compare() {
    local hash
    hash=$(hash_of o.nc)
    [[ $hash == "$expected" ]] || fail "study $studies after $done kills: the hash is '$hash', not $expected"
    rm o.nc
    local left
    left=$(find . -name 'o.nc*')
    [[ -z $left ]] || fail "study $studies after $done kills: there is still $left"
    studies=$((studies + 1))
}
while :; do
    isa=${isas[RANDOM % ${#isas[@]}]} ranks=${rank_counts[RANDOM % ${#rank_counts[@]}]} threads=$((1 + RANDOM % 2))
    life=$((RANDOM % longest))
    command=("$program" run s.toml -o "$folder/o.nc" --no-progress --isa "$isa" --threads "$threads" --block-members 4)
    [[ ! -d o.nc.shards ]] || {
        command+=(--resume)
        resumes=$((resumes + 1))
    }
    ((ranks == 1)) || command=(mpiexec --oversubscribe -n "$ranks" "${command[@]}")
    ((done < kills)) || life=none
    run_once "$life" "${command[@]}"
    lives=$((lives + 1))
    if ((code == 137)); then
        done=$((done + 1))
        killed_with["$isa, $ranks ranks, $threads threads"]=$((${killed_with["$isa, $ranks ranks, $threads threads"]:-0} + 1))
        # Killed between the result and its folder's end: the study is done, and a resume clears the rest.  Killed after that, while it
        # ended: the study is done, too.
        [[ ! -f o.nc || -d o.nc.shards ]] || compare
        continue
    fi
    ((code == 0)) || fail "study $studies after $done kills ended with code $code: $(cat err)"
    compare
    ((done < kills)) || break
done
for key in "${!killed_with[@]}"; do echo "killed ${killed_with[$key]} with $key"; done | sort
echo "kills.sh: $done kills, $resumes resumes, $studies studies with the hash $expected, $(($(date +%s) - start)) s"
