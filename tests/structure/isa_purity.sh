#!/usr/bin/env bash
# isa_purity.sh LIST: fails when a unit built for one instruction set defines a symbol that the linker could merge with
# another unit's.  A merged AVX-512 copy would then crash, or round otherwise, on a path that never asked for it.
#
# LIST holds lines "<library> <object>"; the library's name says the instruction set: slideway_kernels_<isa>_….
# Weak and unique symbols (nm: W V u) must carry the instruction set in their name: its own namespace,
# slideway::<isa>::, or an xsimd architecture that no other unit uses.
set -euo pipefail
export LC_ALL=C

# Pattern of the xsimd architecture of an instruction set; those that contain a wider one's belong to that one.
declare -A arch=([scalar]='' [scalar_libm]='' [avx2]='xsimd::fma3<xsimd::avx2' [avx512]='xsimd::avx512' [neon]='xsimd::neon64')
declare -A wider=([scalar]='' [scalar_libm]='' [avx2]='xsimd::avx512' [avx512]='' [neon]='')

# May be merged: data, not instructions.
#   DW.ref.…                      pointer to the exception personality routine, made by the compiler
#   slideway::quantity_table …    constant tables of the plain-data headers, the same bytes in every unit
allowed='^(DW\.ref\.__gxx_personality_v0|slideway::(quantity_table|series_table|status_names|mode_class_names|start_inputs))$'

list=$1
objects=0
bad=0
while read -r library object; do
    [[ -n $library ]] || continue
    isa=''
    for known in "${!arch[@]}"; do
        if [[ $library == "slideway_kernels_${known}_"* ]] && ((${#known} > ${#isa})); then isa=$known; fi
    done
    if [[ -z $isa ]]; then
        echo "isa_purity: no rule for the instruction set of $library" >&2
        exit 1
    fi
    symbols=$(nm -C --defined-only "$object")
    # It runs where there is neither AVX nor FMA: none of their instructions (v…), nor what came with them.
    if [[ $isa == scalar_libm ]]; then
        later=$(objdump -d --no-show-raw-insn "$object" | awk -F'\t' '
            $2 ~ /^(v[a-z]|popcnt|[tl]zcnt|andn |pext|pdep|movbe)/ && ++count <= 3 { print "  " $2 }')
        if [[ -n $later ]]; then
            echo "$object: not of every processor:"
            echo "$later"
            bad=$((bad + 1))
        fi
    fi
    # A unit whose kernels are not in its namespace would make the check below pass for the wrong reason.
    if ! grep -q "slideway::$isa::" <<<"$symbols"; then
        echo "$object: nothing in slideway::$isa::"
        bad=$((bad + 1))
    fi
    shared=$(awk -v own="slideway::(testing::)?$isa::" -v arch="${arch[$isa]}" -v wider="${wider[$isa]}" -v allowed="$allowed" '
        $2 !~ /^[WVu]$/ { next }
        {
            name = $0
            sub(/^[^ ]* [^ ] /, "", name)
            if (name ~ own || name ~ allowed) next
            if (arch != "" && name ~ arch && (wider == "" || name !~ wider)) next
            print "  " name
        }' <<<"$symbols")
    if [[ -n $shared ]]; then
        echo "$object: could be merged with another unit's:"
        echo "$shared"
        bad=$((bad + 1))
    fi
    objects=$((objects + 1))
done <"$list"

if ((objects == 0)); then
    echo "isa_purity: $list names no object" >&2
    exit 1
fi
echo "$objects objects, $bad impure"
((bad == 0))
