#!/usr/bin/env bash
# Data sets in their published layouts, listed for bench; runs that go on, curves, and comparison with other results.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
list() { "$varimap" bench-list "$@" >out.txt 2>log || fail "bench-list $*"; }
field() { awk -F, -v row="$2" -v column="$3" 'NR == row + 1 { print $column }' "$1"; }

# Ren et al. 2018: lists that start at 1, mirrored lists beside them, pairs parted by tabs.
mkdir -p set/vtx_5k/corres
figure set/vtx_5k/cat0.off 6
figure set/vtx_5k/cat1.off 6 .3
for name in cat0 cat1; do
    seq 1 146 >set/vtx_5k/corres/$name.vts
    seq 146 -1 1 >set/vtx_5k/corres/$name.sym.vts
done
printf 'cat0\tcat1\ncat1\tcat0\n\n' >set/test_pairs.txt
list set set/test_pairs.txt -o ren.csv --group cats --landmarks 3
[[ $(wc -l <ren.csv) == 3 && $(field ren.csv 1 1) == cats && $(field ren.csv 1 7) == 1 ]] || fail "ren.csv: $(cat ren.csv)"
[[ $(field ren.csv 1 2) == "$PWD/set/vtx_5k/cat0.off" && $(field ren.csv 2 5) == "$PWD/set/vtx_5k/corres/cat1.vts" ]] ||
    fail "paths of ren.csv: $(cat ren.csv)"
# Landmarks: three points, each where it belongs, far from each other: no two on one limb.
[[ $(sort -u "$(field ren.csv 1 4)" | wc -l) == 3 ]] || fail "landmarks"
awk '$1 != $2 { exit 1 }' "$(field ren.csv 1 4)" || fail "landmarks of two points"
awk 'NR == FNR { if (FNR > 2 && NF == 3) { x[FNR - 3] = $1; y[FNR - 3] = $2; z[FNR - 3] = $3 } next } { v[++n] = $1 }
    END { for (i = 1; i <= n; ++i) for (k = 1; k < i; ++k)
        if ((x[v[i]] - x[v[k]]) ^ 2 + (y[v[i]] - y[v[k]]) ^ 2 + (z[v[i]] - z[v[k]]) ^ 2 < 1) exit 1 }' \
    set/vtx_5k/cat0.off "$(field ren.csv 1 4)" || fail "landmarks near each other"

# SHREC'07 with coordinates behind the vertex: from 0. Names of files in the list, parted by commas.
mkdir seven
for name in 381 382; do
    figure seven/$name.off 6
    awk 'FNR > 2 && NF == 3 && FNR % 20 == 3 { print FNR - 3, $1, $2, $3 }' seven/$name.off >seven/$name.vts
done
echo 381.off,382.off >pairs.txt
list seven pairs.txt -o seven.csv
[[ $(field seven.csv 1 1) == seven && $(field seven.csv 1 7) == 0 ]] || fail "seven.csv: $(cat seven.csv)"

# SHREC'19: a file for every pair.
mkdir -p nineteen/off nineteen/corres
figure nineteen/off/1.off 6
figure nineteen/off/2.off 6 .3
seq 1 146 >nineteen/corres/1_2.map
printf '1 2\n2 1\n' >pairs.txt
list nineteen pairs.txt -o nineteen.csv
grep -q 'pairs: 2, 1 without known points' out.txt || fail "missing points: $(cat out.txt)"
[[ $(field nineteen.csv 1 7) == 1 && -z $(field nineteen.csv 2 5) ]] || fail "nineteen.csv: $(cat nineteen.csv)"
same "$(field nineteen.csv 1 5)" nineteen/corres/1_2.map
list nineteen pairs.txt -o nineteen.csv --landmarks 2
grep -q 'pairs: 2, 1 without known points' out.txt || fail "missing points with --landmarks: $(cat out.txt)"
[[ -s $(field nineteen.csv 1 4) && -z $(field nineteen.csv 2 4) ]] || fail "landmarks where points are known"
seq 0 145 >nineteen/corres/1_2.map
list nineteen pairs.txt -o nineteen.csv
[[ $(field nineteen.csv 1 7) == 0 ]] || fail "numbers from 0: $(cat nineteen.csv)"
same "$(field nineteen.csv 1 5)" nineteen/corres/1_2.map

