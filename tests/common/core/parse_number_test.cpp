#include "varimap/core/parse_number.h"

#include <gtest/gtest.h>

namespace varimap {
namespace {

TEST(ParseNumber, TakesWholeNumbersOfTheType) {
    int whole = 0;
    EXPECT_TRUE(parse_number("-12", whole));
    EXPECT_EQ(whole, -12);
    double real = 0;
    EXPECT_TRUE(parse_number("2.5e-1", real));
    EXPECT_EQ(real, .25);
}

TEST(ParseNumber, RefusesWhatIsMoreOrLessThanANumber) {
    int whole = 0;
    for (const char* text : {"", " 1", "1 ", "+1", "1.5", "1x", "x", "2147483648"})
        EXPECT_FALSE(parse_number(text, whole)) << text;
    unsigned positive = 0;
    EXPECT_FALSE(parse_number("-1", positive));
}

}  // namespace
}  // namespace varimap
