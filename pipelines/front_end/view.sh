# shellcheck shell=bash
# The page that shows what is in OUT. To be sourced.
# shellcheck disable=SC2154  # what other files of the front end set

# The page of the viewer without data: installed with varimap, or built with npm beside the executables.
viewer_frame() {
    local frame=$share/view/frame.html file
    [[ ! -s $frame ]] || { echo "$frame"; return; }
    frame=$(realpath -m -- "$VARIMAP_BIN/../view/frame.html")
    for file in "$share"/view/*.* "$share"/view/src/*.js; do
        [[ $frame -nt $file ]] || { build_frame "$frame"; break; }
    done
    echo "$frame"
}

build_frame() {  # FILE
    [[ -x $share/view/build ]] || fail 6 "this varimap was installed without its viewer: in its source folder run pipelines/view/build build/view/frame.html, and install it again"
    command -v npm >/dev/null ||
        fail 6 "npm is missing, which the viewer is built with; install it (Debian: apt-get install npm), nothing else needs it"
    "$share/view/build" "$1" >&2 || fail 6 "cannot build the viewer: npm needs the network once"
}

view_usage='varimap view OUT [-o PAGE] [--texture FILE] [--landmark-space AXES] [--landmark-base 0|1]'
# view OUT ...: OUT/view.html or another page that shows what is in OUT.
view() {
    local result hashes i out page='' more=() frame
    local -A reading=()
    out=$(of_folder "$1")
    read_view_options "${@:2}"
    find_result "$out"
    for i in "${!more[@]}"; do more[i]=$(stand_in "$out" "${more[i]}"); done
    frame=$(viewer_frame)
    show_landmarks
    show_exploration
    [[ $page ]] && page=$(of_folder "$page") || page=$out/view.html
    with_temporary_folder write_page "$out" "${result[@]}" "$frame" "$page" "${hashes[@]}" "${more[@]}"
}

# These follow in the variables of view: the page, options of the executable, and how landmarks are to be read.
read_view_options() {
    local parameter
    while (($#)); do
        case $1 in
        --texture=*) more+=("$1") ;;
        --out=*) page=${1#*=} ;;
        -o?*) page=${1#-o} ;;
        --landmark[-_]space=* | --landmark[-_]base=*) parameter=${1%%=*} reading[${parameter#--landmark?}]=${1#*=} ;;
        -o) set -- --out "${@:2}"; continue ;;
        --out | --texture | --landmark[-_]space | --landmark[-_]base)
            (($# > 1)) || fail 2 "$1 needs a value; say $view_usage"
            set -- "$1=$2" "${@:3}"
            continue
            ;;
        *) fail 2 "$1: not understood; say $view_usage" ;;
        esac
        shift
    done
}

show_landmarks() {
    local list=() parameter value diffusion
    mapfile -t list < <(jq -r '.provenance.landmarks[]?.file' "$out/quality.json")
    if ((${#list[@]})) && [[ -f ${list[0]} && -f ${list[-1]} ]]; then more+=(--landmarks "${list[@]}"); fi
    # The stage knows how it read them, whoever told it.
    diffusion=$out/artifacts/$(jq -r '[.stages | keys[] | select(startswith("diffuse "))][0] // "" | sub("^diffuse "; "")' \
        "$out/quality.json").diffusion
    for parameter in space base; do
        value=${reading[$parameter]:-}
        [[ $value || ! -f $diffusion ]] || value=$(sed -n "/^parameter landmark_$parameter /{s///p;q}" "$diffusion")
        [[ -z $value ]] || more+=("--landmark_$parameter=$value")
    done
}

show_exploration() {
    local pair
    if jq -e 'any(.stages | keys[]; test("^diffuse .*[.]mirrored--"))' "$out/quality.json" >/dev/null; then more+=(--mirror); fi
    pair=$(jq -r 'if .exploration then [.stages | keys[] | select(test("^explore .*--"))][0] // "" else "" end' "$out/quality.json")
    pair=$out/artifacts/${pair#explore }.candidates
    [[ ! -f $pair ]] || more+=(--candidates "$pair")
}

write_page() {  # FOLDER OUT ARGUMENT...: of the executable
    jq "$(words_of_quality)report" "$2/quality.json" >"$1/report.json" || fail 6 "$1/report.json: cannot be written"
    "$VARIMAP_BIN/varimap-view" "${@:3}" --report "$1/report.json"
}