refused() {  # CODE TEXT ARGUMENT...
    rm -f bad.csv
    expect_exit "$1" "$varimap" bench-list "${@:3}" -o bad.csv
    grep -q -- "$2" log || fail "no '$2' in: $(cat log)"
    [[ ! -e bad.csv ]] || fail "a list was left"
}
refused 6 'no such folder' nowhere pairs.txt
refused 6 'no such file' set none.txt
refused 2 'bench-list --help' set
echo cat0 cat7 >bad.txt
refused 6 'bad.txt: row 1: there is no mesh of the name cat7' set bad.txt
echo cat0 cat1 cat0 >bad.txt
refused 3 'row 1 has 3 names' set bad.txt
echo '# none' >bad.txt
refused 3 'names no pair' set bad.txt
cp -r set twice
cp -r twice/vtx_5k twice/vtx_10k
refused 3 'the same name; say which with --meshes' twice set/test_pairs.txt
list twice set/test_pairs.txt -o twice.csv --meshes vtx_10k
seq 1 140 >set/vtx_5k/corres/cat1.vts
refused 3 'has 146 points, .* has 140' set set/test_pairs.txt
echo one >set/vtx_5k/corres/cat1.vts
refused 3 'line 1 begins with no number of a vertex: one' set set/test_pairs.txt
echo 147 >set/vtx_5k/corres/cat0.vts
echo 1 >set/vtx_5k/corres/cat1.vts
refused 3 'has no vertex 147' set set/test_pairs.txt --landmarks 2
for name in cat0 cat1; do seq 1 146 >set/vtx_5k/corres/$name.vts; done

# bench takes the list, goes on where it ended, and draws curves.
bench() { "$varimap" bench "$@" "${coarse[@]}" --set render.width=64 --set render.samples=1 >out.txt 2>log || fail "bench $*: $(cat out.txt)"; }
bench ren.csv -o benched
[[ $(wc -l <benched/bench.csv) == 3 ]] || fail "bench.csv: $(cat benched/bench.csv)"
awk -F, 'NR > 1 && !($3 < .2) { exit 1 }' benched/bench.csv || fail "errors: $(cat benched/bench.csv)"
awk -F, '$1 != "cats" || $3 < before { exit 1 } { before = $3 } END { exit !(NR > 10 && before > 90) }' benched/curves.csv ||
    fail "curves.csv: $(cat benched/curves.csv)"
grep -q 'cats' benched/curves.svg || fail "curves.svg"
made() { find benched -name '*.plan' -printf '%p %T@\n' -o -name '*.map' -printf '%p %T@\n' | sort; }
made >before.txt
[[ -s before.txt ]] || fail "no artifacts"
bench ren.csv -o benched
made >after.txt
same before.txt after.txt

# Points may be landmarks of any form: here where the vertices of the lists are.
awk 'NR == 2 { n = $1 } NR > 2 && NR <= n + 2' set/vtx_5k/cat0.off >places.txt
awk 'NR == 2 { n = $1 } NR > 2 && NR <= n + 2 { print "Point" NR ",", $1 ",", $2 ",", $3 }' set/vtx_5k/cat1.off >places.csv
cp benched/bench.csv lists.csv
awk -F, -v OFS=, -v places="$PWD/places" 'NR > 1 {
    $5 = places (NR == 2 ? ".txt" : ".csv"); $6 = places (NR == 2 ? ".csv" : ".txt"); $7 = "" } { print }' ren.csv >places_list.csv
bench places_list.csv -o benched
made >after.txt
same before.txt after.txt
awk -F, 'function far(a, b) { return (a - b) ^ 2 > 1e-8 } NR == FNR { mean[FNR] = $3; next } FNR > 1 && far($3, mean[FNR]) { exit 1 }' \
    lists.csv benched/bench.csv || fail "points as places: $(cat benched/bench.csv), as vertices: $(cat lists.csv)"
bench ren.csv -o benched

