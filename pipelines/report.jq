# What quality.json says, for people: a verdict, every check with its grade, warnings, their stages (alarms), both as
# what to look at before the map is used (look), notes, times.
# Definitions, of words_of_quality (script.sh): jq [--arg changed TEXT] "$(words_of_quality)report" quality.json
# TEXT: what has changed since the map was made, to be looked at as well.
def grade($good; $usable): if . <= $good then "good" elif . <= $usable then "usable" else "look here" end;
# badness: 1 at the end of what is usable.
def check($what; $value; $number; $good; $usable):
    {what: $what, value: $value, grade: ($number | grade($good; $usable)), badness: ($number / $usable)};

def direction($words):
    reversed_percent as $reversed | reached as $reached
    | check("area reversed, \($words)"; "\($reversed | fixed(2)) %"; $reversed; 0.1; 1),
      check("area covered, \($words)\(if .when_closed then ", holes closed" else "" end)"; "\(100 * $reached.coverage | fixed(1)) %"; 1 - $reached.coverage; 0.03; 0.1),
      # A limb that the other surface has not, or that the map misses.
      (($reached.uncovered // [])[0] // empty | check("largest part not reached, \($words)";
          "\(.area_percent | fixed(1)) %, vertex \(.vertex)"; .area_percent; 0.5; 2)),
      (.conformal_distortion | check("change of angles, \($words)"; "\(.p50 | fixed(2)) (median), \(.p95 | fixed(2)) (95 %)";
          .p95; 3; 6)),
      # Of a tube, such as a shaft, whose ends the map turns against each other.
      (.twist // empty | check("twist, \($words)"; "\(.degrees | round) degrees, around vertex \(.vertex)"; .degrees; 90; 120)),
      (.verification.degree // empty | check("how often covered, \($words)"; "\(fixed(2))"; fabs - 1 | fabs; 0.02; 0.1));

def report:
    [(.source_to_target // empty | direction("source to target")), (.target_to_source // empty | direction("target to source")),
        (.part.strain // empty | check("part placed"; "strained by \(fixed(3))"; .; 0.12; 0.12)),
        (.round_trip // empty | check("there and back, mean"; "\(.mean | fixed(4)) sqrt(area)"; .mean; 0.01; 0.03),
            # Where the directions disagree on a limb, one of them has lost it. Right maps have .03 at most where shapes are alike.
            (.p95 // empty | check("there and back, 95 %"; "\(fixed(4)) sqrt(area)"; .; 0.03; 0.1))),
        (.exploration // empty | check("choice among mirrored and turned maps";
            if .continued > 1 then "candidate \(.continued), as asked\(if .probability then " (the first: \(.probability | probability_in_words(rounded_down(2))))" else "" end)" elif .confident then "sure" else "not sure" end;
            # Another than the first is what the user wants, though the program may not.
            if .continued > 1 then (if (.probability // 0) >= 0.5 then 1.5 else 0 end)
            elif .confident then 0 else 4 - 2 * (.probability // 0) end; 1; 2))] as $checks
    | [shown_warnings] as $warnings | ($warnings | map(.stage) | unique) as $alarms
    | (($alarms | map("what \(.) warns of")) + ($checks | map(select(.grade == "look here").what))
        + [$ARGS.named.changed // empty | select(. != "")]) as $look
    | {verdict: (if $look | length > 0 then "look here"
            elif any($checks[]; .grade == "usable") then "usable" else "good" end),
        warnings: ($warnings | map("\(.stage): \(.message)")), notes: [.notes[]? | "\(.stage): \(.message)"], alarms: $alarms,
        look: $look, checks: $checks,
        command: (.provenance.command // ""), options: (.provenance.options // []), version: (.provenance.version // ""),
        times: [.stages // {} | to_entries[] | select(.value.wall_seconds)
            | {stage: .key, seconds: .value.wall_seconds, megabytes: (.value.peak_megabytes // 0)}]};

# Of a report, as a line.
def verdict_line: "verdict  \({good: "good: nothing speaks against this map; whether it is the right one, the pictures show",
    usable: "usable: some numbers are worse than usual",
    "look here": "look here: before you use this map, see \(.look | join("; "))"}[.verdict])";
