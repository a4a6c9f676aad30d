#!/usr/bin/env bash
# Members a second and core of rigid and compliant contacts beside one another (docs/evidence/rigid.md): the planar slider-crank, 0.1 mm, two turns, and the spatial
# one at rest and rattling; in turn, three times; medians.  Usage: scripts/rigid_rates.sh [PROGRAM].  A minute and a half.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
program=${1:-$root/build/release/bin/slideway}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
sed -e '/^law = /d' "$root/scenes/rigid_starts.toml" >"$folder/compliant.toml"
cp "$root/scenes/rigid_starts.toml" "$folder/rigid.toml"
cp "$root/scenes/slider_crank_rigid.toml" "$folder/spatial.toml"
rattling=(--set "joint.clearance=0.5 mm" --set "mechanism.crank_speed=47 rad/s")
compliant=(--set contact.law=conservative --set "friction.stick_speed=1 mm/s" --set "friction.slip_speed=10 mm/s")

# run NAME SCENE MEMBERS [--set KEY=VALUE]...: rate, right-hand sides of a member and largest residual, into NAME.txt.
run() {
    local name=$1 scene=$2 members=$3
    shift 3
    "$program" run "$folder/$scene.toml" --threads 1 --set "study.members=$members" "$@" -o "$folder/out.nc" --force --json 2>/dev/null |
        python3 -c '
import json, sys
told = json.load(sys.stdin)
run = told["run"]
q = next(q for q in told["quantities"] if q["name"] == "energy_residual")
print(run["members"] / run["seconds"], run["rhs_evaluations"] / run["members"], max(abs(q["min"]), abs(q["max"])))' >>"$folder/$name.txt"
}
for _ in 1 2 3; do
    run rigid rigid 4096
    run rigid_scalar rigid 4096 --isa scalar
    run compliant compliant 64
    run compliant_tight compliant 64 --set integrator.rtol=1e-8 --set integrator.atol=1e-8
    run spatial_rest spatial 256
    run spatial_rest_compliant spatial 256 "${compliant[@]}"
    run spatial_rattling spatial 256 "${rattling[@]}"
    run spatial_rattling_compliant spatial 256 "${rattling[@]}" "${compliant[@]}"
done
names=(rigid rigid_scalar compliant compliant_tight spatial_rest spatial_rest_compliant spatial_rattling spatial_rattling_compliant)
for name in "${names[@]}"; do
    sort -g "$folder/$name.txt" | sed -n 2p | sed "s/^/$name: /"
done
