#!/usr/bin/env bash
# slideway's linkages beside Siconos and MuJoCo (bench/linkage_peers.py): installs what is not there, python3-siconos of Debian as root, MuJoCo and the
# package into build/peers, and prints the table.  Usage: scripts/linkage_peers.sh [TABLE.csv].  Some minutes.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
scripts/python_environment.sh build/release >/dev/null
system=/usr/lib/python3/dist-packages
[[ -d $system/siconos ]] || apt-get install -y --no-install-recommends python3-siconos
# Siconos is made for numpy 1, and for Debian's Python.
environment=$root/build/peers
[[ -d $environment ]] || /usr/bin/python3 -m venv "$environment" 2>/dev/null || python3 -m venv "$environment"
"$environment/bin/python" -m pip --disable-pip-version-check install --quiet 'numpy<2' mujoco build/wheel/*.whl
ln -sfn "$system/siconos" "$(echo "$environment"/lib/python3*/site-packages)/siconos"
"$environment/bin/python" bench/linkage_peers.py ${1:+-o "$1"}
