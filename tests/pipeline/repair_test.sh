#!/usr/bin/env bash
# Meshes as they are: loose triangles, some turned, with duplicates, vertices that are not numbers and a small part of their
# own. Every vertex of the file has its row, every tool takes the file, and the map is that of the clean mesh.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
small_picture+=("${smaller[@]}")
figure a.off 15
figure b.off 15 .7
landmarks_of_figure a.off >tips.txt

# spoil FILE: its triangles with vertices of their own, every fifth turned, the first twice; then a face with a vertex that is
# not a number, one that names a vertex twice, and a tiny triangle apart.
spoil() {
    awk 'NR == 2 { n = $1; f = $2; print "OFF\n" 3 * f + 5, f + 4, 0 }
        NR > 2 && NR <= n + 2 { at[NR - 3] = $0 }
        NR > n + 2 && NR <= n + f + 2 {
            for (c = 2; c <= 4; c++) print at[$c]
            i = 3 * (NR - n - 3)
            faces = faces "3 " i " " (NR % 5 ? i + 1 " " i + 2 : i + 2 " " i + 1) "\n"
        }
        END {
            print "0 0 0\nnan 0 0\n9 9 9\n9.001 9 9\n9 9.001 9"
            printf "%s3 0 1 2\n3 0 1 %d\n3 0 0 1\n3 %d %d %d\n", faces, 3 * f + 1, 3 * f + 2, 3 * f + 3, 3 * f + 4
        }' "$1"
}
# places FILE: the vertices of the clean file that those of the spoiled one are.
places() {
    awk 'NR == 2 { n = $1; f = $2 } NR > n + 2 && NR <= n + f + 2 { for (c = 2; c <= 4; c++) print $c }' "$1"
}
spoil a.off >a-spoiled.off
spoil b.off >b-spoiled.off
places a.off >place.txt
rows=$(($(wc -l <place.txt) + 5))
awk 'NR == FNR { if (!($1 in first)) first[$1] = FNR - 1; next } { print first[$1], first[$2] }' place.txt tips.txt >tips-spoiled.txt

expect_exit 3 "$varimap" map a-spoiled.off b-spoiled.off -o refused --repair none
expect_exit 2 "$varimap" map a-spoiled.off b-spoiled.off -o refused --repair everything
# A list of repairs reaches every stage that reads a mesh, also of plain make.
map a.off b.off -o listed --landmarks tips.txt --repair weld,faces "${coarse[@]}"
map a.off b.off -o listed --mirror --repair=weld,faces --until preprocess
make -s -f "$VARIMAP_SOURCE/pipelines/Makefile" SOURCE=a.off TARGET=b.off OUT=made PREPROCESS_FLAGS="--repair weld,faces" MIRROR=yes \
    until-preprocess >out.txt 2>log || fail "make with a list of repairs (exit $?)"
for surface in {listed,made}/artifacts/{a.mirrored:true,b:false}; do
    grep -q "mirror=${surface#*:} repair=weld,faces " <<<"$("$VARIMAP_BIN/varimap-inspect" "${surface%:*}.surface" 2>log)" ||
        fail "the repairs that were asked for are not those of ${surface%:*}"
done
map a-spoiled.off b-spoiled.off -o part --until preprocess
grep -q 'warning  preprocess a-spoiled: repaired: ' out.txt || fail "what was repaired is not said before the end"
map a-spoiled.off b-spoiled.off -o part-elsewhere --artifacts elsewhere --until preprocess
grep -q 'warning  preprocess a-spoiled: repaired: ' out.txt || fail "what was repaired is not said of artifacts elsewhere"
map a-spoiled.off b-spoiled.off -o out --landmarks tips-spoiled.txt
cp out.txt summary.txt
grep -q 'warning  preprocess a-spoiled: repaired: .* welded, .* dropped, .* turned, 1 component left out' out.txt ||
    fail "what was repaired is not said"
jq -e '.stages["preprocess a-spoiled"] | .welded_vertices > 1000 and .not_finite_faces == 1 and .degenerate_faces == 1
    and .duplicate_faces == 1 and .turned_faces > 300 and .dropped_components == 1' out/quality.json >/dev/null ||
    fail "what was repaired is not counted"

# Rows, and why there is none.
for table in source_to_target target_to_source; do
    awk -F, -v n="$rows" 'NR > 1 && ($1 != NR - 2 || ($2 < 0) != (NR - 1 > n - 5)) { bad = 1 } END { exit bad || NR != n + 1 }' \
        out/$table.csv || fail "$table.csv: rows"
