#!/usr/bin/env bash
# How the scripts read their command lines, what else the front end calls, and an installed prefix.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
small_picture+=("${coarse[@]}")
figure a.off 6
figure b.off 6 .5
seq 0 2 >list.txt

says() {  # TEXT COMMAND...: stdout holds TEXT
    "${@:2}" >out.txt 2>log || fail "exit $?: ${*:2}"
    grep -Fq -- "$1" out.txt || fail "'$1' is not in what ${*:2} prints"
}

# Spellings of options.
map a.off b.off -oout --landmark_weight=.5 --landmarks list.txt list.txt --area_bound=2 --set render.width=64 -j2
map --landmarks=list.txt list.txt a.off b.off --out=out --landmark-weight .5 --area-bound 2 --set=render.width=64 --cores 2
expect_ran ""
map --out out --landmarks=list.txt list.txt --landmark-weight=.5 --set diffuse.area-bound=2 --set refine.area_bound=2 -j 1 -- a.off b.off
expect_ran ""
jq -e --arg here "$PWD" '.provenance | .source.file == $here + "/a.off" and .target.file == $here + "/b.off"
    and (.landmarks | map(.file)) == [$here + "/list.txt", $here + "/list.txt"] and .landmarks[0].hash == .landmarks[1].hash
    and .source.hash != .target.hash and (.source | .area * .scale * .scale - 1 | fabs < 1e-9) and .schema == 1
    and (.command | startswith("varimap map ") and contains(" --landmarks=list.txt list.txt "))' out/quality.json >/dev/null || fail "provenance"
# What other commands made of an earlier map in the folder is named.
touch -d 2001-01-01 out/view.html
map --out out --landmarks=list.txt list.txt --landmark-weight=.5 --set diffuse.area-bound=2 --set refine.area_bound=2 -j 1 -- a.off b.off
grep -q '^older    out/view.html was made before this map: run varimap view out again$' out.txt || fail "an older page is not named"
touch out/view.html
map --out out --landmarks=list.txt list.txt --landmark-weight=.5 --set diffuse.area-bound=2 --set refine.area_bound=2 -j 1 -- a.off b.off
! grep -q '^older' out.txt || fail "a page of this map is called older"
rm out/view.html
says "CARRYING THINGS OVER" "$varimap" transfer --help
says "LOOKING AT A MAP" "$varimap" view -h
says "varimap report OUT" "$varimap" report --help
expect_exit 2 "$varimap" map a.off b.off -o out --explore=yes
expect_exit 2 "$varimap" map a.off b.off -o out --out
expect_exit 2 "$varimap" map a.off b.off -o out --area_bounds=2
expect_exit 2 "$varimap" map a.off b.off -o out -x
says "--area_bound 3 --landmark_weight 0.5" "$VARIMAP_BIN/varimap-diffuse" --landmark-weight=.5 --area-bound 3 --parameters

# A configuration file; --set counts more, and what comes to the same reruns nothing.
printf '[eigen]\ncount = 30\n[refine]\ntolerance = 0.01  # coarse\n[diffuse]\narea-bound = 2\n' >good.toml
map a.off b.off -o configured --config good.toml
map a.off b.off -o configured --set eigen.count=30 --set refine.tolerance=.01 --set diffuse.area_bound=2
expect_ran ""
map a.off b.off -o configured --config=good.toml --set refine.tolerance=1e-2
expect_ran ""
refuse_config() {  # TEXT MESSAGE
    printf '%b' "$1" >bad.toml
    expect_exit 2 "$varimap" map a.off b.off -o none --config bad.toml
    grep -Fq -- "$2" log || fail "no '$2' for $1"
}
refuse_config '[eigen]\n\ncuont = 30\n' 'bad.toml, line 3: varimap-eigen has no parameter cuont; did you mean count?'
refuse_config '[eigne]\ncount = 30\n' 'bad.toml, line 1: no stage is called eigne; did you mean eigen?'
refuse_config '[render]\nwidth = wide\n' 'bad.toml, line 2: '
refuse_config '[eigen]\ncount 30\n' 'bad.toml, line 2: '
expect_exit 6 "$varimap" map a.off b.off -o none --config absent.toml
expect_exit 6 "$varimap" map a.off b.off -o none --config .
[[ ! -e none ]] || fail "a refused configuration left files"

