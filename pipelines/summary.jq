# What quality.json says of a map that was just made, in lines for people.
# A program behind words_of_quality (script.sh): jq -r --arg out OUT PROGRAM quality.json
def direction(name; d): "  \(name): \(d.verification.reversed_count | counted("triangle"; "triangles")) reversed "
    + "(\(d.verification.reversed_area_percent | fixed(2)) % of the area), \(d.verification.branch_points | counted("branch point"; "branch points")), "
    + "coverage \(d | reached.coverage * 100 | fixed(1)) %\(if d.when_closed then " (holes closed)" else "" end), conformal distortion \(d.conformal_distortion.p50 | fixed(2))"
    + " (median), \(d.conformal_distortion.p95 | fixed(2)) (95 %)";
def uncovered(name; d): d | reached.uncovered | select(length > 0) | "  not reached on the \(name): "
    + (.[:3] | map("\(.area_percent | fixed(1)) % of the area around vertex \(.vertex)") | join(", "))
    + (if length > 3 then " and \(length - 3) more" else "" end);
(.part | select(. != null) | "  the \(.is) lies on \(.area_percent | fixed(1)) % of the \(if .is == "source" then "target" else "source" end); what follows is about that part"),
direction("source to target"; .source_to_target),
direction("target to source"; .target_to_source),
uncovered("target"; .source_to_target), uncovered("source"; .target_to_source),
"  round trip: \(.round_trip.mean | fixed(4)) (mean), \(.round_trip.p95 | fixed(4)) (95 %), in units of sqrt(area)",
(.exploration | select(. != null) | "  explored: candidate \(.continued) of \(.candidates | length), "
    + (if .continued == 1 then "" else "as asked; the first, as it was found, is " end) + "right with a probability "
    + (.probability | probability_in_words("of \(rounded_down(2))"))
    + (if .confident or .continued != 1 then "" else ", not sure: look at \($out)/\(if .confident_when_found then "picture" else "candidates" end).png" + (if .candidates | length > 1 then ", try another by --candidate" else "" end) end)),
(.landmarks | select(length > 0) | "  landmarks: off by at most \(max | fixed(4)), the same units"),
"  stages: \([.stages[].cpu_seconds] | add | fixed(1)) CPU seconds, \([.stages[].peak_megabytes] | max | round) MB at most"
