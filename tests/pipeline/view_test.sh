#!/usr/bin/env bash
# varimap view and report; where there are Chromium, node and a built page, landmarks are picked there and used.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
coarse_pair

"$varimap" report good >out.txt 2>log || fail "report (exit $?)"
grep -q '^verdict ' out.txt || fail "no verdict"
grep -q 'area covered, source to target' out.txt || fail "no numbers"
jq '.warnings = [{stage: "diffuse a--b", message: "all is\nlost"}]' good/quality.json >warned.json
[[ $(jq -r -f "$VARIMAP_SOURCE/pipelines/report.jq" warned.json | jq -r .verdict) == "look here" ]] || fail "a warning is not heeded"
expect_exit 6 "$varimap" report absent
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

frame=$VARIMAP_BIN/../view/frame.html
[[ -s $frame ]] || { echo "skipped the browser: build $frame with pipelines/view/build"; exit 0; }
for tool in node chromium; do
    command -v $tool >/dev/null || { echo "skipped the browser: $tool is missing"; exit 0; }
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
