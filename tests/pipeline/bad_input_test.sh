#!/usr/bin/env bash
# What cannot be served is refused: one line, the right exit code, nothing written over.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
figure a.off 6
figure b.off 6 .5
map() { "$varimap" map -v "${small_picture[@]}" "$@"; }

refuse() {  # CODE ARGUMENTS
    local code=$1
    shift
    expect_exit "$code" map "$@"
}

# The command line and the files it names.
refuse 2
refuse 2 a.off -o out
refuse 2 a.off b.off
refuse 2 a.off b.off -o
refuse 2 a.off b.off c.off -o out
refuse 2 a.off b.off -o out --landmarks
refuse 2 a.off b.off -o out --sett x
refuse 2 a.off b.off -o out -j 0
refuse 2 a.off b.off -o out --set eigen
refuse 2 a.off b.off -o out --set eigne.count=10
refuse 2 a.off b.off -o out --set eigen.count=10 --set refine.threads=1
for setting in explore.{onto_itself,only_if_needed}=true explore.{surfaces,self_maps}=x diffuse.initial_map=one.txt remesh.{meshes,export}=x \
    eigen.{config,parameters,help,version,if-stale,error_file}=x; do
    refuse 2 a.off b.off -o out --set "$setting"
    [[ $(<log) == "varimap: error: --set $setting: "*" is not a parameter"* ]] || fail "--set $setting: $(<log)"
done
for option in '--set eigen.count=abc' '--area-bound 0.5' '--candidate x' '--set refine.colour=1'; do
    # shellcheck disable=SC2086
    refuse 2 a.off b.off -o out $option
    [[ $(<log) == "varimap: error: $option: "* ]] || fail "$option is not named: $(<log)"
done
refuse 2 a.off b.off -o out --repair ''
[[ $(<log) == "varimap: error: --repair '': "* ]] || fail "--repair without a value: $(<log)"
refuse 2 a.off b.off -o out -j 4097
refuse 2 a.off b.off -o out -j 9999
# shellcheck disable=SC2016
for line in 'repair = "`touch obeyed`"' 'repair = "weld;touch obeyed"' 'fill_holes = "30 --mirror true"' 'fill_holes = "30 --mirror"' 'fill_holes = "30 40"' \
    'repair = "weld, orient"'; do
    printf '[preprocess]\n%s\n' "$line" >bad.toml
    refuse 2 a.off b.off -o out --config bad.toml
    grep -q 'error: bad.toml: ' log || fail "$line: $(<log)"
done
printf '[preprocess]\nrepair = "weld"\nfill-holes = 30\nleast_component = 0.02\n' >some.toml
map a.off b.off -o some --config some.toml --set preprocess.fill_holes=40 --until preprocess >out.txt 2>log || fail "a good file: $(<log)"
rm -r some
printf '[explore]\nonto_itself = true\n' >bad.toml
refuse 2 a.off b.off -o out --config bad.toml
grep -q 'error: bad.toml: onto_itself is not a parameter' log || fail "onto_itself in a file: $(<log)"
[[ ! -e obeyed ]] || fail "a shell obeys what is in a file"
refuse 2 a.off b.off -o out --area-bound
refuse 2 a.off b.off -o out --landmark-weight
refuse 2 a.off b.off -o out --landmark-weight 0.2
grep -Fq -- '--landmark-weight needs --landmarks' log || fail "the reason is not given"
refuse 2 a.off b.off -o out --landmark-space ras
grep -Fq -- '--landmark-space needs --landmarks' log || fail "the reason is not given"
refuse 2 a.off b.off -o out --landmark-base 1
grep -Fq -- '--landmark-base needs --landmarks' log || fail "the reason is not given"
refuse 6 a.off absent.off -o out
refuse 6 a.off . -o out
refuse 6 a.off b.off -o out --landmarks absent.txt
refuse 6 a.off b.off -o a.off
refuse 6 a.off b.off -o a.off/out
VARIMAP_BIN=$PWD refuse 6 a.off b.off -o out
[[ ! -e out ]] || fail "a refused command line left files"

