#!/usr/bin/env bash
# The evidence behind docs/evidence/findings.md: which law makes energy, where, how much, and what the integration has to do with it, on one page.
# Usage: scripts/evidence.sh [OUTDIR [options of python -m evidence]]; OUTDIR: build/evidence; --quick: a minute, for the machinery alone.
# Builds first if SLIDEWAY_PROGRAM does not name a built program.  Stop it with Ctrl-C and start it again: it goes on where it was.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
exec env SLIDEWAY_STUDY=evidence bash "$root/scripts/reproduce.sh" "${1:-$root/build/evidence}" "${@:2}"
