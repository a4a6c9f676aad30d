#!/usr/bin/env bash
# ptxas_report.sh OBJECT COMMAND...: compiles, and keeps what ptxas -v says of registers, stack and spills as OBJECT.ptxas.  All else
# that the compiler says is shown as ever.
set -uo pipefail
report=$1.ptxas
shift
said=$(mktemp)
trap 'rm -f "$said"' EXIT

code=0
rm -f "$report"
"$@" 2>"$said" || code=$?
awk -v report="$report" -v failed="$code" '
    /^ptxas info / || /^ +[0-9]+ bytes stack frame, / { if (!failed) print >report; next }
    { print }' "$said" >&2
exit "$code"
