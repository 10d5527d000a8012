# shellcheck shell=bash
# What was finished in OUT, for those that use it. To be sourced.
# shellcheck disable=SC2154  # what other files of the front end set

require_result() {  # OUT of a finished run
    local file pairs
    [[ -e $1 ]] || fail 6 "$1: no such folder; give the OUT of varimap map first"
    for pairs in "$1/pairs" "$1/maps/pairs"; do
        [[ -f $1/quality.json || ! -d $pairs ]] || fail 6 "$1: holds the maps of many pairs; give one of them: $pairs/NAME"
    done
    [[ -f $1/quality.json ]] || fail 6 "$1: holds no finished map (no quality.json); run varimap map ... -o $1"
    require jq
    [[ $(jq '.provenance | .source.file and .target.file' "$1/quality.json" 2>/dev/null || true) == true ]] ||
        fail 4 "$1/quality.json: damaged; run varimap map ... -o $1 again"
    for file in source_to_target target_to_source; do
        [[ -f $1/$file.csv ]] || fail 6 "$1/$file.csv: is missing; run varimap map ... -o $1 again"
    done
}

# The meshes and tables that a finished run left in OUT, as arguments of an executable, in the array `result`.
find_result() {  # OUT
    local side file hash
    require_result "$1"
    result=() hashes=()
    for side in source target; do
        file=$(jq -r ".provenance.$side.file" "$1/quality.json")
        hash=$(jq -r ".provenance.$side.hash // empty" "$1/quality.json")
        # Within a condition errors alone do not end the shell.
        file=$(mesh_of_result "$1" "$side" "$file") || exit
        [[ -f $file ]] || file=$(input_of_result "$1" "$side" "$file")
        [[ -f $file ]] || file=$(moved_with "$1" "$(mesh_behind "$1" "$file")" "$hash")
        [[ -f $file ]] || fail 6 "$file: the mesh is not there any more; put it back, or make the map again"
        result+=("$file") hashes+=("--$side-hash" "$hash")
    done
    result+=("$1"/{source_to_target,target_to_source}.csv)
}

# Why what lies there is no longer what the map in OUT was made from: a line, or nothing.
changed_since() {  # OUT
    local reason
    reason=$( (find_result "$1" && require_same_inputs "$1") 2>&1) || printable "$(error_in "$reason")"
}

require_same_inputs() {  # OUT: as transfer and view do, for what reads no mesh; of `result`, and of landmarks that are there
    local i file hash
    is_tool inspect || return 0
    for i in 0 1; do
        has_hash "${result[i]}" "${hashes[2 * i + 1]}" ||
            fail 4 "$(realpath -- "${result[i]}"): changed since the map was made; make the map again"
    done
    while IFS= read -r -d '' hash && IFS= read -r -d '' file; do
        [[ ! -f $file ]] || has_hash "$file" "$hash" || fail 4 "$file: changed since the map was made; make the map again"
    done < <(jq -j '.provenance.landmarks[]? | "\(.hash // "")\u0000\(.file)\u0000"' "$1/quality.json")
}

# has_hash FILE HASH: whether it has the content of that hash; of none it is taken to have it.
has_hash() {
    [[ -z $2 || $("$VARIMAP_BIN/varimap-inspect" --hash "$1" 2>/dev/null) == "$2 "* ]]
}

