#!/usr/bin/env bash
# A disk that is full, or a limit on the size of files: exit 6 and one line, nothing half-written is left, and with
# space again a run carries on to the same bytes.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
mounted=''
! own_disk || mounted=yes
coarse_pair

whole() {  # FOLDER: every artifact in it passes its check
    artifacts "$1" | xargs -r "$VARIMAP_BIN/varimap-inspect" --check >log 2>&1 || fail "a damaged artifact was left"
}

# Files may grow to so many kB only. Stages are ended by no signal for it.
for limit in 1 8 32 64 128; do
    for signal in '' "trap '' XFSZ;"; do
        echo 0 >code
        # What it says is written by another: the limit is not to cut the log.
        { bash -c "$signal ulimit -f $limit; exec \"\$@\"" limited "$varimap" map -v "${small_picture[@]}" a.off b.off -o limited 2>&1 >out.txt ||
            echo $? >code; } | cat >log
        code=$(<code)
        ((code == 6 || code == 0)) || fail "exit $code with a limit of $limit kB on files"
        ((code == 0)) || [[ $(grep -c 'error: ' log) == 1 ]] || fail "not one error line"
        [[ ! -d limited/artifacts ]] || whole limited/artifacts/
        nothing_left limited
    done
done
map a.off b.off -o limited
same_results good limited

# Of a map that is replaced, no quality.json or picture is left that tells of another one than the tables.
# One table can be written, the one behind it, which is larger, cannot.
limit=$((($(stat -c %s good/source_to_target.csv) + 1023) / 1024 + 1))
cp -r good replaced
code=0
(ulimit -f $limit && exec "$varimap" map "${small_picture[@]}" a.off b.off -o replaced --set relax.area_weight=3) &>log || code=$?
((code == 6)) || fail "exit $code with a limit of $limit kB on files"
! cmp -s {good,replaced}/source_to_target.csv || fail "the first table was not written"
[[ ! -e replaced/quality.json && ! -e replaced/picture.png ]] || fail "a report of another map was left"

# Where no disk can be mounted, that is all.
[[ -n $mounted ]] || { echo "no full disk: mounting is not permitted here"; exit 0; }

# Some kB more are free in each run, from none on, until one has enough.
leave_free() {  # KB
    rm -f disk/filler
    local free
    free=$(df --output=avail -k disk | tail -n 1)
    ((free <= $1)) || head -c $(((free - $1) * 1024)) /dev/zero >disk/filler
}
refusals=0
for ((free = 0; ; free += 40)); do
    leave_free $free
    code=0
    "$varimap" map -v "${small_picture[@]}" a.off b.off -o disk/out >out.txt 2>log || code=$?
    ((code != 0)) || break
    ((code == 6)) || fail "exit $code with $free kB free"
    [[ $(grep -c 'error: ' log) == 1 ]] || fail "not one error line with $free kB free"
    ((++refusals < 200)) || fail "never enough space"
    if [[ -d disk/out ]]; then
        nothing_left disk/out
        [[ ! -d disk/out/artifacts ]] || whole disk/out/artifacts/
    fi
done
((refusals > 3)) || fail "the disk was full $refusals times only"
rm -f disk/filler
same_results good disk/out
map a.off b.off -o disk/out
expect_ran ""
echo "the disk was full $refusals times"

# Scripts around the stages: 6 and one line of their own, and no half of a table.
mkdir meshes
cp a.off b.off meshes
one_line() {  # COMMAND...
    rm -rf disk/*
    mkdir disk/out
    leave_free $free
    expect_exit 6 "$varimap" "$@" -o disk/out -q -j 1 "${small_picture[@]}"
    [[ $(wc -l <log) == 1 && $(<log) =~ ^(batch|register)": error: "[^:]*disk/out[^:]*": cannot be written; is the disk full?"$ ]] ||
        fail "$1 with $free kB free: $(cat log)"
    nothing_left disk/out
}
for free in 0 12 40 200; do
    one_line batch --all-pairs meshes
    one_line register a.off b.off
done
echo "so it was for scripts"
