#!/usr/bin/env bash
# varimap view and report; where there are Chromium, node and a built page, landmarks are picked there and used.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
coarse_pair
cp out.txt summary.txt

"$varimap" report good >out.txt 2>log || fail "report (exit $?)"
grep -q '^verdict ' out.txt || fail "no verdict"
diff <(grep '^verdict  look here' out.txt) <(grep '^verdict' summary.txt) || fail "map and report disagree"
grep -q 'area covered, source to target' out.txt || fail "no numbers"
jq '.warnings = [{stage: "diffuse a--b", message: "all is\nlost"}]' good/quality.json >warned.json
[[ $(report_on <warned.json | jq -r .verdict) == "look here" ]] || fail "a warning is not heeded"
expect_exit 6 "$varimap" report absent

# Of many parts that are not reached the largest are named; nothing is called impossible, or certain.
summary_of() { jq -r --arg out good "$(words_of_quality)$(<"$VARIMAP_SOURCE/pipelines/summary.jq")" "$@"; }
jq '.source_to_target.uncovered = [range(7) | {area_percent: (9 - .), vertex: .}] | .target_to_source.uncovered = .source_to_target.uncovered[:3]
    | .exploration = {continued: 1, candidates: [{}], probability: .004, confident: false}' good/quality.json >doubtful.json
summary_of doubtful.json >summary.txt
grep -q 'not reached on the target: 9 % .* vertex 0, 8 % .* vertex 1, 7 % of the area around vertex 2 and 4 more$' summary.txt || fail "the largest of many parts"
grep -q 'not reached on the source: .* vertex 2$' summary.txt || fail "three parts"
grep -q 'candidate 1 of 1, right with a probability below 0.01, not sure' summary.txt || fail "a small probability"
jq '.exploration |= (.probability = .996 | .confident = true)' doubtful.json | summary_of >summary.txt
grep -q 'candidate 1 of 1, right with a probability above 0.99$' summary.txt || fail "a large probability"

# What the source's holes lack counts against no map: the report goes by what is reached with these closed, and so does the table of a batch.
jq '.source_to_target += {coverage: .8, when_closed: {coverage: .995, uncovered: []}} | .target_to_source.coverage = .99' good/quality.json >holes.json
report_on <holes.json | jq -e 'any(.checks[]; .what == "area covered, source to target, holes closed" and .value == "99.5 %" and .grade == "good")' >/dev/null ||
    fail "coverage with holes closed in the report"
jq --arg name p --arg source a --arg target b --arg key k --arg candidate 1 \
    "$(words_of_quality)$(<"$VARIMAP_SOURCE/pipelines/batch/result.jq")" holes.json | jq -e '.coverage_percent == 99' >/dev/null ||
    fail "coverage with holes closed in the table of a batch"
# Of another candidate the first one's probability is not rounded up either.
jq '.exploration = {continued: 2, candidates: [{}, {}], probability: .996}' good/quality.json |
    report_on | jq -e 'any(.checks[]; .value == "candidate 2, as asked (the first: above 0.99)")' >/dev/null || fail "the first one's probability"
expect_exit 6 "$varimap" view absent
expect_exit 2 "$varimap" view good more

# The page's data: what a browser does with it is tested below.
printf '<!--varimap-data-->' >frame.html
"$VARIMAP_BIN/varimap-view" a.off b.off good/{source_to_target,target_to_source}.csv frame.html page.html >out.txt 2>log ||
    fail "view (exit $?)"
grep -q 'id="arrays"' page.html || fail "no arrays"
: >empty.html
expect_exit 3 "$VARIMAP_BIN/varimap-view" a.off b.off good/{source_to_target,target_to_source}.csv empty.html none.html
[[ ! -e none.html ]] || fail "half a page"

# Meshes other than the map was made of are refused.
hash=$(jq -r .provenance.source.hash good/quality.json)
"$VARIMAP_BIN/varimap-view" a.off b.off good/{source_to_target,target_to_source}.csv frame.html page.html --source-hash "$hash" \
    >out.txt 2>log || fail "view of the mesh that was mapped (exit $?)"
expect_exit 4 "$VARIMAP_BIN/varimap-view" a.off b.off good/{source_to_target,target_to_source}.csv frame.html none.html --target-hash "$hash"
[[ ! -e none.html ]] || fail "a page of another mesh"

# Points whose file states other axes than they are in.
picked() {  # FILE OF A MESH: five of its vertices
    echo '# CoordinateSystem = RAS'
    landmarks_of_figure "$1" | awk 'NR == FNR { at[$1] = FNR; next } FNR - 3 in at { print at[FNR - 3] "," $1 "," $2 "," $3 ",0,0,0,1,1,1,0,tip" at[FNR - 3] ",," }' - "$1"
}
picked a.off >a.fcsv
picked b.off >b.fcsv
spaced_page() {  # OPTION...
    "$VARIMAP_BIN/varimap-view" a.off b.off good/{source_to_target,target_to_source}.csv frame.html page.html --landmarks a.fcsv b.fcsv \
        "$@" >out.txt 2>log || fail "view --landmarks $* (exit $?)"
}
spaced_page
grep -q 'page shows no landmarks' log || fail "landmarks in other axes are shown"
spaced_page --landmark_space as-is
grep -q 'tip3' page.html || fail "landmarks are not shown in the axes that were said"

# Options are recorded as they were understood, for the command that the page offers.
cp a.off "it's --mirror.off"
printf '[eigen]\ncount = 80\n' >'my file.toml'
landmarks_of_figure a.off >"it's a tip.txt"
map a.off "it's --mirror.off" -o told --until remesh --part=source --fill_holes 30 --config 'my file.toml' --landmarks="it's a tip.txt"
jq -c .provenance.options told/quality.json >options.txt
grep -qxF "[[\"--set\",\"render.width=64\"],[\"--set\",\"render.samples=1\"],$(printf '["--set","%s"],' "${coarse[1]}" "${coarse[3]}")[\"--part\",\"source\"],[\"--fill-holes\",\"30\"],[\"--config\",\"$PWD/my file.toml\"]]" options.txt ||
    fail "options that are recorded: $(<options.txt)"
