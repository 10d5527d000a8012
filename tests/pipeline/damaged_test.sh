#!/usr/bin/env bash
# Truncated, altered and foreign artifacts are refused with exit 4; the front end makes them anew.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
figure a.off 6
figure b.off 6 .5
map a.off b.off -o out
cp -rp out good
here=out/artifacts
eigen=$VARIMAP_BIN/varimap-eigen
hierarchy=$VARIMAP_BIN/varimap-hierarchy
inspect=$VARIMAP_BIN/varimap-inspect

flip() {  # FILE OFFSET: turns over the bits of one byte
    local byte
    byte=$(od -An -tu1 -j "$2" -N 1 "$1" | tr -d ' ')
    # shellcheck disable=SC2059
    printf "\\x$(printf %x $((255 - byte)))" | dd of="$1" bs=1 seek="$2" conv=notrunc status=none
}

size=$(stat -c %s $here/a.surface)
for part in 0 1 100 $((size / 2)) $((size - 1)); do
    head -c "$part" $here/a.surface >cut.surface
    expect_exit 4 "$eigen" cut.surface new.basis
    expect_exit 4 "$inspect" --check cut.surface
done
# What is missing is bad as well, but keeps nothing from being looked at; a pattern without a match is not missed.
expect_exit 4 "$inspect" --check absent.surface $here/a.surface cut.surface
[[ $(wc -l <out.txt) == 2 ]] || fail "how many files are bad"
for bad in absent cut; do grep -q "'$bad.surface'" out.txt || fail "which files are bad"; done
expect_exit 0 "$inspect" --check "$here/*.none" $here/*.surface
expect_exit 6 "$inspect" --check "$here/*.none"
expect_exit 6 "$inspect" absent.surface
expect_exit 0 "$inspect" --check out/.exports
for offset in 0 30 200 $((size / 3)) $((size / 2)) $((size - 2)); do
    cp $here/a.surface flipped.surface
    flip flipped.surface "$offset"
    expect_exit 4 "$eigen" flipped.surface new.basis
done
{ cat $here/a.surface; echo more; } >longer.surface
expect_exit 4 "$eigen" longer.surface new.basis
expect_exit 4 "$eigen" a.off new.basis
expect_exit 4 "$eigen" $here/a.basis new.basis
expect_exit 4 "$hierarchy" $here/a.surface $here/b.basis new.hierarchy
expect_exit 6 "$eigen" absent.surface new.basis
[[ ! -e new.basis && ! -e new.hierarchy ]] || fail "something was written"

# The front end notices and rebuilds; a good surface made anew has the same bytes, and so has all that follows.
for victim in a.surface b.coarse b.basis a.hierarchy a--b.diffusion a--b.plan a--b.map a--b.quality; do
    flip "$here/$victim" $(($(stat -c %s "$here/$victim") / 2))
    map a.off b.off -o out
    same "$here/$victim" "good/artifacts/$victim"
    head -c 50 "good/artifacts/$victim" >"$here/$victim"
    map a.off b.off -o out
    same "$here/$victim" "good/artifacts/$victim"
done
cp a.off $here/b.surface
map a.off b.off -o out
for artifact in good/artifacts/*.{surface,coarse,basis,hierarchy,diffusion,plan,map,quality}; do
    same "$artifact" "$here/${artifact##*/}"
done
