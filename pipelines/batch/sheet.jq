# The contact sheet: a card for each pair, the worst first, a thousand at most.
# A program behind words_of_quality (script.sh): jq -r -n PROGRAM results.jsonl
def rank: if .status == "done" then [1, -.badness, .name] elif .status == "failed" then [0, 0, .name] else [2, 0, .name] end;
def shown: if .sure_when_found then "picture.png" else "candidates.png" end;
def card: (.name | @uri) as $folder
    | "<article class=\"\(.verdict // .status | gsub(" "; "-") | @html)\"><h2><a href=\"pairs/\($folder)/\">\(.name | @html)</a></h2>"
    + (if .status == "done" then
        "<a href=\"pairs/\($folder)/picture.png\"><img loading=\"lazy\" alt=\"the map, from both sides\" src=\"pairs/\($folder)/picture.png\"></a>"
        + "<p><b>\(.verdict | @html)</b> · reversed \(.reversed_percent) % · covered \(.coverage_percent) % · angles \(.conformal_p95) · there and back \(.round_trip)"
        + (if .landmarks_off then " · landmarks off \(.landmarks_off)" else "" end)
        + (if .probability then " · \(if .sure then "sure" else "<a href=\"pairs/\($folder)/\(shown)\">not sure</a>" end) (\(.probability | probability_in_words(.)))" else "" end) + "</p>"
        + ([.warnings[] | "<p class=\"warning\">\(.[:240] | @html)</p>"] | join(""))
      elif .status == "failed" then "<p class=\"warning\">failed (\(.code)): \(.message | @html)</p>"
      else "<p>waiting</p>" end) + "</article>";
[inputs] as $all
| ($all | group_by(.verdict // .status) | map("\(length) \(.[0].verdict // .[0].status)") | join(", ")) as $counts
| "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>varimap batch: \($all | length) pairs</title>\n<style>
body { font: 15px/1.4 system-ui, sans-serif; margin: 1.5rem; color: #222; background: #f4f4f2 }
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(19rem, 1fr)); gap: 1rem }
article { background: #fff; border-top: .35rem solid #999; padding: .6rem; overflow-wrap: anywhere }
article.good { border-color: #2a7f4f } article.usable { border-color: #c8960c } article.look-here, article.failed { border-color: #b3261e }
h1 { font-size: 1.3rem } h2 { font-size: 1rem; margin: 0 0 .4rem } p { margin: .3rem 0; font-size: .85rem }
img { width: 100%; height: 12rem; object-fit: contain } .warning { color: #8c1d18 } a { color: inherit }
@media (prefers-color-scheme: dark) { body { background: #1b1b1b; color: #ddd } article { background: #262626 } .warning { color: #ff9c94 } }
</style></head><body><h1>\($all | length) pairs: \($counts | @html)</h1>\n<p>The worst come first\(if $all | length > 1000 then ", a thousand of them; status.csv has all" else "" end). A name leads to the pair’s folder, a picture to its full size.</p>\n<main>",
($all | sort_by(rank)[:1000][] | card), "</main></body></html>"
