# shellcheck shell=bash
# What the scripts of a batch, `bench` and `register` share, besides script.sh, which is sourced before.
: "${share:?}" "${varimap:?}" "${landmark_endings[0]:?}"

# written WHAT: waits for a command that writes files, started in the background just before, since before || bash would let it
# go on after a failure; where it failed, the script ends with one line.
written() {
    wait $! || fail 6 "$1: cannot be written; is the disk full?"
}

# was_interrupted CODE: whether a script ended so (script.sh): it has neither done what it was asked nor failed.
was_interrupted() { (($1 == 129 || $1 == 130 || $1 == 143)); }

# handful NAME...: the first five, and how many more there are.
handful() {
    local text
    printf -v text '%s, ' "${@:1:5}"
    text=${text%, }
    (($# <= 5)) || text+=" and $(($# - 5)) more"
    echo "$text"
}

# named_alike FOLDER MESH...: of meshes without landmarks by their names, files in FOLDER that may be theirs, in words; nothing where
# there are none.
named_alike() {
    local mesh file stem alike=()
    for mesh in "${@:2}"; do
        stem=${mesh##*/}
        for file in "$1/${stem%.*}"[._-]*; do
            [[ " ${landmark_endings[*]##*.} " != *" ${file##*.} "* || ! -f $file || ${mesh_with_landmarks[$file]:-} ]] || alike+=("${file##*/}")
        done
    done
    ((${#alike[@]} == 0)) || echo "; there are files of other names: $(handful "${alike[@]}")"
}

# pairs_lacking_landmarks RESULTS: their names, of those that are done.
pairs_lacking_landmarks() {
    jq -r 'select(.status == "done" and .landmarks_left_out > 0).name' "$1"
}

# claim_landmarks FOLDER MESH: of a mesh that is new. Landmarks by names are of one mesh alone; other files by its name, which are not
# read, are told.
declare -A mesh_with_landmarks=()
# shellcheck disable=SC2154  # name is the script's
claim_landmarks() {
    local landmark_files other others
    list_landmarks "$1" "$2"
    ((${#landmark_files[@]})) || return 0
    other=${mesh_with_landmarks[${landmark_files[0]}]:-}
    [[ -z $other || $other == "$2" ]] ||
        fail 3 "$2: another mesh is called $(artifact_stem "$other"): $other has the same landmarks by its name, ${landmark_files[0]##*/}; rename one"
    [[ -z $other ]] || return 0
    mesh_with_landmarks[${landmark_files[0]}]=$2
    others=("${landmark_files[@]:1}")
    ((${#others[@]} == 0)) ||
        warn "$1: landmarks are read from ${landmark_files[0]##*/}, not from $(handful "${others[@]##*/}")"
}

# files_named_in MESH: the files beside it without which it is not whole, as it names them: those of a .gltf.
files_named_in() {
    [[ ${1,,} == *.gltf ]] || return 0
    local uri
    while IFS= read -r uri; do
        # Escaped or not, as varimap-import has it.
        [[ -f ${1%/*}/$uri || $uri != *%* || $uri == *\\* ]] || printf -v uri '%b' "${uri//%/\\x}"
        printf '%s\n' "$uri"
    done < <(jq -r '(.buffers, .images)[]?.uri? | strings | select(startswith("data:") | not)' "$1" 2>/dev/null || true)
}

# hash_files FILE...: sets hash_of[FILE] to sixteen digits of the SHA-256 of what is in it and in the files that it names.
declare -A hash_of=()
hash_files() {
    local file line named
    # 64 digits, two blanks and the name.
    while IFS= read -r -d '' line; do hash_of[${line:66}]=${line::16}; done < <(printf '%s\0' "$@" | xargs -0 sha256sum -z --)
    for file in "$@"; do
        [[ -v hash_of[$file] ]] || fail 6 "$file: cannot be read"
        mapfile -t named < <(files_named_in "$file")
        ((${#named[@]} == 0)) || hash_of[$file]=$({ echo "${hash_of[$file]}"; hashes_beside "$file" "${named[@]}"; } | short_hash)
    done
}

# hashes_beside MESH FILE...: of those that are there, by the names that MESH has for them.
hashes_beside() { (cd -- "${1%/*}" && sha256sum -- "${@:2}" 2>/dev/null) || true; }

# short_hash: sixteen digits of the SHA-256 of what is read.
short_hash() { sha256sum | cut -c 1-16; }

# split_csv LIST: as lines of fields separated by \037; quotes as in RFC 4180, blanks around fields and lines of # alone and blank ones
# left out. The first line tells what separates: commas, or where it has none semicolons or tabs.
split_csv() {
    tr -d '\r' <"$1" | sed '1s/^\xef\xbb\xbf//' | awk '
        /^[ \t]*(#|$)/ { next }
        function without_blanks(text) { if (!had_quotes) gsub(/^ +| +$/, "", text); return text }
        separator == "" { separator = /,/ ? "," : /;/ ? ";" : /\t/ ? "\t" : "," }
        {
            line = $0; field = ""; out = ""; quoted = 0; had_quotes = 0
            for (i = 1; i <= length(line); i++) {
                c = substr(line, i, 1)
                if (quoted && c == "\"" && substr(line, i + 1, 1) == "\"") { field = field c; i++ }
                else if (c == "\"") { quoted = !quoted; if (field ~ /^ *$/ && !had_quotes) field = ""; had_quotes = 1 }
                else if (c == separator && !quoted) { out = out without_blanks(field) "\037"; field = ""; had_quotes = 0 }
                else if (quoted || !had_quotes || c != " ") field = field c
            }
            if (quoted || index(line, "\037") || (separator != "\t" && index(line, "\t"))) { print "\036" NR; exit }
            print out without_blanks(field)
        }'
}

# place PATH: sets places[PATH] to where a file of a list in `list_folder` is: relative to the folder above that, or to it.
declare -A places=()
list_folder=
place() {
    [[ -n $1 ]] || return 0
    if [[ -n ${places[$1]:-} ]]; then return; fi
    local path=$1
    [[ $path == /* ]] || path=$list_folder/../$1
    [[ -e $path ]] || path=$list_folder/$1
    [[ $1 != /* ]] || path=$1
    require_file "$path"
    places[$1]=$(realpath -s -- "$path")
}
