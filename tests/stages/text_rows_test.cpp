#include "stages/transfer/text_rows.h"

#include <gmock/gmock.h>

#include "varimap/core/error.h"

namespace varimap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Words = std::vector<std::string>;

std::vector<Words> rows(const std::string& text, const std::string& path = "a.csv",
                        Content content = Content::words) {
    std::vector<Words> found;
    for (const TextRow& row : split_rows(text, path, content).rows) found.push_back(row.words);
    return found;
}

std::string refusal(const std::string& text) {
    try {
        rows(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "none";
}

TEST(TextRows, CommentsBeginLinesAndStandBehindNumbers) {
    EXPECT_THAT(rows("# of a scan\nseg#1\n  # more\nseg #2\n"), ElementsAre(Words{"seg#1"}, Words{"seg #2"}));
    EXPECT_THAT(rows("# x y\n1 2 # a peak\n#\n3 4\n", "a.txt", Content::numbers),
                ElementsAre(Words{"1", "2"}, Words{"3", "4"}));
    EXPECT_THAT(rows("nose #1,0,0,1\n", "a.csv", Content::numbers),
                ElementsAre(Words{"nose #1", "0", "0", "1"}));
}

TEST(TextRows, RefusesFilesThatAreNoText) {
    EXPECT_THAT(refusal(std::string("PK\3\4a,b\n1,2\n") + '\0'), HasSubstr("is no text"));
}

TEST(TextRows, WordsOfOneColumnMayBeLeftEmpty) {
    EXPECT_THAT(rows("part\na\n\nb\n\n\n"), ElementsAre(Words{"part"}, Words{"a"}, Words{""}, Words{"b"}));
    EXPECT_THAT(rows("\nname,part\n\n1,a\n"), ElementsAre(Words{"name", "part"}, Words{"1", "a"}));
    EXPECT_THAT(rows("a\n\nb\n", "a.txt"), ElementsAre(Words{"a"}, Words{"b"}));
    EXPECT_THAT(rows("1\n\n2\n", "a.csv", Content::numbers), ElementsAre(Words{"1"}, Words{"2"}));
}

TEST(TextRows, AnIndexMayBeAFloatThatIsExact) {
    const auto index = [](std::string_view word) {
        long long found = -1;
        return to_index(word, found) ? found : -1;
    };
    EXPECT_EQ(index("12"), 12);
    EXPECT_EQ(index("0.000000000000000000e+00"), 0);
    EXPECT_EQ(index("4.711e+03"), 4711);
    for (const char* word : {"0.5", "4.7115e+03", "1e300", "9007199254740992.0", "nan", "inf", "arm", ""})
        EXPECT_EQ(index(word), -1) << word;
}

TEST(TextRows, TheFirstLineTellsTheSeparator) {
    EXPECT_THAT(rows("a, b ,\n1,,3\r\n"), ElementsAre(Words{"a", "b", ""}, Words{"1", "", "3"}));
    EXPECT_THAT(rows("a;b c\n1;2,5\n"), ElementsAre(Words{"a", "b c"}, Words{"1", "2,5"}));
    EXPECT_THAT(rows("\theat\n0\t.5\n"), ElementsAre(Words{"", "heat"}, Words{"0", ".5"}));
    EXPECT_THAT(rows(" a  b\t\nc d\n", "a.txt"), ElementsAre(Words{"a", "b"}, Words{"c", "d"}));
    EXPECT_THAT(rows("\"a;b\",c\n"), ElementsAre(Words{"a;b", "c"}));
}

TEST(TextRows, BlanksBelongToTheWordsOfACsvAlone) {
    const std::string text = "left arm\nhead\n";
    EXPECT_THAT(rows(text), ElementsAre(Words{"left arm"}, Words{"head"}));
    EXPECT_THAT(rows(text, "a.txt"), ElementsAre(Words{"left", "arm"}, Words{"head"}));
    EXPECT_THAT(rows("0 .5 .8\n", "a.csv", Content::numbers), ElementsAre(Words{"0", ".5", ".8"}));
}

TEST(TextRows, QuotesAreThoseOfRfc4180) {
    EXPECT_THAT(rows("\"arm, left\",\"the \"\"big\"\" one\" ,\"\"\n"),
                ElementsAre(Words{"arm, left", "the \"big\" one", ""}));
    EXPECT_THAT(rows("head\n\"arm, left\"\n\"#1\"\n"),
                ElementsAre(Words{"head"}, Words{"arm, left"}, Words{"#1"}));
    EXPECT_THAT(rows("\"left arm\" 3\n", "a.txt"), ElementsAre(Words{"left arm", "3"}));
    EXPECT_THAT(refusal("a\n\"b\n"), HasSubstr("a.csv:2: a quote is not closed"));
    EXPECT_THAT(refusal("\"a\"b\n"), HasSubstr("a.csv:1: text stands behind a quote"));
}

TEST(TextRows, ALineThatIsJoinedIsSplitIntoTheSameWords) {
    for (const Words& words : {Words{"arm, left", "b;c", "", "d\te"}, Words{"#1", "say \"a\"", " b "},
                               Words{""}, Words{"left arm"}}) {
        for (const char separator : {',', ';', '\t', ' '}) {
            // Behind a line that tells the separator.
            const std::string first = join({"x", "y"}, separator) + "\n";
            const auto found = rows(first + join(words, separator) + "\n", "a.txt");
            ASSERT_EQ(found.size(), 2u) << separator << words[0];
            EXPECT_EQ(found[1], words) << separator;
        }
    }
    EXPECT_EQ(join({"left arm", "", "seg#1"}, ','), "left arm,,seg#1");
}

}  // namespace
}  // namespace varimap
