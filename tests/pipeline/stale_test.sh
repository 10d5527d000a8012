#!/usr/bin/env bash
# Files that lie about their age, stand in the wrong place or were altered: the result is that of a run from nothing.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
small_picture+=("${coarse[@]}")
figure a.off 6
figure b.off 6 .5
figure c.off 6 -.5
landmarks_of_figure a.off >tips.txt
map a.off b.off -o good --landmarks tips.txt
map a.off c.off -o good_c --landmarks tips.txt
map a.off b.off -o good_30 --landmarks tips.txt --set eigen.count=30
cp -r good out
here=out/artifacts

to_the_future() { touch -d '+2 days' out/* out/.[a-z]* "$here"/*; }

again() {  # [EXPECTED [OPTION...]]: maps a onto b in out again
    map a.off b.off -o out --landmarks tips.txt "${@:2}"
    [[ -z ${1:-} ]] || same_results "$1" out
}

# What was made lies in the future: changes of a mesh, of landmarks and of parameters count all the same.
again good
expect_ran ""
to_the_future
again good
expect_ran ""
cp b.off kept.off
cp c.off b.off
again
same out/source_to_target.csv good_c/source_to_target.csv
to_the_future
cp kept.off b.off
again good
to_the_future
again good_30 --set eigen.count=30
to_the_future
again good
to_the_future
head -n 4 tips.txt >four.txt
map a.off b.off -o out --landmarks four.txt
map a.off b.off -o four --landmarks four.txt
same out/source_to_target.csv four/source_to_target.csv

# Other content with the same size and the same time.
again good
awk 'NR == 5 { held = $0; next } { print } NR == 6 { print held }' a.off >other.off
touch -r a.off other.off
cp a.off kept.off
cp -p other.off a.off
map a.off b.off -o out --landmarks tips.txt
[[ $(ran) == *preprocess* ]] || fail "a mesh of the same size and time was not noticed"
cp kept.off a.off
again good

# Artifacts swapped, foreign, or of an older run, and as new as can be.
for kind in surface coarse basis hierarchy; do
    mv $here/a.$kind swapped
    mv $here/b.$kind $here/a.$kind
    mv swapped $here/b.$kind
    to_the_future
    again good
    cp good_c/artifacts/c.$kind $here/b.$kind
    to_the_future
    again good
done
for artifact in a.basis a.hierarchy a--b.diffusion a--b.plan a--b.map a--b.quality; do
    cp good_30/artifacts/$artifact $here/$artifact
    to_the_future
    again good
    cp good/artifacts/a.surface $here/$artifact
    again good
done

# Results that somebody altered or replaced.
for file in source_to_target.csv source_on_target.ply; do
    echo 0 >>out/$file
    again good
    cp good_30/$file out/$file
    to_the_future
    again good
done
cp good/source_on_target.ply out/picture.png
again good
rm out/.exports out/.picture out/.numbers.json
again good

# Stages called by hand refuse what does not belong together.
both=(good/artifacts/{a,b}.{coarse,basis,hierarchy})
expect_exit 4 "$VARIMAP_BIN/varimap-refine" "${both[@]}" good_30/artifacts/a--b.diffusion new.plan
expect_exit 4 "$VARIMAP_BIN/varimap-hierarchy" good/artifacts/a.surface good_30/artifacts/b.basis new.hierarchy
expect_exit 4 "$VARIMAP_BIN/varimap-diffuse" good/artifacts/{a.surface,a.basis} good_30/artifacts/a.hierarchy \
    good/artifacts/b.{surface,basis,hierarchy} new.diffusion
expect_exit 4 "$VARIMAP_BIN/varimap-relax" good_c/artifacts/{a,c}.surface good/artifacts/a--b.plan new.map
expect_exit 4 "$VARIMAP_BIN/varimap-remesh" good/artifacts/{a,b}.surface good_30/artifacts/a--b.plan good/artifacts/a--b.map new.quality
# One landmark list for exploration, another for what continues it.
"$VARIMAP_BIN/varimap-explore" "${both[@]}" found.candidates --landmarks four.txt --random_starts 1 2>log || fail "explore"
expect_exit 4 "$VARIMAP_BIN/varimap-diffuse" "${both[@]}" new.diffusion --candidates found.candidates --landmarks tips.txt
grep -q 'do not belong together' log || fail "the reason is not given"
# A basis and a hierarchy that candidates were not found with, of either side; --surfaces were given, or not.
for side in a b; do
    mixed=("${both[@]}")
    for i in "${!both[@]}"; do
        [[ ${both[i]} == */$side.coarse || ${both[i]} != */$side.* ]] || mixed[i]=good_30/artifacts/${both[i]##*/}
    done
    for found in found.candidates good/artifacts/a--b.landmarks.candidates; do
        expect_exit 4 "$VARIMAP_BIN/varimap-diffuse" "${mixed[@]}" new.diffusion --candidates $found --landmarks tips.txt
        grep -q "'$found' and 'good_30/artifacts/$side.basis' do not belong together" log || fail "which do not belong together"
    done
done
# Self-maps of two surfaces.
expect_exit 2 "$VARIMAP_BIN/varimap-explore" "${both[@]}" new.selfmaps --onto_itself true
expect_exit 4 "$VARIMAP_BIN/varimap-explore" "${both[@]}" new.candidates --self-maps found.candidates found.candidates
grep -Fq '(B.sketch.hierarchy)' log || fail "the other side of self-maps is not looked at"
# Another mesh, of as many vertices and triangles, in place of that which a surface was made from.
for meshes in "c.off b.off c.off a" "a.off a.off a.off b" "a.off c.off c.off b"; do
    read -r source target wrong side <<<"$meshes"
    expect_exit 4 "$VARIMAP_BIN/varimap-remesh" good/artifacts/{a,b}.coarse good/artifacts/a--b.{plan,map} new.quality \
        --export new.folder --meshes "$source" "$target"
    grep -q "'$wrong' is not the mesh that 'good/artifacts/$side.coarse' was made from" log || fail "which mesh is another"
done
[[ $(find . -maxdepth 1 -name 'new.*') == "" ]] || fail "something was written"
nothing_left out
