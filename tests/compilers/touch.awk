# LLVM's code for NVIDIA, with a call of plait_touch(kind, amount) before what reads and writes memory. Of
# address space 0 is private memory, 1 the device's, 3 the work-group's; what a kernel reads of its
# parameters, which are handed over by value, is in neither. Kinds are those of kernel_bytes.cpp.
function size_of(type,   n) {
    if (match(type, /^<[0-9]+ x /)) {
        n = substr(type, 2, RLENGTH - 4) + 0
        sub(/^<[0-9]+ x /, "", type)
        sub(/>$/, "", type)
        return n * size_of(type)
    }
    if (type ~ /^ptr/ || type == "i64" || type == "double") return 8
    if (type == "float" || type == "i32") return 4
    if (type == "i16") return 2
    if (type == "i8" || type == "i1") return 1
    print "touch.awk: what size has " type "?" >"/dev/stderr"
    failed = 1
    exit 1
}
function space_of(pointer) { # "ptr", "ptr addrspace(1)"
    return match(pointer, /addrspace\([0-9]\)/) ? substr(pointer, RSTART + 10, 1) + 0 : 0
}
function touch(space, written, amount) {
    if (space == 4) return # constants
    print "  call void @plait_touch(i32 " (space == 0 ? 0 : space == 1 ? 2 : 4) + written ", i64 " amount ")"
}
/^define/ {
    delete parameter
    if (match($0, /byval\([^)]*\) align [0-9]+ %[0-9]+/)) {
        name = substr($0, RSTART, RLENGTH)
        sub(/.* /, "", name)
        parameter[name] = 1
    }
}
/ = getelementptr / && match($0, /ptr %[0-9]+/) && (substr($0, RSTART + 4, RLENGTH - 4) in parameter) { parameter[$1] = 1 }
/^ +%[0-9]+ = load / {
    text = $0
    sub(/^.* = load (volatile )?/, "", text)
    type = text
    sub(/, ptr.*/, "", type)
    pointer = substr(text, length(type) + 3)
    name = pointer
    sub(/^ptr (addrspace\([0-9]\) )?/, "", name)
    sub(/,.*/, "", name)
    if (!(name in parameter)) touch(space_of(substr(pointer, 1, 20)), 0, size_of(type))
}
/^ +store / {
    text = $0
    sub(/^ +store (volatile )?/, "", text)
    type = text
    if (text ~ /^<[0-9]+ x [a-z0-9]+>/) sub(/>.*/, ">", type)
    else sub(/ .*/, "", type)
    match(text, /, ptr( addrspace\([0-9]\))? [%@]/)
    touch(space_of(substr(text, RSTART, RLENGTH)), 1, size_of(type))
}
/ = atomicrmw / { print "  call void @plait_touch(i32 " ($0 ~ /addrspace\(3\)/ ? 7 : 6) ", i64 1)" }
/call void @llvm\.mem(cpy|set)/ {
    match($0, /, i64 [%0-9]+, i1 /)
    amount = substr($0, RSTART + 6, RLENGTH - 11)
    split($0, part, /[(]ptr |, ptr /)
    touch(space_of(substr(part[2], 1, 15)), 1, amount)
    if ($0 ~ /memcpy/) {
        name = part[3]
        sub(/,.*/, "", name)
        sub(/.* /, "", name)
        if (!(name in parameter)) touch(space_of(substr(part[3], 1, 15)), 0, amount)
    }
}
{ print }
END {
    if (failed) exit 1
    print "declare void @plait_touch(i32, i64)"
}
