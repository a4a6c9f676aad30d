#!/usr/bin/env bash
# quantity_without_line.sh CXX ROOT WORK: what the compiler says when a quantity has a row and nothing computes it.
set -euo pipefail
cxx=$1 root=$2 work=$3
rm -rf "$work"
mkdir -p "$work"
cd "$work"
cp -r "$root/kernels" .
patch -s -p1 < "$root/tests/extending/own_quantity.patch"
cp "$root/kernels/observers/slider_observer.hpp" kernels/observers
"$cxx" -std=c++20 -fsyntax-only -DSLIDEWAY_NO_SIMD -I . "$root/tests/extending/own_quantity.cpp"
