#include "varimap/artifact/artifact.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "fixtures/temporary_folder.h"
#include "varimap/artifact/temporaries.h"
#include "varimap/core/error.h"

namespace varimap {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Header sample_header() {
    Header header;
    header.kind = "sample";
    header.schema = 3;
    header.stage = "varimap-test";
    header.parameters = {{"length", "0.1"}, {"name", "two words"}, {"empty", ""}};
    header.inputs = {{"mesh", "file", content_hash("mesh")}, {"basis", "basis", content_hash("basis")}};
    return header;
}

/// Written without the library's own atomic writer, which tests must not depend on here.
void overwrite(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

class ArtifactFile : public testing::Test {
  protected:
    void SetUp() override { write_payload(path, sample_header(), payload); }
    TemporaryFolder folder;
    std::string path = folder / "a.sample";
    std::string payload = std::string("pay\0load\n", 9);
};

TEST_F(ArtifactFile, ReadsBackWhatWasWritten) {
    const auto [header, read] = read_payload(path, "sample", 3, "varimap-test");
    EXPECT_EQ(read, payload);
    EXPECT_EQ(header.kind, "sample");
    EXPECT_EQ(header.schema, 3);
    EXPECT_EQ(header.stage, "varimap-test");
    EXPECT_EQ(header.version, version());
    EXPECT_EQ(header.parameters, sample_header().parameters);
    ASSERT_EQ(header.inputs.size(), 2u);
    EXPECT_EQ(header.input_hash("basis"), content_hash("basis"));
    EXPECT_EQ(header.input_hash("nobody"), "");
    EXPECT_EQ(header.payload_bytes, payload.size());
    EXPECT_EQ(header.payload_hash, content_hash(payload));
    EXPECT_EQ(header_text(header), header_text(read_header(path)));
}

TEST_F(ArtifactFile, IsReadableAsTextUpToThePayload) {
    EXPECT_TRUE(
        read_file(path).starts_with("varimap artifact 1\nkind sample\nschema 3\nstage varimap-test\n"));
}

TEST_F(ArtifactFile, EqualContentGivesEqualBytes) {
    write_payload(folder / "b.sample", sample_header(), payload);
    EXPECT_EQ(read_file(path), read_file(folder / "b.sample"));
}

TEST_F(ArtifactFile, KeepsEmptyPayloads) {
    write_payload(path, sample_header(), "");
    EXPECT_EQ(read_checked(path).second, "");
}

TEST_F(ArtifactFile, RefusesEverySingleAlteredByte) {
    const std::string good = read_file(path);
    for (std::size_t i = 0; i < good.size(); ++i)
        for (const int flip : {1, 0x20}) {
            std::string bad = good;
            bad[i] = char(bad[i] ^ flip);
            overwrite(path, bad);
            EXPECT_THROW(read_checked(path), ArtifactError) << "byte " << i << " flip " << flip;
        }
}

TEST_F(ArtifactFile, RefusesEveryTruncationAndExtension) {
    const std::string good = read_file(path);
    for (std::size_t size = 0; size < good.size(); ++size) {
        overwrite(path, good.substr(0, size));
        EXPECT_THROW(read_checked(path), ArtifactError) << "first " << size << " bytes";
    }
    for (const std::string& tail : {std::string("\n"), std::string(1, '\0'), good}) {
        overwrite(path, good + tail);
        EXPECT_THROW(read_checked(path), ArtifactError);
    }
    overwrite(path, good);
    EXPECT_NO_THROW(read_checked(path));
}

TEST_F(ArtifactFile, RefusesAHeaderWhoseLinesWereChanged) {
    const std::string good = read_file(path);
    const auto replaced = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        return text.replace(text.find(from), from.size(), to);
    };
    for (const auto& bad : {replaced("length 0.1", "length 0.2"), replaced("schema 3", "schema 03"),
                            replaced("parameter length 0.1\n", ""), replaced("input mesh", "input cow"),
                            replaced("kind sample\n", "kind sample\nkind sample\n"),
                            replaced("payload 9", "payload 18446744073709551615")}) {
        overwrite(path, bad);
        EXPECT_THROW(read_header(path), ArtifactError);
        EXPECT_THROW(read_checked(path), ArtifactError);
    }
}

TEST_F(ArtifactFile, RefusesARecordedLengthThatTheFileDoesNotHaveBeforeAllocatingIt) {
    Header header = sample_header();
    header.version = version();
    header.payload_bytes = std::uint64_t(-1);
    header.payload_hash = content_hash("");
    overwrite(path, header_text(header) + "short");
    EXPECT_THAT([&] { read_checked(path); }, ThrowsMessage<ArtifactError>(HasSubstr("length")));
}

TEST_F(ArtifactFile, RefusesForeignFiles) {
    for (const std::string& foreign :
         {std::string(), std::string("OFF\n3 1 0\n"), std::string(100, '\0'), std::string(1 << 17, 'x'),
          std::string("varimap artifact 2\n"), "varimap artifact 1\n" + std::string(1 << 17, 'x')}) {
        overwrite(path, foreign);
        EXPECT_THROW(read_header(path), ArtifactError);
        EXPECT_THROW(read_checked(path), ArtifactError);
    }
}

TEST_F(ArtifactFile, NamesTheStageToRerunForAnotherKindOrSchema) {
    EXPECT_THAT([&] { read_payload(path, "surface", 3, "varimap-preprocess"); },
                ThrowsMessage<ArtifactError>(HasSubstr("varimap-preprocess")));
    EXPECT_THAT([&] { read_payload(path, "sample", 4, "varimap-test"); },
                ThrowsMessage<ArtifactError>(HasSubstr("rerun varimap-test")));
}

TEST_F(ArtifactFile, MissingFilesAndFoldersAreInputOutputErrors) {
    EXPECT_THROW(read_checked(folder / "missing"), IoError);
    EXPECT_THROW(read_header(folder / ""), IoError);
    EXPECT_THROW(read_file(folder / ""), IoError);
    EXPECT_THROW(file_hash(folder / "missing"), IoError);
}

TEST_F(ArtifactFile, RefusesToWriteHeadersThatWouldNotReadBack) {
    Header header = sample_header();
    header.parameters.emplace_back("text", "two\nlines");
    EXPECT_THROW(write_payload(path, header, "x"), std::logic_error);
    header = sample_header();
    header.inputs.push_back({"two words", "file", "0"});
    EXPECT_THROW(write_payload(path, header, "x"), std::logic_error);
    header = sample_header();
    header.parameters.emplace_back("text", std::string(1 << 17, 'x'));
    EXPECT_THROW(write_payload(path, header, "x"), std::logic_error);
    EXPECT_EQ(read_checked(path).second, payload);
}

TEST(ContentHash, IsXxh3With128Bits) {
    EXPECT_EQ(content_hash(""), "99aa06d3014798d86001c324468d497f");  // published for the empty input
    EXPECT_NE(content_hash("a"), content_hash("b"));
}

TEST(ContentHash, OfAFileIsThatOfItsBytes) {
    const TemporaryFolder folder;
    const std::string bytes(3'000'000, 'v');
    overwrite(folder / "file", bytes);
    EXPECT_EQ(file_hash(folder / "file"), content_hash(bytes));
    EXPECT_EQ(read_file(folder / "file"), bytes);
}

TEST(AtomicWrite, ReplacesAndLeavesNothingElseBehind) {
    const TemporaryFolder folder;
    write_file_atomically(folder / "file", "old");
    write_file_atomically(folder / "file", "new");
    EXPECT_EQ(read_file(folder / "file"), "new");
    EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicWrite, WorksBesideATemporaryFileLeftByAKilledProcess) {
    const TemporaryFolder folder;
    for (int i = 0; i < 1000; ++i) overwrite(folder / ("file.tmp." + std::to_string(i)), "left over");
    write_file_atomically(folder / "file", "new");
    EXPECT_EQ(read_file(folder / "file"), "new");
    EXPECT_EQ(folder.file_count(), 1001u);
}

TEST(AtomicWrite, WhatKilledWritersLeftIsRemovedAndNothingElse) {
    const TemporaryFolder folder;
    for (const char* name : {"file.tmp.0", "file.tmp.3", "other.tmp.0", "file.tmp.x"})
        overwrite(folder / name, "left over");
    // Of a writer that lives.
    const int held = ::open((folder / "file.tmp.1").c_str(), O_WRONLY | O_CREAT, 0666);
    ASSERT_EQ(::flock(held, LOCK_EX), 0);
    remove_dead_temporaries(folder / "file");
    EXPECT_EQ(folder.file_count(), 3u);
    EXPECT_TRUE(std::filesystem::exists(folder / "file.tmp.1"));
    ::close(held);
}

TEST(AtomicWrite, FailsWhereNothingCanBeWritten) {
    const TemporaryFolder folder;
    EXPECT_THROW(write_file_atomically(folder / "none/file", "x"), IoError);
    std::filesystem::create_directory(folder / "folder");
    EXPECT_THROW(write_file_atomically(folder / "folder", "x"), IoError);
    EXPECT_EQ(folder.file_count(), 1u);
}

/// In a child process, where no file may grow beyond 1 MB: as on a full disk, the write fails half-way.
int exit_code_of_too_large_write(const std::string& path) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{1 << 20, 1 << 20};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        try {
            write_file_atomically(path, std::string(2 << 20, 'n'));
        } catch (const IoError&) {
            ::_exit(6);
        }
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WEXITSTATUS(status);
}

TEST(AtomicWrite, AFailureHalfWayKeepsTheOldFileAndCleansUp) {
    const TemporaryFolder folder;
    write_file_atomically(folder / "file", "old");
    EXPECT_EQ(exit_code_of_too_large_write(folder / "file"), 6);
    EXPECT_EQ(read_file(folder / "file"), "old");
    EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicWrite, AProcessKilledAtAnyMomentLeavesTheOldFileOrTheNewOne) {
    const TemporaryFolder folder;
    const std::string old_bytes(1 << 20, 'o'), new_bytes(8 << 20, 'n');
    for (int wait = 0; wait < 20; ++wait) {
        write_file_atomically(folder / "file", old_bytes);
        const pid_t child = ::fork();
        if (child == 0) {
            write_file_atomically(folder / "file", new_bytes);
            ::_exit(0);
        }
        ::usleep(useconds_t(500 * wait));
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        const std::string found = read_file(folder / "file");
        EXPECT_TRUE(found == old_bytes || found == new_bytes) << "killed after " << 500 * wait << " us";
    }
}

}  // namespace
}  // namespace varimap