# moved_with OUT FILE HASH: where FILE went if it was moved together with OUT: it lies below a folder above OUT, as it did. Else FILE.
moved_with() {
    local above here below rest
    above=$(realpath -- "$1")
    while [[ -n $3 && $above == */* ]] && is_tool inspect; do
        above=${above%/*} below=${2##*/} rest=${2%/*}
        while :; do
            here=$above/$below
            [[ ! -f $here ]] || ! has_hash "$here" "$3" || { echo "$here"; return; }
            [[ $rest == */* ]] || break
            below=${rest##*/}/$below rest=${rest%/*}
        done
    done
    echo "$2"
}

# mesh_behind OUT FILE: of a batch that was moved, the mesh that its link of that name led to; else FILE.
mesh_behind() { readlink -- "$1/../../meshes/${2##*/}" || echo "$2"; }

# mesh_of_result OUT SIDE FILE: FILE, which the map in OUT was made from. What was imported lies in OUT, and of a batch
# links to all meshes in the folder above, wherever these were moved. Of a scene it must still be what that holds.
mesh_of_result() {
    local scene file=$3
    [[ -f $file || ! -f $1/../../meshes/${file##*/} ]] || file=$1/../../meshes/${file##*/}
    scene=$(jq -r ".provenance.$2.imported_from // empty" "$1/quality.json")
    [[ -n $scene ]] || { echo "$file"; return; }
    [[ -f $file ]] || file=$1/artifacts/${file##*/}
    [[ -f $file ]] || fail 6 "$file: what was imported from $scene is not there any more; make the map again"
    if [[ -f $scene ]] && is_tool import; then
        with_temporary_folder require_same_scene "$scene" "$file" || exit
    fi
    echo "$file"
}

require_same_scene() {  # FOLDER SCENE, and what was IMPORTED from it
    local imported=$1/${3##*/}
    { "$VARIMAP_BIN/varimap-import" "$2" "$imported" >"$1/log" 2>&1 && cmp -s -- "$imported" "$3"; } ||
        fail 4 "$2: is no longer the scene that was mapped; put it back, or make the map again"
}

# input_of_result OUT SIDE FILE: where the link to that mesh leads, FILE without one: JSON holds no name that is not UTF-8.
input_of_result() {
    local name link
    name=$(jq -r --arg side "$2" '[.stages | keys[] | select(startswith("diffuse "))][0] // "" | sub("^diffuse "; "") | sub("[.](source|target)-part$"; "")
        | split("--") | if $side == "source" then .[0] // "" | sub("[.]mirrored$"; "") else .[1] // "" end' "$1/quality.json")
    link=$1/artifacts/inputs/$name
    [[ -n $name && -L $link && -f $link ]] && realpath -s -- "$(readlink -- "$link")" || echo "$3"
}

# of_result COMMAND QUESTION [OUT ...]: the function of that name on what was finished in OUT. Files instead of a folder, or options
# alone, are for the executable; without any argument QUESTION is said.
of_result() {
    local command=$1 question=$2
    shift 2
    require_tool "$command"
    ! asks_for_help "${1:-}" || { help_topic "$command"; exit; }
    (($#)) || fail 2 "$question"
    if [[ -d $1 || (-n $1 && $1 != -* && ! -f $1) ]]; then "$command" "$@"; return; fi
    # Options alone, and among them a folder that they are not to write to.
    local word before=''
    [[ $1 != -* ]] || for word in "$@"; do
        [[ ! -f $word/quality.json || $before =~ ^(-o|--out)$ ]] ||
            fail 2 "$word: the folder of the map comes first: varimap $command $(printf '%q' "$word") ..."
        before=$word
    done
    exec "$VARIMAP_BIN/varimap-$command" "$@"
}

# of_folder OUT: a name that no program takes for an option.
of_folder() {
    [[ $1 == -* ]] && echo "./$1" || echo "$1"
}

# stand_in OUT WORD: of a file that the map in OUT (in `result`) was made from by importing it, the OBJ that stands for it, also behind
# --option=; all else as it is.
stand_in() {
    local file=$2 option='' side=''
    [[ $file != --*=* ]] || option=${file%%=*}= file=${file#*=}
    if [[ -f $file ]]; then
        side=$(jq -r --arg file "$(realpath -- "$file")" \
            '.provenance | if .source.imported_from == $file then 0 elif .target.imported_from == $file then 1 else empty end' \
            "$1/quality.json")
    fi
    [[ -z $side ]] || file=${result[side]}
    echo "$option$file"
}
