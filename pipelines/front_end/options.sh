# shellcheck shell=bash
# The command line of varimap map. To be sourced.
# shellcheck disable=SC2154  # what other files of the front end set

# shellcheck disable=SC2034  # for script.sh
explains='varimap help map'
declare -A options=([landmarks]=words [part]=value [mirror]=flag [candidate]=value [out]=value [cores]=value [artifacts]=value
    [initial-map]=value [map-base]=value [until]=value [ascii]=flag [quiet]=flag [verbose]=flag [json]=flag [help]=flag)
take_options_of_maps
words=()            # SOURCE, TARGET and landmark files, in the order given
landmarks_at=-1     # how many words came before --landmarks
landmarks_run=0     # how many words follow it directly
after_landmarks=0   # whether the next word follows it directly
landmark_options=() # those given that say how landmarks are read and hold
part='' explore='' candidate='' initial_map='' map_base='' mirror='' full_resolution='' quiet='' verbose='' json='' until=''
goals=(preprocess coarsen eigen hierarchy sketches locate explore diffuse refine relax remesh render)
out='' artifacts='' config='' cores=${SLURM_CPUS_PER_TASK:-$(cores_here)}
recorded=()         # options and their values, empty of flags: those that say what map is made

option() {  # NAME [VALUE]
    after_landmarks=0
    case $1 in
    landmarks | out | cores | artifacts | until | quiet | verbose | json | help) ;;
    config) recorded+=(--config "${2:+$(realpath -m -s -- "$2")}") ;;
    *) recorded+=("--$1" "${2:-}") ;;
    esac
    case $1 in
    landmarks)
        ((landmarks_at < 0)) || fail 2 "--landmarks is given twice"
        landmarks_at=${#words[@]} after_landmarks=1
        ;;
    part)
        [[ $2 == source || $2 == target ]] || fail 2 "--part ${2:-''}: say source or target, whichever is a part of the other"
        [[ -z $part || $part == "$2" ]] || fail 2 "--part $2: --part $part was given, too; one of them is the part"
        part=$2
        ;;
    explore | mirror | full-resolution | quiet | verbose | json) printf -v "${1//-/_}" yes ;;
    initial-map | out | artifacts | config | until | cores) printf -v "${1//-/_}" %s "$2" ;;
    help) help_topic map; exit ;;
    *) option_of_stages "$@" ;;
    esac
}

option_of_stages() {  # NAME [VALUE]: what is a parameter of theirs
    local as_typed="--$1 ${2:-''}"
    [[ $1 != landmark-* ]] || landmark_options+=("--$1")
    case $1 in
    ascii) set_in --ascii ascii_ply true remesh ;;
    landmark-vicinity) set_in "$as_typed" vicinity_weight "$2" explore diffuse refine ;;
    landmark-weight) set_in "$as_typed" landmark_weight "$2" explore diffuse ;;
    landmark-space | landmark-base) set_in "$as_typed" "${1/-/_}" "$2" locate explore diffuse render ;;
    candidate | map-base) printf -v "${1/-/_}" %s "$2"; set_in "$as_typed" "${1/-/_}" "$2" diffuse ;;
    area-bound | area-energy) set_in "$as_typed" "${1/-/_}" "$2" diffuse refine ;;
    repair | components | fill-holes | cut-handles) set_in "$as_typed" "${1/-/_}" "$2" preprocess ;;
    set) add_setting "$2" ;;
    esac
}

word() {
    words+=("$1")
    ((landmarks_run += after_landmarks)) || true
}

