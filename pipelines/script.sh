# shellcheck shell=bash
# What the scripts share: where things are, how a command line is read, and how a failure is said. To be sourced.
#
# A script sets `name` (its own, for messages) before that, then `options`, and defines two functions:
#   declare -A options=([out]=value [explore]=flag [landmarks]=words)
#   option NAME [VALUE]   called for each option, in order; NAME with dashes, whatever was typed
#   word TEXT             called for everything else
# flag: no value; value: the next argument, or behind `=`; words: as flag, but `--NAME=WORD` is `--NAME WORD`.
# Options that are not in the list go to the array `other_options` where that is set, as they stand.
set -euo pipefail +fC  # -f and -C may come with an exported SHELLOPTS
shopt -s inherit_errexit
unset CDPATH
: "${name:?}"
explains="$name --help"  # what tells a user about options; a script may say otherwise
# One language of sorting, numbers and letters: in Turkish the capital of i is none of A-Z.
export LC_ALL=C

# The project's pipelines folder, or PREFIX/share/varimap; beside it are the front end and the executables.
share=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")" && pwd)
# shellcheck disable=SC2034  # used where this is sourced
if [[ -x $share/varimap ]]; then
    varimap=$share/varimap bin=$share/../build/bin
else
    bin=$share/../../bin varimap=$share/../../bin/varimap
fi
VARIMAP_BIN=$(realpath -m -- "${VARIMAP_BIN:-$bin}")
export VARIMAP_BIN

# printable TEXT: TEXT without what a terminal would obey instead of showing it.
printable() {
    local text=$1
    iconv -f UTF-8 -t UTF-8 <<<"$text" &>/dev/null || text=${text//[$'\x80'-$'\xff']/?}
    text=${text//$'\xc2'[$'\x80'-$'\x9f']/?}
    printf '%s\n' "${text//[[:cntrl:]]/?}"
}

printable_lines() {  # of what is read
    local line
    while IFS= read -r line; do printable "$line"; done
}

# stderr may be closed.
warn() { printable "$name: warning: $1" >&2 || true; }  # MESSAGE

# complain LINE: what went wrong, in the file `failure_note`, too, where a script sets that.
failure_note=''
complain() {
    printable "$1" >&2 || true
    [[ -z $failure_note ]] || printable "$1" >"$failure_note"
}

fail() {  # CODE MESSAGE
    complain "$name: error: $2"
    exit "$1"
}

# say TEXT: on stdout, or the script ends and says that it could not.
say() { printf '%s\n' "$1" 2>/dev/null || fail 6 "cannot write to standard output"; }

require() {  # PROGRAM
    command -v "$1" >/dev/null || fail 6 "$1 is missing; install it (Debian: apt-get install $1)"
}

# is_tool NAME: whether there is an executable varimap-NAME beside the stages.
is_tool() { [[ $1 =~ ^[a-z][a-z-]*$ && -x $VARIMAP_BIN/varimap-$1 ]]; }

require_tool() {  # NAME
    is_tool "$1" || fail 6 "no varimap-$1 in $VARIMAP_BIN; build the project (README.md) or set VARIMAP_BIN"
}

require_file() {  # FILE that is read: a pipe would be read twice, and wait
    [[ -e $1 ]] || fail 6 "$1: no such file"
    [[ -f $1 ]] || fail 6 "$1: not a file"
    [[ -r $1 ]] || fail 6 "$1: cannot be read"
}

make_folder() {
    [[ ! -e $1 || -d $1 ]] || fail 6 "$1: is a file, not a folder"
    local said
    said=$(mkdir -p -- "$1" 2>&1) || fail 6 "$1: cannot be made: ${said##*: }"
    [[ -w $1 && -x $1 ]] || fail 6 "$1: cannot be written to"
}

lock() {  # FOLDER: one run at a time; the lock lasts until the last stage has ended
    local fd
    { exec {fd}>"$1/.lock"; } 2>/dev/null || fail 6 "$1: cannot be written to"
    flock -n "$fd" && return
    (($? == 1)) || return 0  # a file system without locks: what is made twice is renamed into place
    echo "$name: waiting for another run in $1" >&2
    flock "$fd"
}

# with_temporary_folder FUNCTION ARGUMENT...: calls FUNCTION FOLDER ARGUMENT... in a shell of its own, whose end removes FOLDER, also
# by an interrupt.
with_temporary_folder() (
    temporary=$(mktemp -d 2>/dev/null) || fail 6 "no folder for temporary files can be written to"
    trap 'rm -rf -- "$temporary"' EXIT
    "$1" "$temporary" "${@:2}"
)

# is_mesh FILE: whether its ending makes it a mesh of the folder that it is in. A file that is named itself is one in any case.
is_mesh() { [[ ${1,,} =~ \.(obj|ply|off|stl|gltf|glb|fbx|dae|3mf)$ ]]; }
# meshes_in PATH: sets `mesh_files` to the meshes of a folder, or to PATH itself; no program takes their names for options.
meshes_in() {
    local path=$1 file
    [[ $path != -* ]] || path=./$path
    mesh_files=("$path")
    [[ -d $path ]] || return 0
    mesh_files=()
    for file in "$path"/*; do
        # Of a link that leads nowhere it is said that no file is there.
        if [[ ! -d $file ]] && is_mesh "$file"; then mesh_files+=("$file"); fi
    done
}
# is_foreign MESH: whether it must be imported, being of a format that no stage reads.
is_foreign() { [[ ${1##*/} == *.* && ! ${1,,} =~ \.(obj|ply|off|stl)$ ]]; }

