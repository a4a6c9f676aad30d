#!/usr/bin/env bash
# The clearances of Fig. 17 of Qian et al. (2020) under every contact law: largest Lyapunov exponents and energy audit from perturbed
# starts, as docs/chaos.md tells them.  Usage: scripts/chaos_table.sh [FOLDER [MEMBERS [THREADS]]]; a few minutes on two cores.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=${1:-$root/demo/chaos}
members=${2:-128}
threads=${3:-$(nproc)}
slideway=$root/build/release/bin/slideway
[[ -x $slideway ]] || {
    echo "chaos_table.sh: no $slideway; run scripts/test.sh or scripts/demo.sh first" >&2
    exit 2
}
mkdir -p "$folder"
for clearance in 0.08 0.1 0.3 0.5; do
    for law in paper conservative kelvin_voigt; do
        echo
        echo "== $clearance mm, $law"
        "$slideway" run "$root/scenes/lyapunov_0.1mm.toml" --quiet --threads "$threads" \
            --set "joint.clearance=$clearance mm" --set "contact.law=$law" --set "study.members=$members" \
            --set study.revolutions=4 --set 'study.quantities=["energy_residual","crank_work","mode_time"]' \
            -o "$folder/exponents_${clearance}mm_$law.nc"
    done
done
