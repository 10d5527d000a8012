#!/usr/bin/env bash
# consumer_test.sh BUILD SOURCE: installs a build folder into a prefix of its own, where the front end finds all that it needs; a project
# elsewhere finds the package there, links it and runs. The same project takes the sources in by add_subdirectory, which is only configured.
set -euo pipefail
shopt -s inherit_errexit
build=$(realpath -- "$1") source=$(realpath -- "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset VARIMAP_BIN VARIMAP_SOURCE  # what is installed stands alone
cp "$source"/tests/consumer/{CMakeLists.txt,*.cpp} "$work"

cmake --install "$build" --prefix "$work/prefix" >"$work/log"
cmake -S "$work" -B "$work/found" -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix"
cmake --build "$work/found"
"$work/found/transport"

# In memory and through files: the same map, and the same is said of it.
for how in landmarks explore parts; do
    mkdir "$work/$how"
    "$work/found/map" "$work/$how" "$how" >"$work/in_memory" 2>"$work/log" || { cat "$work/log"; exit 1; }
    arguments=("$work/$how/A.ply" "$work/$how/B.ply" -o "$work/$how/out")
    [[ $how == explore ]] || arguments+=(--landmarks "$work/$how/landmarks.txt")
    "$work/prefix/bin/varimap" map "${arguments[@]}" >"$work/log" 2>&1 ||
        { cat "$work/log"; exit 1; }
    cmp "$work/$how/A_to_B.csv" "$work/$how/out/source_to_target.csv"
    cmp "$work/$how/B_to_A.csv" "$work/$how/out/target_to_source.csv"
    jq -r '[.source_to_target.coverage, .round_trip.mean, .source_to_target.flipped_count] | @tsv' "$work/$how/out/quality.json" |
        awk '{ printf "%.12g %.12g %d\n", $1, $2, $3 }' | diff - "$work/in_memory"
done

# Pages and scripts are found beside the front end.
for words in "help" "help map" "batch --help" "bench --help" "survey $work/explore/A.ply"; do
    # shellcheck disable=SC2086
    "$work/prefix/bin/varimap" $words >"$work/log" 2>&1 || { echo "FAILED: the installed varimap $words"; cat "$work/log"; exit 1; }
done
grep -q ',taken,' "$work/log" || { echo "FAILED: the installed survey"; cat "$work/log"; exit 1; }

version=$("$work/prefix/bin/varimap-preprocess" --version)
[[ -n $version ]] || { echo "FAILED: the installed varimap-preprocess names no version"; exit 1; }

cmake -S "$work" -B "$work/along" -DVARIMAP_SOURCE="$source"
# Nothing of varimap's settings reaches the project around it.
grep -q '^CMAKE_BUILD_TYPE:STRING=$' "$work/along/CMakeCache.txt" || { echo "FAILED: a build type was set"; exit 1; }
grep -q '^VARIMAP_TESTS:BOOL=OFF$' "$work/along/CMakeCache.txt" || { echo "FAILED: the tests are on"; exit 1; }
