#include "varimap/core/printable.h"

#include <gtest/gtest.h>

namespace varimap {
namespace {

TEST(Printable, ShowsNothingThatSteersATerminal) {
    EXPECT_EQ(printable("ear 1"), "ear 1");
    EXPECT_EQ(printable("\x1b[31mred\n\x9b"), "?[31mred??");
    EXPECT_EQ(printable(std::string(100, 'x')), std::string(40, 'x'));
}

}  // namespace
}  // namespace varimap
