#!/usr/bin/env bash
# A stage killed at any moment leaves its old artifact or none, and the next run completes.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
figure a.off 10
figure b.off 10 .5
inspect=$VARIMAP_BIN/varimap-inspect
map a.off b.off -o reference -j 1

# kill_after SECONDS COMMAND...
kill_after() {
    local seconds=$1 child
    shift
    "$@" >out.txt 2>log </dev/null &
    child=$!
    sleep "$seconds"
    kill -9 "$child" 2>/dev/null || true
    wait "$child" 2>/dev/null || true
}

both=(reference/artifacts/{a,b}.{coarse,basis,hierarchy})
mkdir killed
cp reference/artifacts/b.basis old.basis
for moment in .002 .005 .01 .02 .03 .05 .08 .12 .2; do
    kill_after $moment "$VARIMAP_BIN/varimap-eigen" reference/artifacts/a.surface killed/new.basis
    [[ ! -e killed/new.basis ]] || same killed/new.basis reference/artifacts/a.basis
    rm -f killed/new.basis
    cp old.basis killed/a.basis
    kill_after $moment "$VARIMAP_BIN/varimap-eigen" reference/artifacts/a.surface killed/a.basis
    cmp -s killed/a.basis old.basis || same killed/a.basis reference/artifacts/a.basis
    kill_after $moment "$VARIMAP_BIN/varimap-diffuse" "${both[@]}" killed/new.diffusion \
        --candidates reference/artifacts/a--b.candidates
    [[ ! -e killed/new.diffusion ]] || same killed/new.diffusion reference/artifacts/a--b.diffusion
    rm -f killed/new.diffusion
done

# The whole pipeline, ended by an interrupt, which it answers, while some stage runs.
for stage in preprocess eigen explore diffuse; do
    signal=TERM expected=143
    [[ $stage != eigen ]] || signal=HUP expected=129
    : >log
    "$varimap" map -v "${small_picture[@]}" a.off b.off -o out -j 2 >/dev/null 2>log &
    front_end=$! code=0
    until grep -q "^\[$stage\]" log || ! kill -0 $front_end 2>/dev/null; do sleep .02; done
    kill -$signal $front_end 2>/dev/null || true
    wait $front_end 2>/dev/null || code=$?
    ((code == expected)) || fail "exit $code after SIG$signal while $stage ran"
    [[ $(tail -n 1 log) == 'varimap: error: interrupted; what is finished is kept' ]] || fail "an interrupt is not said"
    find out -name '*.surface' -o -name '*.coarse' -o -name '*.basis' -o -name '*.hierarchy' -o -name '*.candidates' -o -name '*.diffusion' -o -name '*.plan' \
        -o -name '*.map' -o -name '*.quality' | while read -r artifact; do
        "$inspect" --check "$artifact" &>/dev/null || fail "$artifact is damaged after an interrupt"
    done
done
map a.off b.off -o out
for artifact in reference/artifacts/*.{surface,coarse,basis,hierarchy,candidates,diffusion,plan,map,quality}; do
    same "$artifact" "out/artifacts/${artifact##*/}"
done

# Two runs at the same time in one folder.
"$varimap" map -v "${small_picture[@]}" a.off b.off -o twice >/dev/null 2>first &
first=$!
map b.off a.off -o twice
wait $first || fail "the first of two runs"
map a.off b.off -o twice
same twice/source_to_target.csv reference/source_to_target.csv
