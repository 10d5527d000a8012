#!/usr/bin/env bash
# A template onto specimens whose vertices correspond: points, landmarks, the mean shape, components, several templates.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
small_picture+=("${smaller[@]}")
mkdir -p meshes/parts.obj points
for twist in 1 2 3 4; do figure "meshes/s$twist.off" 10 ".$twist"; done
figure template.off 10
figure other.off 10 .25
landmarks_of_figure template.off | cut -d ' ' -f 1 >points/template.txt
cp points/template.txt points/other.txt

register() {  # ARGUMENTS
    "$varimap" register "${small_picture[@]}" "$@" >out.txt 2>log || fail "varimap register $* (exit $?)"
}
vertices() { awk 'NR == 2 { n = $1 } NR > 2 && NR <= n + 2' "$1"; }
# error TABLE MESH: mean distance of rows x,y,z in columns 2 to 4 from the mesh's vertices, its size being about 2
error() {
    paste -d ' ' <(tail -n +2 "$1" | cut -d , -f 2-4 | tr , ' ') <(vertices "$2") |
        awk '{ sum += sqrt(($1 - $4) ^ 2 + ($2 - $5) ^ 2 + ($3 - $6) ^ 2) } END { print sum / NR }'
}
at_most() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a <= b) }' || fail "$3: $1 instead of at most $2"; }

register template.off meshes -o out --landmarks-from points -j 2
for specimen in s1 s2 s3 s4; do
    at_most "$(error out/specimens/$specimen.csv meshes/$specimen.off)" .06 "points of $specimen"
    [[ $(sed -n 's/^element vertex //p' out/specimens/$specimen.ply) == 402 ]] || fail "$specimen.ply"
done
[[ $(wc -c <out/points.npy) == $((128 + 4 * 402 * 3 * 8)) ]] || fail "the size of points.npy"
head -c 128 out/points.npy | grep -q "'shape': (4, 402, 3," || fail "the shape of points.npy"
[[ $(wc -l <out/landmarks.csv) == 21 ]] || fail "rows of landmarks.csv"
for specimen in s1 s4; do
    paste -d ' ' <(grep "^$specimen," out/landmarks.csv | cut -d , -f 3-5 | tr , ' ') \
        <(while read -r v; do vertices meshes/$specimen.off | sed -n "$((v + 1))p"; done <points/template.txt) |
        awk '{ sum += sqrt(($1 - $4) ^ 2 + ($2 - $5) ^ 2 + ($3 - $6) ^ 2) } END { print sum / NR }' >error.txt
    at_most "$(<error.txt)" .1 "landmarks of $specimen"
done
# They differ in one thing, how far they are twisted: the first component is that.
share=$(sed -n 's/^1,[^,]*,//p' out/components.csv)
at_most .9 "$share" "share of the first component"
tail -n +2 out/specimens.csv | cut -d , -f 7 | sort -g -c 2>/dev/null || tail -n +2 out/specimens.csv | cut -d , -f 7 | sort -gr -c ||
    fail "scores are not in the order of the twists"
[[ -s out/component_1.png && -s out/mean.png ]] || fail "pictures"

# Again: nothing is mapped anew, and the bytes are the same.
cp -r out before
register template.off meshes -o out --landmarks-from points -j 1
grep -q '4 done already' log || fail "maps were made again"
for file in points.npy aligned.npy landmarks.csv specimens.csv components.csv mean.ply; do same "out/$file" "before/$file"; done

# Of two meshes with one name the second gets a number; landmarks, which go by names, would be the same.
mkdir same
cp meshes/s1.off same/template.off
register "${coarse[@]}" template.off same -o named -j 2
grep -q '^register: warning: other names.* same/template.off is template-2$' log || fail "another name is not told"
[[ -s named/specimens/template-2.csv && -s named/maps/pairs/template--template-2/quality.json ]] || fail "the second of one name"
# Without landmarks maps are chosen among several, right with some probability.
diff <(jq '.exploration.probability' named/maps/pairs/template--template-2/quality.json) \
    <(jq '.specimens[].answers[].probability' named/manifest.json) >log || fail "the probability of a map: $(<log)"
