# A page of Markdown as plain text, for a terminal.
# The text in lines of at most `room` columns; returns how many.
function broken(text, room, lines,    words, n, i, k) {
    n = split(text, words, " ")
    lines[k = 1] = words[1]
    for (i = 2; i <= n; i++)
        if (length(lines[k]) + 1 + length(words[i]) > room) lines[++k] = words[i]
        else lines[k] = lines[k] " " words[i]
    return k
}

function wrap(text, first, rest,    lines, n, i) {
    n = broken(text, most - length(rest), lines)
    for (i = 1; i <= n; i++) print (i == 1 ? first : rest) lines[i]
}

function unstarred(text) {
    gsub(/\*/, "", text)
    return text
}

function plain(text,    link) {
    gsub(/`|\*\*/, "", text)
    while (match(text, /(^|[ (])\*[A-Za-z][^*]*\*/))
        text = substr(text, 1, RSTART - 1) unstarred(substr(text, RSTART, RLENGTH)) substr(text, RSTART + RLENGTH)
    while (match(text, /!?\[[^]]*\]\([^)]*\)/)) {
        link = substr(text, RSTART, RLENGTH)
        sub(/^!?\[/, "", link); sub(/\]\(.*/, "", link)
        text = substr(text, 1, RSTART - 1) link substr(text, RSTART + RLENGTH)
    }
    return text
}

# Columns side by side where they fit, the first of them wrapped where the others are narrow; else the first of each row
# with the others below it. Pictures have no place here, nor has their heading.
function show_table(    r, c, others) {
    if (pictures) rows = 0
    for (c = 2; c <= columns; c++) others += width[c] + 2
    if (4 + width[1] + others <= most) for (r = 1; r <= rows; r++) show_row(r, width[1])
    else if (columns > 2 && others <= most / 2) for (r = 1; r <= rows; r++) show_row(r, most - 4 - others)
    else for (r = 2; r <= rows; r++) show_below(r)
    for (c in width) delete width[c]
    rows = pictures = 0
}

function show_row(r, first,    c, line, lines, n, i) {
    n = broken(cell[r, 1], first, lines)
    for (i = 1; i < n; i++) print "    " lines[i]
    line = sprintf("    %-" first "s", lines[n])
    for (c = 2; c <= columns; c++) line = line sprintf("  %-" width[c] "s", cell[r, c])
    sub(/ +$/, "", line)
    print line
}

function show_below(r,    c) {
    wrap(cell[r, 1], "    ", "    ")
    for (c = 2; c <= columns; c++)
        if (cell[r, c] != "") wrap((columns > 2 ? cell[1, c] ": " : "") cell[r, c], "        ", "        ")
}

function show_paragraph() {
    if (paragraph != "") wrap(plain(paragraph), indent, hanging)
    paragraph = ""
}

function flush() {
    show_paragraph()
    if (rows) show_table()
}

BEGIN { most = 112 }  # columns; code stays as wide as it is
picture && !/^$/ && !/^\*[^*].*\*$/ { picture = 0 }
/^ *```/ { flush(); code = !code; next }
code { print "    " $0; next }
/^\|[-:| ]+\|$/ { next }
/^\|.*!\[.*\|$/ { pictures = 1; next }
/^\|.*\|$/ {
    show_paragraph()
    row = plain($0); gsub(/\\\|/, "\001", row)
    columns = split(substr(row, 2, length(row) - 2), cells, "|")
    rows++
    for (c = 1; c <= columns; c++) {
        gsub(/^ +| +$/, "", cells[c]); gsub(/\001/, "|", cells[c])
        cell[rows, c] = cells[c]
        if (length(cells[c]) > width[c]) width[c] = length(cells[c])
    }
    next
}
/^#/ { flush(); sub(/^#+ */, ""); print toupper(plain($0)); next }
/^!\[/ { flush(); picture = 1; next }
/^\*[^*].*\*$/ && picture { next }  # its caption
/^$/ { flush(); if (!picture) print; next }
/^ *([-*]|[0-9]+\.) / {
    flush()
    match($0, /^ *([-*]|[0-9]+\.) /)
    indent = substr($0, 1, RLENGTH)
    hanging = sprintf("%" RLENGTH "s", "")
    paragraph = substr($0, RLENGTH + 1)
    next
}
{
    if (paragraph == "") indent = hanging = ""
    paragraph = paragraph (paragraph == "" ? "" : " ") $0
}
END { flush() }
