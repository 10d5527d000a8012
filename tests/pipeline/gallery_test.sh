#!/usr/bin/env bash
# Cheap figures of the gallery: a page, a table, and what they measured.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
gallery=$VARIMAP_SOURCE/pipelines/gallery
"$gallery" -o out fig02 fig04 fig20 >out.txt 2>log || fail "gallery (exit $?): $(cat out.txt)"
cat out.txt
for figure in fig02 fig04 fig20; do grep -qE "^$figure +[0-9]+ s  same: " out.txt || fail "$figure is not as in the paper"; done
[[ $(wc -l <out/table.csv) == 4 ]] || fail "table.csv"
grep -q '<img src="fig02/widths.svg"' out/index.html || fail "index.html"
while read -r file; do [[ -s out/$file ]] || fail "no $file"; done < <(grep -o 'src="[^"]*"' out/index.html | cut -d'"' -f2)
grep -qE 'nan|inf' out/fig02/widths.svg && fail "a number in widths.svg"
# Along the curves every point goes to itself, up to one sample, whatever the width; in space not. Not only as rounded.
awk -F, 'NR > 1 && $3 != 100 { exit 1 }' out/fig02/widths.csv || fail "no identity: $(cat out/fig02/widths.csv)"
for width in 11 81; do
    awk -F, 'NR > 1 && ($1 - $2) ^ 2 > 1 { exit 1 } END { exit NR != 201 }' out/fig02/intrinsic-$width/source_partners.csv ||
        fail "no identity for $width neighbours"
done
awk -F, 'NR > 1 { near += ($1 - $2) ^ 2 <= 1 } END { exit !(near < 150) }' out/fig02/ambient/source_partners.csv || fail "no fold in space"
# Narrow weights need more iterations.
awk -F, 'NR == 2 { first = $2 } END { exit !(first > 5 * $2) }' out/fig02/widths.csv || fail "widths.csv"
expect_exit 2 "$gallery" -o out fig99
expect_exit 2 "$gallery" --nothing
expect_exit 2 "$VARIMAP_SOURCE/pipelines/plot" --x </dev/null
# What is no number is left out, in either column.
printf '%s\n' s,1,2 s,2,nan s,-inf,1 s,3,-NaN s,3e-1,4e+0 | "$VARIMAP_SOURCE/pipelines/plot" >with.svg
printf '%s\n' s,1,2 s,3e-1,4e+0 | "$VARIMAP_SOURCE/pipelines/plot" >without.svg
cmp with.svg without.svg || fail "plot draws what is no number"
