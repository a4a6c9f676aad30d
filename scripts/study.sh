#!/usr/bin/env bash
# A worked study: which fit for the crosshead of a pump, which tolerance to tighten, what being wrong costs; rigid and compliant contacts side by side.
# Usage: scripts/study.sh [OUTDIR [--quick]]; OUTDIR: build/study; `docs` writes docs/study.md again.  Under five minutes.
# Builds first if SLIDEWAY_PROGRAM does not name a built program.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
exec env SLIDEWAY_STUDY=study bash "$root/scripts/reproduce.sh" "${1:-$root/build/study}" "${@:2}"
