#!/usr/bin/env bash
# Names in no encoding and full of escapes, pipes, devices and folders where files belong, inputs in the way of outputs.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
small_picture+=("${coarse[@]}")
figure a.off 6
figure b.off 6 .5
landmarks_of_figure a.off >tips.txt
map a.off b.off -o plain --landmarks tips.txt

odd=$'\xff\xfe\e]0;owned\a\e[31m\nsecond line \xc2\x9b'
mkdir "$odd"
cp a.off "$odd/$odd.off"
cp b.off "$odd/b.off"
cp tips.txt "$odd/$odd.txt"
map "$odd/$odd.off" "$odd/b.off" -o "$odd/out$odd" --landmarks "$odd/$odd.txt"
same plain/source_to_target.csv "$odd/out$odd/source_to_target.csv"
printable_only log out.txt
map "$odd/$odd.off" "$odd/b.off" -o "$odd/out$odd" --landmarks "$odd/$odd.txt"
expect_ran ""
# JSON cannot hold such a name: the link that the run left knows it.
seq 146 >numbers.csv
"$varimap" transfer "$odd/out$odd" --values numbers.csv >out.txt 2>log || fail "transfer where names are in no encoding (exit $?): $(<log)"
"$varimap" transfer plain --values numbers.csv >out.txt 2>log || fail "transfer (exit $?)"
same plain/transfer/numbers.csv "$odd/out$odd/transfer/numbers.csv"
map "$odd/b.off" b.off -o same_names
map b.off "$odd/b.off" -o same_names

# Errors name the user's own file, and end what is printed.
last_line_names() {  # TEXT
    tail -n 1 log | grep -Fq "error: " || fail "the error is not the last line"
    tail -n 1 log | grep -Fq -- "$1" || fail "the error does not name $1"
    printable_only log
}
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 \e[31m7\n' >bad.off
expect_exit 3 "$varimap" map bad.off b.off -o out -j 4
last_line_names "$PWD/bad.off"
expect_exit 3 "$varimap" map b.off bad.off -o out -j 4
last_line_names "$PWD/bad.off"
printf '0 \e[31mx\n' >bad.txt
expect_exit 3 "$varimap" map a.off b.off -o out --landmarks bad.txt
last_line_names "$PWD/bad.txt"
expect_exit 6 "$varimap" map "$odd/absent" b.off -o out
printable_only log
expect_exit 2 "$varimap" map a.off b.off -o out --$'\e[31m'
printable_only log

# No pipe is waited for.
mkfifo pipe.off
for arguments in "pipe.off b.off" "a.off pipe.off" "a.off b.off --landmarks pipe.off" "a.off b.off --config pipe.off"; do
    # shellcheck disable=SC2086
    expect_exit 6 timeout 10 "$varimap" map $arguments -o out
done
expect_exit 6 timeout 10 "$VARIMAP_BIN/varimap-preprocess" pipe.off x.surface
expect_exit 6 timeout 10 "$VARIMAP_BIN/varimap-eigen" plain/artifacts/a.surface x.basis --config pipe.off
expect_exit 4 timeout 10 "$VARIMAP_BIN/varimap-inspect" --check pipe.off
expect_exit 6 timeout 10 "$VARIMAP_BIN/varimap-verify" a.off b.off pipe.off
expect_exit 6 "$VARIMAP_BIN/varimap-preprocess" . x.surface

# Nothing but a file is replaced.
mkfifo pipe
mkdir folder
for output in pipe folder /dev/null /dev/full; do
    expect_exit 6 timeout 10 "$VARIMAP_BIN/varimap-preprocess" a.off $output
    expect_exit 6 timeout 10 "$VARIMAP_BIN/varimap-render" a.off b.off plain/{source_to_target,target_to_source}.csv $output
done
[[ -p pipe && -d folder && -c /dev/null ]] || fail "something was replaced"
for name in source_to_target.csv quality.json picture.png; do
    mkdir -p "blocked/$name"
    expect_exit 6 "$varimap" map a.off b.off -o blocked
    rmdir "blocked/$name"
done

# Errors say where, as seen from where the user is: of artifacts, results, and folders that are gone or cannot be made.
mkdir -p blocked/artifacts/a.basis
expect_exit 6 "$varimap" map a.off b.off -o ./blocked
last_line_names "'./blocked/artifacts/a.basis'"
rmdir blocked/artifacts/a.basis
map a.off b.off -o linked --artifacts away --until preprocess
rm -r away
expect_exit 6 "$varimap" map a.off b.off -o linked
last_line_names "linked/artifacts: leads to $PWD/away, which is gone"
map a.off b.off -o linked --artifacts away --until preprocess
expect_exit 6 "$varimap" map a.off b.off -o /proc/none
last_line_names '/proc/none: cannot be made: No such file or directory'
map a.off b.off -o halfway --until remesh
"$varimap" report halfway >out.txt 2>log || fail "report"
! grep -q '^picture' out.txt || fail "a picture that is not there"

# A run does not write over what it reads.
cp -r plain self
for name in source_on_target.ply target_on_source.ply; do
    expect_exit 2 "$varimap" map self/$name b.off -o self
    expect_exit 2 "$varimap" map b.off self/$name -o "$PWD/plain/../self"
done
ln -s self/source_on_target.ply linked.ply
expect_exit 2 "$varimap" map linked.ply b.off -o self
same_results plain self
nothing_left plain self
