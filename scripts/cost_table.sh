#!/usr/bin/env bash
# The time and steps that `slideway check` predicts for the shipped scenes beside what `slideway run` takes on this machine.  Usage: scripts/cost_table.sh [SECONDS [THREADS]]:
# for scenes with a prediction up to SECONDS (120), on THREADS threads (1).  Exit code 1 where one is off by more than a factor of three; below half a second
# nothing is judged.  Steps are the same on every machine; seconds depend on its load.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
slideway=${SLIDEWAY_PROGRAM:-$root/build/release/bin/slideway}
longest=${1:-120} threads=${2:-1}
[[ -x $slideway ]] || {
    echo "cost_table.sh: no $slideway; run scripts/test.sh or scripts/demo.sh first" >&2
    exit 2
}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

code=0
printf '%-28s %10s %10s %8s %12s %12s %8s\n' scene "told [s]" "took [s]" ratio "told steps" "took steps" ratio
for scene in "$root"/scenes/*.toml; do
    python3 - "$slideway" "$scene" "$folder/out.nc" "$longest" "$threads" <<'EOF' || code=1
import json, os, subprocess, sys, time

slideway, scene, output, longest, threads = sys.argv[1:]


def values(command: str, *options: str) -> dict:
    words = [slideway, command, scene, "--json", "--threads", threads, *options]
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"cost_table.sh: {' '.join(words)}: {done.stderr.strip()}")
    return json.loads(done.stdout)


told = values("check")
seconds, steps = told["seconds"].get("expected"), told["steps"].get("expected")
row = os.path.basename(scene)[:-5].ljust(28)
if seconds is None:
    print(f"{row} not told")
    sys.exit(0)
if seconds > float(longest):
    print(f"{row} {seconds:10.3g} {'not run':>10} {'':8} {steps:12.3g}")
    sys.exit(0)
began = time.monotonic()
run = values("run", "--no-progress", "--force", "--max-failures", "100%", "-o", output)["run"]
took, walked = time.monotonic() - began, run["steps_accepted"] + run["steps_rejected"]
print(f"{row} {seconds:10.3g} {took:10.3g} {seconds / took:8.2f} {steps:12.3g} {walked:12.3g} {steps / walked:8.2f}", flush=True)
sys.exit(took > 0.5 and not 1 / 3 < seconds / took < 3)
EOF
done
exit "$code"
