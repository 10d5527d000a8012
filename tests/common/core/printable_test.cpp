#include "varimap/core/printable.h"

#include <gtest/gtest.h>

namespace varimap {
namespace {

TEST(Printable, ShowsNothingThatSteersATerminal) {
    EXPECT_EQ(printable("plain é 漢 😀"), "plain é 漢 😀");
    EXPECT_EQ(printable("\x1b[2J\a\n\x7f"), "\\x1b[2J\\x07\\x0a\\x7f");
    EXPECT_EQ(printable("\xff\xfe a\xc3"), "\\xff\\xfe a\\xc3");
    EXPECT_EQ(printable("\xc2\x9b"), "\\xc2\\x9b");           // the C1 form of an escape
    EXPECT_EQ(printable("\xe2\x80\xae"), "\\xe2\\x80\\xae");  // turns the direction of the text
    EXPECT_EQ(printable("\xc0\x9b\xed\xa0\x80"), "\\xc0\\x9b\\xed\\xa0\\x80");  // overlong, surrogate
    EXPECT_EQ(printable(""), "");
}

TEST(Printable, ExcerptsAreShort) {
    EXPECT_EQ(excerpt("\x1b[31mred\n"), "\\x1b[31mred\\x0a");
    EXPECT_EQ(excerpt(std::string(100, 'x')), std::string(40, 'x'));
}

}  // namespace
}  // namespace varimap
