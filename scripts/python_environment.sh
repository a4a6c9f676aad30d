#!/usr/bin/env bash
# Makes a Python environment with the package of this repository and what its tests need, build/python, and prints its path.  The package is
# a wheel that is made of a build of the program, so that nothing is compiled twice.
# Usage: scripts/python_environment.sh [BUILD | --without-package].  BUILD: build/release if not given.
# The environment is made anew when what the package needs has changed; making it takes a package index, using it does not.
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
needs=$(python3 --version && sed -n '/^\[build-system\]/,/^\[tool/p' pyproject.toml)
if [[ $(cat "$stamp" 2>/dev/null) != "$needs" ]]; then
    rm -rf "$environment"
    python3 -m venv "$environment" >&2 || stop "python3 -m venv failed; install it (Debian: python3-venv)"
    "${pip[@]}" install tomli >&2 || stop "pip could not install what the package needs (see above)"
    "$environment/bin/python" - <<'END' >"$environment/needs.txt"
import tomli
with open("pyproject.toml", "rb") as file:
    project = tomli.load(file)
print(*project["build-system"]["requires"], *project["project"]["dependencies"], *project["project"]["optional-dependencies"]["test"], sep="\n")
END
    # What is imported is compiled when it is, which is a part of it.
    "${pip[@]}" install --no-compile -r "$environment/needs.txt" >&2 || stop "pip could not install what the package needs (see above)"
    # What all tests import is compiled once, not by each of those that begin at the same time (python_tests.sh has the folder).
    env -u PYTHONDONTWRITEBYTECODE PYTHONPYCACHEPREFIX="$root/build/pycache" "$environment/bin/python" -c \
        'import matplotlib.pyplot, netCDF4, numpy.testing, pandas, pytest, scipy.stats, xarray' >&2 ||
        stop "what the package needs cannot be imported (see above)"
    echo "$needs" >"$stamp"
fi
if [[ ${1:-} != --without-package ]]; then
    build=${1:-build/release}
    # Of a build whose module nobody made yet there is none to find.
    package=$({ find python/slideway python/native pyproject.toml "$build"/bin/slideway "$build"/bin/kernels/*.so "$build"/python/_native*.so -type f -not -name '*.pyc' -print0 2>/dev/null || true; } |
        sort -z | xargs -0 sha256sum | sha256sum)
    if [[ $(cat "$stamp.package" 2>/dev/null) != "$package" ]]; then
        # Only then: another script may be at work in it.
        rm -rf build/wheel
        "${pip[@]}" wheel --no-deps --no-build-isolation -C build-dir="$build" -w build/wheel . >&2 || stop "pip could not make the wheel (see above)"
        "${pip[@]}" install --no-compile --no-deps --force-reinstall build/wheel/*.whl >&2 || stop "pip could not install the package (see above)"
        echo "$package" >"$stamp.package"
    fi
fi
echo "$environment"
