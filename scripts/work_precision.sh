#!/usr/bin/env bash
# Builds and runs the work-precision benchmark, with SUNDIALS CVODE among the peers.
# Usage: scripts/work_precision.sh [arguments of work_precision], e.g. --quick.  Results: bench/results/.
#
# Debian 12 builds its SUNDIALS without optimisation (debian/rules sets CMAKE_C_FLAGS, which replaces -O2), and CVODE's
# own work then takes twice as long.  The comparison should be with CVODE at its best, so the same source is built here
# with the peers' flags; where it cannot be fetched, Debian's library is taken and the tables say so.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"

build=build/release
sundials=build/sundials
flags="-O3 -mavx2 -mfma"

as_root=()
((EUID == 0)) || as_root=(sudo)

# The system's package sources with source packages in place of binary ones, in a folder of their own.
fetch_sundials() {
    mkdir -p "$sundials"/{sources,lists/partial}
    find /etc/apt -name '*.sources' -exec sed -s -e 's/^Types:.*/Types: deb-src/' -e '$s/$/\n/' {} + >"$sundials/sources/source.sources"
    find /etc/apt -name '*.list' -exec sed -n 's/^deb /deb-src /p' {} + >"$sundials/sources/source.list"
    local options=(-o Dir::Etc::sourcelist=/dev/null -o "Dir::Etc::sourceparts=$root/$sundials/sources"
        -o "Dir::State::lists=$root/$sundials/lists" -o APT::Sandbox::User="$(id -un)")
    (cd "$sundials" && apt-get -qq "${options[@]}" update && apt-get -qq "${options[@]}" source --download-only sundials) &&
        mkdir -p "$sundials/source" && tar -xf "$sundials"/sundials_*.orig.tar.* -C "$sundials/source" --strip-components=1
}

build_sundials() {
    cmake -S "$sundials/source" -B "$sundials/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS="$flags" \
        -DBUILD_ARKODE=OFF -DBUILD_CVODE=OFF -DBUILD_IDA=OFF -DBUILD_IDAS=OFF -DBUILD_KINSOL=OFF -DBUILD_SHARED_LIBS=OFF \
        -DEXAMPLES_ENABLE_C=OFF -DEXAMPLES_INSTALL=OFF -DCMAKE_INSTALL_PREFIX="$root/$sundials/install" \
        -DCMAKE_INSTALL_LIBDIR=lib >"$sundials/configure.log" 2>&1 &&
        cmake --build "$sundials/build" --target install >"$sundials/build.log"
}

bash scripts/setup.sh
if [[ -d $sundials/install ]] || { fetch_sundials && build_sundials; }; then
    cvode=(-DSUNDIALS_DIR="$root/$sundials/install/lib/cmake/sundials" -DSLIDEWAY_CVODE_BUILD="built with $flags")
else
    echo "work_precision.sh: no source of SUNDIALS; taking Debian's library, which is built without optimisation" >&2
    dpkg-query -W libsundials-dev >/dev/null 2>&1 ||
        "${as_root[@]}" apt-get install -y -qq --no-install-recommends libsundials-dev
    cvode=(-USUNDIALS_DIR -DSLIDEWAY_CVODE_BUILD="Debian's library, built without optimisation")
fi

cmake --preset release --log-level=WARNING "${cvode[@]}"
cmake --build "$build" --parallel "$(nproc)" --target work_precision
mkdir -p bench/results
"$build/bin/work_precision" --output bench/results "$@"
