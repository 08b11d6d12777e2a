// Reading and writing by path: what can be wrong with a file before its first byte, and on its way
// to the disk.
#include "io_support.hpp"

#include "base/path.hpp"

#include <new>
#ifndef _WIN32
#include <csignal>
#include <sys/resource.h>
#endif

namespace plait {
namespace {

void expect_read_error(const std::string& path, plait_result code) {
    auto strands = read_strands(path);
    ASSERT_FALSE(strands.ok()) << path;
    EXPECT_EQ(strands.error().code, code) << strands.error().message;
    EXPECT_NE(strands.error().message.find(path), std::string::npos) << strands.error().message;
}

const char* const READABLE[] = {".tfx", ".hair",
#ifndef PLAIT_WITHOUT_ASSIMP
                                ".obj"
#endif
};

TEST(IoFiles, MissingFile) {
    TemporaryDirectory directory;
    for (const char* extension : READABLE)
        expect_read_error(directory.file(std::string("none") + extension), PLAIT_NOT_FOUND);
    expect_read_error(directory.file("no/such/directory.tfx"), PLAIT_NOT_FOUND);
}

// Written as UTF-8, on every system.
TEST(IoFiles, NamesBeyondAscii) {
    TemporaryDirectory directory;
    const std::string folder = directory.path() + "/\xc3\xa4\xe9\xab\xaa";
    std::filesystem::create_directory(native_path(folder));
    StrandSet strands = sample_strands({3, 3, 3});
    add_skin(strands);
    const std::string path = folder + "/\xd0\xb2.TFX";
    ASSERT_OK(write_strands(path, strands));
    EXPECT_TRUE(std::filesystem::exists(native_path(folder + "/\xd0\xb2.tfxbone")));
    auto again = read_strands(path);
    ASSERT_OK(again);
    expect_equal(*again, strands);
    expect_read_error(folder + "/\xd0\xb3.tfx", PLAIT_NOT_FOUND);
}

TEST(IoFiles, DirectoryAndDevice) {
    TemporaryDirectory directory;
    for (const char* extension : READABLE) {
        const std::string path = directory.file(std::string("named") + extension);
        std::filesystem::create_directory(path);
        expect_read_error(path, PLAIT_IO);
    }
#ifndef _WIN32
    const std::string device = directory.file("device.tfx");
    std::filesystem::create_symlink("/dev/zero", device);
    expect_read_error(device, PLAIT_IO);
#endif
}

TEST(IoFiles, EmptyFile) {
    TemporaryDirectory directory;
    for (const char* extension : READABLE) {
        const std::string path = directory.file(std::string("empty") + extension);
        put_file(path, "");
        expect_read_error(path, PLAIT_BAD_DATA);
    }
}

TEST(IoFiles, UnknownExtension) {
    TemporaryDirectory directory;
    expect_read_error(directory.file("hair.xyz"), PLAIT_UNSUPPORTED);
    expect_read_error(directory.file("hair"), PLAIT_UNSUPPORTED);
    for (const char* name : {"hair.gltf", "hair.GLB"}) {
        auto strands = read_strands(directory.file(name));
        ASSERT_FALSE(strands.ok());
        EXPECT_EQ(strands.error().code, PLAIT_UNSUPPORTED);
        const std::string& message = strands.error().message;
        EXPECT_NE(message.find(directory.file(name) + ": cannot read strands from \".gl"),
                  std::string::npos)
            << message;
        EXPECT_NE(message.find("known are .tfx, .hair, .obj"), std::string::npos) << message;
    }
    const Status status = write_strands(directory.file("hair.obj"), sample_strands({2}));
    EXPECT_EQ(status.error().code, PLAIT_UNSUPPORTED);
    EXPECT_EQ(directory.entries(), 0u);
}

TEST(IoFiles, ExtensionsInCapitals) {
    TemporaryDirectory directory;
    ASSERT_OK(write_strands(directory.file("A.TFX"), sample_strands({3, 3})));
    auto strands = read_strands(directory.file("A.TFX"));
    ASSERT_OK(strands);
    expect_equal(*strands, sample_strands({3, 3}));
}

TEST(IoFiles, SkinIsKeptBesideTheStrands) {
    TemporaryDirectory directory;
    StrandSet strands = sample_strands({3, 3, 3});
    add_uv_and_thickness(strands);
    add_skin(strands);
    ASSERT_OK(write_strands(directory.file("a.tfx"), strands));
    EXPECT_EQ(directory.entries(), 2u);
    auto again = read_strands(directory.file("a.tfx"));
    ASSERT_OK(again);
    expect_equal(*again, strands);
}

TEST(IoFiles, SkinOfOtherStrandsIsRefusedByItsName) {
    TemporaryDirectory directory;
    StrandSet strands = sample_strands({3, 3, 3});
    add_skin(strands);
    ASSERT_OK(write_strands(directory.file("a.tfx"), strands));
    ASSERT_OK(write_strands(directory.file("b.tfx"), sample_strands({3, 3})));
    std::filesystem::rename(directory.file("a.tfxbone"), directory.file("b.tfxbone"));
    expect_bad_data(read_strands(directory.file("b.tfx")), "b.tfxbone: byte ",
                    "number of strands is 3; the strands are 2");
}

TEST(IoFiles, WritingReplacesTheFile) {
    TemporaryDirectory directory;
    const std::string path = directory.file("a.hair");
    ASSERT_OK(write_strands(path, sample_strands({2, 3})));
    ASSERT_OK(write_strands(path, sample_strands({5})));
    auto strands = read_strands(path);
    ASSERT_OK(strands);
    expect_equal(*strands, sample_strands({5}));
    EXPECT_EQ(directory.entries(), 1u);
}

TEST(IoFiles, WritingWhereThereIsNoDirectory) {
    TemporaryDirectory directory;
    const std::string path = directory.file("no/a.tfx");
    const Status status = write_strands(path, sample_strands({2}));
    EXPECT_FALSE(status.ok());
    EXPECT_NE(status.error().message.find(path), std::string::npos);
    EXPECT_EQ(directory.entries(), 0u);
}

TEST(IoFiles, WritingOverADirectoryLeavesNothingBehind) {
    TemporaryDirectory directory;
    std::filesystem::create_directory(directory.file("a.tfx"));
    EXPECT_EQ(write_strands(directory.file("a.tfx"), sample_strands({2})).error().code, PLAIT_IO);
    EXPECT_EQ(directory.entries(), 1u);
}

#ifndef _WIN32 // which has no such limit

// Files of this process may have at most `bytes` for as long as this lives: as on a full disk, a
// write stops in the middle of a file.
class FullDisk {
  public:
    explicit FullDisk(rlim_t bytes) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        rlimit now = before_;
        now.rlim_cur = bytes;
        setrlimit(RLIMIT_FSIZE, &now);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;
    ~FullDisk() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, signal_);
    }

  private:
    void (*signal_)(int);
    rlimit before_ = {};
};

TEST(IoFiles, FailedWriteKeepsTheOldFile) {
    TemporaryDirectory directory;
    const std::string path = directory.file("a.tfx");
    ASSERT_OK(write_strands(path, sample_strands({2})));
    const std::vector<std::byte> before = file_bytes(path);
    Status status;
    {
        FullDisk disk(before.size());
        status = write_strands(path, sample_strands({900, 900}));
    }
    EXPECT_EQ(status.error().code, PLAIT_IO);
    EXPECT_NE(status.error().message.find("cannot write"), std::string::npos);
    EXPECT_EQ(file_bytes(path), before);
    EXPECT_EQ(directory.entries(), 1u);
}

#endif

TEST(IoFiles, ExhaustedMemoryIsAnError) {
    TemporaryDirectory directory;
    const std::string path = directory.file("a.tfx");
    ASSERT_OK(write_strands(path, sample_strands({4, 4})));
    auto strands = read_strands(path, {.memory = std::pmr::null_memory_resource()});
    ASSERT_FALSE(strands.ok());
    EXPECT_EQ(strands.error().code, PLAIT_OUT_OF_MEMORY);
}

} // namespace
} // namespace plait
