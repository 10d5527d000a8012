#!/usr/bin/env bash
# A part finds its place on the whole, whichever is the source, and the rest of the whole is left out and named.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
small_picture+=("${smaller[@]}")
figure rest.off 12
figure whole.off 12 .3
upper_part rest.off >part.off
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
grep -q 'part placed  *strained by 0[.]0[0-9]*  *good$' report.txt || fail "the report does not tell how the part was placed"
"$varimap" report out --json | jq -e '.verdict and (.checks | length > 0)' >/dev/null || fail "the report as JSON"
expect_exit 2 "$varimap" report out --jsn
grep -q 'unknown option --jsn' log || fail "an unknown option of report: $(<log)"
expect_exit 2 "$varimap" transfer --values values.csv out
grep -q 'the folder of the map comes first' log || fail "options before the folder: $(<log)"
jq '.part.strain = .13' out/quality.json | report_on |
    jq -e '.verdict == "look here" and any(.checks[]; .what == "part placed" and .grade == "look here")' >/dev/null ||
    fail "a strained part does not make one look"
jq '.round_trip.p95 = .12' out/quality.json | report_on |
    jq -e '.verdict == "look here" and any(.checks[]; .what == "there and back, 95 %" and .grade == "look here")' >/dev/null ||
    fail "directions that disagree do not make one look"
"$varimap" map part.off whole.off -o out --landmarks tips.txt --part source "${small_picture[@]}" -v >again.txt 2>log || fail "again"
! grep -q ' done:' log || fail "a second run finds something to do: $(grep -m 1 ' done:' log)"
"$VARIMAP_BIN/varimap-inspect" --check out/artifacts/*.{region,surface} || fail "artifacts"
make -s -f "$VARIMAP_SOURCE/pipelines/Makefile" SOURCE=part.off TARGET=whole.off OUT=made LANDMARKS=tips.txt PART=source \
    PREPROCESS_FLAGS="--target_edge_length .15" RENDER_FLAGS="--width=64 --samples=1" VARIMAP_BIN="$VARIMAP_BIN" >log 2>&1 || fail "make"
cmp out/source_to_target.csv made/source_to_target.csv || fail "make makes another map"

map whole.off part.off -o back --landmarks tips.txt --part target
jq -e '.part | .is == "target" and .area_percent > 40 and .area_percent < 75' back/quality.json >/dev/null || fail "the target as part"
"$VARIMAP_BIN/varimap-evaluate" whole.off back/target_to_source.csv used.txt used.txt --index-base 0 --json 2>log |
    jq -e '.mean < .03 and .maximum < .2' >/dev/null || fail "the target is elsewhere"

# Without landmarks, and with one: the part tells where it belongs.
head -n 1 tips.txt >one.txt
for landmarks in '' '--landmarks one.txt'; do
    # shellcheck disable=SC2086
    map part.off whole.off -o free $landmarks --part source
    "$VARIMAP_BIN/varimap-evaluate" whole.off free/source_to_target.csv used.txt used.txt --index-base 0 --json 2>log |
        jq -e '.mean < .03 and .maximum < .2' >/dev/null || fail "the part is elsewhere: $landmarks"
    # The figure's limbs are much alike: other places are nearly as good, which is said.
    jq -e '.part.lead > .02' free/quality.json >/dev/null || fail "how sure it is: $landmarks $(jq -c .part free/quality.json)"
    jq -e '(.part.lead < .1) == any(.warnings[]; .message | test("agrees with another place"))' free/quality.json >/dev/null ||
        fail "whether there is another place: $landmarks"
done
# Files of other units have no part of each other.
awk 'NF == 3 && /[.]/ { print $1 * 40, $2 * 40, $3 * 40; next } { print }' part.off >large.off
code=0
"$varimap" map large.off whole.off -o other --part source >log 2>&1 || code=$?
((code == 3)) || fail "other units: exit code $code"
grep -q 'same units' log || fail "other units: $(<log)"

# As far as the place of the part, with axes of landmarks that all stages get.
map whole.off part.off -o back --landmarks tips.txt --part target --until locate --landmark-space lps
expect_ran locate
grep -q '^parameter landmark_space lps$' back/artifacts/whole--part.target-part.region || fail "locate has other axes"
# Runs that take either surface for the part share no file of the pair.
for part in source target; do
    make -n -s -f "$VARIMAP_SOURCE/pipelines/Makefile" SOURCE=part.off TARGET=whole.off OUT=made LANDMARKS=tips.txt PART=$part \
        VARIMAP_BIN="$VARIMAP_BIN" >log 2>&1 || fail "make -n"
    grep -o 'made/artifacts/part--whole[^ ]*' log | sort -u >$part.txt
    # Where the part was placed goes on to the two stages that begin there.
    for stage in diffuse relax; do
        grep -q "varimap-$stage .*--placed made/artifacts/part--whole.$part-part.region" log || fail "$stage does not get the region"
    done
done
(($(wc -l <source.txt) > 10 && $(wc -l <target.txt) > 10)) || fail "names of artifacts are not found"
[[ -z $(comm -12 source.txt target.txt) ]] || fail "the same names with either part: $(comm -12 source.txt target.txt | xargs)"

refused() {  # WORDS ARGUMENTS
    local code=0
    "$varimap" map part.off whole.off -o bad "${@:2}" >log 2>&1 || code=$?
    ((code == 2)) || fail "${*:2}: exit code $code instead of 2"
    grep -q -- "$1" log || fail "${*:2}: does not say '$1'"
}
refused 'say source or target' --part whole --landmarks tips.txt
refused "part '': say source or target" --part '' --landmarks tips.txt
refused '--until locate: without --part no part is looked for' --until locate --landmarks tips.txt
refused '--candidate 2: with --part nothing is explored without landmarks' --part source --candidate 2
refused '--set preprocess.mirror=true: say --mirror' --landmarks tips.txt --set preprocess.mirror=true
refused 'locate.part=target: part is not a parameter' --part source --landmarks tips.txt --set locate.part=target
printf '[locate]\npart = "target"\n[preprocess]\nfill_holes = "all"\n' >bad.toml
refused 'bad.toml: part is not a parameter' --landmarks tips.txt --config bad.toml
sed -i 1,2d bad.toml
refused 'bad.toml: fill_holes: with --part' --part source --landmarks tips.txt --config bad.toml
for all in '--fill-holes all' '--set preprocess.fill_holes=all'; do
    # shellcheck disable=SC2086
    refused "$all: with --part" --part source --landmarks tips.txt $all
done
printf '[preprocess]\nmirror = true\n' >mirror.toml
refused 'mirror.toml: mirror: say --mirror' --landmarks tips.txt --config mirror.toml
[[ ! -e bad ]] || fail "what is refused left files"
# Parameters of stages that do not run.
map part.off whole.off -o idle --landmarks tips.txt --full-resolution --set coarsen.vertices=900 --set locate.enough=.1 --until preprocess
grep -q 'warning: --set coarsen.vertices=900 has no effect: with --full-resolution' log || fail "coarsen with --full-resolution: $(<log)"
grep -q 'warning: --set locate.enough=.1 has no effect: without --part' log || fail "locate without --part: $(<log)"
# A number of edges is taken, and counts more than the file.
map part.off whole.off -o filled --landmarks tips.txt --part source --config bad.toml --fill-holes 3 --until preprocess
! make -f "$VARIMAP_SOURCE/pipelines/Makefile" SOURCE=part.off TARGET=whole.off OUT=made until-locate >log 2>&1 || fail "until-locate without PART"
grep -q 'until-locate needs PART' log || fail "make does not say what until-locate needs"
