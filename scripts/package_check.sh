#!/usr/bin/env bash
# Tries what scripts/package.sh made in bare roots of Debian 12 without compilers: each package installs and runs the first examples.  Projects
# that find_package(slideway) are built against the Debian package, unpacked on this machine.
# Usage: scripts/package_check.sh; needs root, mmdebstrap and the network; some minutes, most of them for the two roots.
# Exit code 0 when all went well, and where something is missing that it needs: the last line then is `skipped: ` and what.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
exec </dev/null

skip() {
    echo "skipped: $1"
    exit 0
}
stop() {
    echo "package_check.sh: $1" >&2
    exit 1
}
((EUID == 0)) || skip "only root can make a root"
command -v mmdebstrap >/dev/null || apt-get install -y -qq mmdebstrap >/dev/null || skip "no mmdebstrap"
wheel=$(ls build/package/*.whl) && deb=$(ls build/package/*.deb) || stop "no packages; run scripts/package.sh first"

bare=$(mktemp -d)
clean() {
    umount "$bare"/*/proc 2>/dev/null || true
    rm -rf --one-file-system "$bare"
}
trap clean EXIT
# With the sources of this machine, whichever they are.
mapfile -t sources < <(find /etc/apt/sources.list /etc/apt/sources.list.d -type f 2>/dev/null)
new_root() {
    cat "${sources[@]}" | mmdebstrap --quiet --variant=apt --include="$2" bookworm "$bare/$1" - || stop "mmdebstrap failed (see above)"
    # The loader finds what lies beside a program through /proc, which every machine has.
    mount -t proc proc "$bare/$1/proc" 2>/dev/null || mount --bind /proc "$bare/$1/proc" || skip "cannot mount /proc in a new root"
    cp /etc/resolv.conf "$bare/$1/etc/resolv.conf" 2>/dev/null || true
    cp -rL /etc/ssl/certs/. "$bare/$1/etc/ssl/certs/" 2>/dev/null || true
}
inside() { chroot "$bare/$1" /usr/bin/env -i PATH=/usr/local/bin:/usr/bin:/bin HOME=/tmp LC_ALL=C.UTF-8 bash -euc "$2"; }

new_root debian ca-certificates,man-db
cp "$deb" "$bare/debian/slideway.deb"
inside debian 'apt-get update -qq && apt-get install -y -qq --no-install-recommends /slideway.deb >/dev/null'
inside debian '! command -v g++ >/dev/null'
inside debian 'slideway run /usr/share/slideway/scenes/ensemble_starts.toml --set study.members=64 --set "study.duration=20 ms" --quiet -o /tmp/a.nc'
inside debian 'slideway info --check /tmp/a.nc'
inside debian 'test -s /usr/share/man/man1/slideway.1 && test -s /usr/share/bash-completion/completions/slideway'
payload() { sed -n 's/^payload  *\([0-9a-f]*\):.*/\1/p'; }
inside debian 'test -s /usr/share/doc/slideway/copyright && test -s /usr/share/doc/slideway/changelog.gz'
of_deb=$(inside debian 'slideway info /tmp/a.nc' | payload)
echo "Debian package: installed, ran, payload $of_deb"

# Its library and kernels, with the compilers of this machine.
dpkg -x "$deb" "$bare/installed"
bash tests/examples/run.sh cmake "$root" "$bare/installed/usr" "$bare/examples" || stop "the examples do not build against the Debian package (see above)"

# Its headers are all that a law of one's own is compiled with.
"$bare/installed/usr/bin/slideway" compile tests/extending/hunt_crossley.hpp -o "$bare/modules" >/dev/null || stop "the Debian package compiles no law (see above)"

new_root python ca-certificates,python3-minimal,python3-venv
for file in /etc/pip.conf "$HOME/.config/pip/pip.conf" "$HOME/.pip/pip.conf"; do
    [[ ! -f $file ]] || cp "$file" "$bare/python/etc/pip.conf"
done
cp "$wheel" "$bare/python/tmp/"
inside python 'cd /tmp && python3 -m venv v && ! command -v g++ >/dev/null'
SECONDS=0
inside python "cd /tmp && v/bin/pip install --quiet --disable-pip-version-check ./$(basename "$wheel")"
scene='$(ls -d v/lib/python3*/site-packages/slideway/scenes)/ensemble_starts.toml'
inside python "cd /tmp && v/bin/slideway run $scene --set study.members=64 --set 'study.duration=20 ms' --quiet -o a.nc"
seconds=$SECONDS
of_wheel=$(inside python 'cd /tmp && v/bin/slideway info a.nc' | payload)
echo "wheel: from pip install to the first result $seconds s, payload $of_wheel"
[[ -n $of_wheel && $of_wheel == "$of_deb" ]] || stop "the two packages have other numbers: $of_deb, $of_wheel"
inside python "cd /tmp && v/bin/python - <<'END'
import matplotlib
matplotlib.use('Agg')
import slideway
result = slideway.run(slideway.__path__[0] + '/scenes/ensemble_starts.toml', study__members=64, study__duration='20 ms', progress=False)
slideway.plot.quantiles(result, 'peak_normal_force').figure.savefig('a.png')
slideway.report.write(result, 'a.html')
print('Python:', result.sizes['member'], 'members, a plot and a page')
END"
echo "package_check.sh: both packages install and run without compilers"
