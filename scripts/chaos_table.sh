#!/usr/bin/env bash
# The clearances of Fig. 17 of Qian et al. (2020) under the published and the conservative law, and 0.1 mm under undamped springs, at
# the apices and as a bed, with an eighth of the members, because their contacts vibrate long: largest Lyapunov exponents and energy
# audit from perturbed starts, the table of docs/evidence/chaos.md.  Usage: scripts/chaos_table.sh [FOLDER [MEMBERS [THREADS]]]; on two cores
# two minutes a row under the published law, a quarter of an hour at 0.1 mm under the conservative one and a minute elsewhere, two and
# nine minutes under the springs.
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

# exponents CLEARANCE LAW MEMBERS [RTOL], at a given tolerance without a check against tighter ones
exponents() {
    # What lies on its way takes an explicit method a hundred times as long: there 24, eight by each way, fill its lanes, and at one
    # clearance alone; the others have what a tenth of their work allows.
    local tolerance=()
    [[ $2 != paper ]] || tolerance=(--set "study.verify=$3")
    [[ $2 == paper || $1 != 0.1 ]] || tolerance=(--set study.verify=24)
    [[ $# -lt 4 ]] || tolerance=(--set study.verify=0 --set "integrator.rtol=$4")
    echo
    echo "== $1 mm, $2${4:+ at rtol $4}"
    "$slideway" run "$root/scenes/lyapunov_0.1mm.toml" --no-progress --force --threads "$threads" \
        --set "joint.clearance=$1 mm" --set "contact.law=$2" --set "study.members=$3" \
        --set study.revolutions=4 "${tolerance[@]}" --set 'study.quantities=["energy_residual","drive_work","mode_time"]' \
        -o "$folder/exponents_$1mm_$2${4:+_$4}.nc"
}
for clearance in 0.08 0.1 0.3 0.5; do
    for law in paper conservative; do exponents "$clearance" "$law" "$members"; done
done
for law in kelvin_voigt foundation; do exponents 0.1 "$law" $(((members + 7) / 8)); done
exponents 0.1 foundation $(((members + 7) / 8)) 1e-8
