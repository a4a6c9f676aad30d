#!/usr/bin/env bash
# example.sh CXX ROOT WORK PROGRAM RESULTS NAME: what docs/how_to/extending.md shows of an example is the file here; built outside the tree by the commands of
# the page, or of NAME.commands, it prints what the page says, or NAME.printed.  The motor takes long to compile: it goes
# where other tests of this build look for it (ProgramWithOwnModules::provide_motor).
set -euo pipefail
cxx=$1 root=$2 work=$3/$6 program=$4 results=$5 name=$6
page=$root/docs/how_to/extending.md

# The fenced block of the page that is named "<language> <name>".
block() { awk -v fence='```'"$1" '/^```/ { on = !on && $0 == fence; next } on' "$page"; }

rm -rf "$work"
mkdir -p "$work/bin"
cd "$work"
for file in "cpp $name.cpp" "cpp $name.hpp" "diff $name.patch"; do
    path=$root/tests/extending/${file#* }
    [ -e "$path" ] || continue
    cp "$path" .
    block "$file" > shown
    [ ! -s shown ] || diff -u "$path" shown || { echo "docs/how_to/extending.md shows another ${file#* } than tests/extending has"; exit 1; }
done
cp -n "$root"/tests/extending/*.{hpp,toml} .
for scene in $(sed -n 's/^```toml \(.*\.toml\)$/\1/p' "$page"); do block "toml $scene" > "$scene"; done

# What the page says of the example, or else a file here: FENCE FILE.
said() { block "$1" | grep . || cat "$root/tests/extending/$2"; }
said "sh $name" "$name.commands" > commands
said "text $name" "$name.printed" > expected
g++() { "$cxx" "$@"; }
cache=$work/cache
[ "$name" != motor_yoke ] || cache=$results/cache
export SLIDEWAY=$root XDG_CACHE_HOME=$cache
modules=$XDG_CACHE_HOME/slideway/modules
mkdir -p "$modules"
slideway() { if [ "$1" = compile ]; then flock "$modules/lock" "$program" "$@"; else "$program" "$@"; fi; }
. ./commands | tee printed
diff -u expected printed || { echo "docs/how_to/extending.md or $name.printed shows other output"; exit 1; }
