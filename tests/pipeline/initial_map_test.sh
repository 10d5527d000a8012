#!/usr/bin/env bash
# --initial-map continues another method's map, right or wrong, in each format; evaluate and verify read them, too.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
figure a.off 10
figure b.off 10 .5
n=$(awk 'NR == 2 { print $1 }' a.off)
seq 0 $((n - 1)) >all.txt

# A coarse map: every vertex goes to its nearest one among every twentieth; counted from 1. And a wrong one: turned by half
# a turn about the long axis.
coarse_map() {  # SIGN OF X AND Y, FILE
    awk -v n="$n" -v sign="$1" 'NR > 2 && NR <= n + 2 { x[NR - 3] = $1; y[NR - 3] = $2; z[NR - 3] = $3 }
        END { for (v = 0; v < n; v++) {
            best = -1
            for (w = 0; w < n; w += 20) {
                d = (sign * x[v] - x[w]) ^ 2 + (sign * y[v] - y[w]) ^ 2 + (z[v] - z[w]) ^ 2
                if (best < 0 || d < least) { best = w; least = d }
            }
            print best + 1 } }' a.off >"$2"
}
coarse_map 1 right.txt
coarse_map -1 turned.txt

mean() {  # MAP OPTIONS: mean error of a map of a onto b
    "$VARIMAP_BIN/varimap-evaluate" b.off "$1" all.txt all.txt --index-base 0 --json "${@:2}" 2>log | jq .mean
}
is_below() { jq -en "$1 < $2" >/dev/null; }  # NUMBER BOUND

given=$(mean right.txt --source-mesh a.off)
map a.off b.off -o out --initial-map right.txt
made=$(mean out/source_to_target.csv)
echo "mean error: given $given, made of it $made"
is_below "$given" .1 || fail "the map that is given is too far off"
is_below .04 "$given" || fail "the map that is given leaves nothing to do"
is_below "$made" .03 || fail "the map was not refined"
moved=$(jq -c .initial_map out/quality.json)
jq -en "$moved | .mean > .03 and .mean < .1 and .step > .02" >/dev/null || fail "how far it moved: $moved"
! jq -r '.warnings[].message' out/quality.json | grep -q 'from the initial one' || fail "a coarse map is meant to move"
[[ $(jq -r '.provenance.initial_map.file' out/quality.json) == "$PWD/right.txt" ]] || fail "where it came from"
jq -e '.exploration == null' out/quality.json >/dev/null || fail "explored all the same"
map a.off b.off -o out --initial-map right.txt
expect_ran ""
map a.off b.off -o out --initial-map right.txt --map-base 1
same_as_before=$(mean out/source_to_target.csv)
[[ $same_as_before == "$made" ]] || fail "the base was not found"
[[ $(jq -c .initial_map out/quality.json) == "$moved" ]] || fail "the base was not passed on"
map a.off b.off -o out --initial-map turned.txt
is_below .1 "$(mean out/source_to_target.csv)" || fail "the map that was given was not followed"

seq 7 $((n + 6)) | sed 's/.*/7/' >constant.txt
map a.off b.off -o out --initial-map constant.txt --map-base 0 --until diffuse
grep -q 'to one place of the target' out/log.txt || fail "a constant map passes without a word"

# What varimap wrote may be continued: a table, its arrays.
map a.off b.off -o kept --initial-map right.txt
cp kept/source_to_target.csv table.csv
for file in table.csv kept/source_to_target.npz; do
    map a.off b.off -o out --initial-map "$file"
    is_below "$(mean out/source_to_target.csv)" .03 || fail "$file"
done
for file in right.txt kept/source_to_target.npz; do
    "$VARIMAP_BIN/varimap-verify" a.off b.off "$file" --json >verified.json 2>log || fail "verify $file"
done
jq -e '.reversed_area_percent < 1' verified.json >/dev/null || fail "arrays are read wrongly by verify"
is_below "$(mean kept/source_to_target.npz)" .03 || fail "arrays are read wrongly by evaluate"
cp b.off b_before.off
expect_exit 2 "$VARIMAP_BIN/varimap-evaluate" b.off kept/source_to_target.npz all.txt all.txt --curve b.off
cmp b.off b_before.off || fail "evaluate wrote its curve over the mesh"

# Landmarks in other forms: points, one file of pairs.
points() { awk -v n="$n" 'NR > 2 && NR <= n + 2 && NR % 40 == 5' "$1"; }
points a.off >a.points.txt
points b.off >b.points.txt
paste -d' ' a.points.txt b.points.txt >pairs.txt
awk -v n="$n" 'NR > 2 && NR <= n + 2 && NR % 40 == 5 { print NR - 3, NR - 3 }' a.off >numbers.txt
for list in "a.points.txt b.points.txt" pairs.txt numbers.txt; do
    # shellcheck disable=SC2086
    "$VARIMAP_BIN/varimap-evaluate" b.off kept/source_to_target.csv $list --source-mesh a.off --json >errors.json 2>log ||
        fail "evaluate $list"
    jq -e '.pairs > 5 and .mean < .03' errors.json >/dev/null || fail "evaluate $list: $(jq -c . errors.json)"
done
expect_exit 2 "$VARIMAP_BIN/varimap-evaluate" b.off kept/source_to_target.csv pairs.txt
# Known partners may share a vertex, as two lists may have one twice.
printf '0 0\n1 0\n' >shared.txt
"$VARIMAP_BIN/varimap-evaluate" b.off kept/source_to_target.csv shared.txt --source-mesh a.off --json 2>log | jq -e '.pairs == 2' >/dev/null ||
    fail "pairs that share a vertex: $(<log)"

# Refused in one line.
head -n 5 right.txt >few.txt
expect_exit 3 "$varimap" map a.off b.off -o none --initial-map few.txt
grep -q 'few.txt: 5 rows, but the source mesh has' log || fail "the reason is not given"
sed '7s/.*/100000/' right.txt >range.txt
expect_exit 3 "$varimap" map a.off b.off -o none --initial-map range.txt
grep -q 'range.txt:7: vertex 100000 is out of range' log || fail "the reason is not given"
expect_exit 6 "$varimap" map a.off b.off -o none2 --initial-map absent.txt
expect_exit 2 "$varimap" map a.off b.off -o none2 --initial-map right.txt --explore
expect_exit 2 "$varimap" map a.off b.off -o none2 --map-base 1
[[ ! -e none2 && ! -e none/source_to_target.csv ]] || fail "something was written"
