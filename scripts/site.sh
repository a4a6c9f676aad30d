#!/usr/bin/env bash
# The documentation as a site that is read from files, without a server or a network: pages of docs/, README.md and the Python reference.
# Usage: scripts/site.sh [OUTDIR]; OUTDIR: build/site.  Ends with an error where a link or an anchor leads nowhere.
# What makes the site is in an environment of its own, build/site_environment; making that takes a package index, using it does not.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
output=$(realpath -m "${1:-$root/build/site}")
cd "$root"

stop() {
    echo "site.sh: $1" >&2
    exit 1
}

command -v python3 >/dev/null || stop "no python3; install it (Debian: python3 python3-venv python3-pip)"
[[ ! -e $output || -f $output/index.html || -z $(ls -A "$output") ]] ||
    stop "$output is there and no site; give another folder"
[[ ! -e $output.part ]] || stop "$output.part is there; remove it"
environment=$root/build/site_environment
stamp=$environment/requirements.txt
needs="mkdocs>=1.6,<2 mkdocs-material>=9.6,<10 mkdocstrings[python]>=1,<2"
mkdir -p build
exec 9>build/site.lock
flock 9
if [[ $(cat "$stamp" 2>/dev/null) != "$needs" ]]; then
    rm -rf "$environment"
    python3 -m venv "$environment" || stop "python3 -m venv failed; install it (Debian: python3-venv)"
    # shellcheck disable=SC2086
    "$environment/bin/python" -m pip --disable-pip-version-check --quiet install $needs || stop "pip could not install mkdocs (see above)"
    echo "$needs" >"$stamp"
fi
PYTHONDONTWRITEBYTECODE=1 NO_MKDOCS_2_WARNING=1 "$environment/bin/mkdocs" build --strict \
    --config-file scripts/site/mkdocs.yml --site-dir "$output.part" 2>&1 | sed '/^INFO/d' >&2 || {  # --quiet would let warnings pass
    rm -rf "$output.part"
    stop "the site was not made, one made before is as it was (see above)"
}
rm -f "$output.part/404.html"  # of a server; its links would lead nowhere
rm -rf "$output"
mv "$output.part" "$output"
echo "site         $output/index.html"
