#!/usr/bin/env bash
# The pictures of the documentation, each from a run: writes docs/pictures.  The same program and packages write the same files, but for the date in
# `report`, which needs chromium.
# Usage: scripts/pictures.sh [OUTDIR [names of pictures]]; OUTDIR: docs/pictures; names: all.
# Builds first if SLIDEWAY_PROGRAM does not name a built program.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
exec env SLIDEWAY_STUDY=pictures bash "$root/scripts/reproduce.sh" "${1:-$root/docs/pictures}" "${@:2}"
