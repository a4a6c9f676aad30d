#!/usr/bin/env bash
# run.sh CMAKE ROOT BUILD WORK: installs a build and builds the projects of examples/ against it, outside the tree.  They print what the
# program says of the same members.
set -euo pipefail
cmake=$1 root=$2 build=$3 work=$4
rm -rf "$work"
mkdir -p "$work"
"$cmake" --install "$build" --prefix "$work/prefix" >"$work/install.log"
program=$work/prefix/bin/slideway

for example in library kernels; do
    lines=$(cat "$root/examples/$example"/{CMakeLists.txt,*.cpp} | grep -cv '^ *\(//.*\)\?$')
    ((lines <= 40)) || { echo "examples/$example has $lines lines, more than 40"; exit 1; }
    "$cmake" -S "$root/examples/$example" -B "$work/$example" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" -DSLIDEWAY_ISAS=native >"$work/$example.log"
    "$cmake" --build "$work/$example" >>"$work/$example.log" || { cat "$work/$example.log"; exit 1; }
done

cd "$work"
awk 'BEGIN { print "joint.clearance"; for (i = 0; i < 64; ++i) printf "%.17g\n", 5e-5 + 5e-5 * i / 63 }' >clearances.csv
cat >cranks.toml <<'END'
schema = 1
[contact]
law = "conservative"
[study]
kind = "ensemble"
design = "table"
table = "clearances.csv"
duration = "20 ms"
quantities = ["peak_tilt", "peak_normal_force"]
END

# The program rounds its exact sum once, the example adds up.
"$program" run cranks.toml --quiet -o cranks.nc
expected=$("$program" info --json cranks.nc | tr -d ' \n' | sed 's/.*"name":"peak_normal_force"[^}]*"mean":\([^,}]*\).*/\1/')
printed=$(library/example cranks.toml peak_normal_force)
awk -v a="$printed" -v b="$expected" 'BEGIN { exit !(b > 1 && (a - b) ^ 2 <= (1e-13 * b) ^ 2) }' ||
    { echo "examples/library prints $printed, and the program says $expected"; exit 1; }
echo "library: $printed"

printed=$(kernels/example)
expected=$(library/example cranks.toml final_y)
[[ $printed == "$expected" ]] || { echo "examples/kernels prints $printed, and the members of the scene have the mean $expected"; exit 1; }
echo "kernels: $printed"

code=0
said=$(library/example nowhere.toml y 2>&1) || code=$?
[[ $code == 2 && $said == "nowhere.toml: "* ]] || { echo "a scene that is not there: code $code, $said"; exit 1; }
