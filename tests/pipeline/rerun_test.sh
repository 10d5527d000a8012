#!/usr/bin/env bash
# What reruns after which change, and nothing else does.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
small_picture+=("${coarse[@]}")
figure a.off 8
figure b.off 8 .5
figure c.off 8 -.5
landmarks_of_figure a.off >tips.txt
pair="diffuse refine relax remesh render"
explored="diffuse explore refine relax remesh render"
# Every surface has a sketch, on which exploration runs.
all="coarsen*4 diffuse eigen*4 explore hierarchy*4 preprocess*2 refine relax remesh render"
one_surface="coarsen*2 diffuse eigen*2 explore hierarchy*2 preprocess refine relax remesh render"

solved="diffuse eigen*4 explore hierarchy*4 refine relax remesh render"
coarser="coarsen*4 $solved"

step() {  # STAGES ARGUMENTS: maps a onto b in out, and expects what ran
    local expected=$1
    shift
    map a.off b.off -o out "$@"
    expect_ran "$expected"
}

step "$all"
step ""
step "" -j 3

step "relax remesh render" --set relax.relaxation_steps=3
step "relax remesh render"

step "$solved" --set eigen.count=30
step "refine relax remesh render" --set eigen.count=30 --set refine.tolerance=0.01
step "render" --set eigen.count=30 --set refine.tolerance=0.01 --set render.width=320
step "" --set render.width=320 --set refine.tolerance=0.01 --set eigen.count=30
step "$solved"

# Coarse meshes; and where nothing was coarsened, all vertices are the same.
step "" --full-resolution
step "$coarser" --set coarsen.vertices=150
jq -e '.source.vertices == 150 and .source.input_vertices > 250' out/quality.json >/dev/null || fail "no coarse mesh"
step "coarsen*2 $solved" --full-resolution  # the sketches
step "coarsen*2"

# Times mean nothing.
touch a.off
step ""
touch -d 2001-01-01 a.off b.off
step ""
touch -d 2001-01-01 out/artifacts/*
step ""
touch -d '+2 days' out/artifacts/* out/*.csv
step ""
# Another mesh of the same name, older than what was made of the first.
touch -d 2001-01-01 c.off
mv b.off kept.off
cp -p c.off b.off
step "$one_surface"
mv kept.off b.off
step "$one_surface"

step "$pair" --area-bound 1.5
step "" --set diffuse.area_bound=1.5 --set refine.area_bound=1.5
jq -e '.area_bound == 1.5 and .mass_ratio.source.max < 1.226 and .mass_ratio.target.min > .815' out/quality.json >/dev/null ||
    fail "the bound in quality.json"
step "$pair" --area-bound 1.5 --area-energy paper
step "$explored" --landmarks tips.txt
step "" --landmarks tips.txt
step "$explored" --landmarks tips.txt --landmark-weight .2
jq -e '.landmark_weight == .2' out/quality.json >/dev/null || fail "the weight in quality.json"
head -n 3 tips.txt >three.txt
touch -d 2001-01-01 three.txt
step "$explored" --landmarks three.txt
awk '{ print $1 }' tips.txt >list.txt
step "$explored" --landmarks list.txt list.txt
# The candidates of before are still those of the two surfaces.
step "$pair"
step "$pair" --candidate 1 --set diffuse.tolerance=0.02
step "$pair"

# Another pair in the same folder shares a; its exports take the place of the first's.
cp out/source_to_target.csv to_b.csv
map a.off c.off -o out
expect_ran "$one_surface"
cmp -s out/source_to_target.csv to_b.csv && fail "the exports are still those of a and b"
step "remesh render"
same out/source_to_target.csv to_b.csv

# Other places that share the intermediate files.
map a.off c.off -o other --artifacts out/artifacts
expect_ran "remesh render"
map c.off b.off -o other --artifacts out/artifacts
expect_ran "$explored"
map a.off a.off -o self
expect_ran "$one_surface"
map a.off a.off -o self --mirror
expect_ran "$one_surface"

# The tables are made without relaxing the map again, and quality.json without making the tables again. What is made
# again with the same bytes makes nothing else run.
rm out/source_on_target.ply
step "remesh"
rm out/picture.png
step "render"
cp out/quality.json whole.json
rm out/quality.json
step ""
same <(jq 'del(.stages)' out/quality.json) <(jq 'del(.stages)' whole.json)
jq -e '.stages | keys == ["coarsen a", "coarsen a.sketch", "coarsen b", "coarsen b.sketch", "diffuse a--b", "eigen a", "eigen a.sketch", "eigen b",
    "eigen b.sketch", "explore a--b", "hierarchy a", "hierarchy a.sketch", "hierarchy b",
    "hierarchy b.sketch", "preprocess a", "preprocess b", "refine a--b", "relax a--b", "remesh a--b"] and all(.wall_seconds > 0)' out/quality.json >/dev/null ||
    fail "the stages in quality.json"
# A stage without its side file was killed before its end.
echo '{' >out/artifacts/a.basis.run.json
step "eigen"
rm out/artifacts/a.basis.run.json
step "eigen"
step ""
same <(jq 'del(.stages)' out/quality.json) <(jq 'del(.stages)' whole.json)
rm out/artifacts/a--b.plan
step "refine"
step ""
nothing_left out
