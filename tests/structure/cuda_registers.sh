#!/usr/bin/env bash
# cuda_registers.sh REPORTS RELEASE ROWS: fails when a kernel of cuda.cu needs more of a card than it is known to need.
#
# REPORTS names the files in which the build put what ptxas -v says (cmake/ptxas_report.sh), ROWS is scripts/ptxas_rows.awk.  Functions
# other than kernels must have no stack frame of their own: with frames ptxas follows the calling convention, which saves half of the
# registers, in place of sharing them out.  It does so where functions are called through pointers and where a unit has too many.
# What else a function needs differs between releases and architectures: it is compared where it was measured
# (bench/results/cuda_registers.md).  RELEASE is nvcc's, with "-fmad" if that contracts.
set -euo pipefail
export LC_ALL=C
reports=$1
release=$2
rows=$3

while read -r report; do
    [[ -s $report ]] || {
        echo "cuda_registers: no report of ptxas in $report" >&2
        exit 1
    }
    cat "$report"
done <"$reports" | c++filt | awk -f "$rows" | awk -F'\t' -v release="$release" '
    function fail(what) {
        print $1 " " $2 ": " $3 ": " what
        bad++
    }
    BEGIN {
        # [B], a little above what was measured
        stack["members"] = 12800
        stack["shadowed"] = 25200
        # What the derivative with a report, which is evaluated far less often, stores and loads of spills [B]; other equations none.
        spills["full derivative"] = 32
        spills["full faces"] = 16
    }
    { known = release ~ /^13\.0[0-9.]*$/ && ($1 == "sm_80" || $1 == "sm_90") }
    $3 != "kernel" && $4 > 0 { fail($4 " bytes of stack frame; are functions called through pointers?") }
    $3 == "kernel" {
        kernels++
        compared += known
        if (known && $4 > stack[$2]) fail($4 " bytes of stack, above " stack[$2])
    }
    $3 ~ /^(lean|full) (derivative|faces|law)$|^linearis/ {
        equations++
        if (known && $5 + $6 > spills[$3] + 0) fail($5 + $6 " bytes of spills, above " spills[$3] + 0)
    }
    END {
        if (kernels == 0 || equations == 0) {
            print "cuda_registers: the reports name no kernel or no equations"
            exit 1
        }
        print kernels " kernels (" compared + 0 " with known needs), " equations " functions of the equations, " bad + 0 " excesses"
        exit bad > 0
    }'
