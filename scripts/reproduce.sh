#!/usr/bin/env bash
# Figs. 3-5, 11-15, 17 and 19 of Qian et al. (2020) under both contact laws: runs, figures, claims and verdicts on one page.
# Usage: scripts/reproduce.sh [OUTDIR [options of python -m reproduction]]; OUTDIR: build/reproduction.
# Builds first if SLIDEWAY_PROGRAM does not name a built program.  Stop it with Ctrl-C and start it again: it goes on where it was.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
study=${SLIDEWAY_STUDY:-reproduction}  # or evidence, by scripts/evidence.sh
mkdir -p "${1:-$root/build/$study}"
output=$(realpath "${1:-$root/build/$study}")
shift $(($# > 0))
cd "$root"

stop() {
    echo "$study: $1" >&2
    exit 1
}

if [[ -z ${SLIDEWAY_PROGRAM:-} ]]; then
    build=build/release
    bash scripts/setup.sh python || stop "the set-up failed (see above)"
    cmake --preset release --log-level=WARNING || stop "the configuration failed (see above)"
    cmake --build "$build" --parallel "$(nproc)" --target slideway || stop "the build failed (see above)"
    SLIDEWAY_PROGRAM=$root/$build/bin/slideway
fi
export SLIDEWAY_PROGRAM
[[ -x $SLIDEWAY_PROGRAM ]] || stop "SLIDEWAY_PROGRAM is $SLIDEWAY_PROGRAM, which is no program; unset it, or give the path of slideway"

environment=$(bash scripts/python_environment.sh) || stop "no Python environment (see above)"

SECONDS=0
code=0
unset PYTHONDONTWRITEBYTECODE
PYTHONPATH=$root/scripts PYTHONPYCACHEPREFIX=$root/build/pycache "$environment/bin/python" -m "$study" "$output" "$@" || code=$?
echo "time         $SECONDS s"
exit "$code"
