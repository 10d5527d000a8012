#!/usr/bin/env bash
# What the documentation names is there: linked files, functions in the files said to hold them, parameters of stages, with the
# defaults that it tells; and the commands that are to make the map by hand make it.
# shellcheck disable=SC2016  # backquotes are those of Markdown
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
cd "$VARIMAP_SOURCE"

pages=(README.md CHANGELOG.md common/README.md pipelines/README.md pipelines/measurements.md pipelines/experiments/README.md pipelines/help/*.md stages/*/README.md)

links_lead_somewhere() {
    local page link broken=0
    for page in "${pages[@]}"; do
        while read -r link; do
            [[ -z $link || $link == *://* ]] && continue
            [[ -e $(dirname "$page")/$link ]] || { echo "$page: links to $link, which is not there" >&2; broken=1; }
        done < <(grep -o '](\([^)#]*\)' "$page" | sed 's/^](//')
    done
    return $broken
}

# Rows of the table `| paper | computed by | file |`: each name in the first backquoted file of its row, or the others.
names_are_in_their_files() {
    local row names files sources name missing=0 rows=0
    while IFS= read -r row; do
        ((++rows))
        names=$(cut -d'|' -f3 <<<"$row" | grep -o '`[A-Za-z_:]*`' | tr -d '`' | sed 's/.*:://') || continue
        mapfile -t files < <(cut -d'|' -f4 <<<"$row" | grep -o '`[^`]*`' | tr -d '`')
        for name in $names; do
            mapfile -t sources < <(places "${files[@]}")
            grep -qw -- "$name" "${sources[@]}" ||
                { echo "common/README.md: $name is not in ${files[*]}" >&2; missing=1; }
        done
    done < <(sed -n '/^| paper | computed by/,/^$/p' common/README.md | tail -n +3 | grep '|')
    ((rows)) || { echo "common/README.md: no table of what is computed where" >&2; return 1; }
    return $missing
}

places() {  # FILES as the table names them: of common/varimap, or of the project
    local file
    for file in "$@"; do
        if [[ -e $file ]]; then echo "$file"; else echo "common/varimap/$file"; fi
    done
}

# is_stage STAGE WORD: whether there is one whose parameters can be asked for.
is_stage() {
    [[ -x $VARIMAP_BIN/varimap-$1 ]] || { echo "pipelines/help/parameters.md: $2: there is no stage $1" >&2; return 1; }
}

parameters_exist() {
    local word stage name missing=0
    for word in $(grep -oh '`[a-z][a-z]*\.[a-z_]*`' pipelines/help/parameters.md | tr -d '`' | sort -u); do
        stage=${word%%.*} name=${word#*.}
        is_stage "$stage" "$word" || { missing=1; continue; }
        grep -q -- "--$name " <<<"$("$VARIMAP_BIN/varimap-$stage" --help)" ||
            { echo "pipelines/help/parameters.md: $word is no parameter" >&2; missing=1; }
    done
    return $missing
}

# Rows of the table `| parameter | default | meaning |`: one default for all parameters of the row, or one for each.
defaults_are_those_of_the_stages() {
    local names said name i default wrong=0 rows=0
    while IFS='|' read -r _ names said _; do
        said=$(sed 's/(.*//; s/[` ]//g; s/^[.]/0./; s/,[.]/,0./g' <<<"$said") i=0
        ((++rows))
        while read -r name; do
            ((++i))
            is_stage "${name%.*}" "$name" || { wrong=1; continue; }
            default=$("$VARIMAP_BIN/varimap-${name%.*}" --help | sed -n "/^  --${name#*.} VALUE/{/(default/!N; s/.*(default \([^;]*\);.*/\1/p}")
            [[ $default == "$(cut -d, -f$i <<<"$said")" ]] ||
                { echo "pipelines/help/parameters.md: the default of $name is $default" >&2; wrong=1; }
        done < <(grep -o '[a-z]*[.][a-z_]*' <<<"$names")
    done < <(sed -n '/^| parameter | default/,/^$/p' pipelines/help/parameters.md | grep '`[a-z]*[.]')
    ((rows)) || { echo "pipelines/help/parameters.md: no table of defaults" >&2; return 1; }
    return $wrong
}

every_stage_has_a_page() {
    local main
    for main in stages/*/main.cpp; do
        [[ -s $(dirname "$main")/README.md ]] || { echo "$(dirname "$main") has no README.md" >&2; return 1; }
    done
}

# In a folder as the page has it, with small surfaces.
commands_of_stages_make_the_map() {
    local file
    mkdir -p "$work"/{build/demo,pipelines}
    cd "$work"
    ln -s "$VARIMAP_BIN" build/bin
    figure build/demo/bull.off 17
    figure build/demo/cow.off 17 .5
    landmarks_of_figure build/demo/bull.off >pipelines/bull--cow.landmarks.txt
    sed -n '/^```$/,/^```$/p; /^cd [.][.]$/q' "$VARIMAP_SOURCE/pipelines/help/stages.md" | grep -v '^```' >commands
    bash -euo pipefail commands >out.txt 2>log || fail "the commands of pipelines/help/stages.md"
    "$varimap" map build/demo/bull.off build/demo/cow.off -o out --landmarks pipelines/bull--cow.landmarks.txt >out.txt 2>log ||
        fail "varimap map (exit $?)"
    # The same files, none more and none less, beside one another by hand.
    cp out/*.{csv,ply,png} out/artifacts
    for file in $(artifacts out/artifacts) out/artifacts/*.{csv,ply,png}; do same "$file" "out-hand/${file##*/}"; done
    [[ $(artifacts out-hand | wc -l) == $(artifacts out/artifacts | wc -l) ]] || fail "pipelines/help/stages.md makes more than make"
    cd "$VARIMAP_SOURCE"
}

links_lead_somewhere
names_are_in_their_files
parameters_exist
defaults_are_those_of_the_stages
every_stage_has_a_page
commands_of_stages_make_the_map
(($(wc -l <README.md) <= 250)) || { echo "README.md has more than 250 lines" >&2; exit 1; }
