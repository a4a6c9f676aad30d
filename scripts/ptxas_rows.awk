# Rows of what ptxas -v reports, demangled (c++filt), one per function of a kernel and tab-separated:
#   architecture, kernel, function, stack frame, spill stores, spill loads [B], registers (of the kernel)
# The kernels are `members` and `shadowed`.  What is compiled with and without the report of a state is `full` and `lean`.
function without_templates(name) {
    while (gsub(/<[^<>]*>/, "", name)) continue
    sub(/\(.*/, "", name)
    sub(/^.* /, "", name)
    return name
}

function match_of(text, pattern) { return match(text, pattern) ? substr(text, RSTART, RLENGTH) : "" }

function function_of(name, plain, fullness, stepper) {
    gsub(/\([A-Za-z]+\)/, "", name)  # (Axis)0
    plain = without_templates(name)
    fullness = name ~ /::derivative<true|, true>::add_faces</ ? "full" : "lean"
    if (plain == "SpatialSlider::derivative") return fullness " derivative"
    if (plain == "Joint::add_faces") return fullness " faces"
    if (plain ~ /Law::normals$/) return "lean law"
    if (plain ~ /Law::forces$/) return "full law"
    if (plain == "SpatialSlider::linearise") return "linearisation"
    if (plain == "JointLinearisation::add_face") return "linearised faces"
    if (plain ~ /Law::stiffness$/) return "linearised law"
    # The stepper is the first argument.
    stepper = match_of(name, "(::work<|CrossingSearch<)[A-Za-z0-9]+")
    sub(/.*</, "", stepper)
    return plain (stepper == "" ? "" : " " stepper)
}

BEGIN { OFS = "\t" }
{ gsub(/slideway::(cuda::)?/, "") }
/Compiling entry function/ {
    architecture = match_of($0, "sm_[0-9a-z]+'$")
    sub(/'/, "", architecture)
    kernel = /integrate_members<Shadowed</ ? "shadowed" : "members"
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
        print architecture, kernel, function_of(name), $1, $5, $9, ""
    }
}
/Used [0-9]+ registers/ {
    print architecture, kernel, "kernel", entry_frame, entry_stores, entry_loads, match_of($0, "[0-9]+ registers") + 0
}
