#!/usr/bin/env bash
# include_rules_test.sh RULES SOURCE: fails where a source includes what its room, stage or library does not link, and
# names the line, the include and what is allowed. RULES is the include_rules.txt that CMake writes into the build
# folder from what the targets link. Then plants forbidden includes in a copy and sees that each is found.
set -euo pipefail
shopt -s inherit_errexit
rules=$(realpath -- "$1") source=$(realpath -- "$2")

# check SOURCE: prints a line for every forbidden include.
# Of <...> those are judged that begin like an include of a package that some target links; others are the system's.
check() {
    cd "$1"
    grep -rnE '^[[:space:]]*#[[:space:]]*include' common stages pipelines --include='*.h' --include='*.cpp' |
        awk -v rules="$rules" '
        function begins_like_one_of(text, prefixes, count,    k) {
            for (k = 1; k <= count; k++) if (index(text, prefixes[k]) == 1) return 1
            return 0
        }
        BEGIN {
            while ((getline line < rules) > 0) {
                split(line, words, " ")
                folders[words[1]] = 1
                allowed[words[1], words[2]] = substr(line, length(words[1]) + length(words[2]) + 3)
                all = all " " allowed[words[1], words[2]]
            }
            packages = split(all, package, " ")
        }
        {
            match($0, /:[0-9]+:/)
            file = substr($0, 1, RSTART - 1); place = substr($0, 1, RSTART + RLENGTH - 2)
            if (!match($0, /[<"][^>"]*[>"]/)) next
            quoted = substr($0, RSTART, 1) == "\""; name = substr($0, RSTART + 1, RLENGTH - 2)
            # Headers in private/ are not installed, and include what the sources may.
            folder = file; ending = file ~ /\.h$/ && file !~ /\/private\// ? "h" : "cpp"
            while (!(folder in folders) && sub(/\/[^\/]*$/, "", folder));
            if (!(folder in folders)) { print place ": no rule covers this folder"; next }
            count = split(allowed[folder, ending], prefix, " ")
            if (begins_like_one_of(name, prefix, count)) next
            if (!quoted && !begins_like_one_of(name, package, packages)) next
            print place ": " name " is not allowed here; allowed: " allowed[folder, ending]
        }'
}

forbidden=$(check "$source")
if [[ -n $forbidden ]]; then
    echo "$forbidden"
    echo "common/CMakeLists.txt and stages/CMakeLists.txt say what each may include."
    exit 1
fi

# --- The test itself ------------------------------------------------------------------------------------------

copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
cp -r "$source"/{common,stages,pipelines} "$copy"

# expect_found FILE INCLUDE: the include, added to the file, is the only one found.
expect_found() {
    local lines found
    cp "$source/$1" "$copy/$1"
    printf '\n#include %s\n' "$2" >>"$copy/$1"
    lines=$(wc -l <"$copy/$1")
    found=$(check "$copy")
    cp "$source/$1" "$copy/$1"
    [[ $found == "$1:$lines: ${2:1:-1} is not allowed here; allowed: "* && $found != *$'\n'* ]] || {
        echo "FAILED: $2 in $1 gave: ${found:-nothing}"
        exit 1
    }
}
expect_found common/varimap/core/log.cpp '"varimap/surface/surface.h"'
expect_found common/varimap/transport/sinkhorn.cpp '"varimap/spectral/laplacian.h"'
expect_found common/varimap/untangling/untangling.cpp '"varimap/multilevel/orientation.h"'
expect_found common/varimap/sliding/sliding_map.cpp '"varimap/relaxation/fold_removal.h"'
expect_found common/varimap/verification/verification.h '"varimap/quality/quality.h"'
expect_found common/varimap/verification/verification.cpp '<CLI/CLI.hpp>'
expect_found common/varimap/mesh/closest_point.h '<embree3/rtcore.h>'
expect_found common/varimap/mesh_files/mesh_file.cpp '"varimap/mesh_repair/weld.h"'
expect_found stages/refine/refine.cpp '"stages/diffuse/params.h"'
expect_found stages/eigen/main.cpp '"varimap/multilevel/orientation.h"'
echo "include rules hold"
