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
        print $1 " " $2 " " $3 ": " $4 ($5 == "" ? "" : " of " $5) ": " what
        bad++
    }
    BEGIN {
        # [B], a little above what was measured
        stack["integrate_members"] = 13200
        stack["integrate_shadowed"] = 24000
        # What lean derivatives store and load of spills, [B]; those of other parts none.
        spills["StickSlipFriction MisalignedWay RateDamping"] = 16
        spills["StickSlipFriction MisalignedWay PointDamping"] = 16
        spills["NoFriction AlignedWay RestitutionDamping"] = 8
        spills["NoFriction MisalignedWay RestitutionDamping"] = 48
        spills["StickSlipFriction AlignedWay RestitutionDamping"] = 32
        spills["StickSlipFriction MisalignedWay RestitutionDamping"] = 400
    }
    { known = release ~ /^13\.0[0-9.]*$/ && ($1 == "sm_80" || $1 == "sm_90") }
    $4 != "kernel" && $6 > 0 { fail($6 " bytes of stack frame; are functions called through pointers?") }
    $4 == "kernel" {
        kernels++
        compared += known
        if (known && $6 > stack[$3]) fail($6 " bytes of stack, above " stack[$3])
    }
    $4 == "lean derivative" {
        derivatives++
        if (known && $7 + $8 > spills[$5] + 0) fail($7 + $8 " bytes of spills, above " spills[$5] + 0)
    }
    END {
        if (kernels == 0 || derivatives == 0) {
            print "cuda_registers: the reports name no kernel or no derivative"
            exit 1
        }
        print kernels " kernels (" compared + 0 " with known needs), " derivatives " lean derivatives, " bad + 0 " excesses"
        exit bad > 0
    }'
