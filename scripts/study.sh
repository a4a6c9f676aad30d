#!/usr/bin/env bash
# Worked studies: which fit for the crosshead of a pump and which tolerance to tighten, on a new way and a worn one; a press; a carriage.
# Usage: scripts/study.sh [OUTDIR [--quick]]; OUTDIR: build/study; `docs` writes docs/tutorial/study.md again.  Seven minutes on two cores of a Zen 3.
# Builds first if SLIDEWAY_PROGRAM does not name a built program.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
exec env SLIDEWAY_STUDY=study bash "$root/scripts/reproduce.sh" "${1:-$root/build/study}" "${@:2}"
