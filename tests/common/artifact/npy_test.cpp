#include "varimap/artifact/npy.h"

#include <gmock/gmock.h>

#include "varimap/core/error.h"

namespace varimap {
namespace {

using ::testing::HasSubstr;

TEST(Npy, HeaderFillsBlocksOf64Bytes) {
    for (const auto& shape : std::vector<std::vector<long long>>{{}, {7}, {123456789, 3}, {1, 2, 3, 4}}) {
        const std::string header = npy_header("<f8", shape);
        EXPECT_EQ(header.size() % 64, 0u);
        EXPECT_EQ(header.back(), '\n');
        EXPECT_TRUE(header.starts_with("\x93NUMPY"));
    }
    EXPECT_THAT(npy_header("<i4", {5, 3}),
                HasSubstr("'descr': '<i4', 'fortran_order': False, 'shape': (5, 3, )"));
    EXPECT_THAT(npy_header("|S3", {}), HasSubstr("'shape': ()"));
    EXPECT_THAT(npy_header("<f8", {2}, true), HasSubstr("'fortran_order': True"));
}

TEST(Npy, ListFollowsItsHeader) {
    const std::string bytes = to_npy("<i4", {2}, std::vector<int>{1, 256});
    EXPECT_EQ(bytes.substr(npy_header("<i4", {2}).size()), std::string("\1\0\0\0\0\1\0\0", 8));
}

TEST(Zip, HoldsFilesAsTheyAreAndTheSumOfEach) {
    const std::string zip = to_zip({{"a.txt", "123456789"}, {"b", ""}});
    EXPECT_TRUE(zip.starts_with(std::string("PK\x03\x04", 4)));
    EXPECT_THAT(zip, HasSubstr("a.txt123456789"));
    // The check value of CRC-32, from lowest to highest byte.
    EXPECT_EQ(zip.substr(14, 4), "\x26\x39\xf4\xcb");
    const std::string end = zip.substr(zip.size() - 22);
    EXPECT_TRUE(end.starts_with(std::string("PK\x05\x06", 4)));
    EXPECT_EQ(end.substr(10, 2), std::string("\2\0", 2));
    EXPECT_EQ(zip, to_zip({{"a.txt", "123456789"}, {"b", ""}}));
}

TEST(Zip, ReadsBackWhatIsStored) {
    const std::string zip = to_zip({{"a.txt", "123456789"}, {"b", ""}});
    EXPECT_EQ(from_zip(zip, "x"), (std::map<std::string, std::string>{{"a.txt", "123456789"}, {"b", ""}}));
    std::string damaged = zip;
    damaged[damaged.find("123456789")] = '0';
    EXPECT_THROW(from_zip(damaged, "x"), InputError);
    for (std::size_t size = 0; size < zip.size(); ++size)
        EXPECT_THROW(from_zip(zip.substr(0, size), "x"), InputError);
    EXPECT_THROW(from_zip(to_zip({{"a", "1"}, {"a", "2"}}), "x"), InputError);
}

/// Or a small archive might unpack without end.
TEST(Zip, RefusesFilesOfTheSameBytes) {
    std::vector<std::pair<std::string, std::string>> files{{"0", std::string(10'000, 'x')}};
    for (int i = 1; i < 3; ++i) files.emplace_back(std::to_string(i), "");
    std::string zip = to_zip(files);
    const std::size_t list = zip.find("PK\x01\x02"), sizes = list + 16, place = list + 42;
    const std::string first_sizes = zip.substr(sizes, 12), first_place = zip.substr(place, 4);
    for (std::size_t at = list; at != zip.npos; at = zip.find("PK\x01\x02", at + 1)) {
        zip.replace(at + 16, 12, first_sizes);
        zip.replace(at + 42, 4, first_place);
    }
    EXPECT_THROW(from_zip(zip, "x"), InputError);
}

/// As Python's zipfile writes "a" * 1000, deflated.
TEST(Zip, ReadsWhatIsDeflated) {
    const unsigned char bytes[] = {
        80, 75, 3,   4,   20, 0,   0,   0,  8, 0,  0,   0,  33,  0,   3,   218, 56,  154, 11, 0,
        0,  0,  232, 3,   0,  0,   5,   0,  0, 0,  110, 46, 110, 112, 121, 75,  76,  28,  5,  163,
        96, 20, 12,  119, 0,  0,   80,  75, 1, 2,  20,  3,  20,  0,   0,   0,   8,   0,   0,  0,
        33, 0,  3,   218, 56, 154, 11,  0,  0, 0,  232, 3,  0,   0,   5,   0,   0,   0,   0,  0,
        0,  0,  0,   0,   0,  0,   128, 1,  0, 0,  0,   0,  110, 46,  110, 112, 121, 80,  75, 5,
        6,  0,  0,   0,   0,  1,   0,   1,  0, 51, 0,   0,  0,   46,  0,   0,   0,   0,   0};
    const auto files = from_zip({reinterpret_cast<const char*>(bytes), sizeof bytes}, "x");
    ASSERT_EQ(files.size(), 1u);
    EXPECT_EQ(files.at("n.npy"), std::string(1000, 'a'));
}

}  // namespace
}  // namespace varimap
