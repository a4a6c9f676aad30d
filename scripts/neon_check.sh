#!/usr/bin/env bash
# The kernels on 64-bit ARM, without one: cross-built with Debian's compiler and run under qemu-user.  NEON and scalar give each other's
# bits (the kernels' parity tests), and those of the program of this machine: the functions of kernels/math, and the hashes of small studies.
# Usage: scripts/neon_check.sh [--no-install] [BUILD].  BUILD: the build of this machine to compare with, build/release if not given; it
# needs the targets slideway and parity_tests.  Some minutes the first time.
#
# Installs the compiler and qemu where they are missing, unless told not to, and unpacks the libraries for ARM into build/neon/sysroot,
# where they touch nothing.  Exit code 0 when all agree, and where something is missing that it may not or cannot install: the last line
# then is `skipped: ` and what.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
exec </dev/null

install=true
if [[ ${1:-} == --no-install ]]; then
    install=false
    shift
fi
here=${1:-build/release}
build=$root/build/neon
sysroot=$build/sysroot
jobs=${SLIDEWAY_JOBS:-$(nproc)}
# The libraries of scripts/setup.sh that the program and its tests are made of.
libraries=(libeigen3-dev libnanoflann-dev libxsimd-dev libboost-dev librandom123-dev libfmt-dev libcli11-dev libtomlplusplus-dev nlohmann-json3-dev
    libudunits2-dev libnetcdf-dev libgtest-dev libgomp1)

skip() {
    echo "skipped: $1"
    exit 0
}
stop() {
    echo "neon_check.sh: $1"
    exit 1
}

missing=()
command -v aarch64-linux-gnu-g++ >/dev/null || missing+=(g++-aarch64-linux-gnu)
command -v qemu-aarch64 >/dev/null || command -v qemu-aarch64-static >/dev/null || missing+=(qemu-user)
if ((${#missing[@]} > 0)); then
    [[ $install == true ]] || skip "no ${missing[*]}; run scripts/neon_check.sh, which installs them"
    as_root=()
    ((EUID == 0)) || as_root=(sudo -n)
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" ||
        skip "${missing[*]} could not be installed"
fi
qemu=$(command -v qemu-aarch64 || command -v qemu-aarch64-static)
[[ -x $here/bin/slideway && -x $here/bin/parity_tests ]] || stop "no slideway and parity_tests in $here/bin to compare with"

# The packages of another architecture with what they need, by the system's sources: lists, state and archives of their own.
unpack_libraries() {
    local apt=$build/apt
    rm -rf "$sysroot"
    mkdir -p "$sysroot" "$apt"/{lists,archives}/partial
    : >"$apt/status"
    local options=(-qq -o APT::Architecture=arm64 -o APT::Architectures::=arm64 -o Dir::State::lists="$apt/lists"
        -o Dir::State::status="$apt/status" -o Dir::Cache::archives="$apt/archives" -o Dir::Cache::pkgcache=
        -o Dir::Cache::srcpkgcache= -o APT::Sandbox::User="$(id -un)" -o Debug::NoLocking=true)
    apt-get "${options[@]}" update || echo "neon_check.sh: apt-get update failed" >&2
    apt-get "${options[@]}" install --download-only --no-install-recommends -y "${libraries[@]}" >/dev/null || return 1
    local package
    for package in "$apt"/archives/*.deb; do dpkg-deb -x "$package" "$sysroot"; done
    # Links from / are meant from the sysroot.
    local link target
    while IFS= read -r link; do
        target=$sysroot$(readlink "$link")
        [[ ! -e $target ]] || ln -sfn "$(realpath --relative-to="$(dirname "$link")" "$target")" "$link"
    done < <(find "$sysroot" -type l -lname '/*')
    echo "${libraries[*]}" >"$sysroot.of"
}
if [[ $(cat "$sysroot.of" 2>/dev/null) != "${libraries[*]}" ]]; then
    [[ $install == true ]] || skip "no libraries for ARM; run scripts/neon_check.sh, which fetches them"
    unpack_libraries || skip "the libraries for ARM could not be fetched"
fi

cmake -S . -B "$build" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$root/cmake/aarch64.cmake" -DSLIDEWAY_SYSROOT="$sysroot" \
    -DCMAKE_BUILD_TYPE=Release -DSLIDEWAY_CUDA=OFF -DSLIDEWAY_MPI=OFF -DSLIDEWAY_BENCH=OFF --log-level=WARNING ||
    stop "the configuration failed"
cmake --build "$build" --parallel "$jobs" --target slideway parity_tests || stop "the build failed"

on_arm() { "$qemu" -L "$sysroot" "$@"; }
failures=0
say() { printf '%-50s %s\n' "$1" "$2"; }
compare() {
    if [[ -n $2 && $2 == "$3" ]]; then
        say "$1" "$2, the same"
    else
        say "$1" "'$3' on ARM, '$2' here"
        failures=$((failures + 1))
    fi
}

# The kernels' functions one by one, equal steps, and the engine with members of all parts; without those that take long under emulation.
echo "== parity tests on ARM"
on_arm "$build/bin/parity_tests" --gtest_brief=1 \
    --gtest_filter='*/MathParity.*:*/LinearisationParity.GivesTheBits*:*/FixedStepParity.*:*/TwinParity.*:*EveryIsa*' ||
    failures=$((failures + 1))

echo "== bits of the mathematical functions"
bits_of() { "$@" --gtest_filter='*TellsItsBits*' | sed -n 's/^bits of //p'; }
expected=$(bits_of "$here/bin/parity_tests")
while read -r isa name bits; do
    compare "$name, $isa" "$(awk -v name="$name" '$1 == "scalar" && $2 == name { print $3 }' <<<"$expected")" "$bits"
done < <(bits_of on_arm "$build/bin/parity_tests")

echo "== hashes of small studies"
results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT
hash_of() { "$here/bin/slideway" info "$1" | sed -n 's/^payload  *\([0-9a-f]*\): matches the data$/\1/p'; }
study() {
    local name=$1 scene=$2 isa
    shift 2
    "$here/bin/slideway" run "scenes/$scene" --quiet -o "$results/here.nc" "$@" >/dev/null || stop "$name: the run failed"
    for isa in neon scalar; do
        on_arm "$build/bin/slideway" run "scenes/$scene" --quiet --isa $isa --force -o "$results/arm.nc" "$@" >/dev/null ||
            stop "$name: the run on ARM failed"
        compare "$name, $isa" "$(hash_of "$results/here.nc")" "$(hash_of "$results/arm.nc")"
    done
    rm "$results"/*.nc
}
# Long enough that all touch the way: the hashes of the two laws differ.
few=(--set study.members=24 --set 'study.duration=20 ms')
study "conservative law" ensemble_starts.toml "${few[@]}" --set contact.law=conservative
study "law of the paper" ensemble_starts.toml "${few[@]}" --set contact.law=paper
study "tolerances, drawn from their distributions" tolerance_0.1mm.toml --set study.base=4 --set 'study.duration=1 ms'
study "planar mechanism" planar_flores.toml --set 'study.duration=20 ms'

((failures == 0)) || stop "$failures differences"
echo "neon_check.sh: ARM has the bits of this machine"
