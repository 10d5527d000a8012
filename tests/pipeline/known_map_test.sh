#!/usr/bin/env bash
# The map between two poses of one figure is known: vertex i goes to vertex i.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
figure a.off 15
figure b.off 15 .7
landmarks_of_figure a.off >tips.txt
map a.off b.off -o out --landmarks tips.txt
n=$(awk 'NR == 2 { print $1 }' a.off)
seq 0 $((n - 1)) >all.txt

"$VARIMAP_BIN/varimap-evaluate" b.off out/source_to_target.csv all.txt all.txt --index-base 0 --json >forth.json 2>log
"$VARIMAP_BIN/varimap-evaluate" a.off out/target_to_source.csv all.txt all.txt --index-base 0 --json >back.json 2>log
jq -c '{mean, median, maximum}' forth.json back.json
jq -e '.mean < .03 and .median < .025 and .maximum < .2' forth.json >/dev/null || fail "source to target"
jq -e '.mean < .03 and .median < .025 and .maximum < .2' back.json >/dev/null || fail "target to source"
jq -c '{flips: .source_to_target.flipped_area_percent, coverage: .source_to_target.coverage, round_trip}' out/quality.json
jq -e '.source_to_target.coverage > .97 and .target_to_source.coverage > .97' out/quality.json >/dev/null || fail "coverage"
jq -e '(.landmarks | length) == 5 and (.landmarks | max) < 1e-6' out/quality.json >/dev/null || fail "landmarks"
for table in source_to_target target_to_source; do
    awk -F, -v n="$n" 'NR == 1 { bad = $0 != "vertex,face,b0,b1,b2"; next }
        $1 != NR - 2 || $2 < 0 || $3 < 0 || $4 < 0 || $5 < 0 || ($3 + $4 + $5 - 1) ^ 2 > 1e-18 { bad = 1 }
        END { exit bad || NR != n + 1 }' out/$table.csv || fail "$table.csv is malformed"
done

# More landmarks than the sketches have vertices for.
figure dense.off 30
awk 'NR == 2 { for (v = 0; v < $1; v += 4) print v, v }' dense.off >many.txt
map dense.off dense.off -o many --landmarks many.txt --until diffuse
grep -q 'landmarks are too many or too near to others for the sketches' many/log.txt || fail "all landmarks are on the sketches"
