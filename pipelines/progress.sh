# shellcheck shell=bash
# What a run shows of itself while it goes on. To be sourced.

# How long each stage usually takes beside the others, in the order in which they run; and what it does.
progress_stages=(import preprocess coarsen eigen hierarchy locate explore diffuse refine relax remesh render)
declare -A progress_share=([import]=1 [preprocess]=2 [coarsen]=3 [eigen]=5 [hierarchy]=3 [locate]=30 [explore]=150 [diffuse]=12 [refine]=8
    [relax]=14 [remesh]=2 [render]=6)
declare -A progress_words=([import]="importing" [preprocess]="reading and repairing" [coarsen]="coarsening" [eigen]="eigenfunctions"
    [hierarchy]="choosing samples" [locate]="looking for the part" [explore]="looking for the map" [diffuse]="the map, roughly" [refine]="the map, finely"
    [relax]="smoothing it, no folds" [remesh]="measuring, writing" [render]="drawing the picture")

# show_progress LOG KIND EXPLORES LOCATES: reads what the stages say, line by line, appends it to LOG, and shows on stderr how far
# they are. KIND: line (one line for each stage, with a bar, redrawn: for terminals), plain (a line every ten seconds) or
# json (an object for each stage that begins or ends). EXPLORES: yes where the map is looked for, LOCATES: where a part is. A LOG that cannot be
# written stops nothing.
show_progress() {
    local kind=$2 line='' piece log fd_open=yes
    local -A open=()
    local begun=$SECONDS stage='' stage_begun=$SECONDS told=$SECONDS at=0 all=0 before=0 name shown='' colour='' plain=''
    [[ $3 ]] || progress_share[explore]=0
    [[ ${4:-} ]] || progress_share[locate]=0
    for name in "${progress_stages[@]}"; do ((all += progress_share[$name])); done
    if [[ $kind == line && -z ${NO_COLOR:-} ]]; then colour=$'\e[36m' plain=$'\e[0m'; fi
    true >&2 || exec 2>/dev/null  # closed
    { exec {log}>>"$1"; } 2>/dev/null || fd_open=''
    while true; do
        if IFS= read -r -t 0.5 piece; then
            line+=$piece
            [[ -z $fd_open ]] || { printf '%s\n' "$line" >&"$log"; } 2>/dev/null || true
            note_line
            line=''
        elif (($? > 128)); then
            line+=$piece
        else
            break
        fi
        say_progress
    done
    [[ -z $fd_open || -z $line ]] || { printf '%s\n' "$line" >&"$log"; } 2>/dev/null || true
    [[ $kind != line || -z $stage ]] || end_stage
}

# The variables of show_progress follow a line of the log.
note_line() {
    [[ $line =~ ^\[([a-z]+)\]\ (done:)? ]] || return 0
    name=${BASH_REMATCH[1]}
    [[ -n ${progress_words[$name]:-} ]] || return 0
    if [[ $kind == json ]]; then say_event; return; fi
    [[ $name != "$stage" && -z ${BASH_REMATCH[2]} ]] || return 0
    # The two surfaces' stages run side by side, and sketches have them once more: only what is further on counts.
    local i reached=0
    for i in "${!progress_stages[@]}"; do [[ ${progress_stages[i]} != "$name" ]] || reached=$i; done
    [[ -z $stage || $reached -gt $at ]] || return 0
    [[ $kind != line || -z $stage ]] || end_stage
    stage=$name stage_begun=$SECONDS at=$reached before=0
    for ((i = 0; i < at; ++i)); do ((before += progress_share[${progress_stages[i]}])) || true; done
}

# Beginnings and ends of a stage take turns: of one that runs for both surfaces at once, the second beginning is told once the
# first has ended.
say_event() {
    [[ ${open[$name]:-} ]] || tell_event begins
    open[$name]=yes
    [[ ${BASH_REMATCH[2]} ]] || return 0
    tell_event ends
    open[$name]=''
}
tell_event() { printf '{"stage": "%s", "event": "%s", "seconds": %d}\n' "$name" "$1" $((SECONDS - begun)) >&2 || true; }

# Per mille of the run that is done; within a stage as time passes, as far as the stages before tell.
done_so_far() {
    local spent=$((SECONDS - begun)) in_stage=$((SECONDS - stage_begun)) share=${progress_share[$stage]} inside=0
    if ((before > 0 && spent > in_stage)); then
        inside=$((in_stage * before / (spent - in_stage)))
        ((inside <= share * 9 / 10)) || inside=$((share * 9 / 10))
    fi
    echo $(((before + inside) * 1000 / all))
}

clock() {  # SECONDS
    if (($1 < 100)); then echo "$1 s"; else printf '%d:%02d min\n' $(($1 / 60)) $(($1 % 60)); fi
}

# "12 s, about 30 s to go"
time_left() {  # PER MILLE
    local spent=$((SECONDS - begun)) text
    ((spent >= 0)) || spent=0
    text=$(clock "$spent")
    if (($1 >= 100 && spent >= 3)); then text+=", about $(clock $((spent * (1000 - $1) / $1 + 1))) to go"; fi
    echo "$text"
}

say_progress() {
    [[ -n $stage && $kind != json ]] || return 0
    local share bar text
    if [[ $kind == plain ]]; then
        ((SECONDS - told >= 10)) || return 0
        told=$SECONDS
        share=$(done_so_far)
        echo "varimap: ${progress_words[$stage]}, $((share / 10)) %, $(time_left "$share")" >&2 || true
        return
    fi
    share=$(done_so_far)
    printf -v bar '%*s' $((share / 50)) ''
    printf -v text '\r%-24s %s%-20s%s %3d %%  %s\e[K' "${progress_words[$stage]}" "$colour" "${bar// /#}" "$plain" \
        $((share / 10)) "$(time_left "$share")"
    [[ $text == "$shown" ]] || printf '%s' "$text" >&2 || true
    shown=$text
}

end_stage() {
    printf '\r%-24s %s\e[K\n' "${progress_words[$stage]}" "$(clock $((SECONDS - stage_begun)))" >&2 || true
}
