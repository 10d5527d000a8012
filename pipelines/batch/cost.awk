# What is still to be done, and what it costs by the model (cost_model.csv: seconds of a core and megabytes of each stage,
# linear in thousands of vertices; of a pair, those of both surfaces divided by two).
#   awk -v what=pending|sum -v full= -v explore= -v cores= -f cost.awk cost_model.csv surfaces.tsv DONE pairs.tsv
# pending: lines of KIND NAME SECONDS MEGABYTES. sum: what all of it costs, in words.
# DONE: lines of KIND and NAME, tab-separated.
function cost(kind, size, looked_for,    s, seconds, megabytes, m) {
    for (s = 1; s <= stages; s++) {
        if (of[s] != kind || (!looked_for && (stage[s] == "explore" || stage[s] == "sketches"))) continue
        m = megabytes0[s] + megabytes1[s] * size
        # On every vertex instead of 6000 these stages grow: 24 MB and 2.5 seconds for a thousand vertices.
        if (full && (stage[s] == "diffuse" || stage[s] == "refine")) { m += 24 * size; seconds += 2.5 * size }
        seconds += seconds0[s] + seconds1[s] * size
        if (m > megabytes) megabytes = m
    }
    seconds_all[kind] += seconds; if (megabytes > peak[kind]) peak[kind] = megabytes
    count[kind]++
    return sprintf("%.1f %.0f", seconds, megabytes)
}
FILENAME != file { file = FILENAME; part++ }
part == 1 { if (FNR > 1) { split($0, c, ","); s = ++stages; stage[s] = c[1]; of[s] = c[2]
    seconds0[s] = c[3]; seconds1[s] = c[4]; megabytes0[s] = c[5]; megabytes1[s] = c[6] } next }
BEGIN { FS = "\t" }
part == 2 { size[$1] = $3 / 1000; order[++surfaces] = $1; next }
FILENAME ~ /\/done$/ { done[$1, $2]; next }
("pair", $1) in done { next }
{
    looked_for = $4 == "-" || explore
    needed[$2]; needed[$3]
    if (looked_for) { sketched[$2]; sketched[$3] }
    text = cost("pair", (size[$2] + size[$3]) / 2, looked_for)
    if (what == "pending") print "pair", $1, text
}
END {
    for (i = 1; i <= surfaces; i++) if (order[i] in needed && !(("surface", order[i]) in done)) {
        text = cost("surface", size[order[i]], order[i] in sketched)
        if (what == "pending") print "surface", order[i], text
    }
    if (what != "sum") exit
    hours = (seconds_all["surface"] + seconds_all["pair"]) / 3600
    printf "about %.2f core-hours for %d surfaces and %d pairs, %.0f MB for one at a time; %.2f hours on %d cores\n", hours,
        count["surface"], count["pair"], (peak["pair"] > peak["surface"] ? peak["pair"] : peak["surface"]), hours / cores, cores
}
