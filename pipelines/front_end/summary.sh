# shellcheck shell=bash
# What varimap map ends with. To be sourced.
# shellcheck disable=SC2154  # what other files of the front end set

# What the stages said, where a run ends before there is a quality.json: a JSON object for each, and twice what two files tell of.
said_so_far() {  # notes|warnings
    local begun=() stage last=$until
    [[ $last != sketches ]] || last=hierarchy
    for stage in "${progress_stages[@]}"; do  # later ones may be of another run
        begun+=("$stage")
        [[ $stage != "$last" ]] || break
    done
    find "$out/artifacts/" -maxdepth 1 \( -name "$source.*run.json" -o -name "$target.*run.json" -o \
        -name "$source--$target.*run.json" \) -exec jq -c --arg how "$1" --arg stages "${begun[*]}" '(input_filename | sub(".*/"; "") | sub("[.].*"; "")) as $of
            | .stage as $stage | select(any($stages | splits(" "); . == $stage)) | .[$how][]? | {stage: "\($stage) \($of)", message: gsub("\n"; " ")}' {} + | sort -u
}
said_so_far_json() {
    jq -n --arg until "$until" --slurpfile warnings <(said_so_far warnings) --slurpfile notes <(said_so_far notes) \
        '{$until, $warnings, $notes}'
}
print_said_so_far() {
    printable_lines < <(said_so_far warnings | jq -r '"warning  \(.stage): \(.message)"'; said_so_far notes | jq -r '"note     \(.stage): \(.message)"')
}

print_said() {  # by all stages, those that ran earlier too
    printable_lines < <(jq -r "$(words_of_quality)"'
        (shown_warnings | "warning  \(.stage): \(.message | gsub("\n"; " "))"),
        (.notes[]? | "note     \(.stage): \(.message | gsub("\n"; " "))")' "$out/quality.json")
}

print_doubtful_verdict() {
    printable_lines < <(jq -r "$(words_of_quality)"'report | select(.verdict == "look here") | verdict_line' "$out/quality.json")
}

summary() {  # OUT as the user wrote it
    local shown made
    shown=$(printable "$1")
    print_said
    print_doubtful_verdict
    echo "map      $shown/source_to_target.csv  $shown/target_to_source.csv"
    echo "meshes   $shown/source_on_target.ply  $shown/target_on_source.ply"
    echo "picture  $shown/picture.png"
    echo "quality  $shown/quality.json"
    for made in $(older_than_the_map); do
        echo "older    $shown/$made was made before this map: $([[ $made == transfer ]] && echo carry what you need once more || echo "run varimap view $shown again")"
    done
    jq -r --arg out "$shown" "$(words_of_quality)$(<"$share/summary.jq")" "$out/quality.json"
}

older_than_the_map() {  # what other commands made of an earlier map in the same folder
    local made
    for made in view.html transfer; do
        [[ ! -e $out/$made || ! $out/$made -ot $out/source_to_target.csv ]] || echo "$made"
    done
}

# The same for programs: where things are, the verdict with its checks, warnings and times (report.jq).
summary_json() {  # OUT as the user wrote it
    jq --arg out "$1" --arg older "$(older_than_the_map)" "$(words_of_quality)"'{map: {source_to_target: "\($out)/source_to_target.csv",
        target_to_source: "\($out)/target_to_source.csv"}, picture: "\($out)/picture.png", quality: "\($out)/quality.json",
        older: ($older | split("\n") | map("\($out)/\(.)"))} + report' "$out/quality.json"
}
