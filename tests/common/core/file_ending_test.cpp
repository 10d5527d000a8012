#include "varimap/core/file_ending.h"

#include <gtest/gtest.h>

namespace varimap {
namespace {

TEST(FileEnding, IsFoundInAnyCaseOfLetters) {
    for (const char* path : {"a.obj", "folder/A.OBJ", "a.b.Obj"})
        EXPECT_TRUE(has_ending(path, ".obj")) << path;
    for (const char* path : {"a.objs", "obj", "a.obj/b", "a.bj", ""})
        EXPECT_FALSE(has_ending(path, ".obj")) << path;
}

}  // namespace
}  // namespace varimap
