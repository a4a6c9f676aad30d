#!/usr/bin/env bash
# cuda_module.sh PROGRAM MODULE: fails when the program holds any of the CUDA runtime, or the module exports more than its one function.
set -euo pipefail
export LC_ALL=C
program=$1
module=$2

runtime=$(nm "$program" | awk '$NF ~ /^_*cuda[A-Z]/ { print $NF }')
exported=$(nm -D --defined-only "$module" | awk '{ print $NF }')
needed=$(nm -D --undefined-only "$module" | awk '$NF ~ /slideway/ { print $NF }')
code=0
if [[ -n $runtime ]]; then
    echo "cuda_module: the program has functions of the CUDA runtime:" $runtime
    code=1
fi
if [[ $exported != slideway_cuda_module ]]; then
    echo "cuda_module: the module exports more than slideway_cuda_module:" $exported
    code=1
fi
if [[ -n $needed ]]; then
    echo "cuda_module: the module asks the program for" $needed
    code=1
fi
((code == 0)) && echo "the program has no CUDA, the module exports slideway_cuda_module"
exit "$code"
