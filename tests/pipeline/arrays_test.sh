#!/usr/bin/env bash
# The snippets of pipelines/help/arrays.md, each as it is printed, where its program is installed: they carry what
# varimap transfer carries, and nothing to vertices without an image, which those outside of a part are.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
small_picture+=("${smaller[@]}")
figure whole.off 12
figure cow.off 12 .3
upper_part whole.off >bull.off
landmarks_of_figure whole.off | sed -n '1p;2p;5p' >tips.txt
map bull.off cow.off -o out-cow --landmarks tips.txt --part source
n=$(awk 'NR == 2 { print $1 }' bull.off)
awk -v n="$n" 'NR > 2 && NR <= n + 2 { print $3 + .3 * $1 }' bull.off >heat.txt
"$varimap" transfer out-cow --values heat.txt >/dev/null 2>log || fail "transfer"
(($(grep -c nan out-cow/transfer/heat.txt) > 100)) || fail "every vertex of the whole has an image on the part"

# snippet LANGUAGE NUMBER: that block of the page
snippet() {
    awk -v language="$1" -v number="$2" '$0 == "```" language { inside = ++count == number; next }
        /^```/ { inside = 0 } inside' "$VARIMAP_SOURCE/pipelines/help/arrays.md"
}

tried=''
agrees() {  # NAME: what it wrote agrees with transfer
    [[ $(wc -l <"$1.txt") == "$(wc -l <out-cow/transfer/heat.txt)" ]] || fail "$1: another number of rows"
    paste "$1.txt" out-cow/transfer/heat.txt | awk '
        function without_image(text) { return tolower(text) ~ /^[-+]?na/ }
        without_image($1) != without_image($2) { exit 1 }
        !without_image($1) { d = $1 - $2; if (d * d > 1e-10) exit 1 }' || fail "$1: other numbers"
    tried+=" $1"
}

python=/usr/bin/python3
if $python -c 'import numpy' 2>/dev/null; then
    { snippet python 1; echo 'np.savetxt("numpy.txt", carried)'; } >with_numpy.py
    $python with_numpy.py >log 2>&1 || fail "NumPy"
    agrees numpy
fi
if $python -c 'import scipy' 2>/dev/null; then
    { snippet python 2; echo 'np.savetxt("scipy.txt", carried)'; } >with_scipy.py
    $python with_scipy.py >log 2>&1 || fail "SciPy"
    agrees scipy
    "$varimap" inspect out-cow/artifacts/bull--cow.source-part.plan --export plan >/dev/null 2>log || fail "the plan"
    $python -c 'import scipy.sparse; m = scipy.sparse.load_npz("plan/plan.npz"); assert abs(m.sum() - 1) < .01, m.sum()' 2>log || fail "SciPy, plan"
fi
if command -v Rscript >/dev/null; then
    { snippet r 1; echo 'write(format(carried, digits = 15), "r.txt", ncolumns = 1)'; } >snippet.R
    Rscript snippet.R >log 2>&1 || fail "R"
    agrees r
fi
if command -v octave-cli >/dev/null; then
    { snippet matlab 1; echo 'dlmwrite("octave.txt", carried, "precision", 15);'; } >snippet.m
    octave-cli --norc snippet.m >log 2>&1 || fail "Octave"
    agrees octave
fi
if command -v blender >/dev/null; then
    # OBJ with the same vertices and faces, as for --mesh.
    awk -v n="$n" 'NR > 2 && NR <= n + 2 { print "v", $0 } NR > n + 2 { print "f", $2 + 1, $3 + 1, $4 + 1 }' bull.off >bull.obj
    "$varimap" transfer out-cow --mesh bull.obj >/dev/null 2>log || fail "transfer --mesh"
    { snippet python 3; echo 'print("keys", len(bull.data.shape_keys.key_blocks))'; } >blender.py
    blender --background --factory-startup --python-exit-code 1 --python blender.py >log 2>&1 || fail "Blender"
    grep -q '^keys 2' log || fail "Blender: no shape key"
    tried+=" blender"
fi
[[ $tried ]] || { echo "skipped: none of NumPy, SciPy, R, Octave and Blender is installed"; exit 77; }
echo "tried:$tried"
