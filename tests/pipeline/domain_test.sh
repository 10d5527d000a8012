#!/usr/bin/env bash
# Points, curves and graphs through the stages: a graph onto a surface; what is bad is refused in one line.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
stage() { "$VARIMAP_BIN/varimap-$1" "${@:2}" >out.txt 2>log || fail "varimap-$1 (exit $?)"; }

# Short limbs: points of a graph weigh the same, also where they are far from each other.
figure body.off 6 0 .4
figure other.off 8 .4 .4
stage preprocess other.off surface.surface
stage coarsen --vertices 500 surface.surface surface.coarse
stage domain --kind graph body.off graph.domain
for name in graph.domain surface.coarse; do
    stage eigen --count 60 $name ${name%.*}.basis
    stage hierarchy $name ${name%.*}.basis ${name%.*}.hierarchy
done
both=(graph.domain graph.basis graph.hierarchy surface.coarse surface.basis surface.hierarchy)
paste -d' ' <(landmarks_of_figure body.off | cut -d' ' -f1) <(landmarks_of_figure other.off | cut -d' ' -f1) >landmarks.txt
stage diffuse "${both[@]}" pair.diffusion --landmarks landmarks.txt
stage refine "${both[@]}" pair.diffusion pair.plan
mkdir out
stage partners graph.domain surface.coarse pair.plan out
[[ $(head -n 1 out/source_partners.csv) == point,partner,certainty && $(wc -l <out/source_partners.csv) == 147 ]] ||
    fail "source_partners.csv"
jq -e '.source.mean_certainty > .6 and .source.edges_apart < .1' out/partners.json >jq.txt || fail "partners.json: $(cat out/partners.json)"
# Landmarks hold the centres of images; the plan's best partner is the landmark's or near it: at most two edges away, since a
# node of the graph weighs as much as two vertices there. (That plans are the identity up to one sample where shapes are the
# same, gallery_test demands of curves.)
while read -r a b; do
    partner=$(awk -F, -v a="$a" '$1 == a { print $2 }' out/source_partners.csv)
    awk -v b="$b" -v p="$partner" '
        NF == 4 { for (i = 2; i <= 4; ++i) for (k = 2; k <= 4; ++k) around[$i] = around[$i] " " $k }
        END {
            away[b] = 0; reached[1] = b; count = 1
            for (r = 1; r <= count; ++r) {
                n = split(around[reached[r]], next_ones, " ")
                for (i = 1; i <= n; ++i) if (!(next_ones[i] in away)) {
                    away[next_ones[i]] = away[reached[r]] + 1; reached[++count] = next_ones[i]
                }
            }
            print away[p]; exit !(p in away && away[p] <= 2)
        }' other.off >edges.txt || fail "landmark $a goes to $partner, $(cat edges.txt) edges from $b"
done <landmarks.txt
[[ $(tail -n 1 out/partners.svg) == '</svg>' ]] || fail "partners.svg"
stage inspect graph.domain --export exported
[[ -s exported/edge_lengths.npy ]] || fail "inspect"
# The same bytes for any number of threads.
stage domain --kind graph body.off again.domain --threads 1
same graph.domain again.domain

# refuse FILE TEXT WHY: a file with that text is refused in one line that names the file and says why.
refuse() {
    # shellcheck disable=SC2059
    printf "$2" >"$1"
    expect_exit 3 "$VARIMAP_BIN/varimap-domain" "$1" bad.domain
    grep -q "error: $1:.*$3" log || fail "no '$3' for $1: $(tail -n 1 log)"
    [[ ! -e bad.domain ]] || fail "$1 left a domain"
}
refuse two.edges '0 1\n1 2\n2 0\n3 4\n4 5\n5 3\n' 'falls into 2 parts: point 3 '
refuse few.edges '0 1\n2 3\n' '2 edges cannot join 4 points'
refuse two.mtx '%%%%MatrixMarket matrix coordinate real symmetric\n4 4 2\n2 1 1\n4 3 1\n' '2 edges cannot join 4 points'
refuse two.obj 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nl 1 2\nl 3 4\n' '2 edges cannot join 4 points'
refuse negative.edges '0 1\n1 2 -1\n' 'the weight -1 is not positive'
refuse negative.mtx '%%%%MatrixMarket matrix coordinate real symmetric\n4 4 3\n2 1 1\n3 2 -2\n4 3 1\n' 'the weight -2 is not positive'
refuse half.mtx '%%%%MatrixMarket matrix coordinate pattern general\n4 4 3\n2 1\n3 2\n4 3\n' 'but none at 1 2'
refuse same.xyz '0 0\n1 0\n0 0\n2 2\n' 'points 0 and 2 .* lie at the same place'
refuse same.obj 'v 0 0 0\nv 1 0 0\nv 0 0 0\nv 1 1 0\nl 1 2 3 4\n' 'points 0 and 2 .* lie at the same place'
refuse nan.xyz '0 0\n1 nan\n0 0\n2 2\n' 'coordinate nan is not finite'
refuse nan.obj 'v 0 0 0\nv 1 0 0\nv nan 0 0\nl 1 2 3\n' 'coordinate nan is not finite'
refuse nan.edges '0 1 nan\n' 'weight nan is not finite'
refuse one.xyz '1 1\n' '1 point; at least 4 are needed'
refuse none.xyz '' '0 points; at least 4 are needed'
rm none.xyz
expect_exit 6 "$VARIMAP_BIN/varimap-domain" none.xyz bad.domain
printf '0 1\n1 2\n2 3\n' >path.edges
expect_exit 2 "$VARIMAP_BIN/varimap-domain" --distances ambient path.edges bad.domain
expect_exit 3 "$VARIMAP_BIN/varimap-explore" "${both[@]}" bad.candidates
expect_exit 4 "$VARIMAP_BIN/varimap-eigen" graph.basis bad.basis
expect_exit 6 "$VARIMAP_BIN/varimap-partners" graph.domain surface.coarse pair.plan nowhere
expect_exit 2 "$VARIMAP_BIN/varimap-show" nothing graph.domain

# Initial maps are for meshes.
seq 0 145 >initial.txt
expect_exit 2 "$VARIMAP_BIN/varimap-diffuse" "${both[@]}" new.diffusion --initial-map initial.txt
grep -q -- '--initial-map is for meshes' log || fail "an initial map of a graph: $(<log)"
