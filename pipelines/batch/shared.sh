# shellcheck shell=bash
# What the scripts of a batch, `bench` and `register` share, besides script.sh, which is sourced before.
: "${share:?}" "${varimap:?}"

# written WHAT: waits for a command that writes files, started in the background just before, since before || bash would let it
# go on after a failure; where it failed, the script ends with one line.
written() {
    wait $! || fail 6 "$1: cannot be written; is the disk full?"
}

# handful NAME...: the first five, and how many more there are.
handful() {
    local text
    printf -v text '%s, ' "${@:1:5}"
    text=${text%, }
    (($# <= 5)) || text+=" and $(($# - 5)) more"
    echo "$text"
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
        mapfile -t named < <(files_named_in "$file")
        ((${#named[@]} == 0)) || hash_of[$file]=$({ echo "${hash_of[$file]}"; hashes_beside "$file" "${named[@]}"; } | short_hash)
    done
}

# hashes_beside MESH FILE...: of those that are there, by the names that MESH has for them.
hashes_beside() { (cd -- "${1%/*}" && sha256sum -- "${@:2}" 2>/dev/null) || true; }

# short_hash: sixteen digits of the SHA-256 of what is read.
short_hash() { sha256sum | cut -c 1-16; }
