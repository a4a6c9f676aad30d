#!/usr/bin/env bash
# What `slideway check` says that the shipped scenes will take beside what `slideway run` takes, here and now.  Usage: scripts/cost_table.sh [SECONDS]: of scenes
# that are said to take no longer (120).  Exit code 1 where one is off by more than a factor of three; below half a second nothing is judged.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
slideway=${SLIDEWAY_PROGRAM:-$root/build/release/bin/slideway}
longest=${1:-120}
[[ -x $slideway ]] || {
    echo "cost_table.sh: no $slideway; run scripts/test.sh or scripts/demo.sh first" >&2
    exit 2
}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

number() { python3 -c 'import json, sys; value = json.load(open(sys.argv[1]))
for name in sys.argv[2].split("."): value = value.get(name, {}) if isinstance(value, dict) else {}
print(value if isinstance(value, (int, float)) else "nan")' "$1" "$2"; }

code=0
printf '%-32s %12s %12s %8s\n' scene "told [s]" "took [s]" ratio
for scene in "$root"/scenes/*.toml; do
    "$slideway" check "$scene" --json >"$folder/check.json"
    told=$(number "$folder/check.json" seconds.expected)
    if [[ $told == nan ]] || python3 -c "import sys; sys.exit(not $told > $longest)"; then
        printf '%-32s %12.3g %12s\n' "$(basename "$scene")" "$told" "not run"
        continue
    fi
    began=$(date +%s.%N)
    "$slideway" run "$scene" --quiet --force --max-failures 100% -o "$folder/out.nc" 2>/dev/null
    took=$(python3 -c "print($(date +%s.%N) - $began)")
    printf '%-32s %12.3g %12.3g %8.2f\n' "$(basename "$scene")" "$told" "$took" "$(python3 -c "print($told / $took)")"
    python3 -c "import sys; sys.exit($took > 0.5 and not 1 / 3 < $told / $took < 3)" || code=1
done
exit "$code"
