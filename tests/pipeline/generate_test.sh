#!/usr/bin/env bash
# Pairs of varimap-generate: what it writes serves the other tools, the same arguments give the same bytes, and bad ones
# are refused in one line.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
generate=$VARIMAP_BIN/varimap-generate
mkdir pair again
"$VARIMAP_SOURCE/pipelines/varimap" generate quadruped 1 pair --vertices 800 --missing 0.5 >kind.txt 2>log ||
    fail "varimap generate (exit $?)"
[[ $(<kind.txt) == quadruped ]] || fail "it says $(<kind.txt)"
[[ $(ls pair) == $'landmarks.txt\nsource.ply\nsource.txt\ntarget.ply\ntarget.txt' ]] || fail "it left $(ls pair)"
[[ $(wc -l <pair/source.txt) == $(wc -l <pair/target.txt) && $(wc -l <pair/landmarks.txt) == 6 ]] || fail "the lists"
for mesh in source target; do
    "$VARIMAP_BIN/varimap-preprocess" "pair/$mesh.ply" "$mesh.surface" 2>log || fail "$mesh.ply (exit $?)"
done
LC_ALL=C "$generate" quadruped 1 again --vertices 800 --missing 0.5 --threads 1 >/dev/null 2>log || fail "again (exit $?)"
diff -r pair again || fail "the same arguments gave other bytes"

# A collection: lists of as many rows, which name vertices that are there; the same again.
mkdir members more
for folder in members more; do
    "$generate" tool 3 $folder --members 3 --vertices 800 >/dev/null 2>log || fail "--members (exit $?)"
done
diff -r members more || fail "the same collection twice differs"
files=(members/*)
[[ ${files[*]##*/} == "tool_000.ply tool_000.txt tool_001.ply tool_001.txt tool_002.ply tool_002.txt" ]] || fail "it left ${files[*]}"
[[ $(wc -l <members/tool_000.txt) -ge 30 ]] || fail "few places"
for list in members/*.txt; do
    [[ $(wc -l <"$list") == $(wc -l <members/tool_000.txt) ]] || fail "lists of different lengths"
    awk '$1 < 0 || $1 >= 800 { exit 1 }' "$list" || fail "$list names vertices that are not there"
done

refused() {  # CODE ARGUMENTS...: one line, and nothing is written
    expect_exit "$1" "$generate" "${@:2}"
    [[ -z $(ls empty) ]] || fail "${*:2} left $(ls empty)"
}
mkdir empty
refused 2
refused 2 quadruped 1
refused 2 bird 1 empty
refused 2 hand one empty
refused 2 hand -1 empty
refused 2 hand 4294967296 empty
refused 2 hand 1 empty more
refused 2 hand 1 empty --vertices 20
refused 2 hand 1 empty --vertices many
refused 2 hand 1 empty --variation -1
refused 2 hand 1 empty --missing nan
refused 2 isometric 1 empty --bending 0.5
refused 2 isometric 1 empty --members 3
refused 2 contact 1 empty --members 3
refused 2 bird 1 empty --members 3
refused 6 hand 1 absent --vertices 500
refused 6 hand 1 pair/source.ply --vertices 500
