#!/usr/bin/env bash
# library_exports.sh LIBRARY HEADER: fails when libslideway.so shows more than the classes and functions of its header, or less, or needs MPI.
# Templates of the libraries inside would otherwise be merged with those of the program that links it.
set -euo pipefail
export LC_ALL=C
library=$1
header=$2

# The API's own names: what follows `class SLIDEWAY_API` or stands before the parenthesis of a SLIDEWAY_API function, and what has such members.
classes=$(sed -n 's/^\(class SLIDEWAY_API\|struct\) \([A-Za-z]*\).*{$/\2/p' "$header" | paste -sd '|')
functions=$(sed -n 's/^SLIDEWAY_API .* \([a-z_]*\)(.*/\1/p' "$header" | paste -sd '|')
api="^((typeinfo|typeinfo name|vtable) for slideway::Error|slideway::(($classes)::[a-z_]+|($functions))(\[abi:cxx11\])?\(.*)$"
exported=$(nm -DC --defined-only "$library" | sed 's/^[^ ]* [^ ] //')
code=0
if more=$(grep -Ev "$api" <<<"$exported"); then
    echo "library_exports: $library shows more than $header declares:"
    echo "$more"
    code=1
fi
for name in Ensemble::read Ensemble::run Result::column Column::numbers slideway::version 'typeinfo for slideway::Error'; do
    grep -qF "$name" <<<"$exported" || { echo "library_exports: $library does not show $name"; code=1; }
done
if needed=$(readelf -d "$library" | grep NEEDED | grep -i mpi); then
    echo "library_exports: $library needs MPI: $needed"
    code=1
fi
((code == 0)) && echo "$library shows $(wc -l <<<"$exported") names, all of $header"
exit "$code"
