#!/usr/bin/env bash
# The same bytes in every artifact and export, for any number of threads, folder, locale and run.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
figure a.off 14
figure b.off 12 .6
figure straight.off 12
landmarks_of_figure a.off | cut -d ' ' -f 1 >a.txt
landmarks_of_figure straight.off | cut -d ' ' -f 1 >b.txt
map a.off b.off -o one --landmarks a.txt b.txt -j 1
map a.off b.off -o again --landmarks a.txt b.txt -j 1
mkdir elsewhere
cp a.off b.off a.txt b.txt elsewhere
# Four cores: two threads for the stages of one surface, four for those of the pair.
(cd elsewhere && LC_ALL=C.UTF-8 TZ=Asia/Tokyo map a.off b.off -o ../four --landmarks a.txt b.txt -j 4)
for other in again four; do
    for file in one/artifacts/*.{surface,coarse,basis,hierarchy,diffusion,plan,map,quality}; do
        same "$file" "$other/artifacts/${file##*/}"
    done
    for file in one/*.csv one/*.ply one/picture.png; do
        same "$file" "$other/${file##*/}"
    done
    same <(jq 'del(.stages, .provenance)' one/quality.json) <(jq 'del(.stages, .provenance)' $other/quality.json)
done
jq -e '[.. | numbers | select(isinfinite or isnan)] == [] and ([.. | nulls] == [])' one/quality.json >/dev/null ||
    fail "quality.json holds numbers that are not finite"
