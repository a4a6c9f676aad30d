#!/usr/bin/env bash
# Makes a Python environment with the package of this repository and what its tests need, build/python, and prints its path.
# It is made anew when what the package needs has changed; making it takes a package index, using it does not.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"

stop() {
    echo "python_environment.sh: $1" >&2
    exit 1
}

command -v python3 >/dev/null || stop "no python3; install it (Debian: python3 python3-venv python3-pip)"
environment=$root/build/python
stamp=$environment/requirements.txt
pip=("$environment/bin/python" -m pip --disable-pip-version-check --quiet)
mkdir -p build
# One at a time: several scripts share the environment.
exec 9>build/python.lock
flock 9
needs=$(python3 --version && cat python/pyproject.toml)
package=$(find python/slideway python/pyproject.toml -type f -not -name '*.pyc' -print0 | sort -z | xargs -0 sha256sum | sha256sum)
if [[ $(cat "$stamp" 2>/dev/null) != "$needs" ]]; then
    rm -rf "$environment"
    python3 -m venv "$environment" >&2 || stop "python3 -m venv failed; install it (Debian: python3-venv)"
    "${pip[@]}" install hatchling "./python[test]" >&2 || stop "pip could not install the package (see above)"
    echo "$needs" >"$stamp"
    echo "$package" >"$stamp.package"
elif [[ $(cat "$stamp.package" 2>/dev/null) != "$package" ]]; then
    # Only then: another script may be at work in it.
    "${pip[@]}" install --no-deps --no-build-isolation --force-reinstall ./python >&2 || stop "pip could not install the package (see above)"
    echo "$package" >"$stamp.package"
fi
echo "$environment"
