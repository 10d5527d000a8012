#!/usr/bin/env bash
# Time and memory by size: a table, a plot, and exponents.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
scaling=$VARIMAP_SOURCE/pipelines/scaling
"$scaling" -o out --sizes "2500 8000" "${small_picture[@]}" >out.txt 2>log || fail "scaling (exit $?)"
cat out.txt
[[ $(wc -l <out/scaling.csv) == 3 ]] || fail "scaling.csv"
# The larger one is mapped on a coarse mesh, and right all the same; memory tells that it was.
awk -F, 'NR > 1 && !($5 < 0.02 && $2 > 0 && $4 > 0) { exit 1 } NR == 3 && !($1 > 7000) { exit 1 }' out/scaling.csv ||
    fail "a row of scaling.csv"
jq -e '.source.vertices == 6000 and .source.input_vertices > 7000' out/8000/map/quality.json >jq.txt || fail "no coarse mesh"
grep -q 'grows as vertices to the' out.txt || fail "no exponents"
[[ $(head -c 4 out/scaling.svg) == '<svg' && $(tail -n 1 out/scaling.svg) == '</svg>' ]] || fail "scaling.svg"
grep -qE 'nan|inf' out/scaling.svg && fail "a number in scaling.svg"

# All vertices in the plan.
"$scaling" -o full --sizes 7000 --full-resolution "${small_picture[@]}" >full.txt 2>log || fail "--full-resolution (exit $?)"
jq -e '.source.vertices > 6000' full/7000/map/quality.json >jq.txt || fail "--full-resolution coarsened"
[[ ! -e full/7000/map/artifacts/source.coarse ]] || fail "--full-resolution made a coarse mesh"

expect_exit 2 "$scaling" --sizes 100
expect_exit 2 "$scaling" --sizes many
expect_exit 2 "$scaling" --shape x
expect_exit 2 "$VARIMAP_BIN/varimap-generate" isometric 3 out --vertices many
