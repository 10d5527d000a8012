#include "varimap/artifact/npy.h"

#include <fmt/format.h>
#include <zlib.h>

#include <bit>
#include <cstdint>
#include <limits>

#include "varimap/core/error.h"

namespace varimap {

static_assert(std::endian::native == std::endian::little, "arrays are written as they are in memory");

namespace {

/// Numbers of two and four bytes, one after the other.
class Record {
  public:
    Record& two(std::uint32_t number) { return append(number, 2); }
    Record& four(std::uint32_t number) { return append(number, 4); }
    const std::string& bytes() const { return bytes_; }

  private:
    Record& append(std::uint32_t number, int count) {
        for (int i = 0; i < count; ++i) bytes_ += char(number >> (8 * i) & 255);
        return *this;
    }
    std::string bytes_;
};

/// What the headers in front of a file and in the list at the end have in common.
Record entry(const std::string& name, const std::string& bytes) {
    constexpr std::uint32_t version = 20, new_year_1980 = 0x21;
    const auto sum =
        std::uint32_t(crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), uInt(bytes.size())));
    Record record;
    record.two(version).two(0).two(0).two(0).two(new_year_1980).four(sum);
    record.four(std::uint32_t(bytes.size())).four(std::uint32_t(bytes.size()));
    record.two(std::uint32_t(name.size())).two(0);
    return record;
}

}  // namespace

std::string npy_header(const std::string& type, const std::vector<long long>& shape, bool column_major) {
    std::string extents;
    for (const long long extent : shape) extents += fmt::format("{}, ", extent);
    std::string text = fmt::format("{{'descr': '{}', 'fortran_order': {}, 'shape': ({}), }}", type,
                                   column_major ? "True" : "False", extents);
    // Ten bytes go before the text; together with it and a line break they fill a multiple of 64.
    text.append(63 - (10 + text.size()) % 64, ' ');
    text += '\n';
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes += char(text.size() % 256);
    bytes += char(text.size() / 256);
    return bytes + text;
}

std::string to_zip(const std::vector<std::pair<std::string, std::string>>& files) {
    std::string archive, list;
    for (const auto& [name, bytes] : files) {
        if (archive.size() + bytes.size() > std::numeric_limits<std::uint32_t>::max() / 2)
            throw IoError("an .npz of more than 2 GB cannot be written");
        const Record common = entry(name, bytes);
        list += Record().four(0x02014b50).two(20).bytes() + common.bytes();
        list += Record().two(0).two(0).two(0).four(0).four(std::uint32_t(archive.size())).bytes() + name;
        archive += Record().four(0x04034b50).bytes() + common.bytes() + name + bytes;
    }
    const auto count = std::uint32_t(files.size());
    Record end;
    end.four(0x06054b50).two(0).two(0).two(count).two(count);
    end.four(std::uint32_t(list.size())).four(std::uint32_t(archive.size())).two(0);
    return archive + list + end.bytes();
}

}  // namespace varimap
