#!/usr/bin/env bash
# Folders that become read-only or vanish under a run: one line and exit 6, nothing broken, and the next run carries on.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
mounted=''
! own_disk || mounted=yes
small_picture+=("${coarse[@]}")
figure a.off 6
figure b.off 6 .5
map a.off b.off -o good

# start OUT OPTION...: a run in the background; ended waits for it.
start() {
    "$varimap" map "${small_picture[@]}" a.off b.off -o "$@" >out.txt 2>log </dev/null &
    run=$!
}
ended() {  # WHAT HAPPENED: the run either has all, or says in one line what it could not do
    local code=0
    wait $run || code=$?
    case $code in
    0) ;;
    6) [[ $(grep -c 'error: ' log) == 1 ]] || fail "not one error line: $1" ;;
    *) fail "exit $code: $1" ;;
    esac
    ((++codes[code]))
}
declare -A codes=([0]=0 [6]=0)

for moment in .02 .05 .1 .15 .2 .3 .4 .6 .8; do
    start gone
    sleep $moment
    rm -rf gone 2>/dev/null || rm -rf gone 2>/dev/null || true
    ended "the folder of results vanished after $moment s"
    start kept --artifacts shared
    sleep $moment
    mv shared elsewhere 2>/dev/null || true
    ended "the folder of artifacts vanished after $moment s"
    rm -rf elsewhere
done
((codes[6] > 2)) || fail "nothing was in the way of the runs"
map a.off b.off -o gone
same_results good gone
map a.off b.off -o kept --artifacts shared
same_results good kept

# Folders that nobody may write to: by mode, which does not stop root, and by mount.
if (($(id -u) != 0)); then
    mkdir locked
    chmod a-w locked
    expect_exit 6 "$varimap" map "${small_picture[@]}" a.off b.off -o locked
    expect_exit 6 "$VARIMAP_BIN/varimap-preprocess" a.off locked/a.surface
    chmod u+w locked
fi
[[ -n $mounted ]] || { echo "no read-only disk: mounting is not permitted here"; exit 0; }
mount -o remount,ro disk
expect_exit 6 "$varimap" map "${small_picture[@]}" a.off b.off -o disk/out
expect_exit 6 "$VARIMAP_BIN/varimap-preprocess" a.off disk/a.surface
for moment in .05 .1 .2 .3 .4 .6 .8 1; do
    mount -o remount,rw disk
    rm -rf disk/*
    start disk/out
    sleep $moment
    # Busy as long as a file is being written.
    for _ in {1..50}; do
        ! mount -o remount,ro disk 2>/dev/null || break
        sleep .01
    done
    ended "read-only after $moment s"
    mount -o remount,rw disk
    map a.off b.off -o disk/out
    same_results good disk/out
    nothing_left disk/out
done
echo "of the runs ${codes[6]} were stopped and ${codes[0]} not"
