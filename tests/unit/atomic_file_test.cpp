#include "base/atomic_file.h"

#include "base/error.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

namespace slant {
namespace {

using test::readText;
using test::TempDir;
using test::writeText;

void expectUnwritable(const std::string& path) {
    try {
        checkWritable(path);
        ADD_FAILURE() << path << " can be written";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::resources);
        EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
    }
}

TEST(AtomicFile, appearsOnCommitOnly) {
    const TempDir dir;
    const std::string path = dir.file("a");
    writeText(path, "old");
    {
        AtomicFile file(path);
        file.write("new ");
        file.write("text");
        EXPECT_EQ(readText(path), "old");
        file.commit();
    }
    EXPECT_EQ(readText(path), "new text");
    EXPECT_EQ(dir.entries(), 1u);
}

TEST(AtomicFile, vanishesWhenAbandonedOrUnwound) {
    const TempDir dir;
    const std::string path = dir.file("a");
    { AtomicFile(path).write("half"); }
    EXPECT_EQ(dir.entries(), 0u);
    writeText(path, "old");
    try {
        AtomicFile file(path);
        file.write("half");
        throw Error(ErrorCode::interrupted, "stop");
    } catch (const Error&) {
    }
    EXPECT_EQ(readText(path), "old");
    EXPECT_EQ(dir.entries(), 1u);
}

TEST(AtomicFile, twoAtOnceDoNotMeet) {
    const TempDir dir;
    AtomicFile a(dir.file("a")), b(dir.file("b"));
    a.write("A");
    b.write("B");
    a.commit();
    b.commit();
    EXPECT_EQ(readText(dir.file("a")), "A");
    EXPECT_EQ(readText(dir.file("b")), "B");
}

TEST(AtomicFile, followsSymbolicLinks) {
    const TempDir dir;
    writeText(dir.file("real"), "old");
    std::filesystem::create_symlink("real", dir.file("link"));
    AtomicFile file(dir.file("link"));
    file.write("new");
    file.commit();
    EXPECT_TRUE(std::filesystem::is_symlink(dir.file("link")));
    EXPECT_EQ(readText(dir.file("real")), "new");
}

TEST(AtomicFile, fullDiskIsAnErrorAndADeviceStaysOne) {
    AtomicFile file("/dev/full");
    EXPECT_THROW(
        {
            file.write(std::string(1 << 20, 'x'));
            file.commit();
        },
        Error);
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(AtomicFile, refusesWhatCannotBeWritten) {
    const TempDir dir;
    expectUnwritable(dir.path().string());
    expectUnwritable(dir.file("no/such/folder"));
    ASSERT_EQ(mkfifo(dir.file("pipe").c_str(), 0600), 0);
    expectUnwritable(dir.file("pipe"));
    writeText(dir.file("a"), "");
    expectUnwritable(dir.file("a/b"));
    EXPECT_THROW(checkWritable(""), Error);
    checkWritable(dir.file("fine"));
    EXPECT_EQ(dir.entries(), 2u);
}

} // namespace
} // namespace slant
