#!/usr/bin/env bash
# A clock that is set back and forth: what changes is dated at random, in the past or the future, and files swap their
# times. Nothing stale, whatever the times say.   VARIMAP_CLOCK_STEPS: how many changes (default 24).
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
small_picture+=("${coarse[@]}")
steps=${VARIMAP_CLOCK_STEPS:-24}
figure a.off 6
for n in 0 1 2; do
    figure b$n.off 6 .$n
    landmarks_of_figure b$n.off | head -n $((3 + n)) >tips$n.txt
done
for mesh in 0 1 2; do
    for tips in 0 2; do
        cp b$mesh.off b.off
        cp tips$tips.txt tips.txt
        map a.off b.off -o good$mesh$tips --landmarks tips.txt
    done
done

dates=('1970-01-02' '1999-12-31 23:59:59' '-1 hour' '-1 second' now '+1 second' '+1 hour' '+2 days' '2037-12-31')
RANDOM=1
any_date() { echo "${dates[RANDOM % ${#dates[@]}]}"; }
for ((i = 0; i < steps; ++i)); do
    mesh=$((RANDOM % 3)) tips=$((RANDOM % 2 * 2))
    cp b$mesh.off b.off
    cp tips$tips.txt tips.txt
    touch -d "$(any_date)" b.off
    touch -d "$(any_date)" tips.txt
    if [[ -d out ]]; then
        find out -type f -print0 | xargs -0 touch -d "$(any_date)"
        touch -d "$(any_date)" out/artifacts/*.surface out/artifacts/hashes/* 2>/dev/null || true
    fi
    map a.off b.off -o out --landmarks tips.txt
    same_results good$mesh$tips out
done
nothing_left out
