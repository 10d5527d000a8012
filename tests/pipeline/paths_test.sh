#!/usr/bin/env bash
# Names with spaces and odd characters, equal names in two folders, relative and absolute paths, make alone.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
odd="it's \$HOME; 50% \"odd\" # -- é"
mkdir -p "$odd/one" "$odd/two"
figure plain.off 6
figure bent.off 6 .5
landmarks_of_figure plain.off >tips.txt
cp plain.off "$odd/one/my figure.off"
cp bent.off "$odd/two/my figure.off"
cp tips.txt "$odd/tips of limbs.txt"

map plain.off bent.off -o plain --landmarks tips.txt
map "$odd/one/my figure.off" "$PWD/$odd/two/my figure.off" -o "$odd/my results" --landmarks "$odd/tips of limbs.txt"
same plain/source_to_target.csv "$odd/my results/source_to_target.csv"
[[ -s $odd/my\ results/picture.png ]] || fail "no picture"
map --landmarks "$odd/tips of limbs.txt" "$odd/one/my figure.off" "$odd/two/my figure.off" -o "$odd/my results"
expect_ran ""

# Longer than names of artifacts can be, and alike at their beginnings.
long=$(printf 'x%.0s' {1..200})
cp plain.off "${long}1.off"
cp bent.off "${long}2.off"
map "${long}1.off" "${long}2.off" -o long --landmarks tips.txt
same plain/source_to_target.csv long/source_to_target.csv

# From the folder of the meshes, with the project reached through a link.
ln -s "$VARIMAP_SOURCE" "$odd/the project"
cp -r plain.off bent.off tips.txt "$odd"
(
    cd "$odd"
    "the project/pipelines/varimap" map -v "${small_picture[@]}" ./plain.off bent.off -o ../linked --landmarks tips.txt >/dev/null 2>log ||
        fail "through a link"
)
same plain/source_to_target.csv linked/source_to_target.csv

# make alone comes to the same, and finds nothing to do the second time.
make -s -f "$VARIMAP_SOURCE/pipelines/Makefile" SOURCE=plain.off TARGET=bent.off OUT=made LANDMARKS=tips.txt \
    RENDER_FLAGS="--width 64 --samples 1" 2>log ||
    fail "make alone"
same plain/source_to_target.csv made/source_to_target.csv
same plain/artifacts/plain--bent.map made/artifacts/plain--bent.map
make -s -f "$VARIMAP_SOURCE/pipelines/Makefile" SOURCE=plain.off TARGET=bent.off OUT=made LANDMARKS=tips.txt \
    RENDER_FLAGS="--width 64 --samples 1" 2>log
expect_ran ""

# A folder that was moved with its meshes, results in it: nothing is made again. So with copies, and meshes that are elsewhere now.
mkdir project
cp plain.off bent.off tips.txt project
map project/plain.off project/bent.off -o project/out --landmarks project/tips.txt
mv project renamed
map renamed/plain.off renamed/bent.off -o renamed/out --landmarks renamed/tips.txt
expect_ran ""
cp -r renamed copy
map copy/plain.off copy/bent.off -o copy/out --landmarks copy/tips.txt
expect_ran ""
[[ $(ls copy/out/artifacts/inputs) == $'bent\nplain' ]] || fail "moved meshes have other names"
# Two of one name and content are two; so are two of one name.
mkdir twin
cp plain.off twin
map plain.off twin/plain.off -o twins --until preprocess
map plain.off twin/plain.off -o twins --until preprocess
expect_ran ""
[[ $(ls twins/artifacts/inputs) == $'plain\nplain-2' ]] || fail "names of twins: $(ls twins/artifacts/inputs)"
cp bent.off twin/plain.off
map twin/plain.off bent.off -o twins --until preprocess
[[ $(readlink twins/artifacts/inputs/plain) == "$PWD/plain.off" ]] || fail "another mesh took a name"

