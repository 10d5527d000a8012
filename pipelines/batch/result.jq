# The result of a pair, one line of JSON, of its quality.json and what report.jq says of it.
# A program behind words_of_quality (script.sh):
#   jq -c --arg name .. --arg source .. --arg target .. --arg key .. --arg candidate .. PROGRAM quality.json
def digits($n): if . == null then null else fixed($n) end;
# What exploration says is about the first candidate.
. as $q | report as $r | (if $q.exploration.continued == 1 then $q.exploration else null end) as $first | [$q.source_to_target, $q.target_to_source | select(. != null)] as $both
| {name: $name, source: $source, target: $target, key: $key, status: "done", code: 0, verdict: $r.verdict,
    badness: ([$r.checks[].badness, ($r.alarms | if length > 0 then 1.01 else 0 end)] | max | digits(4)),
    reversed_percent: ([$both[] | reversed_percent] | max | digits(3)),
    coverage_percent: ([$both[] | reached.coverage] | min * 100 | digits(2)),
    conformal_p95: ([$both[].conformal_distortion.p95] | max | digits(3)),
    round_trip: ($q.round_trip.mean | digits(5)),
    landmarks_off: (if $q.landmarks | length > 0 then $q.landmarks | max | digits(5) else null end),
    strain: ($q.part.strain | digits(4)),
    probability: ($first.probability | if . == null then null else rounded_down(3) end), sure: $first.confident, sure_when_found: $q.exploration.confident_when_found,
    candidate: $candidate,
    landmarks_left_out: ([$q.stages[].landmarks_left_out? // 0] | max), warnings: $r.warnings, notes: $r.notes, message: null}