# Lists are read as those of batch: quotes, blanks, a byte order mark, and a last row without a line end; groups may hold dots.
mkdir 'my set'
figure 'my set/cat, 0.off' 6
cp set/vtx_5k/cat1.off 'my set/cat.1.off'
printf '\xef\xbb\xbfgroup,source,target,landmarks,source_points,target_points,index_base\r\n# two\n%s\n%s' \
    'v1.5,"my set/cat, 0.off",my set/cat.1.off,,set/vtx_5k/corres/cat0.vts,set/vtx_5k/corres/cat1.vts,1' \
    'v1.6,my set/cat.1.off,"my set/cat, 0.off",,set/vtx_5k/corres/cat1.vts,set/vtx_5k/corres/cat0.vts,1' >odd.csv
bench odd.csv -o odd
[[ $(cut -d , -f 1,2 odd/bench.csv | xargs) == "group,pair v1.5,cat__0--cat_1 v1.6,cat_1--cat__0" ]] || fail "rows of an odd list: $(<odd/bench.csv)"
[[ $(cut -d , -f 1 odd/curves.csv | sort -u | xargs) == "v1.5 v1.6" ]] || fail "groups with dots: $(cut -d , -f 1 odd/curves.csv | sort -u)"

# Compared with itself, and with means that were made better and worse by .01.
mkdir was
cp benched/bench.csv was/bench.csv
bench ren.csv -o benched --compare was
grep -q 'of 2 pairs 0 better, 0 worse, 2 the same (within .003); sign test: p = 1$' out.txt || fail "compared: $(tail -n 1 out.txt)"
[[ $(grep -c '^  same   cats' out.txt) == 2 ]] || fail "by pair: $(cat out.txt)"
awk -F, -v OFS=, 'NR > 1 { $3 += .01 } { print }' benched/bench.csv >was/bench.csv
bench ren.csv -o benched --compare was
grep -q 'of 2 pairs 2 better, 0 worse, 0 the same (within .003); sign test: p = 0.5$' out.txt || fail "compared: $(tail -n 1 out.txt)"
[[ $(grep -c '^  better cats' out.txt) == 2 ]] || fail "by pair: $(cat out.txt)"
expect_exit 6 "$varimap" bench ren.csv -o benched --compare nowhere

# Groups that no pair has; maps that cannot be evaluated.
cp benched/list.csv list.csv
expect_exit 2 "$varimap" bench ren.csv -o benched --group cats --group dogs
grep -q 'bench: error: --group dogs: no pair has that group; there are: cats$' log || fail "an unknown group: $(cat log)"
same list.csv benched/list.csv
echo one two >no_numbers.txt
seq 1 3 >three.vts
while IFS='|' read -r code text row; do
    { head -n 1 ren.csv; echo "$row"; } >bad.csv
    expect_exit "$code" "$varimap" bench bad.csv -o none
    grep -q "bench: error: .*$text" log || fail "no '$text' in: $(<log)"
    [[ ! -e none ]] || fail "a refused list left files"
