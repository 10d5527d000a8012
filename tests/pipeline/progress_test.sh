#!/usr/bin/env bash
# What a run shows while it goes on: by default how far it is, with -v all that stages say, with -q nothing, with --json
# objects; log.txt has all of it, always. bench tells the reason of a failure.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
figure a.off 6
figure b.off 6 .5
small=(--set render.width=64 --set render.samples=1 "${coarse[@]}")

run() { "$varimap" map a.off b.off "${small[@]}" "$@" >out.txt 2>log || fail "map $* (exit $?)"; }

run -o plain
! grep -q '^\[' log || fail "what stages say is shown by default"
grep -q '^\[refine\] done' plain/log.txt || fail "what stages say is not in log.txt"
run -o verbose -v
grep -q '^\[refine\] done' log || fail "-v does not show what stages say"
grep -q '^\[refine\] done' verbose/log.txt || fail "log.txt lacks what -v shows"
run -o quiet -q
[[ ! -s log ]] || fail "-q shows something"
grep -q '^\[refine\] done' quiet/log.txt || fail "log.txt lacks what -q hides"
run -o json --json
jq -es 'map(select(.event == "ends") | .stage) | index("refine") != null and index("render") != null' log >/dev/null || fail "--json: progress"
jq -es 'group_by(.stage) | all(map(.event) as $all | ($all | length) % 2 == 0 and all(range(0; $all | length); $all[.] == ["begins", "ends"][. % 2]))' log >/dev/null ||
    fail "--json: a stage's beginnings and ends do not take turns"
jq -e '.verdict and .quality == "json/quality.json" and (.times | length > 5)' out.txt >/dev/null || fail "--json: summary"
# The same results, whatever is shown.
for out in verbose quiet json; do same plain/source_to_target.csv $out/source_to_target.csv; done
expect_exit 2 "$varimap" map a.off b.off -o none -q -v
expect_exit 2 "$varimap" map a.off b.off -o none -v --json

# Nowhere to show it: no reason to fail.
"$varimap" map a.off b.off "${small[@]}" -o closed --json >out.txt 2>&- || fail "closed stderr"
"$varimap" map a.off b.off "${small[@]}" -o full --json >out.txt 2>/dev/full || fail "full stderr"
POSIXLY_CORRECT=1 "$varimap" map a.off b.off "${small[@]}" -o posix >out.txt 2>log || fail "POSIX mode"
for out in closed full posix; do
    same plain/source_to_target.csv $out/source_to_target.csv
    grep -q '^\[refine\] done' $out/log.txt || fail "$out: log.txt"
done

# On a terminal: a line for each stage, colour unless it is unwanted.
if command -v script >/dev/null; then
    on_terminal() { TERM=xterm script -qec "$(printf '%q ' "$varimap" map a.off b.off "${small[@]}" "$@")" terminal.txt >/dev/null; }
    on_terminal -o coloured
    grep -q 'the map, finely' terminal.txt || fail "no line for a stage"
    grep -q $'\e\[36m' terminal.txt || fail "no colour on a terminal"
    NO_COLOR=1 on_terminal -o colourless
    ! grep -q $'\e\[36m' terminal.txt || fail "colour although NO_COLOR is set"
else
    echo "skipped the terminal: script is missing"
fi

# Errors: the user's file, in the last line, whatever is shown.
echo "nothing of the kind" >text.off
for option in -q -v ''; do
    # shellcheck disable=SC2086
    expect_exit 3 "$varimap" map text.off b.off -o bad $option
    tail -n 1 log | grep -q "$PWD/text.off" || fail "the last line does not name the file: $(tail -n 1 log)"
done

# With --json also as an object, whoever said it.
fails_in_json() {  # CODE TEXT COMMAND...
    expect_exit "$1" "${@:3}" --json
    jq -es --argjson code "$1" --arg text "$2" 'length == 1 and (.[0] | .code == $code and (.error | contains($text)))' out.txt >/dev/null ||
        fail "--json of what fails: $(<out.txt)"
    grep -Fq -- "$2" log || fail "a failure with --json is not on stderr: $(<log)"
}
odd=$'say "a\\b"\xff.off'
fails_in_json 6 'say "a\b"' "$varimap" map "$odd" b.off -o bad
fails_in_json 2 'eigen.cuont' "$varimap" map a.off b.off -o bad --set eigen.cuont=3
fails_in_json 2 '--no-such-option' "$varimap" map a.off b.off -o bad --no-such-option
fails_in_json 3 "$PWD/text.off" "$varimap" map text.off b.off -o bad
fails_in_json 6 'nowhere: no such folder' "$varimap" report nowhere
fails_in_json 2 'takes one folder' "$varimap" report
fails_in_json 6 'nothing.csv' "$varimap" verify a.off b.off nothing.csv
fails_in_json 2 'is required' "$varimap" evaluate a.off
expect_exit 6 "$varimap" map a.off absent.off -o bad
[[ ! -s out.txt ]] || fail "a failure without --json says something on stdout"

# bench names the reason, and takes two files of landmarks.
mkdir list
seq 0 2 >a.list.txt
cp a.list.txt b.list.txt
cat >list/pairs.csv <<LIST
group,source,target,landmarks,source_points,target_points,index_base
good,a.off,b.off,a.list.txt;b.list.txt,a.list.txt,a.list.txt,0
bad,text.off,b.off,,,,
LIST
"$varimap" bench list/pairs.csv -o benched "${coarse[@]}" >out.txt 2>log && fail "bench succeeded with a bad pair"
grep -q '^bad .*failed (3): .*error: .*text.off' out.txt || fail "bench does not tell the reason: $(grep ^bad out.txt)"
grep -q '^good .*0.0' out.txt || fail "bench does not take two files of landmarks"
jq -e '.provenance.landmarks | length == 2' benched/pairs/good.a--b/quality.json >/dev/null || fail "bench used one file of landmarks"
