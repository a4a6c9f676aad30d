#!/usr/bin/env bash
# trap.sh CXX ROOT SOURCE: what the compiler says of a source that forgets something (tests/extending/traps).  Flags of the compiler: $FLAGS.
set -euo pipefail
"$1" -std=c++20 -fsyntax-only $FLAGS "-I$2" "$2/tests/extending/traps/$3.cpp"
echo "$3 compiles"
