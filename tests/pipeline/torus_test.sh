#!/usr/bin/env bash
# Fig. 15: with a wider area bound the map of a torus onto a swollen one gets nearer to conformal.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
"$VARIMAP_SOURCE/pipelines/torus" -o out --bound 1 --bound 2 "${small_picture[@]}" >out.txt 2>log || fail "torus (exit $?)"
cat out.txt
for bound in 1 2; do
    jq -e '.source_to_target.flipped_count == 0 and .target_to_source.flipped_count == 0' out/bound-$bound/quality.json \
        >/dev/null || fail "reversed triangles at bound $bound"
    jq -e '(.area_bound | sqrt * 1.001) as $D | .mass_ratio | [.source, .target]
        | all(.min > 1 / $D and .max < $D)' out/bound-$bound/quality.json >/dev/null || fail "masses leave bound $bound"
    [[ -s out/bound-$bound/distortion.png ]] || fail "no picture for bound $bound"
done
jq -es '.[0].source_to_target.conformal_distortion as $exact | .[1].source_to_target.conformal_distortion
    | .p50 < .97 * $exact.p50 and .p95 < .8 * $exact.p95' out/bound-{1,2}/quality.json >/dev/null ||
    fail "not more conformal at bound 2"
jq -e '.source_to_target.area_ratio | .p05 > .8 and .p95 < 1.25' out/bound-1/quality.json >/dev/null ||
    fail "areas are not kept at bound 1"
