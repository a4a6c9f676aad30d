#!/usr/bin/env bash
# Installs the Debian 12 packages that slideway's build and tests need, only those that are missing.
# Usage: scripts/setup.sh [tests|nightly|python|clang].  With `tests` also what the Python package and the costs are tested with; with `nightly` besides
# what slow tests compare with and open pages in;
# with `python` what scripts/reproduce.sh makes its Python environment of; with `clang` what fuzz.sh, sanitize.sh and tidy.sh build with.
# Run by scripts/test.sh, scripts/demo.sh and scripts/reproduce.sh; needs root or sudo only when something is missing.
set -euo pipefail

packages=(
    build-essential cmake ninja-build pkg-config git
    libeigen3-dev libnanoflann-dev libxsimd-dev libboost-dev librandom123-dev libfmt-dev
    libcli11-dev libtomlplusplus-dev nlohmann-json3-dev libudunits2-dev libnetcdf-dev
    libgtest-dev libbenchmark-dev
    libopenmpi-dev openmpi-bin
)
python=(python3 python3-dev python3-pip python3-venv)
[[ ${1:-} == tests || ${1:-} == nightly ]] && packages+=("${python[@]}" valgrind)
[[ ${1:-} == nightly ]] && packages+=(libopenturns-dev chromium)
[[ ${1:-} == python ]] && packages+=("${python[@]}")
[[ ${1:-} == clang ]] && packages+=(clang-14 clang-tidy-14 libclang-rt-14-dev libomp-14-dev)

fail() {
    echo "setup.sh: $*" >&2
    exit 1
}

is_installed() {
    dpkg-query -W -f='${db:Status-Status}\n' "$1" 2>/dev/null | grep -qx installed
}

# Never asks for a password where nobody could type one.
can_use_sudo() {
    command -v sudo >/dev/null || return 1
    sudo -n true 2>/dev/null && return 0
    [[ ${CI:-false} != true && -t 0 && -t 2 ]] && sudo true
}

if ! command -v dpkg-query >/dev/null; then
    echo "setup.sh: not a Debian system; these packages' equivalents are needed: ${packages[*]}" >&2
    exit 0
fi

missing=()
for package in "${packages[@]}"; do
    is_installed "$package" || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
    exit 0
fi

as_root=()
if ((EUID != 0)); then
    can_use_sudo || fail "needs root or sudo; run as root: apt-get install -y ${missing[*]}"
    as_root=(sudo)
fi
apt_get() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 "$@" </dev/null
}

echo "setup.sh: installing ${missing[*]}"
apt_get update -qq || echo "setup.sh: apt-get update failed; trying with the package lists at hand" >&2
apt_get install -y -qq --no-install-recommends "${missing[@]}" || fail "apt-get install failed (see above)"
