#!/usr/bin/env bash
# forgotten.sh CXX CMAKE ROOT WORK SOURCE LIST ROW [HEADER]: what the compiler says of a source when kernels/LIST/list.hpp has a further row.
# With HEADER the file that the row names is there: one of tests/extending/traps, or one that includes the header of that name in kernels/LIST.  Flags of the compiler: $FLAGS.
set -euo pipefail
cxx=$1 cmake=$2 root=$3 work=$4 source=$5 list=$6 row=$7 header=${8-}
rm -rf "$work"
mkdir -p "$work/tree/cmake" "$work"/tree/kernels/{laws,mechanisms}
cd "$work"
for folder in laws mechanisms; do cp "$root/kernels/$folder/list.hpp" "tree/kernels/$folder"; done
cp "$root/cmake/kernel_lists.cmake" tree/cmake
# The last row has no backslash behind it.
last=$(grep -n '^ *row(' "tree/kernels/$list/list.hpp" | tail -1 | cut -d: -f1)
if [ "$row" ]; then sed -i "${last}s/\$/ \\\\\\n    row($row)/" "tree/kernels/$list/list.hpp"; fi
if [[ $header == traps/* ]]; then
    cp "$root/tests/extending/$header.hpp" "tree/kernels/$list/${row%%,*}.hpp"
elif [ "$header" ]; then
    printf '#pragma once\n#include "kernels/%s/%s.hpp"\n' "$list" "$header" > "tree/kernels/$list/${row%%,*}.hpp"
fi
printf 'cmake_minimum_required(VERSION 3.25)\nproject(rows LANGUAGES NONE)\ninclude(cmake/kernel_lists.cmake)\n' > tree/CMakeLists.txt
"$cmake" -S tree -B build > cmake.log || { cat cmake.log; exit 1; }
"$cxx" -std=c++20 -fsyntax-only $FLAGS -Itree -Ibuild/generated "-I$root" "$root/$source"
echo "$source compiles"