expect_exit 3 "$varimap" register "${small_picture[@]}" template.off same -o none --landmarks-from points
grep -q 'another mesh is called template' log || fail "landmarks of two meshes"

# What cannot be done leaves the results as they are.
for modes in five -1 1.5 1001; do
    expect_exit 2 "$varimap" register "${small_picture[@]}" template.off meshes -o out --landmarks-from points --modes $modes
    grep -q "^register: error: --modes $modes: " log || fail "--modes $modes is not said"
done
mkdir beyond
echo 402 >beyond/template.txt
expect_exit 3 "$varimap" register "${small_picture[@]}" template.off meshes -o out --landmarks-from points --points-from beyond
diff -r -x log.txt -x maps out before >log || fail "results of the run before"
nothing_left out

# Several templates: the median of their answers; a specimen that cannot be mapped is left out, and said.
register template.off meshes/s1.off meshes/s4.off -o several --landmarks-from points --templates other.off meshes/s2.off -j 2
[[ $(jq '.specimens | map(.answers | length) | unique[]' several/manifest.json) == 3 ]] || fail "answers of three templates"
at_most "$(error several/specimens/s4.csv meshes/s4.off)" .06 "points by three templates"
awk -F, 'NR > 1 && $8 > 0 { found = 1 } END { exit !found }' several/landmarks.csv || fail "no spread of several answers"
echo nonsense >meshes/s9.off
code=0
"$varimap" register "${small_picture[@]}" template.off meshes -o out --landmarks-from points >out.txt 2>log || code=$?
((code == 1)) || fail "exit $code with a specimen that fails"
grep -q '^left out    1 .*: s9;' out.txt || fail "who is left out"
same out/points.npy before/points.npy

# A further template that cannot be mapped says nothing, which is said.
code=0
"$varimap" register "${small_picture[@]}" template.off meshes/s1.off -o several --landmarks-from points --templates other.off meshes/s9.off >out.txt 2>log || code=$?
((code == 1)) || fail "exit $code with a further template that fails"
grep -q '^failed      1 .*: s9; why: several/maps/status.csv' out.txt || fail "which template failed"
! grep -q '^left out' out.txt || fail "a specimen is left out though templates are mapped to it"

# A broken specimen has points where it is; those that are whole are compared as if it were not there.
mkdir specimens
cp meshes/s1.off meshes/s4.off specimens
upper_part meshes/s2.off >specimens/broken.off
register template.off specimens -o partly --landmarks-from points --parts specimens/broken.off -j 2
grep -c ',nan,nan,nan$' partly/specimens/broken.csv >missing.txt
(($(<missing.txt) > 100 && $(<missing.txt) < 300)) || fail "what a broken specimen lacks"
paste -d ' ' <(tail -n +2 partly/specimens/broken.csv | cut -d , -f 2-4 | tr , ' ') <(vertices meshes/s2.off) |
    awk '$1 != "nan" { sum += sqrt(($1 - $4) ^ 2 + ($2 - $5) ^ 2 + ($3 - $6) ^ 2); n++ } END { print sum / n }' >error.txt
at_most "$(<error.txt)" .06 "points of a broken specimen"
[[ $(cut -d , -f 1,5 partly/specimens.csv | xargs) == 'specimen,part broken,yes s1,no s4,no' ]] || fail "which specimen is a part"
grep -q '^broken,.*,$' partly/specimens.csv || fail "a part has scores"
awk -F, '$1 == "broken" { print $2 } $1 == "s1" { print $2 }' partly/specimens.csv |
    awk '{ size[NR] = $1 } END { r = size[1] / size[2]; exit !(r > .97 && r < 1.03) }' || fail "the size of a part"
grep -c 'broken,.*,nan,nan,nan,0.0000' partly/landmarks.csv >missing.txt
(($(<missing.txt) == 2)) || fail "landmarks that a broken specimen lacks"
expect_exit 2 "$varimap" register "${small_picture[@]}" template.off specimens -o none --parts template.off
grep -q 'template.off: a template, and among --parts' log || fail "a template that is a part"

