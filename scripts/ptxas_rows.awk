# Rows of what ptxas -v reports, demangled (c++filt), one per function of a kernel and tab-separated:
#   architecture, unit of cuda.cu, kernel, function, instance, stack frame, spill stores, spill loads [B], registers (of the kernel)
function without_templates(name) {
    while (gsub(/<[^<>]*>/, "", name)) continue
    sub(/\(.*/, "", name)
    sub(/^.* /, "", name)
    return name
}

function match_of(text, pattern) { return match(text, pattern) ? substr(text, RSTART, RLENGTH) : "" }

# "StickSlipFriction AlignedWay PointDamping" of SliderCrank<PaperLaw, StickSlipFriction, AlignedWay, PointDamping>
function instance_of(name, parts) {
    parts = match_of(name, "(^|[^A-Za-z])SliderCrank<[^<>]*>")
    sub(/.*</, "", parts)
    sub(/>/, "", parts)
    sub(/^[A-Za-z]*, /, "", parts)
    gsub(/,/, "", parts)
    return parts
}

function function_of(name, plain, fullness, stepper) {
    plain = without_templates(name)
    fullness = name ~ /::derivative<true/ ? "full" : "lean"
    if (plain == "SliderCrank::derivative") return fullness " derivative"
    if (plain == "SliderCrankChoice::derivative") return plain " " fullness
    if (plain == "linearise") return "linearisation"
    # The stepper is the first argument, or the first of an explicit one's.
    stepper = match_of(name, "(::work<|CrossingSearch<)(ExplicitStep<)?[A-Za-z0-9]+")
    sub(/.*</, "", stepper)
    return plain (stepper == "" ? "" : " " stepper)
}

function write_row(frame, stores, loads, registers) {
    print architecture, unit, kernel, function_of(name), instance_of(name), frame, stores, loads, registers
}

BEGIN { OFS = "\t" }
{ gsub(/slideway::(cuda::)?/, "") }
/Compiling entry function/ {
    architecture = match_of($0, "sm_[0-9a-z]+'$")
    sub(/'/, "", architecture)
    kernel = match_of($0, "integrate_[a-z]+")
    unit = tolower(match_of($0, "(Paper|Conservative)Law"))
    sub(/law/, /RestitutionDamping/ ? "_impact_kernels" : "_kernels", unit)
}
/Function properties for / {
    name = $0
    sub(/.*Function properties for /, "", name)
}
/bytes stack frame/ {
    if (name ~ /^void integrate_/) {
        entry_frame = $1
        entry_stores = $5
        entry_loads = $9
    } else {
        write_row($1, $5, $9, "")
    }
}
/Used [0-9]+ registers/ {
    print architecture, unit, kernel, "kernel", "", entry_frame, entry_stores, entry_loads, match_of($0, "[0-9]+ registers") + 0
}
