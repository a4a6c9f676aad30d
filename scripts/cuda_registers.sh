#!/usr/bin/env bash
# Writes bench/results/cuda_registers.md: registers, stack and spills of the kernels on cards, from what ptxas -v said when a build
# compiled them.  Usage: scripts/cuda_registers.sh [BUILD], a build for sm_80 and sm_90 (-DCMAKE_CUDA_ARCHITECTURES="80;90").
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${1:-$root/build/release}
list=$build/host/backend/ptxas_reports.txt
[[ -r $list ]] || {
    echo "cuda_registers.sh: no $list; build with nvcc first" >&2
    exit 2
}
rows=$(mktemp)
trap 'rm -f "$rows"' EXIT
while read -r report; do cat "$report"; done <"$list" | c++filt | awk -f "$root/scripts/ptxas_rows.awk" >"$rows"

nvcc=$(sed -n 's/^SLIDEWAY_NVCC:[A-Z]*=//p' "$build/CMakeCache.txt")
changed=
git -C "$root" diff --quiet HEAD -- cmake host kernels || changed=" and changes since"
flags=$(grep -m 1 "SLIDEWAY_KERNELS=" "$build/compile_commands.json" | tr " " "\n" | grep -E "^(-O|--fmad|--expt|-std)" | sort -u | tr "\n" " ")

{
    cat <<EOF
# Registers, stack and spills of the kernels on cards

- compiler: $("$nvcc" --version | sed -n 's/.*release .*, V/nvcc /p')
- commit: $(git -C "$root" rev-parse --short HEAD)$changed
- date: $(date -u +%FT%TZ)
- flags: ${flags% }
- \`scripts/cuda_registers.sh\`, from the reports of \`ptxas -v\` that the build leaves beside its objects (\`cuda.cu.o.ptxas\`)

Assembled, not run. Bytes per thread; of spills, what all instructions of a function store / load, each counted once however often it
runs. A kernel's stack frame is the deepest chain of calls, with the lane program, the shadows and what is spilled; no other function
has a frame, for ptxas shares out the registers between caller and callee. Where functions are called through pointers, or a unit has
too many of them, it follows the calling convention instead and saves half of the registers (the test \`CudaRegisters.AreAsKnown\`).

EOF
    awk -F'\t' '
        function cell(key) {
            if (!(key in stores)) return "–"
            return stores[key] + loads[key] == 0 ? "0" : stores[key] " / " loads[key]
        }
        function keep(key) {  # the larger of several functions of one name
            if (!(key in stores) || stores[key] + loads[key] < $7 + $8) {
                stores[key] = $7
                loads[key] = $8
            }
        }
        function learn(list, name) {  # in the order of their first mention
            if (!((list, name) in known)) {
                known[list, name] = 1
                names[list, ++size[list]] = name
            }
        }
        function heading(text, firsts, lasts, i, line, targets) {
            line = "| " firsts
            for (i = 1; i <= size["target"]; i++) {
                targets = lasts
                gsub(/@/, names["target", i], targets)
                line = line " | " targets
            }
            print text "\n\n" line " |"
            gsub(/[^|]+/, "---", line)
            print line "|"
        }
        BEGIN { steppers = split("RungeKutta4 BogackiShampine DormandPrince StiffStep", stepper, " ") }
        {
            learn("target", $1)
            parts = $5
            sub(/^NoFriction/, "none", parts)
            sub(/^StickSlipFriction/, "stick-slip", parts)
            sub(/ AlignedWay/, " | aligned", parts)
            sub(/ MisalignedWay/, " | misaligned", parts)
            sub(/ Point/, " | point ", parts)
            sub(/ Rate/, " | rate ", parts)
            sub(/ Restitution/, " | restitution ", parts)
            sub(/ Damping/, "", parts)
            instance = ($2 ~ /paper/ ? "paper" : "conservative") " | " parts
        }
        $4 == "kernel" {
            learn("kernel", $2 " | " $3)
            registers[$1, $2 " | " $3] = $9
            frame[$1, $2 " | " $3] = $6
            keep($1 SUBSEP $2 " | " $3)
            next
        }
        $4 ~ /derivative$|^linearisation$/ {
            learn("instance", instance)
            keep($1 SUBSEP $4 SUBSEP instance)
            if ($4 == "lean derivative") {
                count[$1]++
                if ($7 > 0) spilling[$1]++
            }
            next
        }
        $4 ~ /^LaneProgram::work/ {
            sub(/.* /, "", $4)
            keep($1 SUBSEP $4 SUBSEP $2 " | " $3)
            next
        }
        $7 + $8 > 0 {
            sub(/ .*/, "", $4)
            learn("other", $4)
            keep($1 SUBSEP $4)
        }
        END {
            for (i = 1; i <= size["target"]; i++) {
                t = names["target", i]
                printf "On %s %d of %d lean derivatives (%d instances in two kernels) store spills.\n", t, spilling[t], count[t], count[t] / 2
            }
            heading("\n## Kernels\n\nRegisters, stack frame, spills of the kernel itself.", "unit | kernel",
                    "@ registers | frame | spills")
            for (i = 1; i <= size["kernel"]; i++) {
                name = names["kernel", i]
                line = "| " name
                for (j = 1; j <= size["target"]; j++) {
                    t = names["target", j]
                    line = line " | " registers[t, name] " | " frame[t, name] " | " cell(t SUBSEP name)
                }
                print line " |"
            }
            heading("\n## Equations\n\nThe hot path is the lean derivative, which the explicit methods evaluate three (bs32) to six " \
                    "(dopri5) times a step. The full one also fills the report: at the ends of steps or stages, for quantities and " \
                    "events. The linearisation is the stiff method\x27s. Of the two kernels the one that spills more.",
                    "law | friction | way | damping", "@ lean | full | linearisation")
            for (i = 1; i <= size["instance"]; i++) {
                name = names["instance", i]
                line = "| " name
                for (j = 1; j <= size["target"]; j++) {
                    t = names["target", j]
                    line = line " | " cell(t SUBSEP "lean derivative" SUBSEP name) " | " cell(t SUBSEP "full derivative" SUBSEP name) \
                        " | " cell(t SUBSEP "linearisation" SUBSEP name)
                }
                print line " |"
            }
            heading("\n## Stints\n\n`LaneProgram::work` of each method: step control, stages, samples and events.",
                    "unit | kernel", "@ rk4 | bs32 | dopri5 | ros34pw2")
            for (i = 1; i <= size["kernel"]; i++) {
                name = names["kernel", i]
                line = "| " name
                for (j = 1; j <= size["target"]; j++) {
                    t = names["target", j]
                    for (k = 1; k <= steppers; k++) line = line " | " cell(t SUBSEP stepper[k] SUBSEP name)
                }
                print line " |"
            }
            heading("\n## Whatever else spills\n\nThe largest of several functions of one name.", "function", "@")
            for (i = 1; i <= size["other"]; i++) {
                name = names["other", i]
                line = "| `" name "`"
                for (j = 1; j <= size["target"]; j++) line = line " | " cell(names["target", j] SUBSEP name)
                print line " |"
            }
        }' "$rows"
} >"$root/bench/results/cuda_registers.md"