# One of the other side: its points lie on it as it is, and its shape is that of its mirror image. (Twisted the other way it would have a
# score of the other sign.)
mkdir sides
cp meshes/s1.off meshes/s2.off meshes/s4.off sides
awk 'NR == 2 { n = $1 } NR > 2 && NR <= n + 2 { print -$1, $2, $3; next } NR > n + 2 { print 3, $2, $4, $3; next } { print }' meshes/s2.off >left.off
register template.off sides -o sided --landmarks-from points --mirrored left.off -j 2
at_most "$(error sided/specimens/left.csv left.off)" .06 "points of a mirrored specimen"
[[ $(cut -d , -f 1,6 sided/specimens.csv | xargs) == 'specimen,mirrored s1,no s2,no s4,no left,yes' ]] || fail "which specimen is mirrored"
awk -F, 'NR > 1 { score[$1] = $7 } END { d = score["left"] - score["s2"]; r = score["s4"] - score["s1"]; exit !(d * d < .01 * r * r) }' sided/specimens.csv ||
    fail "the shape of a mirrored specimen: $(<sided/specimens.csv)"
volume() { awk 'NF == 3 && !/[a-z]/ { x[n] = $1; y[n] = $2; z[n++] = $3 } NF == 4 && $1 == 3 { a = $2; b = $3; c = $4
    sum += x[a] * (y[b] * z[c] - z[b] * y[c]) - y[a] * (x[b] * z[c] - z[b] * x[c]) + z[a] * (x[b] * y[c] - y[b] * x[c]) } END { print (sum > 0) }'; }
[[ $(sed 1,/end_header/d sided/specimens/left.ply | volume) == $(sed 1,2d left.off | volume) ]] || fail "a mirrored specimen is inside out"
expect_exit 2 "$varimap" register "${small_picture[@]}" template.off sides -o none --mirrored template.off
expect_exit 2 "$varimap" register "${small_picture[@]}" template.off sides -o none --mirrored
grep -q -- '--mirrored: give meshes or folders behind it' log || fail "--mirrored of nothing: $(<log)"
expect_exit 2 "$varimap" register "${small_picture[@]}" template.off sides -o none --landmark-weight .2
grep -q -- '--landmark-weight: no map has landmarks' log || fail "an option of landmarks without any"
expect_exit 2 "$varimap" register "${small_picture[@]}" template.off sides -o none --landmark-base 1
grep -q -- '--landmark-base needs --landmarks-from or --points-from' log || fail "a base of landmarks without any"
mkdir one
awk '{ print $1 + 1 }' points/template.txt >one/template.txt
register "${coarse[@]}" template.off meshes/s1.off -o based --landmarks-from one --landmark-base 1
[[ $(wc -l <based/landmarks.csv) == 6 ]] || fail "landmarks of the template alone, counted from 1"

# A specimen of a format that is imported, though its ending makes it no mesh of a folder.
if [[ -x $VARIMAP_BIN/varimap-import ]]; then
    awk 'NR == 2 { n = $1 } NR > 2 && NR <= n + 2 { at[NR - 3] = $0 } NR > n + 2 { print at[$2], at[$3], at[$4] }' meshes/s1.off >s1.raw
    register template.off s1.raw meshes/s2.off -o imported -j 2
    at_most "$(error imported/specimens/s1.csv meshes/s1.off)" .06 "points of an imported specimen"
fi

# An interrupt ends what it has begun, too.
"$varimap" register "${small_picture[@]}" template.off meshes/s1.off meshes/s4.off -o stopped --landmarks-from points -j 1 >out.txt 2>log &
front_end=$!
until [[ -n $(find stopped -name '*.surface' 2>/dev/null) ]] || ! kill -0 "$front_end" 2>/dev/null; do sleep .1; done
kill -TERM "$front_end" || fail "ended before it was interrupted"
code=0
wait "$front_end" || code=$?
((code == 143)) || fail "exit $code when interrupted"
grep -q 'register: error: interrupted' log || fail "an interrupt is not told"
! pgrep -f "$PWD/stopped" >/dev/null || fail "what an interrupted run has begun goes on"

