#!/usr/bin/env bash
# Writes bench/results/cuda_registers.md: registers, stack and spills of the GPU kernels, from what ptxas -v said when a build
# compiled them.  Usage: scripts/cuda_registers.sh [BUILD], a build of the target slideway_cuda_module for sm_80 and sm_90, as the
# preset cuda makes it.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${1:-$root/build/cuda}
list=$build/host/backend/ptxas_reports.txt
[[ -r $list ]] || {
    echo "cuda_registers.sh: no $list; build the preset cuda first" >&2
    exit 2
}
rows=$(mktemp)
trap 'rm -f "$rows"' EXIT
while read -r report; do cat "$report"; done <"$list" | c++filt | awk -f "$root/scripts/ptxas_rows.awk" >"$rows"

nvcc=$(sed -n 's/^SLIDEWAY_NVCC:[A-Z]*=//p' "$build/CMakeCache.txt")
changed=
git -C "$root" diff --quiet HEAD -- cmake host kernels || changed=" and changes since"
flags=$(grep -m 1 "SLIDEWAY_ISA=cuda " "$build/compile_commands.json" | tr " " "\n" | grep -E "^(-O|--fmad|--expt|-std)" | sort -u | tr "\n" " ")

{
    cat <<EOF
# Registers, stack and spills of the GPU kernels

- compiler: $("$nvcc" --version | sed -n 's/.*release .*, V/nvcc /p')
- commit: $(git -C "$root" rev-parse --short HEAD)$changed
- date: $(date -u +%FT%TZ)
- flags: ${flags% }
- \`scripts/cuda_registers.sh\`, from the reports of \`ptxas -v\` that the build leaves beside its objects (\`cuda.cu.o.ptxas\`)

Assembled, not run. Bytes per thread; spills: what a function stores / loads, each instruction counted once; 0: nothing, –: no such function. A kernel's
stack frame is the deepest chain of calls; no other function has a frame, unless functions are called through pointers or a unit has too many (the test
\`CudaRegisters.AreAsKnown\`). One kernel integrates members, one members with shadows.

EOF
    awk -F'\t' '
        function cell(key) {
            if (!(key in stores)) return "–"
            return stores[key] + loads[key] == 0 ? "0" : stores[key] " / " loads[key]
        }
        function keep(key) {  # the larger of several functions of one name
            if (!(key in stores) || stores[key] + loads[key] < $5 + $6) {
                stores[key] = $5
                loads[key] = $6
            }
        }
        function learn(list, name) {  # in the order of their first mention
            if (!((list, name) in known)) {
                known[list, name] = 1
                names[list, ++size[list]] = name
            }
        }
        function heading(text, first, line, i) {
            line = "| " first
            for (i = 1; i <= size["target"]; i++) line = line " | " names["target", i] " members | " names["target", i] " shadowed"
            print text "\n\n" line " |"
            gsub(/[^|]+/, "---", line)
            print line "|"
        }
        function row(label, name, line, i) {
            line = "| " label
            for (i = 1; i <= size["target"]; i++) {
                line = line " | " cell(names["target", i] SUBSEP "members" SUBSEP name) " | " \
                    cell(names["target", i] SUBSEP "shadowed" SUBSEP name)
            }
            print line " |"
        }
        function kernel_row(label, numbers, line, i) {
            line = "| " label
            for (i = 1; i <= size["target"]; i++) {
                line = line " | " numbers[names["target", i], "members"] " | " numbers[names["target", i], "shadowed"]
            }
            print line " |"
        }
        { learn("target", $1) }
        $3 == "kernel" {
            registers[$1, $2] = $7
            frame[$1, $2] = $4
        }
        $3 !~ /^(lean|full|linearis)|^LaneProgram::work|^kernel$/ {
            sub(/ .*/, "", $3)
            if ($5 + $6 > 0) learn("other", $3)
        }
        { keep($1 SUBSEP $2 SUBSEP $3) }
        END {
            heading("## Kernels", "")
            kernel_row("registers", registers)
            kernel_row("stack frame", frame)
            row("spills of the kernel itself", "kernel")
            heading("\n## Equations\n\nThe hot path is the lean derivative, three to six times a step. The full one also fills the report. " \
                    "Of faces, laws and dampings, those that spill most.", "function")
            row("lean derivative", "lean derivative")
            row("its faces", "lean faces")
            row("its laws", "lean law")
            row("full derivative", "full derivative")
            row("its faces", "full faces")
            row("its laws", "full law")
            row("linearisation", "linearisation")
            row("its faces", "linearised faces")
            row("its laws", "linearised law")
            heading("\n## Stints\n\n`LaneProgram::work` of each method: step control, stages, samples and events.", "method")
            row("rk4, bs32, dopri5, dop853", "LaneProgram::work ExplicitStep")
            row("ros34pw2", "LaneProgram::work StiffStep")
            heading("\n## Whatever else spills\n\nThe largest of several functions of one name.", "function")
            for (i = 1; i <= size["other"]; i++) row("`" names["other", i] "`", names["other", i])
        }' "$rows"
} >"$root/bench/results/cuda_registers.md"
