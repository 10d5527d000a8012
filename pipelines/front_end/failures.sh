# shellcheck shell=bash
# How a command of the front end notes what goes wrong, and ends. To be sourced.

# open_notes VARIABLE...: sets each to the path of a file without a name: the disk of OUT may be full or its folder gone, and a kill
# leaves nothing behind.
open_notes() {
    local folder file note fd
    for folder in /dev/shm "${TMPDIR:-/tmp}" ${out:+"$out"}; do
        for note in "$@"; do
            file=$(mktemp -- "$folder/varimap.XXXXXX" 2>/dev/null) || continue 2
            exec {fd}<>"$file"
            rm -f -- "$file"
            printf -v "$note" '/dev/fd/%d' "$fd"
        done
        return
    done
    fail 6 "no folder for temporary files can be written to: /dev/shm, ${TMPDIR:-/tmp}${out:+, $out}"
}

# tell_failures ARGUMENT...: of a command that takes --json. Where that is among them, a failure is told on stdout as well; what is
# said may come from a shell within this one, so it is noted.
tell_failures() {
    local word
    trap ended EXIT
    for word in "$@"; do
        [[ $word != -- ]] || break
        [[ $word != --json || $failure_note ]] || open_notes failure_note
    done
}

# What nobody foresaw is a defect, and says so: code 1 has no meaning.
ended() {
    local code=$?
    if ((code == 1)); then
        code=70
        complain "varimap: error: internal: a command failed; what is finished is kept"
    fi
    ((code == 0)) || [[ -z $failure_note ]] || failure_json "$code" 2>/dev/null || true
    exit "$code"
}

failure_json() {  # CODE
    local message
    message=$(error_in "$(<"$failure_note")")
    message=${message//\\/\\\\}
    printf '{"error": "%s", "code": %d}\n' "${message//\"/\\\"}" "$1"
}
