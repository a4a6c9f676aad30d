#!/usr/bin/env bash
# Compares what the hot paths cost on one instruction set with the record beside this script: right-hand sides exactly, instructions within 3 %.
# Exit code 77, with the reason, where the record has no rows of that set, or this machine does not run it.  A change that is meant goes into the
# record with --record, and its reason into docs/evidence/performance.md.
# Usage: tests/costs/check.sh PROGRAM COMPILER ISA [--record]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
program=$1 compiler=$2 isa=$3 mode=${4:-}
record=$here/record.txt
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

skip() { echo "skipped: $1" && exit 77; }
head="# Of tests/costs/check.sh.  Instructions are those of: "
grep -q "^$isa " "$record" || [[ $mode == --record ]] || skip "the record has no rows of the instruction set $isa"

valgrind --tool=callgrind --callgrind-out-file="$work/out" "$program" "$isa" >"$work/evaluations" 2>"$work/log" ||
    { cat "$work/log" && exit 1; }
[[ -s $work/evaluations ]] || skip "$isa does not run here"
{
    cat "$work/evaluations"
    for file in "$work"/out.*; do
        sed -n 's/^desc: Trigger: Client Request: //p; s/^totals: //p' "$file" | paste -sd' ' -
    done | awk 'NF == 3 { print $1, $2, "instructions", $3 }'
} | sort >"$work/found"
grep -q instructions "$work/found" || { echo "no instructions were counted" && cat "$work/log" && exit 1; }

if [[ $mode == --record ]]; then
    { echo "$head$compiler" && { grep -v -e '^#' -e "^$isa " "$record" || true; } | cat - "$work/found" | sort; } >"$work/record"
    cp "$work/record" "$record"
    exit 0
fi
same_compiler=$(grep -cF "$head$compiler" "$record" || true)
awk -v count="$same_compiler" -v isa="$isa" '
    /^#/ { next }
    FNR == NR { if ($1 == isa) wanted[$1 " " $2 " " $3] = $4; next }
    { found[$1 " " $2 " " $3] = $4 }
    END {
        for (key in wanted) {
            counts = key ~ / instructions$/
            if (counts && !count) continue
            if (!(key in found)) { print key ": missing"; bad = 1; continue }
            allowed = counts ? 0.03 * wanted[key] : 0
            off = found[key] - wanted[key]
            printf "%s: %d of %d (%+.2f %%)\n", key, found[key], wanted[key], 100 * off / wanted[key]
            if (off > allowed || -off > allowed) { print "  beyond what is allowed: " allowed; bad = 1 }
        }
        for (key in found) if (!(key in wanted)) { print key ": " found[key] ", and the record does not have it"; bad = 1 }
        exit bad
    }' "$record" "$work/found"
((same_compiler > 0)) || echo "instructions were not compared: the record is of another compiler than $compiler"
