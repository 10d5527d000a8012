#!/usr/bin/env bash
# What the documentation names is there: linked files, functions in the files said to hold them, parameters of stages.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
cd "$VARIMAP_SOURCE"

pages=(README.md CHANGELOG.md common/README.md pipelines/README.md pipelines/help/*.md stages/*/README.md)

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
    local row names files name missing=0
    while IFS= read -r row; do
        names=$(cut -d'|' -f3 <<<"$row" | grep -o '`[A-Za-z_:]*`' | tr -d '`' | sed 's/.*:://') || continue
        mapfile -t files < <(cut -d'|' -f4 <<<"$row" | grep -o '`[^`]*`' | tr -d '`')
        for name in $names; do
            cat_sources "${files[@]}" | grep -qw -- "$name" ||
                { echo "common/README.md: $name is not in ${files[*]}" >&2; missing=1; }
        done
    done < <(sed -n '/^| paper | computed by/,/^$/p' common/README.md | tail -n +3 | grep '|')
    return $missing
}

cat_sources() {  # FILES as the table names them: of common/varimap, or of the project
    local file
    for file in "$@"; do
        if [[ -e $file ]]; then cat "$file"; else cat "common/varimap/$file"; fi
    done
}

parameters_exist() {
    local word stage name missing=0
    for word in $(grep -oh '`[a-z]*\.[a-z_]*`' pipelines/help/parameters.md | tr -d '`' | sort -u); do
        stage=${word%%.*} name=${word#*.}
        [[ -x $VARIMAP_BIN/varimap-$stage ]] || continue
        "$VARIMAP_BIN/varimap-$stage" --help | grep -q -- "--$name " ||
            { echo "pipelines/help/parameters.md: $word is no parameter" >&2; missing=1; }
    done
    return $missing
}

every_stage_has_a_page() {
    local main
    for main in stages/*/main.cpp; do
        [[ -s $(dirname "$main")/README.md ]] || { echo "$(dirname "$main") has no README.md" >&2; return 1; }
    done
}

links_lead_somewhere
names_are_in_their_files
parameters_exist
every_stage_has_a_page
(($(wc -l <README.md) <= 250)) || { echo "README.md has more than 250 lines" >&2; exit 1; }
