# shellcheck shell=bash
# Running the stages of varimap map, by make. To be sourced.
# shellcheck disable=SC2154  # what other files of the front end set

stages=(preprocess coarsen eigen hierarchy locate explore diffuse refine relax remesh render)
require_stages() {
    local stage
    for stage in "${stages[@]}"; do require_tool "$stage"; done
}

messages='' codes='' ran='' make_log='' log_fd='' log_pid=''

# What the stages say goes to the end of OUT/log.txt; to stderr goes how far they are, or with --verbose all they say. A log
# that cannot be written stops nothing; interrupts are for the stages, whose last words it takes.
open_log() {
    local shown=2 kind=plain explores=''
    if [[ $json ]]; then kind=json; elif [[ -t 2 && ${TERM:-dumb} != dumb ]]; then kind=line; fi
    [[ $initial_map || ((${#landmarks[@]} -gt 0 || $part) && -z $explore) ]] || explores=yes
    printf '%s\n' "$VARIMAP_COMMAND" 2>/dev/null >>"$out/log.txt" || true
    if [[ $quiet ]]; then exec {shown}>/dev/null; fi
    if [[ $quiet || $verbose ]]; then
        exec {log_fd}> >(trap '' INT TERM HUP; exec tee -a -- "$out/log.txt" 1>&"$shown" 2>/dev/null)
    else
        exec {log_fd}> >(trap '' INT TERM HUP; show_progress "$out/log.txt" "$kind" "$explores" "$part")
    fi
    log_pid=$!
    if [[ $quiet ]]; then exec {shown}>&-; fi
}

# Waits until all is written that was said.
close_log() {
    [[ -n $log_fd ]] || return 0
    exec {log_fd}>&-
    wait "$log_pid" 2>/dev/null || true
    log_fd=''
}

run_make() {
    : >"$messages"
    : >"$codes"
    : >"$ran"
    set -m
    "${make_alone[@]}" -f "$share/Makefile" "$@" FAILURES="$messages" FAILURE_CODES="$codes" \
        RAN="$ran" STAGE_STDERR=3 </dev/null 3>&"$log_fd" {log_fd}>&- 2>"$make_log" >&2 &
    await
}

# The exit code of the first stage that failed; 70 where none did, but make itself.
failure_code() {
    [[ -s $codes ]] && head -n 1 "$codes" || echo 70
}

# The message of that stage, or what happened to it, as the last line.
explain_failure() {
    local code message=''
    close_log
    code=$(failure_code)
    if [[ -s $messages ]]; then
        message=$(head -n 1 "$messages")
        [[ $message != [0-9]*\ * ]] || code=${message%% *} message=${message#* }
    elif [[ ! -s $codes ]]; then
        message="varimap: error: $(tail -n 1 "$make_log")"
    elif ((code == 128 + 9 || code == 128 + 15 || code == 128 + 2 || code == 128 + 1)); then
        message="varimap: error: a stage was killed by signal $((code - 128)) (out of memory?); what is finished is kept"
    else
        message="varimap: error: a stage crashed (exit code $code), which is a defect of varimap; what is finished is kept"
        code=70
    fi
    complain "$(from_outside "$message")"
    exit "$code"
}

# from_outside MESSAGE: paths in it that begin in OUT, where make runs, as the user would write them.
from_outside() {
    local message=$1 before
    for before in "'" ' '; do
        message=${message//"${before}artifacts/"/"$before./artifacts/"}
        message=${message//"$before./"/"$before$shown/"}
    done
    echo "$message"
}

# Another run that shares the artifacts may make some anew, with other parameters, between two stages of this one. Then
# lineages do not fit (4), or a file changes while it is read, or all fit again, and the map is that of the other parameters.
# Starting again mends that, one such run at a time; all is well once no stage finds anything to do.
make_with_patience() {
    local code turn='' attempt said='' alike=yes
    for attempt in 1 2 3 4 5; do
        if ((attempt > 1)) && [[ -e artifacts/.shared && -z $turn ]] && { exec {turn}>>artifacts/.turn; } 2>/dev/null; then
            until flock -n "$turn" || (($? != 1)); do sleep .2; done
        fi
        code=0
        run_make "$@" || code=$?
        [[ $code != 0 || (-s $ran && -e artifacts/.shared) ]] || { [[ ! $turn ]] || exec {turn}>&-; return 0; }
        [[ -z $said || $said == $(head -n 1 "$messages") ]] || alike=''
        said=$(head -n 1 "$messages")
        ((code)) || [[ $until ]] || rm -f -- quality.json  # it tells of parameters that the map may not have
        [[ $code == 0 || $(failure_code) == 4 || $(head -n 1 "$messages") == *'; run again' ]] || break
    done
    ((code == 0)) || [[ -e artifacts/.shared && (! $alike || $said == *'; run again') ]] || explain_failure
    close_log
    [[ $until ]] || rm -f -- quality.json
    fail 4 "$shown/artifacts: other runs make the same files there with other parameters, all the time; start this one again when they have ended, or give it another --artifacts"
}

# Names of files, and options, may hold anything: make finds them in the environment, by numbers where there are several.
export_inputs() {  # sets `numbers`, of the files of landmarks
    local i
    VARIMAP_SOURCE=$(realpath -s -- "${meshes[0]}")
    VARIMAP_TARGET=$(realpath -s -- "${meshes[1]}")
    VARIMAP_OPTIONS=$(printf '%s\0' "${recorded[@]}" | jq -R -s -c 'split("\u0000") as $words
        | [range(0; $words | length - 1; 2) as $i | $words[$i:$i + 2] | map(select(. != "")) | select(length > 0)]')
    export VARIMAP_SOURCE VARIMAP_TARGET VARIMAP_COMMAND VARIMAP_OPTIONS VARIMAP_SHARE=$share
    for i in "${!landmarks[@]}"; do
        numbers+=($((i + 1)))
        export "VARIMAP_LANDMARKS_$((i + 1))=$(realpath -s -- "${landmarks[i]}")"
    done
    if [[ -n $initial_map ]]; then
        VARIMAP_INITIAL_MAP=$(realpath -s -- "$initial_map")
        export VARIMAP_INITIAL_MAP
    fi
}

make_map() {  # sets `source` and `target`, the surfaces' names
    local import=() numbers=() surface_cores=$((cores > 1 ? cores / 2 : 1)) make_arguments=("${flags[@]}")
    export_inputs
    cd -- "$out" || fail 6 "$shown: cannot be entered"
    source=$(name_of_mesh "$VARIMAP_SOURCE")
    target=$(name_of_mesh "$VARIMAP_TARGET")
    # What is imported may name files beside it, beside a link they are not.
    ! is_foreign "$VARIMAP_SOURCE" || { import+=(source); VARIMAP_SOURCE=$(realpath -- "$VARIMAP_SOURCE"); }
    ! is_foreign "$VARIMAP_TARGET" || { import+=(target); VARIMAP_TARGET=$(realpath -- "$VARIMAP_TARGET"); }
    [[ -z $explore ]] || make_arguments+=(EXPLORE=yes)
    [[ -z $initial_map ]] || make_arguments+=(INITIAL_MAP=1)
    # Two jobs: the surfaces' stages run side by side, with half of the cores each.
    make_with_patience -j $((cores > 1 ? 2 : 1)) OUT=. ARTIFACTS=artifacts SOURCE="$source" TARGET="$target" \
        LANDMARKS="${numbers[*]}" FILES_IN_ENVIRONMENT=yes IMPORT="${import[*]}" MIRROR="$mirror" PART="$part" FULL_RESOLUTION="$full_resolution" \
        THREADS="$cores" SURFACE_THREADS="$surface_cores" "${make_arguments[@]}" ${until:+"until-$until"}
}
