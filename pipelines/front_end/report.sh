# shellcheck shell=bash
# How good the map in OUT is. To be sourced.
# shellcheck disable=SC2154  # what other files of the front end set

report() {  # OUT [--json]
    local out folders=() typed json='' text
    tell_failures "$@"
    for typed in "$@"; do
        ! asks_for_help "$typed" || { help_topic report; return; }
        case $typed in
        --json) json=yes ;;
        --*) fail 2 "unknown option $typed; varimap help report explains" ;;
        *) folders+=("$typed") ;;
        esac
    done
    ((${#folders[@]} == 1)) || fail 2 "varimap report takes one folder: varimap report OUT [--json]"
    out=$(of_folder "${folders[0]}")
    require_result "$out"
    text=$(if [[ $json ]]; then report_json "$out"; else report_lines "$out" "$(printable "${folders[0]}")"; fi) ||
        fail 6 "$out/quality.json: cannot be read; make the map again"
    say "$text"
}
report_json() { jq --arg changed "$(changed_since "$1")" "$(words_of_quality)report" "$1/quality.json"; }  # OUT

report_lines() {  # OUT, and as the user wrote it
    report_json "$1" | jq -r "$(words_of_quality)"'
        def pad($n): . + " " * ([$n - length, 1] | max);
        verdict_line,
        (.warnings[] | gsub("\n"; " ") | "warning  \(.)"),
        (.notes[] | gsub("\n"; " ") | "note     \(.)"),
        (.checks[] | "  \(.what | pad(44)) \(.value | pad(28)) \(.grade)"),
        "command  \(.command)", "version  \(.version)",
        (.times[] | "  \(.stage | pad(44)) \(.seconds * 10 | round / 10) s, \(.megabytes | round) MB")' | printable_lines
    [[ ! -e $1/picture.png ]] || echo "picture  $2/picture.png"
}