if command -v node >/dev/null; then
    report_on <told/quality.json >report.json
    node --input-type=module - "$VARIMAP_SOURCE" <<'TEXT' >next.sh || fail "the page's landmarks"
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
const { Landmarks, nextCommand } = await import(`${process.argv[2]}/pipelines/view/src/landmarks.js`);
const landmarks = new Landmarks(() => {});
for (let i = 0; i < 3; i++) landmarks.add({});
landmarks.remove(0);
landmarks.add({});
assert.deepEqual(landmarks.items.map(({ name }) => name), ['L2', 'L3', 'L1']);
const side = (file) => ({ side: { file } });
console.log(nextCommand(JSON.parse(readFileSync('report.json', 'utf8')), { source: side('a.off'), target: side("it's --mirror.off") }));
TEXT
    sed "s/^varimap/printf '%s\\\\n'/" next.sh | sh >words.txt
    printf '%s\n' map a.off "it's --mirror.off" -o out-picked --set render.width=64 --set render.samples=1 "${coarse[@]}" --part source --fill-holes 30 \
        --config "$PWD/my file.toml" --landmarks landmarks.txt | diff words.txt - >log || fail "the command that the page offers: $(<log)"
fi

frame=$VARIMAP_BIN/../view/frame.html
[[ -s $frame ]] || { echo "skipped the browser: build $frame with pipelines/view/build"; exit 77; }
# The front end tells the page what the map was made of, and in which axes.
printf '[diffuse]\nlandmark_space = "as-is"\n[explore]\nlandmark_space = "as-is"\n[render]\nlandmark_space = "as-is"\n' >as-is.toml
for how in --landmark-space=as-is --config=as-is.toml; do
    map a.off b.off -o spaced --landmarks a.fcsv b.fcsv "$how"
    "$varimap" view spaced >out.txt 2>log || fail "view of a map made with $how (exit $?)"
    grep -q 'tip3' spaced/view.html || fail "no landmarks on the page of a map made with $how"
done
rm -r spaced/artifacts
"$varimap" view spaced --landmark_space as-is >out.txt 2>log || fail "view --landmark_space (exit $?)"
grep -q 'tip3' spaced/view.html || fail "axes that are said are not heeded"
expect_exit 2 "$varimap" view spaced --landmark-space
"$varimap" view spaced -o elsewhere.html >out.txt 2>log || fail "view -o (exit $?)"
[[ -s elsewhere.html ]] || fail "no page where -o says"
cp a.off kept.off
awk 'NR == 2 { n = $1 } NR == 3 { first = $0; next } { print } NR == n + 2 { print first }' kept.off >a.off
expect_exit 4 "$varimap" view spaced
grep -q 'a.off: changed since the map was made; make the map again' log || fail "a changed mesh is not named"
mv kept.off a.off
"$varimap" view spaced >out.txt 2>log || fail "view of the mesh as it was (exit $?)"

for tool in node chromium; do
    command -v $tool >/dev/null || { echo "skipped the browser: $tool is missing"; exit 77; }
done
"$VARIMAP_BIN/varimap-view" a.off b.off good/{source_to_target,target_to_source}.csv "$frame" view.html >out.txt 2>log ||
    fail "view (exit $?)"
mkdir downloads
node "$VARIMAP_SOURCE/tests/view/view_test.mjs" "$(command -v chromium)" "$PWD/view.html" "$PWD/downloads" || fail "the page"
# With a texture, and with candidates of a symmetric shape, of which the choice is not sure.
awk -v n="$(awk 'NR == 2 { print $1 }' a.off)" 'BEGIN { print "mtllib a.mtl\nusemtl skin" }
    NR > 2 && NR <= n + 2 { print "v", $0; print "vt", $1 / 4 + .5, $3 / 6 + .5 }
    NR > n + 2 { print "f", $2 + 1 "/" $2 + 1, $3 + 1 "/" $3 + 1, $4 + 1 "/" $4 + 1 }' a.off >a.obj
printf 'newmtl skin\nmap_Kd a.png\n' >a.mtl
base64 -d >a.png <<<iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQDwAEhQGAhKmMIQAAAABJRU5ErkJggg==
"$varimap" view good --texture a.obj >out.txt 2>log || fail "view --texture (exit $?)"
grep -q '"texture":{"image":"data:image/png' good/view.html || fail "no texture on the page"
mkdir textured
node "$VARIMAP_SOURCE/tests/view/view_test.mjs" "$(command -v chromium)" "$PWD/good/view.html" "$PWD/textured" || fail "the page with a texture"
expect_exit 6 "$varimap" view good --texture absent.obj
expect_exit 2 "$varimap" view good --texture
figure c.off 9 0 0
figure d.off 10 0 0
map c.off d.off -o unsure
"$varimap" view unsure >out.txt 2>log || fail "view with candidates (exit $?)"
mkdir compared
node "$VARIMAP_SOURCE/tests/view/view_test.mjs" "$(command -v chromium)" "$PWD/unsure/view.html" "$PWD/compared" >out.txt ||
    fail "the page with candidates: $(cat out.txt)"
grep -q '^candidates: ' out.txt || fail "no candidates on the page of a choice that is not sure"
map a.off b.off -o again --landmarks downloads/landmarks.txt
jq -e '.landmarks | length > 0' again/quality.json >/dev/null || fail "picked landmarks were not used"
