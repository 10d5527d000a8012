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
