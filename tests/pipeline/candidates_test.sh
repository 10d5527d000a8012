#!/usr/bin/env bash
# Where symmetry leaves several maps, the run says so and shows them; once landmarks decide, the picture goes.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
figure a.off 9 0 0
figure b.off 10 0 0
map a.off b.off -o out
grep -q 'explore. warning: .*candidates.png' log || fail "no warning names the picture"
grep -q 'not sure: look at out/candidates.png' out.txt || fail "the summary does not name the picture"
[[ $(head -c 4 out/candidates.png | tail -c 3) == PNG ]] || fail "no picture of the candidates"
jq -e '.exploration | .confident == false and .margin < .25' out/quality.json >/dev/null || fail "sure of a symmetric shape"
# Warnings of stages that ran earlier are repeated.
map a.off b.off -o out
expect_ran ""
head -n 1 out.txt | grep -q '^warning  explore a--b: .*candidates.png' || fail "the summary does not begin with the warning"
jq -e '[.warnings[] | select(.stage == "explore a--b") | .message] | length == 1' out/quality.json >/dev/null ||
    fail "the warning in quality.json"
# Nor is a smooth picture drawn again; runs that share artifacts wait until nothing is to be done.
map a.off b.off -o smooth --artifacts shared --set render.samples=4
map a.off b.off -o smooth --artifacts shared --set render.samples=4
expect_ran ""

# Another candidate is continued: nobody asks again to choose.
map a.off b.off -o out --candidate 2
! grep -q 'not sure\|candidates.png' out.txt || fail "after --candidate 2 the summary still asks"
grep -q 'explored: candidate 2 of [0-9]*, as asked; the first, as it was found, is right with a probability of' out.txt ||
    fail "the summary does not say which candidate it is, or gives it the probability of the first: $(<out.txt)"
"$varimap" report out >report.txt 2>log || fail "report"
grep -q 'candidate 2, as asked' report.txt || fail "the report does not say which candidate it is"
! grep -q '^warning  explore' report.txt || fail "the report still warns"
map a.off b.off -o out

# By hand, what has no effect is refused.
both=(out/artifacts/{a,b}.{coarse,basis,hierarchy})
expect_exit 2 "$VARIMAP_BIN/varimap-diffuse" "${both[@]}" new.diffusion --candidate 2
grep -q 'maps of --candidates' log || fail "--candidate alone"
expect_exit 2 "$VARIMAP_BIN/varimap-diffuse" "${both[@]}" new.diffusion --map_base 1 --candidates out/artifacts/a--b.candidates
grep -q 'how --initial-map counts' log || fail "--map_base alone"

# The long axis runs up to 1.3, the next one to 0.7.
tips() {
    awk 'NR > 2 && NF == 3 { if ($3 > 1.29) up = NR - 3; if ($3 < -1.29) down = NR - 3
            if ($1 > .69) side = NR - 3; if ($1 < -.69) other = NR - 3 }
        END { print up; print down; print side; print other }' "$1"
}
paste <(tips a.off) <(tips b.off) >tips.txt
map a.off b.off -o out --landmarks tips.txt
jq -e '[.warnings[].stage] | index("explore a--b") == null' out/quality.json >/dev/null || fail "the warning of explore, which this map does without"
[[ ! -e out/candidates.png ]] || fail "the candidates of an earlier run are still shown"
# Candidate 2 is another one without them.
map a.off b.off -o out --candidate 2 --until preprocess
grep -q 'warning: the map in out was made with .*tips.txt: candidate 2 is not of the list found then' log ||
    fail "landmarks that are left out change the candidates without a word"

# Symmetries of one shape: its reflection, of which there is no doubt that it mirrors, and turns, of which none is the right one.
map a.off a.off -o sym --mirror
! grep -q 'fit better as mirror images' out.txt log || fail "the reflection of a shape is doubted: it mirrors"
sketch=(sym/artifacts/a.sketch.{coarse,basis,hierarchy})
"$varimap" explore "${sketch[@]}" "${sketch[@]}" self.candidates --onto_itself true >out.txt 2>log || fail "explore --onto_itself"
"$varimap" inspect self.candidates >out.txt || fail "inspect"
grep -q '^ *candidate 1' out.txt || fail "maps onto itself: $(<out.txt)"
! grep -q 'right with a probability' out.txt log || fail "maps onto itself are called right: $(<out.txt)"