# Tools, help and version.
check_front_end() {  # VARIMAP
    local version
    version=$("$VARIMAP_BIN/varimap-eigen" --version)
    says "varimap ${version#varimap-eigen }" "$1" --version
    says "--check" "$1" inspect --help
    "$1" inspect --check out/artifacts/a.surface 2>log || fail "inspect through $1"
    says "degree" "$1" verify a.off b.off out/source_to_target.csv
    says "verdict" "$1" report out
    says "out/transfer/list.txt" "$1" transfer out --points list.txt
    says "varimap map SOURCE TARGET" "$1" --help
    says "varimap map SOURCE TARGET" "$1" help
    says "--landmark-weight W" "$1" help map
    says "--landmark-weight W" "$1" map --help
    says "--count" "$1" help eigen
    says "bench LIST" "$1" bench --help
    says "bench-list FOLDER PAIRS" "$1" bench-list --help
    says "varimap batch LIST" "$1" batch --help
    says "varimap register TEMPLATE" "$1" register --help
    says "LANDMARKS" "$1" help landmark
    says "CARRYING THINGS OVER" "$1" help transfers
    says "--count" "$1" help eig
    says "survey MESH" "$1" help survey
    says "good" "$1" report --help
    expect_exit 2 "$1" map a.off b.off -o out --no-such-option
    grep -q 'unknown option --no-such-option; varimap help map explains' log || fail "what explains options of map"
    expect_exit 2 "$1" help re
    grep -q 'error: no help on re; did you mean one of: .*register .*results?' log || fail "the nearest topics"
    expect_exit 2 "$1" help nothing
    expect_exit 2 "$1" help ../map
    expect_exit 2 "$1" nothing
    expect_exit 2 "$1" eigen
    expect_exit 2 "$1"
}
check_front_end "$varimap"

mkdir empty
cp a.off ./-x.off
"$varimap" survey -- -x.off >out.txt 2>log || fail "survey of a name with a dash (exit $?)"
grep -q '^"./-x.off",taken,' out.txt || fail "a name with a dash: $(<out.txt)"
expect_exit 6 "$varimap" survey empty
grep -q 'survey: error: empty: no mesh there' log || fail "a folder without meshes"

# From an installed prefix, and through a link to it.
mkdir -p prefix/bin prefix/share/varimap/help elsewhere
cp "$VARIMAP_SOURCE/pipelines/varimap" "$VARIMAP_BIN"/varimap-* prefix/bin
cp "$VARIMAP_SOURCE"/pipelines/{Makefile,quality.jq,quality_words.jq,report.jq,summary.jq,script.sh,plain_text.awk,progress.sh,bench,bench-list,debian-meshes,gallery,plot,register,scaling,selftest,survey,torus} prefix/share/varimap
cp -r "$VARIMAP_SOURCE"/pipelines/{batch,front_end} prefix/share/varimap
cp "$VARIMAP_SOURCE"/pipelines/help/*.md prefix/share/varimap/help
ln -s ../prefix/bin/varimap elsewhere/varimap
(
    unset VARIMAP_BIN VARIMAP_SOURCE
    prefix/bin/varimap map -v "${small_picture[@]}" a.off b.off -o installed >/dev/null 2>log || fail "from the prefix"
    elsewhere/varimap map -v "${small_picture[@]}" a.off b.off -o installed >/dev/null 2>log || fail "through a link"
    expect_ran ""
)
check_front_end elsewhere/varimap

# From a folder whose name is not UTF-8, below which jq finds no modules.
odd=$'o\xffdd'
cp -r prefix "$odd"
"$odd/bin/varimap" report installed >out.txt 2>log || fail "from a folder whose name is not UTF-8: $(cat log)"
grep -q '^verdict  ' out.txt || fail "a report from a folder whose name is not UTF-8"

# Markdown as plain text.
cat >prefix/share/varimap/help/page.md <<'TEXT'
# A page
Some `code`, **bold**, and [a link](other.md).

| name | meaning |
|---|---|
| `one` | 1 \| more |
| twelve | 12 |

```
kept  as it is
```
TEXT
prefix/bin/varimap help page >page.txt
same page.txt - <<'TEXT'
A PAGE
Some code, bold, and a link.

    name    meaning
    one     1 | more
    twelve  12

    kept  as it is
TEXT
