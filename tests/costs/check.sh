#!/usr/bin/env bash
# Compares what the hot paths cost with the record beside this script: right-hand sides exactly, instructions within 3 %.  A change that is
# meant goes into the record with --record, and its reason into docs/performance.md.
# Usage: tests/costs/check.sh PROGRAM COMPILER [--record]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
program=$1 compiler=$2 mode=${3:-}
record=$here/record.txt
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

valgrind --tool=callgrind --callgrind-out-file="$work/out" "$program" >"$work/evaluations" 2>"$work/log" ||
    { cat "$work/log" && exit 1; }
{
    cat "$work/evaluations"
    for file in "$work"/out.*; do
        sed -n 's/^desc: Trigger: Client Request: //p; s/^totals: //p' "$file" | paste -sd' ' -
    done | awk 'NF == 3 { print $1, $2, "instructions", $3 }'
} | sort >"$work/found"
grep -q instructions "$work/found" || { echo "no instructions were counted" && cat "$work/log" && exit 1; }

if [[ $mode == --record ]]; then
    { echo "# Of tests/costs/check.sh.  Instructions are those of: $compiler" && cat "$work/found"; } >"$record"
    exit 0
fi
same_compiler=$(grep -cF "those of: $compiler" "$record" || true)
awk -v count="$same_compiler" '
    /^#/ { next }
    FNR == NR { wanted[$1 " " $2 " " $3] = $4; next }
    $3 == "instructions" && !count { next }
    {
        key = $1 " " $2 " " $3
        if (!(key in wanted)) { print key ": " $4 ", and the record does not have it"; bad = 1; next }
        allowed = $3 == "instructions" ? 0.03 * wanted[key] : 0
        ratio = $4 / wanted[key]
        printf "%s: %d of %d (%+.2f %%)\n", key, $4, wanted[key], 100 * (ratio - 1)
        if ($4 - wanted[key] > allowed || wanted[key] - $4 > allowed) { print "  beyond what is allowed: " allowed; bad = 1 }
        ++compared
    }
    END { if (!compared) { print "nothing was compared"; bad = 1 } exit bad }' "$record" "$work/found"
((same_compiler > 0)) || echo "instructions were not compared: the record is of another compiler than $compiler"
