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
refused 6 hand 1 absent --vertices 500
refused 6 hand 1 pair/source.ply --vertices 500
