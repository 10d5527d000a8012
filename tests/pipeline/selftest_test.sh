#!/usr/bin/env bash
# Two of the generated shapes, one of genus 1, onto bent copies of themselves without landmarks.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
selftest=$VARIMAP_SOURCE/pipelines/selftest
"$selftest" -o out --first 2 --count 2 "${small_picture[@]}" >out.txt 2>log || fail "selftest (exit $?)"
cat out.txt
[[ $(tail -n 1 out.txt) == '2 of 2 right;'* ]] || fail "the summary"
[[ $(awk -F, 'NR > 1 { print $1, $2, $8 }' out/selftest.csv) == $'2 ring right\n3 animal right' ]] || fail "selftest.csv"

# A map that reverses orientation is called wrong.
code=0
"$selftest" -o out --first 3 --count 1 "${small_picture[@]}" --mirror >out.txt 2>log || code=$?
((code == 1)) || fail "exit $code for a wrong map"
grep -Eq ' (wrong|mirrored)$' out.txt || fail "no row says that the map is wrong"
expect_exit 2 "$selftest" --count x
expect_exit 2 "$selftest" --family bird
expect_exit 2 "$selftest" --variation 0.5  # copies have no proportions that differ
for wrong in --set=eigen.cout=3 --no-such shape; do
    expect_exit 2 "$selftest" -o none "$wrong"
    [[ ! -e none ]] || fail "a shape is made before $wrong is refused"
done
grep -q '^selftest: error: too many files: shape;' log || fail "a word that is no option"

# Members of a family.
"$selftest" -o members --family bone --first 1 --count 1 --variation 0.3 "${small_picture[@]}" >out.txt 2>log ||
    fail "--family bone (exit $?)"
[[ $(awk -F, 'NR > 1 { print $1, $2, $8 }' members/selftest.csv) == '1 bone right' ]] || fail "members/selftest.csv"

# Any: the number decides what is drawn; what was said of the maps is compared with what is true.
code=0
"$selftest" -o any --family any --first 4 --count 1 "${small_picture[@]}" >out.txt 2>log || code=$?
((code <= 1)) || fail "--family any (exit $code)"
awk -F, 'NR == 2 && $2 != "any" && $6 >= 0 && $6 <= 1 { fine = 1 } END { exit !fine }' any/selftest.csv || fail "any/selftest.csv"
grep -A 1 '^said ' out.txt | tail -n 1 | grep -Eq ' [01] +1$' || fail "no table of what was said: $(<out.txt)"

# Leading zeros do not make a number octal.
"$selftest" -o zeros --first 08 --count 1 "${small_picture[@]}" >out.txt 2>log || (($? == 1)) || fail "--first 08"
[[ $(awk -F, 'NR > 1 { print $1 }' zeros/selftest.csv) == 8 ]] || fail "--first 08 is not shape 8"
