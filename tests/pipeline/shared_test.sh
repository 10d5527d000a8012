#!/usr/bin/env bash
# Runs that share artifacts at the same time, and runs that are killed at random moments: the same bytes in the end.
# VARIMAP_KILLS: how many runs are killed (default 12).
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
small_picture+=("${coarse[@]}")
kills=${VARIMAP_KILLS:-12}
figure a.off 6
figure b.off 6 .5
start=$EPOCHREALTIME
map a.off b.off -o good -j 2
map b.off a.off -o back -j 2
milliseconds=$(((${EPOCHREALTIME/./} - ${start/./}) / 2000))  # of one run

# run OUT OPTION...: in the background, in a session of its own
run() {
    setsid "$varimap" map -v "${small_picture[@]}" "${@:2}" -o "$1" >"$1.out" 2>"$1.log" </dev/null &
}
finish() {  # OUT PROCESS
    local code=0
    wait "$2" || code=$?
    ((code == 0)) || { cat "$1.log"; fail "$1: exit $code"; }
}

# Two runs at once that share artifacts, each made once; then two whose folders are each other's.
run one a.off b.off --artifacts shared
one=$!
run two a.off b.off --artifacts shared
two=$!
finish one $one
finish two $two
same_results good one
same_results good two
cat one.log two.log >log
ran_times() {  # COUNT STAGE...
    local stage
    for stage in "${@:2}"; do
        [[ $(grep -c "^\[$stage\] done" log) == "$1" ]] || fail "$stage did not run $1 times"
    done
}
ran_times 1 explore diffuse refine
ran_times 2 preprocess
ran_times 4 eigen hierarchy  # of both surfaces and their sketches
run p a.off b.off --artifacts q
one=$!
run q b.off a.off --artifacts p
two=$!
finish p $one
finish q $two
same p/source_to_target.csv good/source_to_target.csv
same q/source_to_target.csv back/source_to_target.csv

# Two runs that disagree on a parameter of a shared artifact: both finish with what they asked for, one after the other, or
# one gives up.
same_maps() {  # OUT OUT
    local file
    for file in source_to_target.csv target_to_source.csv; do same "$1/$file" "$2/$file"; done
}
settled() {  # PROCESS OUT OUT OF ONE ALONE
    local code=0
    wait "$1" || code=$?
    ((code == 0 || code == 4)) || { cat "$2.log"; fail "$2: exit $code"; }
    if ((code == 4)); then
        [[ ! -e $2/quality.json ]] || fail "$2: gave up, and left a quality.json"
        grep -q 'other runs make the same files there' "$2.log" || fail "$2: $(<"$2.log")"
        return
    fi
    same_maps "$2" "$3"
}
map a.off b.off -o good_30 --set eigen.count=30
run left a.off b.off --artifacts disputed
one=$!
run right a.off b.off --artifacts disputed --set eigen.count=30
two=$!
settled $one left good
settled $two right good_30
[[ -e left/quality.json || -e right/quality.json ]] || fail "both runs that disagree gave up"
map a.off b.off -o left --artifacts disputed
same_results good left
map a.off b.off -o right --artifacts disputed --set eigen.count=30
same_results good_30 right

# Between two stages of a run another one makes all of both surfaces anew, with other parameters: all fits together again.
landmarks_of_figure a.off >tips.txt
map a.off b.off -o good_tips --landmarks tips.txt --set eigen.count=30
run left a.off b.off --landmarks tips.txt --artifacts taken --set eigen.count=30 -j 1
one=$!
until grep -qs '^\[explore' left/log.txt || ! kill -0 $one 2>/dev/null; do sleep .02; done
run right a.off b.off --artifacts taken --until hierarchy -j 1
wait $! || true  # it may give up, or have its turn after the other
finish left $one
same_maps good_tips left
jq -e '.stages["eigen a"].eigenpairs == 30' left/quality.json >/dev/null || fail "a map of another run's parameters"
# The one whose own folder it is does not know of the other from its command line.
run owner a.off b.off --set eigen.count=30 -j 1
one=$!
until grep -qs '^\[explore' owner/log.txt || ! kill -0 $one 2>/dev/null; do sleep .02; done
run right a.off b.off --artifacts owner/artifacts --until hierarchy -j 1
wait $! || true  # it may give up, or have its turn after the other
finish owner $one
same_maps good_30 owner
jq -e '.stages["eigen a"].eigenpairs == 30' owner/quality.json >/dev/null || fail "a map of another run's parameters, in its owner's folder"
# Where that goes on and on, it is said.
mkdir busy
until [[ ! -d busy || -e busy/end ]]; do  # this test may end before, and remove its folder
    "$VARIMAP_BIN/varimap-preprocess" --least_component .0$((RANDOM % 8 + 2)) a.off busy/artifacts/a.surface 2>busy/log || true
done &
one=$!
expect_exit 4 "$varimap" map -q "${small_picture[@]}" a.off b.off -o left --artifacts busy/artifacts -j 1
touch busy/end
wait $one
grep -q 'error: left/artifacts: other runs make the same files there with other parameters' log || fail "never settled: $(<log)"
[[ ! -e left/quality.json ]] || fail "a map of nobody knows which parameters"

# Killed: everything, or the front end alone, or one stage.
kinds=(all front_end stage)
RANDOM=1
for ((i = 0; i < kills; ++i)); do
    out=killed/$((RANDOM % 2))
    mkdir -p killed
    options=(--artifacts killed/artifacts)
    ((RANDOM % 2)) || options+=(--set eigen.count=30)
    run $out a.off b.off "${options[@]}"
    session=$!
    sleep "$(printf '%d.%03d' $((RANDOM % milliseconds / 1000)) $((RANDOM % 1000 * milliseconds / 1000 % 1000)))"
    # shellcheck disable=SC2046
    kill -9 $(victims "${kinds[RANDOM % 3]}" $session) 2>/dev/null || true
    wait $session 2>/dev/null || true
    # A stage that outlived the front end may write there still.
    ((RANDOM % 4)) || until rm -rf $out 2>/dev/null; do sleep .1; done
done
for out in killed/0 killed/1; do
    map a.off b.off -o $out --artifacts killed/artifacts
    same_results good $out
done
artifacts killed/artifacts | xargs "$VARIMAP_BIN/varimap-inspect" --check 2>log || fail "a damaged artifact was left"
nothing_left good one two p q killed
echo "$kills runs of about $milliseconds ms were killed"