require_import() {  # FILE...: that those can be read which must be imported
    local file
    for file in "$@"; do
        ! is_foreign "$file" || is_tool import ||
            fail 6 "$file: this varimap was built without assimp, which reads such files; install it (Debian: apt-get install libassimp-dev) and build again, or save the mesh as OBJ, PLY, OFF or STL"
    done
}

# as_stages_read MESH OBJ: the path of MESH, or where no stage reads its format, of OBJ, which is made of it.
as_stages_read() {
    is_foreign "$1" || { echo "$1"; return; }
    require_import "$1"
    "$VARIMAP_BIN/varimap-import" "$1" "$2" || return
    echo "$2"
}

# artifact_stem PATH: the name of a mesh's artifacts: the mesh's own, in letters that make can handle, as many as leave room for those
# of a pair and their endings.
artifact_stem() {
    local stem=${1##*/}
    stem=$(tr -c '[:alnum:]_-' _ <<<"${stem%.*}" | sed 's/_$//; s/--*/-/g; s/^-//; s/-$//')
    stem=${stem::90}
    echo "${stem:-mesh}"
}

# free_name STEM IS_FREE ARGUMENT...: the first of STEM, STEM-2, STEM-3 ... of which `IS_FREE NAME ARGUMENT...` says that it can be had.
free_name() {
    local tried=$1 number=1
    until "$2" "$tried" "${@:3}"; do tried=$1-$((++number)); done
    echo "$tried"
}

# make that heeds no other make around it, as where a script runs in a recipe.
# shellcheck disable=SC2034  # for those that source this
make_alone=(env -u MAKEFLAGS -u MFLAGS -u MAKELEVEL -u GNUMAKEFLAGS -u MAKEFILES make -r -s --no-print-directory)

# quoted TEXT: as a field of a CSV file.
quoted() { printf '"%s"' "${1//\"/\"\"}"; }

# shell_words WORD...: as words of a command of any POSIX shell; letters of every language stay readable.
shell_words() {
    local word text=''
    for word in "$@"; do
        [[ $word =~ ^[A-Za-z0-9_./:=,+@%-]+$ ]] || word=\'${word//\'/\'\\\'\'}\'
        text+=" $word"
    done
    printf '%s' "${text# }"
}

# What a jq program that tells of maps begins with: definitions, and no modules, which jq 1.6 does not find below a folder whose name
# is not UTF-8.
words_of_quality() { cat -- "$share/quality_words.jq" "$share/report.jq" && echo; }

# list_landmarks FOLDER MESH: sets landmark_files to those in FOLDER that have the name of that mesh, the one that is read first.
landmark_endings=(mrk.json fcsv pp pts txt csv vts)
list_landmarks() {
    local ending stem=${2##*/}
    landmark_files=()
    [[ -n $1 ]] || return 0
    for ending in "${landmark_endings[@]}"; do
        [[ ! -f $1/${stem%.*}.$ending ]] || landmark_files+=("$1/${stem%.*}.$ending")
    done
}

# landmark_name MESH: what they must be called, in words.
landmark_name() {
    local stem=${1##*/} text
    printf -v text ', .%s' "${landmark_endings[@]}"
    text=${text#, }
    echo "${stem%.*} with ${text%,*} or${text##*,}"
}

# find_landmarks FOLDER MESH: the first of these; nothing where there is none.
find_landmarks() {
    local landmark_files
    list_landmarks "$@"
    ((${#landmark_files[@]} == 0)) || realpath -s -- "${landmark_files[0]}"
}

# wait_for_group: waits for the process group `group`, started in the background under `set -m`, and returns its exit code.
# So an interrupt reaches all that it started and is waited for; then the script ends, after close_log where that is defined.
group=''
wait_for_group() {
    local code=0
    trap 'interrupted 130' INT
    trap 'interrupted 143' TERM
    trap 'interrupted 129' HUP
    wait "$group" || code=$?
    trap - INT TERM HUP
    return "$code"
}

# await: the same for what was started last, and ends `set -m`.
await() {
    group=$!
    set +m
    wait_for_group
}

interrupted() {  # CODE
    trap '' INT TERM HUP
    kill -TERM -- "-$group" 2>/dev/null || true
    # The log ends when all have ended that write to it. It comes first: where the group ended at the very moment of the
    # interrupt, bash may have lost it, and waits for it as long as it has any child.
    ! declare -F close_log >/dev/null || close_log
    wait "$group" 2>/dev/null || true
    fail "$1" "interrupted; what is finished is kept"
}

# generate_pair FAMILY SEED FOLDER OPTION...: makes FOLDER and lets varimap-generate write a pair there; prints its kind.
generate_pair() {
    mkdir -p -- "$3"
    "$VARIMAP_BIN/varimap-generate" "$@" 2>"$3/log.txt" || fail $? "$(error_in "$(<"$3/log.txt")")"
}

# torus_mesh AROUND ACROSS SWELL: vertices along a ring of radius 1, and round the tube, whose radius is 0.4 (1 + SWELL cos u) at the
# angle u along it.
torus_mesh() {
    awk -v n="$1" -v m="$2" -v swell="$3" 'BEGIN {
        pi = atan2(0, -1)
        print "OFF"; print n * m, 2 * n * m, 0
        for (i = 0; i < n; ++i)
            for (j = 0; j < m; ++j) {
                u = 2 * pi * i / n; v = 2 * pi * j / m; r = .4 * (1 + swell * cos(u))
                printf "%.9f %.9f %.9f\n", (1 + r * cos(v)) * cos(u), (1 + r * cos(v)) * sin(u), r * sin(v)
            }
        for (i = 0; i < n; ++i)
            for (j = 0; j < m; ++j) {
                a = i * m + j; b = (i + 1) % n * m + j; c = (i + 1) % n * m + (j + 1) % m; d = i * m + (j + 1) % m
                print 3, a, b, c; print 3, a, c, d
            }
    }'
}

# map_shape FOLDER OUT OPTION...: maps the pair that varimap-generate left in FOLDER, results in OUT; errors.txt and
# errors.json in FOLDER.
map_shape() {
    "$varimap" map -q "$1/source.ply" "$1/target.ply" -o "$2" "${@:3}" >/dev/null 2>"$1/errors.txt" || return
    "$VARIMAP_BIN/varimap-evaluate" "$1/target.ply" "$2/source_to_target.csv" "$1/source.txt" "$1/target.txt" \
        --json >"$1/errors.json" 2>>"$1/errors.txt"
}

# require_map_options OPTION...: refuses what `varimap map` and its stages would refuse, before anything else is done. They
# check options first, and then find that a device is no folder for results.
require_map_options() {
    local code=0 said
    said=$("$varimap" map "$share/batch/job" "$share/batch/job" "$@" -o /dev/null 2>&1 >/dev/null) || code=$?
    ((code == 0)) || [[ $said == *'/dev/null: is a file'* ]] || fail "$code" "$(error_in "$said")"
    [[ ! $* =~ repair|fill.holes|cut.handles ]] || require_repairs "$@"
}

# The values of these are looked at when there is a mesh. It is alone, and so no part: `--part VALUE` is passed over.
require_repairs() {  # OPTION...
    local options=()
    while (($#)); do
        if [[ $1 == --part ]]; then shift 2; continue; fi
        options+=("$1")
        shift
    done
    with_temporary_folder try_repairs "${options[@]}"
}
try_repairs() {  # FOLDER OPTION...
    local folder=$1 code=0 said
    shift
    printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' >"$folder/a.off"
    said=$("$varimap" map "$folder/a.off" "$folder/a.off" "$@" --until preprocess -q -j 1 -o "$folder/out" 2>&1 >/dev/null) || code=$?
    ((code != 2)) || fail 2 "$(error_in "$said")"
}

# error_in TEXT: of what was said on stderr, the last line, without the name of the program.
error_in() {
    local line=${1##*$'\n'}
    printf '%s\n' "${line#*error: }"
}

reason() {  # FILE of what was said on stderr: the error among it, or the last line
    { grep 'error: ' "$1" || tail -n 1 "$1"; } 2>/dev/null | tail -n 1
}

# What awk needs to tell how often that is true which is said to be right with some probability: bins of these, and their edges.
# shellcheck disable=SC2034  # for those that source this
reliability='
    function bin_of(probability) {
        return probability == "-" ? 0 : probability < .5 ? 1 : probability < .7 ? 2 : probability < .9 ? 3 : probability < .98 ? 4 : 5
    }
    BEGIN { split("0 .5 .7 .9 .98 1", edge, " ") }
'

# What OpenMP is told is not about these programs.
cores_here() { env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc; }

require_cores() {  # VALUE of -j; stages take no more threads
    [[ $1 =~ ^[1-9][0-9]{0,3}$ && $1 -le 4096 ]] || fail 2 "-j $1: give a number of cores, from 1 to 4096"
}

require_number() {  # OPTION VALUE LEAST
    [[ $2 =~ ^[0-9]{1,6}$ && $((10#$2)) -ge $3 ]] || fail 2 "$1 $2: give a whole number, at least $3"
}

# The kind of the option NAME; an unknown one ends the script.
kind_of() {  # NAME AS_TYPED
    [[ $1 =~ ^[a-z][a-z-]*$ && -n ${options[$1]:-} ]] || fail 2 "unknown option $2; $explains explains"
    echo "${options[$1]}"
}

# take_options_of_maps: what says how a map is made is an option, too: of `varimap map`, and of what makes many maps.
take_options_of_maps() {
    options+=([explore]=flag [full-resolution]=flag [landmark-weight]=value [landmark-vicinity]=value [landmark-space]=value
        [landmark-base]=value [area-bound]=value [area-energy]=value [repair]=value [components]=value [fill-holes]=value
        [cut-handles]=value [set]=value [config]=value)
}

declare -A short=([-o]=--out [-j]=--cores)

# parse_options ARGUMENTS: calls `option` and `word` as the head of this file says.
parse_options() {
    local typed long kind
    while (($#)); do
        typed=$1
        shift
        case $typed in
        --)
            while (($#)); do word "$1"; shift; done
            return
            ;;
        -h) typed=--help ;;
        -q) typed=--quiet ;;
        -v) typed=--verbose ;;
        -o | -j) typed=${short[$typed]} ;;
        -o?* | -j?*) typed=${short[${typed::2}]}=${typed:2} ;;
        -?*) ;;
        *) word "$typed"; continue ;;
        esac
        long=${typed%%=*} long=${long#--} long=${long//_/-}
        if declare -p other_options &>/dev/null && [[ -z ${options[$long]:-} ]]; then
            other_options+=("$typed")
            continue
        fi
        kind=$(kind_of "$long" "${typed%%=*}")
        case $kind-$typed in
        flag-*=*) fail 2 "${typed%%=*} takes no value" ;;
        words-*=*) option "$long"; word "${typed#*=}" ;;
        value-*=*) option "$long" "${typed#*=}" ;;
        value-*)
            (($#)) || fail 2 "$typed needs a value; $explains explains"
            option "$long" "$1"
            shift
            ;;
        *) option "$long" ;;
        esac
    done
}

# help_topic TOPIC: the page help/TOPIC.md as plain text; false where there is none.
help_topic() {
    [[ $1 =~ ^[a-z][a-z-]*$ && -r $share/help/$1.md ]] || return
    local text
    text=$(awk -f "$share/plain_text.awk" "$share/help/$1.md") || fail 6 "$share/plain_text.awk: cannot be used"
    say "$text"
}
