# What quality.json says, for people: a verdict, every check with its grade, warnings, the stages of those that make one look
# (alarms), both as what to look at before the map is used (look), times.
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

# Of what preprocess recorded: a few faces, edges or vertices were repaired, or a few components joined, and nothing changed the
# surface's form but what was asked for: holes are never filled without.
def little_repaired:
    (.input_faces // 0) as $faces
    | def at_most($share): (. // 0) <= ([10, $share * $faces] | max);
    ([.not_finite_faces, .degenerate_faces, .duplicate_faces, .cut_edges, .closed_slits] | add) as $elements
    | any($elements, .split_vertices, .turned_faces, .bridges, .filled_holes, .asked_cuts; . != null and . > 0)
        and ($elements | at_most(.003)) and (.bridges // 0) <= 10
        # Turning faces changes no form; nor does parting what touches in a point, as around the ragged holes of a scan.
        and (.turned_faces | at_most(.01)) and (.split_vertices | at_most(.03))
        and .cut_handles == .asked_cuts and all(.opened_edges, .unfilled_holes; . == null)
        # Specks, as scans have.
        and (.dropped_area_percent // 0) <= .1;

# Of a warning's message: that one surface lacks landmarks of the other. The map is made without these and judged as any other.
def is_of_lacking_landmarks: test(" in both .*; left out are | switched off on one of the surfaces, and left out: ");

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
    | (.stages // {}) as $stages
    # Every textured mesh is welded at its seams, and faces without area have no form to lose: nothing to look at.
    | [shown_warnings | select(.message | test("^repaired: [0-9]+ vert(ex|ices) welded; ") | not)] as $warnings
    # What an import leaves out, such as colours, is not about the surface.
    | [$warnings[] | select(.message | test("^faces without area removed: ") | not) | select(.stage | startswith("import ") | not)
            | select(.message | is_of_lacking_landmarks | not)
        | select((.message | startswith("repaired: ")) and ($stages[.stage] // {} | little_repaired) | not)] as $alarms
    | (($alarms | map(.stage) | unique | map("what \(.) warns of")) + ($checks | map(select(.grade == "look here").what))
        + [$ARGS.named.changed // empty | select(. != "")]) as $look
    | {verdict: (if $look | length > 0 then "look here"
            elif any($checks[]; .grade == "usable") then "usable" else "good" end),
        warnings: ($warnings | map("\(.stage): \(.message)")), alarms: ($alarms | map(.stage) | unique), look: $look, checks: $checks,
        command: (.provenance.command // ""), options: (.provenance.options // []), version: (.provenance.version // ""),
        times: [$stages | to_entries[] | select(.value.wall_seconds)
            | {stage: .key, seconds: .value.wall_seconds, megabytes: (.value.peak_megabytes // 0)}]};

# Of a report, as a line.
def verdict_line: "verdict  \({good: "good: nothing speaks against this map; whether it is the right one, the pictures show",
    usable: "usable: some numbers are worse than usual",
    "look here": "look here: before you use this map, see \(.look | join("; "))"}[.verdict])";
