#!/usr/bin/env bash
# Folders that become read-only or vanish under a run: one line and exit 6, nothing broken, and the next run carries on.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
mounted=''
! own_disk || mounted=yes
coarse_pair

# start OUT OPTION...: a run in the background; ended waits for it.
start() {
    "$varimap" map -v "${small_picture[@]}" a.off b.off -o "$@" >out.txt 2>log </dev/null &
    run=$!
}
after() {  # FILE: waits until the run has made it, or has ended
    until [[ -e $1 ]] || ! kill -0 $run 2>/dev/null; do sleep .005; done
}
ended() {  # WHAT HAPPENED: the run either has all, or says in one line what it could not do
    local code=0
    wait $run || code=$?
    case $code in
    0) ;;
    6) [[ $(grep -c 'error: ' log) == 1 ]] || fail "not one error line: $1" ;;
    *) fail "exit $code: $1" ;;
    esac
    ((codes[code] += 1))
}
codes=()  # how many runs ended with each

made=(a.surface a.hierarchy a--b.candidates a--b.diffusion a--b.plan a--b.map)
for artifact in "${made[@]}"; do
    start gone
    after "gone/artifacts/$artifact"
    rm -rf gone 2>/dev/null || rm -rf gone 2>/dev/null || true
    ended "the folder of results vanished after $artifact"
    start kept --artifacts shared
    after "shared/$artifact"
    mv shared elsewhere 2>/dev/null || true
    ended "the folder of artifacts vanished after $artifact"
    rm -rf elsewhere
done
((${codes[6]:-0} > 2)) || fail "nothing was in the way of the runs"
map a.off b.off -o gone
same_results good gone
map a.off b.off -o kept --artifacts shared
same_results good kept

# Folders that nobody may write to: by mode, which does not stop root, and by mount.
if (($(id -u) != 0)); then
    mkdir locked
    chmod a-w locked
    expect_exit 6 "$varimap" map -v "${small_picture[@]}" a.off b.off -o locked
    expect_exit 6 "$VARIMAP_BIN/varimap-preprocess" a.off locked/a.surface
    chmod u+w locked
fi
[[ -n $mounted ]] || { echo "no read-only disk: mounting is not permitted here"; exit 0; }
mount -o remount,ro disk
expect_exit 6 "$varimap" map -v "${small_picture[@]}" a.off b.off -o disk/out
expect_exit 6 "$VARIMAP_BIN/varimap-preprocess" a.off disk/a.surface
for artifact in "${made[@]}"; do
    mount -o remount,rw disk
    rm -rf disk/*
    start disk/out
    after "disk/out/artifacts/$artifact"
    # Busy as long as a file is being written.
    for _ in {1..50}; do
        ! mount -o remount,ro disk 2>/dev/null || break
        sleep .01
    done
    ended "read-only after $artifact"
    mount -o remount,rw disk
    map a.off b.off -o disk/out
    same_results good disk/out
    nothing_left disk/out
done
echo "of the runs ${codes[6]} were stopped and ${codes[0]:-0} not"
