#!/usr/bin/env bash
# run.sh CMAKE ROOT BUILD WORK: installs a build (or takes what is installed already, where BUILD is a prefix) and builds the projects of
# examples/ against it, outside the tree.  They print what the program says of the same members.
set -euo pipefail
cmake=$1 root=$2 build=$3 work=$4
rm -rf "$work"
mkdir -p "$work"
if [[ -f $build/CMakeCache.txt ]]; then
    "$cmake" --install "$build" --prefix "$work/prefix" >"$work/install.log"
else
    ln -s "$build" "$work/prefix"
fi
program=$work/prefix/bin/slideway
if [[ -f $build/CMakeCache.txt ]]; then
    # The headers alone, of a configuration of which nothing is built.
    "$cmake" -S "$root" -B "$work/unbuilt" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSLIDEWAY_TESTS=OFF -DSLIDEWAY_BENCH=OFF >"$work/unbuilt.log"
    "$cmake" --install "$work/unbuilt" --prefix "$work/headers" --component headers >>"$work/unbuilt.log"
    mkdir "$work/alone"
    printf 'cmake_minimum_required(VERSION 3.25)\nproject(alone LANGUAGES CXX)\nfind_package(slideway REQUIRED)\nadd_library(alone alone.cpp)\ntarget_link_libraries(alone PRIVATE slideway::kernels)\n' \
        >"$work/alone/CMakeLists.txt"
    printf '#define SLIDEWAY_NO_SIMD\n#include <slideway/kernels.hpp>\nint main_law() { return static_cast<int>(slideway::Law::foundation); }\n' >"$work/alone/alone.cpp"
    "$cmake" -S "$work/alone" -B "$work/alone/build" -G Ninja -DCMAKE_PREFIX_PATH="$work/headers" >"$work/alone.log"
    "$cmake" --build "$work/alone/build" >>"$work/alone.log" || { cat "$work/alone.log"; exit 1; }
fi

# What is built here runs for milliseconds: it is optimised as little as may be, whatever its targets ask for.
printf '#!/bin/sh\nexec "$@" -O1\n' >"$work/compile"
chmod +x "$work/compile"
export CMAKE_CXX_COMPILER_LAUNCHER=$work/compile

for example in library kernels; do
    lines=$(cat "$root/examples/$example"/{CMakeLists.txt,*.cpp} | grep -cv '^ *\(//.*\)\?$')
    ((lines <= 40)) || { echo "examples/$example has $lines lines, more than 40"; exit 1; }
    "$cmake" -S "$root/examples/$example" -B "$work/$example" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" -DSLIDEWAY_ISAS=native >"$work/$example.log"
    "$cmake" --build "$work/$example" >>"$work/$example.log" || { cat "$work/$example.log"; exit 1; }
done

# A unit that uses what headers have outside of its namespace shares no function with the program, and sees what the target sees.
mkdir -p "$work/units/headers"
cat >"$work/units/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(units LANGUAGES CXX)
find_package(slideway REQUIRED)
add_library(units STATIC)
target_include_directories(units PRIVATE headers)
target_compile_definitions(units PRIVATE WANTED=2)
slideway_add_kernels(units SOURCES unit.cpp ISAS scalar)
file(GENERATE OUTPUT objects.txt CONTENT "slideway_kernels_scalar_unit $<TARGET_OBJECTS:units_scalar_1>\n")
END
echo 'static_assert(WANTED == 2);' >"$work/units/headers/of_the_target.hpp"
cat >"$work/units/unit.cpp" <<'END'
#include <of_the_target.hpp>
#include <slideway/kernels.hpp>
#include <slideway/dispatch.hpp>
#include <slideway/kernels/members/drive_period.hpp>
#include <slideway/kernels/members/stiffest_rate.hpp>

namespace slideway::inline SLIDEWAY_ISA {
void const* used(int i) {
    void const* const all[] = {(void*)&complete_inputs, (void*)&start_of,       (void*)&set_start, (void*)&drive_period,
                               (void*)&first_time_at,   (void*)&stiffest_rate, (void*)&runs_here};
    return all[i];
}
}  // namespace slideway::inline SLIDEWAY_ISA
END
"$cmake" -S "$work/units" -B "$work/units/build" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" >"$work/units.log"
"$cmake" --build "$work/units/build" >>"$work/units.log" 2>&1 || { cat "$work/units.log"; exit 1; }
bash "$root/tests/structure/isa_purity.sh" "$work/units/build/objects.txt"

# The blocks of docs/how_to/cpp.md, one program, run in the root of the repository.
mkdir -p "$work/page"
sed '1,/^project/s/library_example/page/' "$root/examples/library/CMakeLists.txt" >"$work/page/CMakeLists.txt"
blocks=$(sed -n '/^```cpp$/,/^```$/{/^```/!p}' "$root/docs/how_to/cpp.md")
{
    grep '^#include' <<<"$blocks"
    printf '#include <cstdio>\nint main() try {\n'
    grep -v '^#include' <<<"$blocks"
    printf 'auto const modes = ensemble.with({{"study.quantities", "[\\"mode_time\\"]"}}).run();\n'
    printf 'std::printf("%%.17g %%d %%s\\n", first, static_cast<int>(finished), modes.column("mode_class_name").texts()[0].c_str());\n'
    printf '} catch (slideway::Error const& error) { return std::fprintf(stderr, "%%s\\n", error.what()), error.code(); }\n'
} >"$work/page/main.cpp"
"$cmake" -S "$work/page" -B "$work/page/build" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" >"$work/page.log"
"$cmake" --build "$work/page/build" >>"$work/page.log" || { cat "$work/page.log"; exit 1; }
ln -sfn "$root/scenes" "$work/scenes"
printed=$(cd "$work" && page/build/example)
[[ $printed =~ ^[0-9.]+\ 64\ free$ && -s $work/starts.nc ]] || { echo "the blocks of docs/how_to/cpp.md print $printed"; exit 1; }

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