# Two words are the meshes; those beyond two are landmark files and stand directly behind --landmarks.
split_words() {
    local lists=$((${#words[@]} - 2))
    ((lists >= 0)) || fail 2 "two meshes are needed: varimap map SOURCE TARGET -o OUT"
    ((landmarks_at < 0 || lists > 0)) || fail 2 "--landmarks needs a file, besides SOURCE and TARGET"
    ((landmarks_at >= 0)) || landmarks_at=2
    ((lists <= 2 && lists <= landmarks_run)) || fail 2 "too many files: ${words[*]:2}; varimap help map explains"
    landmarks=("${words[@]:landmarks_at:lists}")
    meshes=("${words[@]:0:landmarks_at}" "${words[@]:landmarks_at+lists}")
}

check_arguments() {
    local file
    [[ -n $out ]] || fail 2 "say where the results go: -o OUT"
    ((${#landmark_options[@]} == 0 || ${#landmarks[@]} > 0)) || fail 2 "${landmark_options[0]} needs --landmarks"
    [[ -z $map_base || -n $initial_map ]] || fail 2 "--map-base needs --initial-map"
    [[ -z $initial_map || -z $explore$candidate ]] ||
        fail 2 "--initial-map is the map to refine: --explore and --candidate look for another"
    check_idle_options
    [[ -z $quiet || -z $verbose$json ]] || fail 2 "--quiet goes with neither --verbose nor --json"
    [[ -z $verbose || -z $json ]] || fail 2 "--verbose and --json: one of them"
    require_cores "$cores"
    [[ -z $until || " ${goals[*]} " == *" $until "* ]] || fail 2 "--until $until: say one of ${goals[*]}"
    [[ $until != render ]] || until=''  # the whole way
    for file in "${meshes[@]}" "${landmarks[@]}" ${initial_map:+"$initial_map"} ${config:+"$config"}; do require_file "$file"; done
    require make
    require jq
    require flock
    require_stages
    require_import "${meshes[@]}"
}

# What is about a stage that does not run. Parameters may be for several runs, of which some have it.
check_idle_options() {
    local key reason
    local -A idle=()
    [[ -z $full_resolution ]] || idle[coarsen]="with --full-resolution no coarse surfaces are made"
    [[ $part ]] || idle[locate]="without --part no part is looked for"
    [[ ! $part || ${#landmarks[@]} -gt 0 || $explore ]] || idle[explore]="with --part nothing is explored without landmarks; add --explore"
    [[ ${settings[diffuse.start]:-} != wasserstein || $explore ]] || idle[explore]="with diffuse.start=wasserstein no other map is looked for"
    [[ ! $initial_map ]] || idle[explore]="with --initial-map no map is looked for"
    for key in "${!settings[@]}"; do
        reason=${idle[${key%%.*}]:-}
        [[ -z $reason || $json || ${given_by[$key]} != "--set "* ]] || warn "${given_by[$key]} has no effect: $reason"
    done
    [[ $until != locate || -z ${idle[locate]:-} ]] || fail 2 "--until locate: ${idle[locate]}"
    candidate=${settings[diffuse.candidate]:-}
    [[ -z $candidate || -z ${idle[explore]:-} ]] || fail 2 "${given_by[diffuse.candidate]}: ${idle[explore]}"
}

# With other landmarks other maps are found, of which the K-th is not the one that was looked at.
warn_of_other_candidates() {
    local before=() now=() file
    [[ -n ${settings[diffuse.candidate]:-} && -z $json && -f $out/quality.json ]] || return 0
    mapfile -t before < <(jq -r '.provenance.landmarks[]?.file' "$out/quality.json" 2>/dev/null)
    ((${#landmarks[@]} == 0)) || mapfile -t now < <(realpath -s -- "${landmarks[@]}")
    if [[ "${before[*]}" == "${now[*]}" ]]; then
        for file in "${now[@]}"; do
            [[ ! $file -nt $out/quality.json ]] || warn "$file was written to after the map in $out was made: candidate ${settings[diffuse.candidate]} may be another one than in the list made then"
        done
        return 0
    fi
    warn "the map in $out was made with ${before[*]:-no landmarks}: candidate ${settings[diffuse.candidate]} is not of the list found then"
}