# A run with fewer specimens and without landmarks leaves nothing of the run before, but what is not register's.
register template.off meshes/s[1-4].off -o out --landmarks-from points
grep -q '^landmarks ' out.txt || fail "landmarks are not told"
[[ -s out/specimens/s4.ply && -s out/component_2.png ]] || fail "results of four specimens"
touch out/mine.csv out/specimens/mine.csv out/component_mine.ply
ln -s meshes linked
register template.off meshes/s1.off linked/s1.off meshes/s2.off -o out
(cd out && find . -path ./maps -prune -o -type f -print | sort) >left.txt
printf './%s\n' .lock aligned.npy component_1.png component_1_minus.ply component_1_plus.ply component_mine.ply components.csv \
    identity.csv log.txt manifest.json mean.ply mean.png mine.csv pairs.csv points.npy specimens.csv specimens/mine.csv \
    specimens/s{1,2}.{csv,ply} | sort | diff - left.txt >log || fail "what is there after a smaller run"
! grep -q '^landmarks ' out.txt || fail "landmarks of the run before are told"
! grep -q '^doubtful ' out.txt || fail "maps that are good are called doubtful"

# Maps that batch says to look at are named, the worst first, with -q too.
doubt() {  # PAIR BADNESS
    jq -c ".badness = $2" "out/maps/pairs/$1/result.json" >result.json && mv result.json "out/maps/pairs/$1/result.json"
}
doubt template--s1 1.2
doubt template--s2 1.5
register template.off meshes/s1.off meshes/s2.off -o out -q
grep -q '^doubtful    s2, s1: .*out/maps/status.csv' out.txt || fail "whose maps are doubtful"

# More than a handful are counted.
mkdir broken
for i in 1 2 3 4 5 6 7; do echo nonsense >broken/b$i.off; done
cp points/template.txt points/b7.txt
code=0
"$varimap" register "${small_picture[@]}" template.off meshes/s1.off broken -o out --landmarks-from points >out.txt 2>log || code=$?
((code == 1)) || fail "exit $code where seven are left out"
grep -q '^left out    7 .*: b1, b2, b3, b4, b5 and 2 more' out.txt || fail "the names of those left out"
grep -q 'register: warning: points: no landmarks of 7 of the 8 .*(s1, b1, b2, b3, b4 and 2 more)' log || fail "who has no landmarks"

# Landmarks of others are of no use without the template's; a template counts once.
mkdir others
cp points/template.txt others/s1.txt
for folder in landmarks-from points-from; do
    expect_exit 3 "$varimap" register template.off meshes/s1.off -o none --$folder others
    grep -q 'register: error: others: no landmarks of the template template.off' log || fail "--$folder without the template's"
done
expect_exit 3 "$varimap" register template.off meshes/s1.off -o none --landmarks-from points --points-from others
expect_exit 2 "$varimap" register template.off meshes/s1.off -o none --templates template.off
grep -q 'register: error: template.off: .* twice' log || fail "the template as a further one"
expect_exit 2 "$varimap" register template.off meshes/s1.off -o none --templates other.off ./other.off

# Landmarks may be points, of the template and of the specimens, by their names; whatever could not be carried is refused before a map
# is made.
mkdir places wrong
tips() {  # MESH
    echo name,x,y,z
    while read -r v; do echo "tip $v,$(vertices "$1" | sed -n "$((v + 1))p" | tr ' ' ,)"; done <points/template.txt
}
for mesh in template other meshes/s1; do tips $mesh.off >"places/${mesh##*/}.csv"; done
register template.off meshes/s1.off meshes/s2.off -o placed "${coarse[@]}" --landmarks-from places --templates other.off
[[ $(cut -d , -f 2 placed/landmarks.csv | sed -n 2p) == "tip $(head -n 1 points/template.txt)" ]] || fail "names of landmarks that are points"
# A specimen that lacks some is named, and its map judged as any other.
mkdir lacking
cp places/template.csv lacking
sed 3d places/s1.csv >lacking/s1.csv
tips meshes/s2.off | sed '3s/,.*/,NA,NA,NA/' >lacking/s2.csv
register template.off meshes/s1.off meshes/s2.off -o lacks --landmarks-from lacking
grep -q '^lacking     some landmarks: s1, s2, .*; which: lacks/maps/status.csv$' out.txt || fail "who lacks landmarks: $(<out.txt)"
! grep -q '^doubtful' out.txt || fail "who lacks landmarks is called doubtful: $(<out.txt)"
grep -q '^"template--s1".*left out are .tip ' lacks/maps/status.csv || fail "which landmarks are lacking: $(<lacks/maps/status.csv)"
grep -q '^"template--s2".*on one of the surfaces, and left out: .tip ' lacks/maps/status.csv || fail "which landmarks are missing: $(<lacks/maps/status.csv)"
cut -d , -f 2-4 places/template.csv | tail -n +2 | tr , ' ' >wrong/template.txt
register template.off meshes/s1.off meshes/s2.off -o placed "${coarse[@]}" --landmarks-from places --points-from wrong --templates other.off
grep -q '5 done already' log || fail "points to carry make maps anew"
awk '{ print $1 + 50, $2, $3 }' wrong/template.txt >far.txt && mv far.txt wrong/template.txt
for folder in landmarks-from points-from; do
    expect_exit 3 "$varimap" register template.off meshes/s1.off -o none --$folder wrong
    grep -q 'register: error: .*/wrong/template.txt:[0-9]*: .* lie farther' log || fail "points far from the template, --$folder"
