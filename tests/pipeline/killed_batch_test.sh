#!/usr/bin/env bash
# A batch that is killed at random moments (SIGKILL: everything, the front end alone, one job or one stage), some of whose artifacts
# are then damaged, ends with the same bytes as one that was left alone, says what it made anew, and leaves nothing else.
#   VARIMAP_KILLS: how many runs are killed (default 6); VARIMAP_SEED: of the random moments (default 1)
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
kills=${VARIMAP_KILLS:-6}
RANDOM=${VARIMAP_SEED:-1}
mkdir meshes
figure meshes/a.off 6
figure meshes/b.off 6 .5
figure meshes/c.off 6 .3
command=("$varimap" batch "${small_picture[@]}" "${coarse[@]}" --all-pairs meshes --consistent -j 2 -o)

start=$EPOCHREALTIME
"${command[@]}" whole >out.txt 2>log || fail "a batch (exit $?)"
milliseconds=$(((${EPOCHREALTIME/./} - ${start/./}) / 1000))

kinds=(all front_end job stage)
# Half of the bytes of some artifact that was not damaged already; its name goes to the list.
damage() {
    local files file
    mapfile -t files < <(artifacts killed/artifacts/ | sort)
    ((${#files[@]})) || return 0
    file=${files[RANDOM % ${#files[@]}]}
    ! grep -qx "$file" damaged || return 0
    truncate -s $(($(stat -c %s "$file") / 2)) "$file"
    echo "$file" >>damaged
}

# All that was damaged is said, in the log of whoever made it anew.
finish() {
    local file
    "${command[@]}" killed --check >out.txt 2>log || fail "the batch after $killed kills (exit $?)"
    same_batch whole killed
    nothing_left killed
    while read -r file; do
        grep -rhsF --include=log.txt "${file##*/}' is damaged" killed >said || fail "nobody says that $file was damaged"
        grep -q 'making it anew' said || fail "$file was damaged, and nobody says that it was made anew"
    done <damaged
    echo "after $killed kills, and $(wc -l <damaged) damaged artifacts: the same bytes"
    rm -rf killed damaged
    : >damaged
}

: >damaged
for ((killed = 1; killed <= kills; ++killed)); do
    setsid "${command[@]}" killed >/dev/null 2>&1 </dev/null &
    session=$!
    moment=$((RANDOM % milliseconds))
    sleep "$((moment / 1000)).$(printf '%03d' $((moment % 1000)))"
    # shellcheck disable=SC2046
    kill -9 $(victims "${kinds[RANDOM % 4]}" $session) 2>/dev/null || true
    wait $session 2>/dev/null || true
    # Where the front end alone was killed its jobs go on, and are waited for by whoever comes next.
    ((RANDOM % 2)) || pgrep -s "$session" >/dev/null || damage
    ((RANDOM % 3)) || finish
done
killed=$kills
finish
echo "$kills batches of about $milliseconds ms were killed"