done
tail -n 5 out/source_vertices.csv | cut -d, -f2 | tr '\n' ' ' >fates.txt
[[ $(<fates.txt) == "unused not_finite component_dropped component_dropped component_dropped " ]] ||
    fail "fates: $(<fates.txt)"
grep -q '^vertex,fate,twin$' out/source_vertices.csv || fail "no header"

# Twins have the same image, and the map is as good as that of the clean meshes.
map a.off b.off -o clean --landmarks tips.txt
seq 0 $((rows - 6)) >all.txt
error() {  # JSON of varimap-evaluate
    "$VARIMAP_BIN/varimap-evaluate" "$@" --index-base 0 --json 2>log
}
sort -nu place.txt >used.txt
error b.off clean/source_to_target.csv used.txt used.txt >clean.json
error b-spoiled.off out/source_to_target.csv all.txt all.txt >spoiled.json
jq -c '{mean, maximum}' clean.json spoiled.json
jq -es '.[1].mean < .03 and .[1].mean < 1.2 * .[0].mean + .002' clean.json spoiled.json >/dev/null || fail "error"
awk -F, 'NR == FNR { place[FNR - 1] = $1; next }
    FNR > 1 && $1 in place { image = $2 " " $3 " " $4 " " $5
        if (place[$1] in had && had[place[$1]] != image) bad++
        had[place[$1]] = image } END { exit bad > 0 }' place.txt out/source_to_target.csv || fail "twins have different images"

# The tools.
"$VARIMAP_BIN/varimap-verify" a-spoiled.off b-spoiled.off out/source_to_target.csv --json >verify.json 2>log || fail "verify"
jq -e '.reversed_area_percent < 1 and .degree > .99 and .degree < 1.01' verify.json >/dev/null || fail "verify finds a bad map"
"$VARIMAP_BIN/varimap-render" a-spoiled.off b-spoiled.off out/{source_to_target,target_to_source}.csv picture.png --width 64 \
    --samples 1 --distortion out/{source,target}_masses.csv 2>log || fail "render"
