# shellcheck shell=bash
# Carrying things through the map in OUT. To be sourced.
# shellcheck disable=SC2154  # what other files of the front end set

# transfer OUT ARGUMENTS: what was finished in OUT carries something; results go to OUT/transfer unless -o says otherwise.
transfer() {
    local result hashes i out arguments=() folder
    out=$(of_folder "$1") folder=$out/transfer
    shift
    while (($#)); do
        case $1 in
        -o | --out)
            (($# > 1)) || fail 2 "$1 needs a folder"
            folder=$2
            shift
            ;;
        -o?*) folder=${1#-o} ;;
        --out=*) folder=${1#--out=} ;;
        *) arguments+=("$1") ;;
        esac
        shift
    done
    find_result "$out"
    for i in "${!arguments[@]}"; do arguments[i]=$(stand_in "$out" "${arguments[i]}"); done
    exec "$VARIMAP_BIN/varimap-transfer" "${result[@]}" "${hashes[@]}" --out "$folder" "${arguments[@]}"
}
