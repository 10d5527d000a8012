# What jobs cost by the model (cost_model.csv: seconds of a core and megabytes of each stage, linear in thousands of
# vertices; of a pair, those of both surfaces divided by two).
#   awk -v what=pending|stages|sum -v full= -v explore= -v cores= -f cost.awk cost_model.csv surfaces.tsv DONE pairs.tsv
# pending: lines of KIND NAME SECONDS MEGABYTES ROW (the byte, from 1, at which its row in surfaces.tsv or pairs.tsv begins); stages: of KIND NAME STAGE SECONDS MEGABYTES; sum: all of it in words.
# Of pairs with landmarks, explore_if_needed is what exploration costs in the mean, with the sketches for it.
# locate: of parts alone, what they cost more, their sketches and the cut among it.
# DONE: lines of KIND and NAME, tab-separated, which cost nothing any more.
function add(kind, name, size, looks, part, row,    s, solves, further, seconds, megabytes, all, peak) {
    for (s = 1; s <= stages; s++) {
        if (of[s] != kind) continue
        if (stage[s] ~ /^explore/ && stage[s] != looks || stage[s] == "sketches" && looks != "explore") continue
        if (stage[s] == "locate" && !part) continue
        # Solved for on every vertex instead of 6000: 24 MB and 2.5 seconds more for a thousand vertices. On up to
        # 24,000 of them where walls are thin, which is not known in advance: room for it, but no time.
        solves = stage[s] == "diffuse" || stage[s] == "refine"
        further = full ? size : size > 24 ? 18 : size > 6 ? size - 6 : 0
        seconds = seconds0[s] + seconds1[s] * size + (full && solves ? 2.5 * size : 0)
        megabytes = megabytes0[s] + megabytes1[s] * size + (solves ? 24 * further : 0)
        if (what == "stages") printf "%s %s %s %.1f %.0f\n", kind, name, (stage[s] ~ /^explore/ ? "explore" : stage[s]), seconds, megabytes
        all += seconds
        if (megabytes > peak) peak = megabytes
    }
    if (what == "pending") printf "%s %s %.1f %.0f %d\n", kind, name, all, peak, row
    total += all
    if (peak > highest) highest = peak
    count[kind]++
}
function row_after(    row) {
    if (FNR == 1) bytes = 0
    row = bytes + 1
    bytes += length($0) + 1
    return row
}
BEGIN { FS = "\t"; count["surface"] = count["pair"] = 0 }
FILENAME ~ /\/cost_model.csv$/ {
    if (FNR == 1) next
    split($0, c, ",")
    stage[++stages] = c[1]; of[stages] = c[2]
    seconds0[stages] = c[3]; seconds1[stages] = c[4]; megabytes0[stages] = c[5]; megabytes1[stages] = c[6]
    next
}
FILENAME ~ /\/surfaces.tsv$/ { size[$1] = $3 / 1000; order[++surfaces] = $1; row_of[$1] = row_after(); next }
FILENAME ~ /\/done$/ { done[$1, $2]; next }
{ row = row_after() }
("pair", $1) in done { next }
{
    part = $6 != "-"
    looks = explore || $4 == "-" && !part ? "explore" : $4 == "-" ? "" : "explore_if_needed"
    needed[$2]; needed[$3]
    if (looks == "explore") { sketched[$2]; sketched[$3] }
    add("pair", $1, (size[$2] + size[$3]) / 2, looks, part, row)
}
END {
    for (i = 1; i <= surfaces; i++)
        if (order[i] in needed && !(("surface", order[i]) in done)) add("surface", order[i], size[order[i]], order[i] in sketched ? "explore" : "", 0, row_of[order[i]])
    if (what == "sum")
        printf "about %.2f core-hours for %d surfaces and %d pairs, %.0f MB for one at a time; %.2f hours on %d cores\n",
            total / 3600, count["surface"], count["pair"], highest, total / 3600 / cores, cores
}
