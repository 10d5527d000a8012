#!/usr/bin/env bash
# varimap transfer on a finished map: each kind of thing by one command; what cannot be carried leaves nothing.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
coarse_pair

# Labels by height, points at the limbs, and an OBJ of the source with a texture.
n=$(awk 'NR == 2 { print $1 }' a.off)
awk -v n="$n" 'NR > 2 && NR <= n + 2 { print ($3 > 0 ? "high" : "low") }' a.off >parts.csv
awk -v n="$n" 'NR > 2 && NR <= n + 2 { print $3 }' a.off >heat.txt
awk 'NR > 2 && NR < 6' a.off >points.txt
awk -v n="$n" 'BEGIN { print "mtllib a.mtl" } NR > 2 && NR <= n + 2 { print "v", $0; print "vt", $1 / 4 + .5, $3 / 6 + .5 }
    NR > n + 2 { print "f", $2 + 1 "/" $2 + 1, $3 + 1 "/" $3 + 1, $4 + 1 "/" $4 + 1 }' a.off >a.obj
printf 'newmtl skin\nKd .5 .2 .1\n' >a.mtl

run() { "$varimap" transfer "$@" >out.txt 2>log || fail "transfer $* (exit $?)"; }
run good --points points.txt --values heat.txt --labels parts.csv --texture a.obj --mesh a.obj --shape a.obj -o carried
for file in points.txt heat.txt parts.csv b_textured.obj b_textured.mtl b_textured.glb source_on_target.obj a.ply; do
    [[ -s carried/$file ]] || fail "no $file"
    grep -qx "carried/$file" out.txt || fail "$file is not named"
done
[[ $(wc -l <carried/parts.csv) == "$n" && $(sort -u carried/parts.csv | xargs) == "high low" ]] || fail "labels"
[[ $(wc -l <carried/points.txt) == 3 ]] || fail "points"
# Vertex i of both figures is the same point: heights agree, but for what a coarse map of coarse meshes misses.
paste carried/heat.txt heat.txt | awk '{ d = ($1 - $2) ^ 2; s += d } END { exit !(sqrt(s / NR) < .25) }' || fail "values"
# A first line above as many words as there are vertices names them; words keep their # and their quotes.
{ echo label; sed 's/high/seg#1/; s/low/"arm, left"/' parts.csv; } >words.csv
run good --labels words.csv -o carried
[[ $(sort carried/words.csv | uniq | xargs -d '\n') == '"arm, left" label seg#1' ]] || fail "words"
[[ $(head -n 1 carried/words.csv) == label && $(wc -l <carried/words.csv) == $((n + 1)) ]] || fail "the name of words"
# The unchanged shape leaves the target as it is.
"$VARIMAP_BIN/varimap-transfer" a.off b.off good/{source_to_target,target_to_source}.csv --shape a.off --out same >out.txt 2>log
tail -c 200 same/a.ply >one; tail -c 200 carried/a.ply >other
same one other
run good --reverse --values heat.txt
[[ -s good/transfer/heat.txt ]] || fail "without -o results go to OUT/transfer"

# From the installed tables alone: nothing is written where anything is wrong.
refuse() {  # CODE TEXT ARGUMENTS
    expect_exit "$1" "$varimap" transfer "${@:3}" -o none
    grep -Fq -- "$2" log || fail "no '$2' for ${*:3}"
    [[ ! -e none ]] || fail "something was written: ${*:3}"
}
head -n 5 heat.txt >few.txt
refuse 3 "5 rows, but" good --labels parts.csv --values few.txt
printf '100 100 100\n' >far.txt
refuse 3 "lie farther than" good --points far.txt
refuse 2 "nothing to carry" good
refuse 6 "absent.txt" good --values absent.txt
refuse 6 "no such folder" absent --values heat.txt
mkdir empty
refuse 6 "holds no finished map" empty --values heat.txt
refuse 2 "has no texture coordinates to bake onto" good --texture a.obj --bake 64
refuse 2 "give --texture" good --values heat.txt --bake 64
refuse 2 "give --bake" good --texture a.obj --onto a.obj
refuse 2 "give --bake" good --texture a.obj --padding 8
refuse 2 "how many of --weights" good --values heat.txt --influences 4
refuse 2 "which axes --points have" good --values heat.txt --landmark-space lps
refuse 2 "how --points count vertices" good --values heat.txt --landmark-base 1
printf '0\n5\n' >from_0.txt
printf '1\n6\n' >from_1.txt
run good --points from_0.txt -o carried
run good --points from_1.txt --landmark-base 1 -o carried
awk '{ print $1 + 1 }' carried/from_0.txt | cmp -s - carried/from_1.txt || fail "vertices that count from 1"
rm a.mtl
refuse 6 "its materials a.mtl are missing" good --texture a.obj
printf 'newmtl skin\nmap_Kd skin.png\n' >a.mtl
refuse 6 "the texture skin.png is missing" good --texture a.obj
for image in one two; do
    echo $image >skin.png
    run good --texture a.obj -o pictures
done
[[ $(cat pictures/skin.png pictures/skin-2.png) == $'one\ntwo' ]] || fail "an image is written over"
grep -qx 'map_Kd skin-2.png' pictures/b_textured.mtl || fail "the other image's name"
figure c.off 5
cp -r good cut
awk 'NR < 10' good/source_to_target.csv >cut/source_to_target.csv
refuse 3 "this is a map of another mesh" cut --values heat.txt
cp a.off kept.off && figure a.off 5
refuse 4 "changed since the map was made" good --values heat.txt
rm a.off
refuse 6 "the mesh is not there any more" good --values heat.txt
mv kept.off a.off
run good --values heat.txt

# Surfaces as text, for programs that read no other PLY.
map a.off b.off -o text --ascii
head -n 2 text/source_on_target.ply | grep -q '^format ascii' || fail "--ascii"
[[ $(awk '/^element vertex/ { print $3 }' text/source_on_target.ply) == "$n" ]] || fail "--ascii: vertices"

# Arrays beside the tables are what SciPy reads.
if /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
    /usr/bin/python3 - <<'PYTHON' || fail "arrays"
import numpy as np
for name in ("source_to_target", "target_to_source"):
    arrays, table = np.load(f"good/{name}.npz"), np.loadtxt(f"good/{name}.csv", delimiter=",", skiprows=1)
    assert (arrays["face"] == table[:, 1]).all() and np.allclose(arrays["barycentric"], table[:, 2:], atol=0)
    rows, columns = arrays["shape"]
    assert rows == len(table) and arrays["format"].item() == b"csr" and len(arrays["indptr"]) == rows + 1
    sums = np.add.reduceat(arrays["data"], arrays["indptr"][:-1])
    assert np.allclose(sums, 1) and arrays["indices"].max() < columns
PYTHON
else
    echo "python3-numpy is missing: arrays are not read back"
fi
