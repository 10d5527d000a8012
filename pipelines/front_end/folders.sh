# shellcheck shell=bash
# What a run of varimap map finds and makes in OUT before the stages run. To be sourced.
# shellcheck disable=SC2154  # what other files of the front end set

# OUT/artifacts is a folder, or a link to the one that --artifacts names. One run at a time writes into OUT; artifacts may
# be shared by runs at the same time, since stages lock what they make.
prepare_folders() {
    make_folder "$out"
    out=$(realpath -- "$out")
    lock "$out"
    if [[ -n $artifacts ]]; then
        make_folder "$artifacts"
        artifacts=$(realpath -- "$artifacts")
        if [[ $(realpath -m -- "$out/artifacts") != "$artifacts" ]]; then
            [[ -L $out/artifacts || ! -e $out/artifacts ]] ||
                fail 2 "$out/artifacts exists already: remove it, or leave out --artifacts"
            ln -sfn -- "$artifacts" "$out/artifacts" || fail 6 "$out/artifacts: cannot be made"
        fi
    fi
    [[ ! -L $out/artifacts || -e $out/artifacts ]] ||
        fail 6 "$shown/artifacts: leads to $(readlink -- "$out/artifacts"), which is gone; put that back, or remove this link to make all anew"
    make_folder "$out/artifacts"
    make_folder "$out/artifacts/inputs"
    make_folder "$out/artifacts/hashes"
    # For the run whose own folder it is as well.
    [[ ! -L $out/artifacts ]] || { : >>"$out/artifacts/.shared"; } 2>/dev/null || fail 6 "$out/artifacts: cannot be written to"
}

# What a run writes into OUT; none of it may be what the run reads.
outputs=(source_to_target.csv target_to_source.csv source_to_target.npz target_to_source.npz source_on_target.ply
    target_on_source.ply source_masses.csv target_masses.csv source_vertices.csv target_vertices.csv quality.json
    picture.png candidates.png view.html log.txt)

require_other_files() {  # FILE...: before anything is written
    local file output
    for file in "$@"; do
        for output in "${outputs[@]}"; do
            [[ ! $file -ef $out/$output ]] ||
                fail 2 "$file: this run would write over it; move it, or give another folder than -o $out"
        done
    done
    for output in "${outputs[@]}"; do
        [[ ! -e $out/$output || -f $out/$output ]] || fail 6 "$out/$output: is there and not a file; move it"
    done
}

# Links in artifacts/inputs tell which mesh has which name: another file of the same name gets a number.
name_of_mesh() { free_name "$(artifact_stem "$1")" take_name "$1"; }  # PATH
take_name() {  # NAME PATH: false where another mesh has that name
    local link=artifacts/inputs/$1
    if ln -s -- "$2" "$link" 2>/dev/null || [[ $(readlink -- "$link") == "$2" ]] || follow "$link" "$2"; then return; fi
    [[ -L $link || -e $link ]] || fail 6 "$shown/$link: cannot be made"
    return 1
}

# follow LINK PATH: lets LINK lead to PATH where its mesh was moved there, or is a copy; not where it is another one of this run, or may
# name other files beside it.
follow() {
    local old
    old=$(readlink -- "$1") || return
    [[ $old != "$VARIMAP_SOURCE" && $old != "$VARIMAP_TARGET" ]] || return
    [[ ! -e $1 ]] || { ! is_foreign "$2" && cmp -s -- "$1" "$2"; } || return
    ln -sfn -- "$2" "$1" 2>/dev/null
}
