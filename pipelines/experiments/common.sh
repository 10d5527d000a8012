# shellcheck shell=bash
# What the figures' scripts share. To be sourced behind `name=figNN title=TEXT`; a figure then works in the folder $out and
# says what came out of it:
#   picture FILE CAPTION        a picture in $out, or one to be copied there
#   number WHAT OURS [PAPER]    a row of its table
#   verdict WORD SENTENCE       better, same, worse or other than in the paper
#   skip WHY                    ends with 77: what it needs is not there
# shellcheck source=pipelines/script.sh
. "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/../script.sh"
: "${title:?}"

usage() {
    cat <<TEXT
  $name [-o OUT] [--data FOLDER] [--meshes FOLDER]

$title

  -o OUT    folder for the results (default: gallery-out/$name)
  --data    folder of data sets, as pipelines/experiments/README.md says (default: none; then generated shapes or Debian's)
  --meshes  folder of Debian's meshes, which are downloaded where missing (default: meshes beside OUT)
TEXT
}

declare -A options=([out]=value [data]=value [meshes]=value [help]=flag)
out=gallery-out/$name data='' meshes=''
option() {  # NAME [VALUE]
    case $1 in
    help) usage; exit ;;
    out) out=$2 ;;
    data) data=$2 ;;
    meshes) meshes=$2 ;;
    esac
}
word() { fail 2 "what is '$1'? $name --help explains"; }
parse_options "$@"
require jq
mkdir -p -- "$out" || fail 6 "$out: cannot be made"
out=$(realpath -- "$out")
meshes=$(realpath -m -- "${meshes:-$out/../meshes}")
shared=$(dirname -- "$out")/shared  # what several figures use
[[ -z $data ]] || data=$(realpath -- "$data") || fail 6 "--data: there is no such folder"
record=$out/figure.tsv
printf 'title\t%s\n' "$title" >"$record"
log=$out/log.txt
: >"$log"

note() {  # KIND FIELD...: a line of the record
    local line=$1 field
    for field in "${@:2}"; do line+=$'\t'${field//[$'\t\n']/ }; done
    echo "$line" >>"$record"
}
picture() {
    [[ $1 -ef $out/${1##*/} ]] || cp -- "$1" "$out/"
    note picture "${1##*/}" "$2"
}
number() { note number "$1" "$2" "${3:-}"; }
verdict() { note verdict "$1" "$2"; echo "$1: $2"; }
skip() {
    note verdict skipped "$1"
    echo "skipped: $1"
    exit 77
}

# run PROGRAM ARGUMENT...: with what it says in log.txt; the last line of it where it fails.
run() {
    local code=0
    "$@" >>"$log" 2>&1 || code=$?
    ((code == 0)) || fail "$code" "${1##*/}: $(tail -n 1 "$log")"
}
stage() { run "$VARIMAP_BIN/varimap-$1" "${@:2}"; }

# to FILE STAGE ARGUMENT...: its standard output into FILE
to() {
    local code=0
    "$VARIMAP_BIN/varimap-$2" "${@:3}" >"$1" 2>>"$log" || code=$?
    ((code == 0)) || fail "$code" "varimap-$2: $(tail -n 1 "$log")"
}

# map FOLDER SOURCE TARGET OPTION...
map() { run "$varimap" map "$2" "$3" -o "$1" -q --set render.width=720 --set render.samples=4 "${@:4}"; }

# generated FOLDER FAMILY SEED OPTION...: source.ply, target.ply, landmarks.txt and the truth
generated() {
    [[ -s $1/target.ply ]] && return
    mkdir -p -- "$1"
    stage generate "$2" "$3" "$1" "${@:4}"
}

debian() {  # NAME...: Debian's meshes
    run_or_skip "$share/debian-meshes" "$meshes" "$@"
}
run_or_skip() { "$@" >>"$log" 2>&1 || skip "$(tail -n 1 "$log")"; }

# The steps before a plan, of one domain or surface FILE.domain: FILE.basis and FILE.hierarchy. Options are hierarchy's.
prepare() {  # FILE.ENDING OPTION...
    stage eigen "$1" "${1%.*}.basis"
    stage hierarchy "${@:2}" "$1" "${1%.*}.basis" "${1%.*}.hierarchy"
}
inputs() { echo "$1" "${1%.*}.basis" "${1%.*}.hierarchy" "$2" "${2%.*}.basis" "${2%.*}.hierarchy"; }

trace() {  # ARTIFACT CSV: its alternations
    rm -rf -- "$out/exported"
    stage inspect "$1" --export "$out/exported"
    mv -- "$out/exported/trace.csv" "$2"
    rm -rf -- "$out/exported"
}

quality() {  # OUT FILTER: of its quality.json
    jq -r "$2" "$1/quality.json"
}
flipped() { quality "$1" '"\(.source_to_target.flipped_count) / \(.target_to_source.flipped_count)"'; }
conformal() { quality "$1" '.source_to_target.conformal_distortion | "\(.p50 * 100 | round / 100) / \(.p95 * 100 | round / 100)"'; }

# error_of MAP FOLDER: mean geodesic error of the map of a generated pair, in units of sqrt(area)
error_of() {
    to "$1/errors.json" evaluate "$2/target.ply" "$1/source_to_target.csv" "$2/source.txt" "$2/target.txt" --json
    jq -r '.mean * 1e4 | round / 1e4' "$1/errors.json"
}

# animal: a generated animal in two poses, mapped without landmarks; figures 6 to 8 use the pair, too
animal=$shared/animal
animal() {
    generated "$animal" isometric 3 --vertices 5000
    map "$animal/map" "$animal/source.ply" "$animal/target.ply"
}