done <<'TEXT'
3|bad.csv, row 2: quotes that do not end|cats,"a.off,b.off,,,,
3|bad.csv: a row with more fields than columns|cats,a.off,b.off,,,,,1
3|bad.csv: a row without group, source or target|cats,a.off,,,,,
6|absent.txt: no such file|cats,set/vtx_5k/cat0.off,set/vtx_5k/cat1.off,,absent.txt,absent.txt,
3|bad.csv: a row with source_points only: cats,a.off,b.off,,a.vts,,; give target_points|cats,a.off,b.off,,a.vts,,
3|bad.csv: a row with target_points only: cats,a.off,b.off,,,a.vts,1; give source_points|cats,a.off,b.off,,,a.vts,1
3|bad.csv: a row whose index_base is one: cats,a.off,b.off,,,,one; say 0 or 1|cats,a.off,b.off,,,,one
3|bad.csv: row cats,set/vtx_5k/cat0.off,.*,0: .*cat0.vts:146: .*146|cats,set/vtx_5k/cat0.off,set/vtx_5k/cat1.off,,set/vtx_5k/corres/cat0.vts,set/vtx_5k/corres/cat1.vts,0
3|bad.csv: row .*no_numbers.txt:1: |cats,set/vtx_5k/cat0.off,set/vtx_5k/cat1.off,,no_numbers.txt,set/vtx_5k/corres/cat1.vts,
3|bad.csv: row .*146|cats,set/vtx_5k/cat0.off,set/vtx_5k/cat1.off,,set/vtx_5k/corres/cat0.vts,three.vts,1
TEXT
# What points leave open is said once. A mesh that cannot be read fails alone, as it does without points.
echo nothing >text.off
seq 2 20 >some.vts
{
    head -n 1 ren.csv
    for name in text cat0 cat1; do echo "open,set/vtx_5k/$name.off,set/vtx_5k/cat1.off,,some.vts,some.vts,"; done
} >open.csv
cp text.off set/vtx_5k
code=0
"$varimap" bench open.csv -o open "${coarse[@]}" --set render.width=64 --set render.samples=1 >out.txt 2>log || code=$?
((code == 1)) || fail "exit $code where a mesh cannot be read"
rm set/vtx_5k/text.off
grep -q '^open .*text--cat1 *failed (3): ' out.txt || fail "a mesh that cannot be read: $(cat out.txt)"
[[ $(wc -l <open/bench.csv) == 3 ]] || fail "others than a mesh that cannot be read: $(cat open/bench.csv)"
[[ $(grep -c 'bench: warning: .*row open,set/vtx_5k/cat0.off.*counted from 0.* index_base 0 or 1 decides; the like in 1 more' log) == 1 ]] || fail "what points leave open: $(<log)"

# An interrupt ends all that was begun, while points are checked, pairs are mapped, or measured, and leaves what was there before.
stopped() {  # FILE: is there once what is to be interrupted goes on
    local session code=0
    until [[ -n $(find . -path "./$1" 2>/dev/null) ]] || ! kill -0 $! 2>/dev/null; do sleep .02; done
    session=$!
    kill -TERM $session || fail "ended before it was interrupted: $(<log)"
    wait $session || code=$?
    ((code == 143)) || fail "exit $code after an interrupt"
    # shellcheck disable=SC2009  # pgrep counts those that have ended, too
    [[ -z $(ps -o stat= -s $session | grep -v Z || true) ]] || fail "something goes on after an interrupt: $(ps -o args= -s $session)"
    grep -q 'bench: error: interrupted' log || fail "an interrupt is not told: $(<log)"
}
setsid "$varimap" bench ren.csv -o stopped >out.txt 2>log </dev/null &
stopped 'stopped/artifacts/*.surface'
bench ren.csv -o benched
mkdir slow
ln -s "$VARIMAP_BIN"/* slow
rm slow/varimap-evaluate
cat >slow/varimap-evaluate <<TEXT
#!/bin/sh
case "\$*" in *--check*) touch "$PWD/checking"; [ ! "\$SLOW_CHECK" ] || sleep 60; exit ;; esac
echo half
touch "$PWD/measuring"
sleep 60
TEXT
chmod +x slow/varimap-evaluate
cp -r benched before
SLOW_CHECK=yes VARIMAP_BIN=$PWD/slow setsid "$varimap" bench ren.csv -o benched >out.txt 2>log </dev/null &
stopped checking
VARIMAP_BIN=$PWD/slow setsid "$varimap" bench ren.csv -o benched "${coarse[@]}" --set render.width=64 --set render.samples=1 >out.txt 2>log </dev/null &
stopped measuring
for file in bench.csv list.csv curves.csv curves.svg; do same before/$file benched/$file; done
nothing_left benched

# What evaluation says is of this run alone, and a pair whose points the list no longer names has no curve.
bench ren.csv -o benched
bench ren.csv -o benched
[[ $(grep -c 'done: ' benched/pairs/cats.cat0--cat1/errors.txt) == 1 ]] || fail "errors.txt is of several runs"
cp benched/curves.csv both.csv
awk -F, -v OFS=, 'NR == 2 { $5 = $6 = "" } { print }' ren.csv >one.csv
bench one.csv -o benched
[[ ! -e benched/pairs/cats.cat0--cat1/curve.csv ]] || fail "a curve of points that are not named"
! cmp -s both.csv benched/curves.csv || fail "curves of points that are not named"