"$VARIMAP_BIN/varimap-inspect" --check out/artifacts/*.{surface,coarse,map} 2>log || fail "inspect"
"$VARIMAP_BIN/varimap-preprocess" out/source_on_target.ply exported.surface 2>log || fail "the exported mesh"

# A clean mesh is the same surface, byte for byte, whatever may be repaired.
payload() {  # ARTIFACT
    grep -a -m 1 '^payload ' "$1"
}
for mesh in a b; do
    for repair in all none weld,faces; do
        "$VARIMAP_BIN/varimap-preprocess" --repair $repair --fill_holes all $mesh.off $mesh.$repair.surface 2>log || fail "$mesh $repair"
    done
    [[ -n $(payload $mesh.all.surface) ]] || fail "no payload"
    for repair in none weld,faces; do
        [[ $(payload $mesh.$repair.surface) == "$(payload $mesh.all.surface)" ]] || fail "$mesh: --repair $repair changes a clean mesh"
    done
done

# Holes are filled on request, and no row changes its meaning: without the first vertex's faces, then with all.
awk 'NR == 2 { n = $1; f = $2 } NR > n + 2 && ($2 == 0 || $3 == 0 || $4 == 0) { lost++; next } { line[++lines] = $0 }
    END { for (i = 1; i <= lines; i++) print i == 2 ? n " " f - lost " 0" : line[i] }' a.off >holed.off
expect_exit 2 "$varimap" map holed.off b.off -o filled --fill-holes few
map holed.off b.off -o filled --landmarks tips.txt --fill-holes 12 "${coarse[@]}"
grep -qx 'note     preprocess holed: repaired: 1 hole filled' out.txt || fail "the filled hole is not told"
jq -e '.stages["preprocess holed"] | .filled_holes == 1 and .filling_faces > 1 and .boundary_loops == 0' filled/quality.json \
    >/dev/null || fail "the filled hole is not counted"
awk -F, 'NR == 2 { bad = $2 != -1 } NR > 2 && $2 < 0 { bad = 1 } END { exit bad }' filled/source_to_target.csv || fail "rows of a filled mesh"
faces=$(awk 'NR == 2 { print $2 }' holed.off)
awk -F, -v faces="$faces" 'NR > 1 && ($2 < 0 || $2 >= faces) { bad = 1 } END { exit bad }' filled/target_to_source.csv ||
    fail "images on faces that fill a hole"
map holed.off b.off -o open --landmarks tips.txt "${coarse[@]}"
jq -e '.stages["preprocess holed"] | .boundary_loops == 1 and (has("filled_holes") | not)' open/quality.json >/dev/null ||
    fail "a hole is filled that should stay"

# A handle is cut on request, and every vertex of the file keeps its row and an image.
mkdir handle
"$VARIMAP_BIN/varimap-generate" handle 1 handle >log 2>&1 || fail "generate"
expect_exit 2 "$varimap" map handle/source.ply handle/target.ply -o cut --cut-handles some
map handle/source.ply handle/target.ply -o cut --landmarks handle/landmarks.txt --cut-handles .3 "${coarse[@]}"
grep -qx 'note     preprocess target: repaired: 1 small handle or tunnel closed' out.txt || fail "the cut handle is not told"
jq -e '(.stages["preprocess target"] | .cut_handles == 1 and .asked_cuts == 1 and .genus == 0)
    and (.stages["preprocess source"] | .genus == 0 and (has("cut_handles") | not))' cut/quality.json >/dev/null ||
    fail "the cut handle is not counted"
awk -F, 'NR > 1 && $2 < 0 { bad = 1 } END { exit bad }' cut/target_to_source.csv || fail "rows of a mesh whose handle is cut"
map handle/source.ply handle/target.ply -o whole --landmarks handle/landmarks.txt "${coarse[@]}"
jq -e '.stages["preprocess target"] | .genus == 1 and (has("cut_handles") | not)' whole/quality.json >/dev/null ||
    fail "a handle is cut that should stay"

# The picture is of what was mapped, however that was asked for: a second component is left out of it, too.
awk 'NR == 2 { n = $1; print "OFF\n" n + 4, $2 + 4, 0 } NR > 2 && NR <= n + 2 { print }
    NR == n + 3 { print "3 0 0\n3.8 0 0\n3 .8 0\n3 0 .8" } NR > n + 2 { print }
    END { print "3", n, n + 2, n + 1; print "3", n, n + 1, n + 3; print "3", n, n + 3, n + 2; print "3", n + 1, n + 2, n + 3 }' a.off >two.off
map two.off b.off -o spelt --landmarks tips.txt "${coarse[@]}" --components largest
map two.off b.off -o spelt --landmarks tips.txt "${coarse[@]}" --set preprocess.components=largest
expect_ran ""
printf '[preprocess]\ncomponents = "largest"\n' >largest.toml
map two.off b.off -o spelt --landmarks tips.txt "${coarse[@]}" --config largest.toml
expect_ran ""
cp spelt/picture.png largest.png
map two.off b.off -o spelt --landmarks tips.txt "${coarse[@]}" --set preprocess.least_component=.2
same spelt/picture.png largest.png
map two.off b.off -o spelt --landmarks tips.txt "${coarse[@]}"
! cmp -s spelt/picture.png largest.png || fail "the second component is in no picture"

# What is noted is told, and nothing to look at; what is warned of is.
report_of() { jq -n "{source_to_target: {flipped_area_percent: 0, coverage: 1, conformal_distortion: {p50: 1, p95: 1}}} + $1" | report_on; }
report_of '{notes: [{stage: "preprocess a", message: "repaired: this"}]}' | jq -e '.verdict == "good" and .alarms == [] and
    .notes == ["preprocess a: repaired: this"]' >/dev/null || fail "a note makes a map doubtful"
report_of '{warnings: [{stage: "preprocess a", message: "repaired: that"}]}' | jq -e '.verdict == "look here" and
    .alarms == ["preprocess a"] and .notes == []' >/dev/null || fail "a warning does not make one look"
"$varimap" report out >report.txt 2>log || fail "report"
grep -q '^verdict  look here: before you use this map, see what preprocess a-spoiled warns of; what preprocess b-spoiled warns of' report.txt ||
    fail "what to look at is not said: $(head -n 1 report.txt)"
# So said the run that made the map.
grep -qxF -- "$(head -n 1 report.txt)" summary.txt || fail "the summary does not say what the report says: $(<summary.txt)"

# Which meshes are taken, and what is repaired.
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 0 0\n3 0 1 0\n' >nothing.off
"$varimap" survey a.off holed.off >survey.csv 2>log || fail "survey"
[[ $(wc -l <survey.csv) == 3 ]] || fail "survey: rows"
grep -q '^"holed.off",taken,.*,0,1,' survey.csv || fail "survey: $(<survey.csv)"
code=0
"$varimap" survey nothing.off a-spoiled.off --fill-holes all >survey.csv 2>log || code=$?
((code == 1)) || fail "survey: exit $code"
for line in '"nothing.off",refused,' '"a-spoiled.off",taken,.*welded'; do
    grep -q "^$line" survey.csv || fail "survey: $(<survey.csv)"
done
expect_exit 2 "$varimap" survey a.off --repair=everything
expect_exit 2 "$varimap" survey a.off --mirror true
