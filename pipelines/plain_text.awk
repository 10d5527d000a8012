# A page of Markdown as plain text, for a terminal.
function wrap(text, first, rest,    words, n, i, line) {
    n = split(text, words, " ")
    line = first
    for (i = 1; i <= n; i++) {
        if (length(line words[i]) > most && line != first && line != rest) {
            sub(/ +$/, "", line)
            print line
            line = rest
        }
        line = line words[i] " "
    }
    sub(/ +$/, "", line)
    print line
}

function unstarred(text) {
    gsub(/\*/, "", text)
    return text
}

function plain(text,    link) {
    gsub(/`|\*\*/, "", text)
    while (match(text, /(^| )\*[A-Za-z][^*]*\*/))
        text = substr(text, 1, RSTART - 1) unstarred(substr(text, RSTART, RLENGTH)) substr(text, RSTART + RLENGTH)
    while (match(text, /!?\[[^]]*\]\([^)]*\)/)) {
        link = substr(text, RSTART, RLENGTH)
        sub(/^!?\[/, "", link); sub(/\]\(.*/, "", link)
        text = substr(text, 1, RSTART - 1) link substr(text, RSTART + RLENGTH)
    }
    return text
}

# Columns side by side where they fit; else the first of each row with the others below it.
function show_table(    r, c, line, total) {
    for (c = 1; c <= columns; c++) total += width[c] + 2
    for (r = 1; r <= rows; r++) {
        line = "   "
        for (c = 1; c < columns; c++) line = line sprintf(" %-" width[c] "s ", cell[r, c])
        if (total <= most) print line " " cell[r, columns]
        else if (r > 1) {
            wrap(cell[r, 1], "    ", "    ")
            for (c = 2; c <= columns; c++)
                if (cell[r, c] != "") wrap((columns > 2 ? cell[1, c] ": " : "") cell[r, c], "        ", "        ")
        }
    }
    for (c in width) delete width[c]
    rows = 0
}

function show_paragraph() {
    if (paragraph != "") wrap(paragraph, indent, hanging)
    paragraph = ""
}

function flush() {
    show_paragraph()
    if (rows) show_table()
}

BEGIN { most = 112 }
/^```/ { flush(); code = !code; next }
code { print "    " $0; next }
/^\|[-:| ]+\|$/ { next }
/^\|.*!\[.*\|$/ { next }  # pictures side by side
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
/^!\[/ { flush(); picture = 1; next }  # its caption is the paragraph after it
/^\*[^*].*\*$/ && picture { picture = 0; next }
/^$/ { flush(); if (!picture) print; next }
/^ *([-*]|[0-9]+\.) / {
    flush()
    match($0, /^ *([-*]|[0-9]+\.) /)
    indent = substr($0, 1, RLENGTH)
    hanging = sprintf("%" RLENGTH "s", "")
    paragraph = plain(substr($0, RLENGTH + 1))
    next
}
{
    if (paragraph == "") indent = hanging = ""
    paragraph = paragraph (paragraph == "" ? "" : " ") plain($0)
}
END { flush() }
