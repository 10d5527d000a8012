# What is said of the numbers of quality.json, in the same words by all that tell of a map. Definitions, of
# words_of_quality (script.sh).
def fixed($digits): . * pow(10; $digits) | round / pow(10; $digits);
# Of probabilities: what is not sure must not look as if it were.
def rounded_down($digits): . * pow(10; $digits) + 1e-9 | floor / pow(10; $digits);
def probability_in_words(numeral): if . < 0.01 then "below 0.01" elif . >= 0.995 then "above 0.99" else numeral end;
def counted(one; several): "\(.) \(if . == 1 then one else several end)";

# Of a direction. What a surface's own holes lack no map reaches.
def reached: .when_closed // .;
def reversed_percent: .verification.reversed_area_percent // .flipped_area_percent;

# Of quality.json. Whoever continues another candidate than the first has looked at what exploration warns of.
def shown_warnings: (.exploration.continued // 1) as $continued | .warnings[]?
    | select($continued == 1 or (.stage | startswith("explore ") | not));