# A folder whose name begins with a dash, and results that were damaged.
cp -r plain ./-dash
"$varimap" report -dash >out.txt 2>log || fail "report of a folder with a dash"
grep -q '^picture  -dash/picture.png' out.txt || fail "report of a folder with a dash: $(<out.txt)"
"$varimap" transfer -dash --mesh plain.off >out.txt 2>log || true
! grep -q 'internal\|usage' log || fail "transfer of a folder with a dash"
if [[ -w /dev/full ]]; then
    code=0
    "$varimap" report plain >/dev/full 2>log || code=$?
    ((code == 6)) || fail "report onto a full disk: exit $code"
    grep -q 'error: cannot write' log || fail "report onto a full disk: no reason"
fi
for text in '' '{}' '{'; do
    echo "$text" >./-dash/quality.json
    expect_exit 4 "$varimap" report -dash
    grep -q 'quality.json: damaged' log || fail "what is damaged is not said"
done

# A report needs the numbers alone, not the meshes.
cp plain.off gone.off
map gone.off bent.off -o without "${coarse[@]}"
rm gone.off
"$varimap" report without >out.txt 2>log || fail "report without the meshes: $(<log)"
grep -q '^verdict  look here: .*gone.off: the mesh is not there any more' out.txt || fail "report without the meshes: $(<out.txt)"
! "$varimap" report plain | grep '^verdict ' | grep 'not there\|changed' || fail "report with the meshes as they were"
expect_exit 6 "$varimap" view without
grep -q 'the mesh is not there any more' log || fail "a view without the meshes"
rm without/source_to_target.csv
expect_exit 6 "$varimap" report without

# Nor are numbers passed off as those of a mesh that took the place of the one that was mapped.
cp plain.off replaced.off
map replaced.off bent.off -o earlier "${coarse[@]}"
cp bent.off replaced.off
"$varimap" report earlier >out.txt 2>log || fail "report of a mesh that was replaced: $(<log)"
grep -q '^verdict  look here: .*replaced.off: changed since the map was made; make the map again' out.txt ||
    fail "report of a mesh that was replaced: $(<out.txt)"

# Nor as those of other landmarks.
printf '0 0\n5 5\n' >tips.txt
map plain.off bent.off --landmarks tips.txt -o with_tips "${coarse[@]}"
"$varimap" report with_tips >out.txt 2>log || fail "report with landmarks: $(<log)"
! grep 'changed since' out.txt || fail "report with landmarks as they were: $(<out.txt)"
printf '0 0\n6 6\n' >tips.txt
"$varimap" report with_tips >out.txt 2>log || fail "report of landmarks that were replaced: $(<log)"
grep -q '^verdict  look here: .*tips.txt: changed since the map was made' out.txt || fail "report of landmarks that were replaced: $(<out.txt)"
# A folder with meshes and results that is moved as a whole.
mkdir -p project/shapes
cp plain.off project/shapes/first.off
cp bent.off project/shapes/second.off
(cd project && map shapes/first.off shapes/second.off -o out "${coarse[@]}")
mv project elsewhere
"$varimap" report elsewhere/out >out.txt 2>log || fail "report of a project that was moved: $(<log)"
! grep '^verdict ' out.txt | grep 'not there\|changed' || fail "report of a project that was moved: $(<out.txt)"
echo 0 >tip.txt
"$varimap" transfer elsewhere/out --points tip.txt >out.txt 2>log || fail "transfer of a project that was moved: $(<log)"
! grep -F '[inspect]' log || fail "a look at what was moved is told of"
cp bent.off elsewhere/shapes/first.off
"$varimap" report elsewhere/out >out.txt 2>log || fail "report of a mesh that was moved and replaced"
grep -q '^verdict  look here: .*first.off: the mesh is not there any more' out.txt || fail "report of a mesh that was moved and replaced: $(<out.txt)"

# Results that were moved with the meshes of their batch.
mkdir meshes && cp plain.off bent.off meshes
"$varimap" batch --all-pairs meshes -o many "${coarse[@]}" -q >out.txt 2>log || fail "batch"
mv many moved
expect_exit 6 "$varimap" report moved
grep -q 'error: moved: holds the maps of many pairs; give one of them: moved/pairs/NAME' log || fail "which report is meant"
"$varimap" report moved/pairs/bent--plain >out.txt 2>log || fail "report of a batch that was moved"
