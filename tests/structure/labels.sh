#!/usr/bin/env bash
# Whether ctest has suites for each label: of every law, and of every folder of the kernels that has more than plain data.
# Usage: tests/structure/labels.sh CTEST BUILD_FOLDER LABEL...
set -euo pipefail
ctest=$1 build=$2
shift 2
missing=0
for label in "$@"; do
    suites=$("$ctest" --test-dir "$build" -N -L "^$label\$" | sed -n 's/^Total Tests: //p')
    ((suites > 0)) || { echo "no suite has the label $label" && missing=1; }
done
exit "$missing"
