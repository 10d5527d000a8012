#!/usr/bin/env bash
# The environment changes nothing: variables with the Makefile's names, none at all, locales, closed descriptors.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
small_picture+=("${coarse[@]}")
figure a.off 6
figure b.off 6 .5
landmarks_of_figure a.off >tips.txt
options=(a.off b.off --landmarks tips.txt --set eigen.count=40 --set refine.tolerance=.01 --set diffuse.ironing=true)
map "${options[@]}" -o plain

# Every variable of the Makefile, and what make, shells and tools listen to.
hostile=(MAKEFLAGS=-n MAKEFILES=/dev/null MAKELEVEL=7 CDPATH=/:/tmp BASH_ENV=/dev/null POSIXLY_CORRECT=1 GREP_OPTIONS=-v IFS=a
    name=other here=/ share=/ out=elsewhere artifacts=elsewhere cores=x stages=none TBB_NUM_THREADS=1 TZ=Asia/Tokyo
    COLUMNS=20 TERM=dumb JQ_COLORS=0 TAR_OPTIONS=-x OMP_NUM_THREADS=9999)
while read -r variable; do
    hostile+=("$variable=9")
done < <(grep -ohE '^[A-Za-z_]+ *[:?+]?=' "$VARIMAP_SOURCE/pipelines/Makefile" | grep -oE '^[A-Za-z_]+')
[[ " ${hostile[*]} " == *" PART=9 "* && " ${hostile[*]} " == *" DIFFUSE_FLAGS=9 "* ]] || fail "the Makefile's names were not found"
hostile+=(VARIMAP_SOURCE=/absent VARIMAP_TARGET=/absent VARIMAP_LANDMARKS_1=/absent "VARIMAP_BIN=$VARIMAP_BIN")
env "${hostile[@]}" "$varimap" map -v "${small_picture[@]}" "${options[@]}" -o hostile >out.txt 2>log || fail "a hostile environment"
same_results plain hostile
ran >hostile_ran
map "${options[@]}" -o count
expect_ran "$(<hostile_ran)"
env "${hostile[@]}" MAKEFLAGS= make -s -f "$VARIMAP_SOURCE/pipelines/Makefile" -j1 SOURCE=a.off TARGET=b.off OUT=made LANDMARKS=tips.txt \
    PREPROCESS_FLAGS="--target_edge_length .2" EIGEN_FLAGS="--count 40" REFINE_FLAGS="--tolerance .01" RENDER_FLAGS="--width 64 --samples 1" 2>log || fail "make"
same plain/source_to_target.csv made/source_to_target.csv
env -i PATH="$PATH" VARIMAP_BIN="$VARIMAP_BIN" "$varimap" map -v "${small_picture[@]}" "${options[@]}" -o empty >out.txt 2>log ||
    fail "an empty environment"
same_results plain empty

# Options of a shell, exported.
(
    set -C
    export SHELLOPTS
    "$varimap" map -v "${small_picture[@]}" "${options[@]}" -o empty >|out.txt 2>|log || fail "noclobber"
)
(
    set -f
    export SHELLOPTS
    "$varimap" map -v "${small_picture[@]}" "${options[@]}" -o empty >out.txt 2>log || fail "noglob"
)

# Locales: all that are here, and the Turkish one, in which i is no lower case of I and the point a comma.
printf '%s\n' stage,artifact,input_vertices,cpu_seconds,wall_seconds,megabytes preprocess,a.surface,1000,1.5,2,3.25 preprocess,b.surface,3000,2.75,3,4.5 >costs.csv
"$VARIMAP_SOURCE/pipelines/batch/fit" costs.csv >model.csv
locales=(C.UTF-8)
if command -v localedef >/dev/null && localedef -i tr_TR -f UTF-8 "$work/tr_TR.UTF-8" 2>/dev/null; then
    export LOCPATH=$work
    locales+=(tr_TR.UTF-8)
fi
mapfile -t -O ${#locales[@]} locales < <(locale -a | grep -vE '^(C|POSIX|C\.utf8)$' | head -n 10)
for locale in "${locales[@]}"; do
    LC_ALL=$locale LANGUAGE=tr "$varimap" map -v "${small_picture[@]}" "${options[@]}" -o plain >out.txt 2>log || fail "locale $locale"
    expect_ran ""
    LC_ALL=$locale "$VARIMAP_SOURCE/pipelines/batch/fit" costs.csv >fitted.csv
    same model.csv fitted.csv
done
echo "locales: ${locales[*]}"
unset LOCPATH

# Descriptors that are closed or full.
"$varimap" map -v "${small_picture[@]}" "${options[@]}" -o closed <&- >/dev/null 2>&- || fail "closed stdin and stderr"
same_results plain closed
exits() {  # CODE COMMAND...
    local code=0
    "${@:2}" || code=$?
    ((code == $1)) || { echo "exit $code, not $1: ${*:2}" >>codes; return 1; }
}
artifact=plain/artifacts/a.surface
exits 2 "$VARIMAP_BIN/varimap-diffuse" absent 2>&- || fail "$(cat codes)"
exits 6 "$VARIMAP_BIN/varimap-inspect" absent 2>&- || fail "$(cat codes)"
exits 4 "$VARIMAP_BIN/varimap-eigen" a.off x.basis 2>&- || fail "$(cat codes)"
exits 4 "$VARIMAP_BIN/varimap-eigen" a.off x.basis 2>/dev/full || fail "$(cat codes)"
exits 6 "$varimap" map a.off absent.off -o none 2>&- || fail "$(cat codes)"
exits 2 "$varimap" map a.off b.off -o none --set eigen.count=x 2>/dev/full || fail "$(cat codes)"
exits 6 "$varimap" map -v "${small_picture[@]}" "${options[@]}" -o plain >/dev/full 2>log || fail "$(cat codes)"
exits 6 "$varimap" map -v "${small_picture[@]}" "${options[@]}" -o plain >&- 2>log || fail "$(cat codes)"
[[ $(tail -n 1 log) == "varimap: error: cannot write to standard output" && $(grep -c 'write error' log) == 0 ]] || fail "a closed stdout: $(<log)"
exits 6 "$varimap" map "${small_picture[@]}" "${options[@]}" -o plain -q >/dev/full 2>log || fail "$(cat codes)"
[[ $(<log) == "varimap: error: cannot write to standard output" ]] || fail "a full stdout: $(<log)"
for words in "help map" "map --help" "help" "--help" "--version" "batch --help" "transfer --help" "report --help" "report plain" "survey a.off"; do
    # shellcheck disable=SC2086
    exits 6 "$varimap" $words >/dev/full 2>log || fail "$(cat codes)"
    [[ $(<log) == *": error: cannot write to standard output" && $(wc -l <log) == 1 ]] || fail "$words: $(<log)"
done
exits 6 "$VARIMAP_BIN/varimap-inspect" $artifact >/dev/full 2>log || fail "$(cat codes)"
exits 6 "$VARIMAP_BIN/varimap-inspect" $artifact >&- 2>log || fail "$(cat codes)"
# With all of them closed the artifact is still whole.
"$VARIMAP_BIN/varimap-eigen" plain/artifacts/a.surface x.basis --count 40 <&- >&- 2>&- || fail "all closed"
same x.basis plain/artifacts/a.basis
