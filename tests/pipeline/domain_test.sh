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
# Landmarks hold the centres of images; the plan's best partner is around the landmark's. Tips of limbs are more than 1 from
# each other.
while read -r a b; do
    partner=$(awk -F, -v a="$a" '$1 == a { print $2 }' out/source_partners.csv)
    awk -v b="$b" -v p="$partner" 'NR == b + 3 { x = $1; y = $2; z = $3 } NR == p + 3 { u = $1; v = $2; w = $3 }
        END { d = sqrt((x - u) ^ 2 + (y - v) ^ 2 + (z - w) ^ 2); print d; exit !(d < .7) }' other.off >distance.txt ||
        fail "landmark $a goes to $partner, $(cat distance.txt) from $b"
    cat distance.txt
done <landmarks.txt
[[ $(tail -n 1 out/partners.svg) == '</svg>' ]] || fail "partners.svg"
stage inspect graph.domain --export exported
[[ -s exported/edge_lengths.npy ]] || fail "inspect"
# The same bytes for any number of threads.
stage domain --kind graph body.off again.domain --threads 1
same graph.domain again.domain

printf '0 1\n2 3\n' >two.edges
printf '0 1\n1 2 -1\n' >negative.edges
printf '0 0\n1 0\n0 0\n2 2\n' >same.xyz
printf '0 0\n1 nan\n0 0\n2 2\n' >nan.xyz
printf '1 1\n' >one.xyz
for file in two.edges negative.edges same.xyz nan.xyz one.xyz; do
    expect_exit 3 "$VARIMAP_BIN/varimap-domain" $file bad.domain
    [[ ! -e bad.domain ]] || fail "$file left a domain"
done
expect_exit 6 "$VARIMAP_BIN/varimap-domain" none.xyz bad.domain
printf '0 1\n1 2\n2 3\n' >path.edges
expect_exit 2 "$VARIMAP_BIN/varimap-domain" --distances ambient path.edges bad.domain
expect_exit 3 "$VARIMAP_BIN/varimap-explore" "${both[@]}" bad.candidates
expect_exit 4 "$VARIMAP_BIN/varimap-eigen" graph.basis bad.basis
expect_exit 6 "$VARIMAP_BIN/varimap-partners" graph.domain surface.coarse pair.plan nowhere
expect_exit 2 "$VARIMAP_BIN/varimap-show" nothing graph.domain