# What only the stages can tell.
printf '1 1\n' >one.txt
refuse 2 a.off b.off -o out --set eigen.colour=1
refuse 2 a.off b.off -o out --set eigen.count=many
refuse 2 a.off b.off -o out --area-bound 0.5
refuse 2 a.off b.off -o out --landmarks one.txt --landmark-weight 0
refuse 2 a.off b.off -o out --landmarks one.txt --landmark-weight 1.5
refuse 2 a.off b.off -o out --landmarks one.txt --landmark-weight firm
refuse 2 a.off b.off -o out --area-energy other
refuse 2 a.off b.off -o out --landmarks one.txt --landmark-space up
refuse 2 a.off b.off -o out --landmarks one.txt --landmark-base 2
printf '0 1\n' >zero.txt
refuse 3 a.off b.off -o out --landmarks zero.txt --landmark-base 1
grep -Fq 'vertex 0 is out of range: numbers start at 1' log || fail "a number below the first one is taken"
map a.off b.off -o out >/dev/null 2>log || fail "a good pair"
cp out/artifacts/a--b.map good.map
refuse 2 a.off b.off -o out --set eigen.count=-3
refuse 2 a.off b.off -o out --set refine.colour=1
map a.off b.off -o out >/dev/null 2>log || fail "the good pair after refusals"
expect_ran ""

echo "nothing of the kind" >text.off
head -c 2000 a.off >cut.off
: >empty.off
printf 'OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 nan\n3 0 1 2\n3 0 2 3\n' >nan.off
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n' >range.off
printf 'OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n' >nonmanifold.off
printf 'OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n5 0 0\n6 0 0\n5 1 0\n3 0 1 2\n3 3 4 5\n' >parts.off
printf 'OFF\n3 1 0\n0 0 0\n0 0 0\n0 0 0\n3 0 1 2\n' >point.off
cp a.off a.unknown
printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n.5 1e-5 0\n.5 0 1e-5\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n' >sliver.off
printf 'OFF\n3 1 0\n0 0 nan\n0 1 0\n1 0 0\n3 0 1 2\n' >nothing.off
for bad in sliver.off text.off cut.off empty.off range.off point.off nothing.off a.unknown; do
    refuse 3 "$bad" b.off -o bad -j 1
    refuse 3 b.off "$bad" -o bad -j 1
done
for bad in nan.off nonmanifold.off parts.off; do
    refuse 3 "$bad" b.off -o bad -j 1 --repair none
    refuse 3 b.off "$bad" -o bad -j 1 --repair none
done

for line in "0 1 x" "zero one" "0 100000" "-1 0" "0.5 1"; do
    printf '1 1\n%s\n' "$line" >bad.txt
    refuse 3 a.off b.off -o out --landmarks bad.txt
done
printf '1\n2\n3\n' >three.txt
printf '1\n2\n' >two.txt
refuse 3 a.off b.off -o out --landmarks three.txt two.txt
printf '1 1\n1 2\n' >twice.txt
refuse 3 a.off b.off -o out --landmarks twice.txt
# Two vertices in one place become one; one landmark on it is served, two are not.
awk 'NR == 3 { held = $0 } NR == 4 { $0 = held } { print }' a.off >merged.off
printf '0 0\n1 1\n' >both.txt
refuse 3 merged.off b.off -o merged --landmarks both.txt
grep -q 'landmark vertices 0 and 1 of the source became one' log || fail "the reason is not given"
refuse 3 b.off merged.off -o merged --landmarks both.txt
head -n 1 both.txt >single.txt
map merged.off b.off -o merged --landmarks single.txt >/dev/null 2>log || fail "one landmark on vertices that became one"

same out/artifacts/a--b.map good.map
map a.off b.off -o out >/dev/null 2>log || fail "the good pair again"
same out/artifacts/a--b.map good.map
