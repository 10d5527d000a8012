#include "varimap/artifact/npy.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
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

std::vector<std::pair<std::string, std::string>> csr_files(long long rows, long long columns,
                                                           const std::vector<double>& data,
                                                           const std::vector<int>& indices,
                                                           const std::vector<int>& indptr) {
    static_assert(sizeof(int) == 4);
    const auto entries = static_cast<long long>(data.size());
    return {{"format.npy", npy_header("|S3", {}) + "csr"},
            {"shape.npy", to_npy("<i8", {2}, std::vector<std::int64_t>{rows, columns})},
            {"data.npy", to_npy("<f8", {entries}, data)},
            {"indices.npy", to_npy("<i4", {entries}, indices)},
            {"indptr.npy", to_npy("<i4", {rows + 1}, indptr)}};
}

bool is_zip(std::string_view bytes) {
    return bytes.starts_with("PK\x03\x04");
}

namespace {

class ZipReader {
  public:
    ZipReader(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path) {}

    std::map<std::string, std::string> files() const {
        constexpr std::size_t end_size = 22;
        const std::size_t end = bytes_.rfind("PK\x05\x06");
        if (end == bytes_.npos || bytes_.size() - end < end_size) fail("its list of files is missing");
        std::map<std::string, std::string> found;
        std::size_t packed = 0;
        std::size_t at = number(end + 16, 4);
        for (std::size_t count = number(end + 10, 2); count > 0; --count) {
            const std::size_t name = number(at + 28, 2), extra = number(at + 30, 2),
                              comment = number(at + 32, 2);
            const auto [file, is_new] = found.try_emplace(std::string(part(at + 46, name)));
            if (!is_new) fail("two files in it have the same name");
            if ((packed += number(at + 20, 4)) > bytes_.size()) fail("files in it overlap");
            file->second = content(at);
            at += 46 + name + extra + comment;
        }
        return found;
    }

  private:
    /// Of the file whose entry in the list starts there.
    std::string content(std::size_t entry) const {
        const std::size_t method = number(entry + 10, 2), packed = number(entry + 20, 4);
        const std::size_t size = number(entry + 24, 4), start = number(entry + 42, 4);
        const std::size_t behind_name = start + 30 + number(start + 26, 2) + number(start + 28, 2);
        const std::string_view data = part(behind_name, packed);
        std::string bytes = method == 8 ? inflated(data, size) : std::string(data);
        if ((method != 0 && method != 8) || bytes.size() != size)
            fail("a file in it is packed in an unknown way");
        if (crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()) != number(entry + 16, 4))
            fail("a file in it is damaged");
        return bytes;
    }

    std::string inflated(std::string_view data, std::size_t size) const {
        constexpr std::size_t most = 1040;  // that one byte can become
        if (size / most > data.size()) fail("a file in it is damaged");
        std::string bytes(std::max<std::size_t>(size, 1), '\0');
        z_stream stream{};
        if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) throw Error(ExitCode::internal, "cannot inflate");
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
        stream.avail_in = uInt(data.size());
        stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
        stream.avail_out = uInt(bytes.size());
        const int status = inflate(&stream, Z_FINISH);
        inflateEnd(&stream);
        if (status != Z_STREAM_END) fail("a file in it is damaged");
        bytes.resize(stream.total_out);
        return bytes;
    }

    std::string_view part(std::size_t at, std::size_t size) const {
        if (at > bytes_.size() || bytes_.size() - at < size) fail("it ends too early");
        return bytes_.substr(at, size);
    }
    std::size_t number(std::size_t at, std::size_t size) const {
        std::size_t value = 0;
        const std::string_view bytes = part(at, size);
        for (std::size_t i = 0; i < size; ++i)
            value |= std::size_t(static_cast<unsigned char>(bytes[i])) << (8 * i);
        return value;
    }
    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(path_ + ": not an archive that can be read: " + what);
    }

    std::string_view bytes_;
    const std::string& path_;
};

}  // namespace

std::map<std::string, std::string> from_zip(std::string_view bytes, const std::string& path) {
    return ZipReader(bytes, path).files();
}

}  // namespace varimap
