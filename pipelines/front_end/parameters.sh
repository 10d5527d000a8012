# shellcheck shell=bash
# Parameters of stages, as options of varimap map give them. To be sourced.
# shellcheck disable=SC2154  # what other files of the front end set

declare -A settings=()  # STAGE.PARAM to VALUE; the last one given counts
declare -A given_by=()  # the same to the option that gave it

set_parameter() {  # TYPED STAGE PARAM VALUE
    # What the pipeline itself gives, and what flags_of asks with. What else is none the stage says.
    [[ ! $3 =~ ^(onto_itself|only_if_needed|config|parameters|help)$ && $2.$3 != locate.part ]] || fail 2 "$1: $3 is not a parameter"
    [[ $3 != mirror ]] || fail 2 "$1: say --mirror, which is of the source alone"
    [[ $4 =~ ^[A-Za-z0-9_.,+-]+$ ]] || fail 2 "$1: a value consists of letters, digits and _ . , + -"
    given_by[$2.$3]=$1 settings[$2.$3]=$4
}

add_setting() {  # STAGE.PARAM=VALUE
    [[ $1 =~ ^([a-z]+)\.([a-z][a-z0-9_-]*)=(.*)$ ]] ||
        fail 2 "--set $1: write STAGE.PARAM=VALUE, for example --set eigen.count=80"
    local stage=${BASH_REMATCH[1]} parameter=${BASH_REMATCH[2]//-/_} value=${BASH_REMATCH[3]}
    [[ " ${stages[*]} " == *" $stage "* ]] ||
        fail 2 "--set $1: no stage is called $stage; there are ${stages[*]}"
    set_parameter "--set $1" "$stage" "$parameter" "$value"
}

set_in() {  # TYPED PARAM VALUE STAGE...
    local stage
    for stage in "${@:4}"; do set_parameter "$1" "$stage" "$2" "$3"; done
}

# parameters_of STAGE OPTION...: with these, and --config, those that are not at their defaults, as options, or why they are refused.
parameters_of() { "$VARIMAP_BIN/varimap-$1" ${config:+--config "$config"} "${@:2}" --parameters 2>&1; }

# flags_of STAGE: its parameters that are not at their defaults, as options; the stage itself reads and checks them.
flags_of() {
    local key given=() said code=0
    for key in "${!settings[@]}"; do
        [[ $key != "$1".* ]] || given+=("--${key#*.}=${settings[$key]}")
    done
    [[ -n $config ]] || ((${#given[@]})) || return 0
    said=$(parameters_of "$1" "${given[@]}") || code=$?
    ((code == 0)) || refuse_parameters "$1" "$code" "$said"
    [[ -z $config ]] || require_allowed_in_config "$1" "$said" "${given[@]}"
    [[ $1 != preprocess || -z $part || ! "$said " =~ --fill_holes\ all\  ]] ||
        fail 2 "${given_by[preprocess.fill_holes]:-$config: fill_holes}: with --part that would close the cut where the part ends; give a number of edges, or none"
    echo "$said"
}

# What set_parameter refuses may stand in the file of --config, and the shell of make would obey it.
require_allowed_in_config() {  # STAGE, WHAT parameters_of IT SAID, OPTION... that were given besides
    local plain='^[A-Za-z0-9_.,+ -]*$' words i
    [[ $2 =~ $plain ]] || refuse_characters "$1"
    # Nor a blank: what follows it would be an option of its own. Each value, given by itself, changes nothing.
    read -r -a words <<<"$2"
    for ((i = 0; i < ${#words[@]}; i += 2)); do
        [[ ${words[i]} == --* && -n ${words[i + 1]:-} ]] || refuse_characters "$1"
        [[ " ${*:3}" == *" ${words[i]}="* || $(parameters_of "$1" "${@:3}" "${words[i]}=${words[i + 1]}") == "$2" ]] ||
            refuse_characters "$1"
    done
    [[ ! $2 =~ --(onto_itself|only_if_needed)\  ]] || fail 2 "$config: ${BASH_REMATCH[1]} is not a parameter"
    [[ $1 != locate || ! $2 =~ --part\  ]] || fail 2 "$config: part is not a parameter"
    [[ ! $2 =~ --mirror\  ]] || fail 2 "$config: mirror: say --mirror, which is of the source alone"
}

refuse_characters() {  # STAGE
    fail 2 "$config: in a value of [$1] there are other characters than letters, digits and _ . , + -"
}

# Names the option that a stage does not take; where it takes all, it is about the file of --config.
refuse_parameters() {  # STAGE CODE WHAT IT SAYS
    local key said
    for key in "${!settings[@]}"; do
        [[ $key == "$1".* ]] || continue
        said=$("$VARIMAP_BIN/varimap-$1" "--${key#*.}=${settings[$key]}" --parameters 2>&1) && continue
        said=$(error_in "$said")
        fail 2 "${given_by[$key]}: ${said#"--${key#*.}: "}"
    done
    fail "$2" "$(error_in "$3")"
}
