#include "varimap/core/lower_case.h"

#include <gtest/gtest.h>

namespace varimap {
namespace {

TEST(LowerCase, ChangesAsciiCapitalsAlone) {
    EXPECT_EQ(lower_case("AZaz @[09_"), "azaz @[09_");
    EXPECT_EQ(lower_case("\xc3\x84\xc4\xb0"), "\xc3\x84\xc4\xb0");  // capitals beyond ASCII, in UTF-8
}

}  // namespace
}  // namespace varimap
