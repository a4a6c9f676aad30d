#!/usr/bin/env bash
# The remaining time that `slideway run` predicts at 10, 25 and 50 % of its time beside the true one, for shipped scenes at sizes of some ten seconds to a
# minute; takes a few minutes.  Usage: scripts/eta_table.sh [--processor] [THREADS] (1).  --processor: for a loaded machine, in processor time; the
# prediction is scaled by the share of the processor so far.  Exit code 1 where the prediction at 10 % is off by more than 30 %.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
slideway=${SLIDEWAY_PROGRAM:-$root/build/release/bin/slideway}
[[ -x $slideway ]] || {
    echo "eta_table.sh: no $slideway; run scripts/test.sh or scripts/demo.sh first" >&2
    exit 2
}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# study SCENE [KEY=VALUE]...: a row.  The program sees a terminal, where its line comes four times a second.
study() {
    local scene=$1
    shift
    python3 - "$clock" "$folder" "$*" "$slideway" run "$root/scenes/$scene" -o "$folder/out.nc" --force --threads "$threads" "${@/#/--set=}" <<'EOF'
import os, pty, re, subprocess, sys, time

clock, folder, changes, command = sys.argv[1], sys.argv[2], sys.argv[3], sys.argv[4:]
terminal, theirs = pty.openpty()
began = time.monotonic()
with open(os.path.join(folder, "out.txt"), "w") as out:
    program = subprocess.Popen(command, stdout=out, stderr=theirs)
os.close(theirs)
told, text = [], ""  # [(seconds, seconds left)]


def processor_time() -> float:
    """Of the program so far."""
    with open(f"/proc/{program.pid}/stat") as stat:
        ticks = stat.read().rsplit(")", 1)[1].split()[11:13]
    return sum(map(int, ticks)) / os.sysconf("SC_CLK_TCK")


while True:
    try:
        piece = os.read(terminal, 4096)
    except OSError:  # the other end is closed
        break
    now = time.monotonic() - began
    *lines, text = (text + piece.decode()).replace("\r", "\n").replace("\x1b[K", "\n").split("\n")
    for line in lines:
        if found := re.search(r"ETA ([\d:]+)", line):
            left = 0
            for part in found[1].split(":"):
                left = 60 * left + int(part)
            used = processor_time() if clock == "processor" else now
            told.append((used, left * used / now))
_, status, usage = os.wait4(program.pid, 0)
if status != 0:
    sys.exit(f"eta_table.sh: {' '.join(command)} failed")
end = usage.ru_utime + usage.ru_stime if clock == "processor" else time.monotonic() - began
row, first = f"{os.path.basename(command[2])[:-5]} {changes}"[:62].ljust(62) + f"{end:8.1f}", None
for share in (0.10, 0.25, 0.50):
    heard = [(at, left) for at, left in told if at <= share * end]
    if not heard:
        row += "        --       "
        continue
    at, left = heard[-1]
    off = left / (end - at) - 1
    first = off if first is None and share == 0.10 else first
    row += f"{left:6.0f} ({100 * off:+4.0f} %)"
print(row)
sys.exit(0 if first is not None and abs(first) <= 0.3 else 1)
EOF
}

clock=wall
if [[ ${1:-} == --processor ]]; then
    clock=processor
    shift
fi
threads=${1:-1}
code=0
printf '%-62s%8s%15s%15s%15s\n' "scene and changes" "took [s]" "told at 10 %" "25 %" "50 %"
study ensemble_starts.toml study.members=8192 || code=1
study tolerance_0.1mm.toml study.base=128 || code=1
study lyapunov_0.1mm.toml study.members=64 study.transient_revolutions=1 study.revolutions=3 || code=1
study sweep_clearance.toml study.points=12 study.transient_revolutions=2 study.revolutions=8 || code=1
study poincare_0.1mm.toml study.revolutions=80 || code=1
study slider_crank_0.1mm.toml study.revolutions=80 || code=1
study ensemble_starts.toml contact.law=conservative study.members=128 study.duration=0.5 || code=1
exit "$code"