done
expect_exit 3 "$varimap" register template.off meshes/s1.off -o none --landmarks-from wrong --points-from points
cp places/template.csv wrong && rm wrong/template.txt
sed 's/^tip/top/' places/other.csv >wrong/other.csv
expect_exit 3 "$varimap" register template.off meshes/s1.off -o none --points-from wrong --templates other.off
grep -q "register: error: .*/wrong/other.csv: 'tip .* is not there" log || fail "other names on a further template"
printf '1 2\n3 4\n' >wrong/template.csv
expect_exit 3 "$varimap" register template.off meshes/s1.off -o none --points-from wrong
grep -q 'register: error: .*/wrong/template.csv:1: expected a vertex number' log || fail "pairs instead of a list"

# Options of maps are looked at first; what a run writes is not what the next one reads.
for option in --set=eigen.cout=3 --area-bound=0.5 --mirror -j9999; do
    expect_exit 2 "$varimap" register template.off meshes -o none $option
done
expect_exit 2 "$varimap" register template.off meshes -o meshes
grep -q 'register: error: meshes: its results would be taken for specimens' log || fail "OUT that holds the specimens"
expect_exit 2 "$varimap" register template.off out/specimens -o out
expect_exit 2 "$varimap" register out/mean.ply meshes -o out

expect_exit 2 "$varimap" register template.off -o none
expect_exit 2 "$varimap" register template.off meshes
expect_exit 6 "$varimap" register absent.off meshes -o none
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n' >flat.off
expect_exit 3 "$varimap" register "${small_picture[@]}" flat.off meshes/s1.off meshes/s2.off -o broken -q
grep -q 'no specimen could be mapped; the first: .*flat' log || fail "a broken template: $(<log)"
expect_exit 6 "$varimap" register template.off meshes -o none --points-from absent
expect_exit 3 "$VARIMAP_BIN/varimap-register" template.off --out none
echo '{"template": "template.off", "specimens": []}' >empty.json
expect_exit 3 "$VARIMAP_BIN/varimap-register" empty.json --out none
echo '{"template": "template.off", "landmarks": "", "specimens": [{"name": "s1", "mesh": "meshes/s1.off", "answers": []}]}' >empty.json
expect_exit 3 "$VARIMAP_BIN/varimap-register" empty.json --out none
grep -q 's1: no answers' log || fail "whose answers are missing"
[[ ! -e none ]] || fail "what is refused left files"

# The map of a mesh that was replaced is not taken for that of the mesh there now where its job was killed.
mkdir replaced
cp meshes/s1.off meshes/s2.off replaced
register template.off replaced -o again
cp meshes/s4.off replaced/s1.off
"$varimap" register "${small_picture[@]}" template.off replaced -o again -j 1 >out.txt 2>log &
front_end=$!
until pkill -KILL -f "batch/job $PWD/again/maps pair "; do
    kill -0 "$front_end" 2>/dev/null || fail "ended before its job was killed: $(<log)"
    sleep .05
done
code=0
wait "$front_end" || code=$?
((code == 1)) || fail "exit $code where a job was killed"
grep -q '^left out    1 .*: s1;' out.txt || fail "the map of a mesh before is taken for that of another"
