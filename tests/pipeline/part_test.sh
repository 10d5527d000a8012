#!/usr/bin/env bash
# A part finds its place on the whole, whichever is the source, and the rest of the whole is left out and named.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
figure rest.off 12
figure whole.off 12 .3
# upper FILE: its faces above z = -.3; all vertices stay.
upper() {
    awk 'NR == 2 { n = $1; m = $2 } NR > 2 && NR <= n + 2 { z[NR - 3] = $3; line[NR - 3] = $0 }
        NR > n + 2 && z[$2] > -.3 && z[$3] > -.3 && z[$4] > -.3 { face[count++] = $0 }
        END { printf "OFF\n%d %d 0\n", n, count; for (v = 0; v < n; v++) print line[v]; for (f = 0; f < count; f++) print face[f] }' "$1"
}
upper rest.off >part.off
# The tips of the upper limbs and of that to the side.
landmarks_of_figure rest.off | sed -n '1p;2p;5p' >tips.txt

map part.off whole.off -o out --landmarks tips.txt --part source
jq -c '.part, .source_to_target.coverage' out/quality.json
jq -e '.part | .is == "source" and .scale == 1 and .strain < .1 and .area_percent > 40 and .area_percent < 75' out/quality.json \
    >/dev/null || fail "quality.json does not tell of the part"
grep -q 'the source lies on' out.txt || fail "the summary does not tell of the part"
! grep -q 'looks like a part' out.txt || fail "what is cut to the part counts as a whole"
awk 'NR == 2 { n = $1 } NR > n + 2 { for (c = 2; c < 5; c++) used[$c] } END { for (v in used) print v }' part.off | sort -n >used.txt
"$VARIMAP_BIN/varimap-evaluate" whole.off out/source_to_target.csv used.txt used.txt --index-base 0 --json >error.json 2>log ||
    fail "evaluate"
jq -c '{mean, maximum}' error.json
jq -e '.mean < .03 and .maximum < .2' error.json >/dev/null || fail "the part is elsewhere"

# Every vertex of the whole has a row; those outside have none on the part, and say why.
awk -F, 'NR > 1 && $2 < 0 { print NR - 2 }' out/target_to_source.csv >left.txt
awk -F, '$2 == "outside_part" { print $1 }' out/target_vertices.csv | cmp -s - left.txt || fail "what is left out is not named"
(($(wc -l <left.txt) > 100)) || fail "nothing was left out"

"$varimap" report out >report.txt || fail "report"
"$varimap" map part.off whole.off -o out --landmarks tips.txt --part source "${small_picture[@]}" -v >again.txt 2>log || fail "again"
! grep -q ' done:' log || fail "a second run finds something to do: $(grep -m 1 ' done:' log)"
"$VARIMAP_BIN/varimap-inspect" --check out/artifacts/*.{region,surface} || fail "artifacts"
make -s -f "$VARIMAP_SOURCE/pipelines/Makefile" SOURCE=part.off TARGET=whole.off OUT=made LANDMARKS=tips.txt PART=source \
    RENDER_FLAGS="--width=64 --samples=1" VARIMAP_BIN="$VARIMAP_BIN" >log 2>&1 || fail "make"
cmp out/source_to_target.csv made/source_to_target.csv || fail "make makes another map"

map whole.off part.off -o back --landmarks tips.txt --part target
jq -e '.part | .is == "target" and .area_percent > 40 and .area_percent < 75' back/quality.json >/dev/null || fail "the target as part"
"$VARIMAP_BIN/varimap-evaluate" whole.off back/target_to_source.csv used.txt used.txt --index-base 0 --json 2>log |
    jq -e '.mean < .03 and .maximum < .2' >/dev/null || fail "the target is elsewhere"

refused() {  # WORDS ARGUMENTS
    local code=0
    "$varimap" map part.off whole.off -o bad "${@:2}" >log 2>&1 || code=$?
    ((code == 2)) || fail "${*:2}: exit code $code instead of 2"
    grep -q -- "$1" log || fail "${*:2}: does not say '$1'"
}
head -n 2 tips.txt >two.txt
refused 'needs --landmarks' --part source
refused 'say source or target' --part whole --landmarks tips.txt
refused 'three' --part source --landmarks two.txt
