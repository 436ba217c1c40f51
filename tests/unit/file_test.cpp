#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "mesh_samples.h"
#include "scarp/io.h"

namespace scarp {
namespace {

namespace fs = std::filesystem;
using test::to_bytes;

class FileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "scarp_file_test_XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t files() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {})); }
  static std::string content(const std::string& file) {
    const auto bytes = read_file(file);
    return bytes ? std::string(bytes->begin(), bytes->end()) : "unreadable";
  }

  fs::path folder_;
};

TEST_F(FileTest, WritesReadsAndReplaces) {
  ASSERT_TRUE(write_file(path("a"), to_bytes("one")));
  EXPECT_EQ(content(path("a")), "one");
  fs::permissions(path("a"), fs::perms(0640));
  ASSERT_TRUE(write_file(path("a"), to_bytes("three")));
  EXPECT_EQ(content(path("a")), "three");
  EXPECT_EQ(fs::status(path("a")).permissions(), fs::perms(0640));
  ASSERT_TRUE(write_file(path("empty"), {}));
  EXPECT_EQ(content(path("empty")), "");
  EXPECT_EQ(files(), 2u);
  EXPECT_STREQ(pending_output(), "");
}

TEST_F(FileTest, RefusesToReplaceWithoutLeave) {
  ASSERT_TRUE(write_file(path("a"), to_bytes("old"), false));
  const auto second = write_file(path("a"), to_bytes("new"), false);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().kind, ErrorKind::kOutput);
  EXPECT_EQ(second.error().message, path("a") + " exists; use --overwrite to replace it");
  EXPECT_EQ(content(path("a")), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(FileTest, FollowsSymbolicLinks) {
  fs::create_directory(path("real"));
  ASSERT_TRUE(write_file(path("real/a"), to_bytes("old")));
  fs::create_symlink(path("real/a"), path("link"));
  ASSERT_TRUE(write_file(path("link"), to_bytes("new")));
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(content(path("real/a")), "new");
}

TEST_F(FileTest, FollowsALinkToWhatDoesNotExistYet) {
  fs::create_directory(path("real"));
  fs::create_symlink("real/b", path("second"));
  fs::create_symlink("second", path("first"));
  ASSERT_TRUE(write_file(path("first"), to_bytes("new"), false));
  EXPECT_TRUE(fs::is_symlink(path("first")));
  EXPECT_TRUE(fs::is_symlink(path("second")));
  EXPECT_EQ(content(path("real/b")), "new");
  fs::create_symlink("circle", path("circle"));
  const auto written = write_file(path("circle"), to_bytes("x"));
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().message, "cannot write " + path("circle") + ": its symbolic links lead in a circle");
}

TEST_F(FileTest, LeavesTemporaryFilesOfOthersAlone) {
  const std::string others = fmt::format(".scarp-{}-0.tmp", ::getpid());
  ASSERT_TRUE(write_file(path(others), to_bytes("theirs")));
  for (int k = 0; k < 20; ++k) ASSERT_TRUE(write_file(path(std::to_string(k)), to_bytes("mine")));
  EXPECT_EQ(content(path(others)), "theirs");
  EXPECT_EQ(files(), 21u);
}

TEST_F(FileTest, OneSentenceForEachFailure) {
  const std::pair<std::string, const char*> kCases[] = {
      {path("missing/a"), "its folder does not exist; create it first"},
      {"/proc/scarp", "its folder takes no new files"},
      {folder_.string(), "it is a folder"},
      {path("x/"), "folder"},
      {path(std::string(300, 'n')), "the name is too long"},
      {"", "without a name"},
  };
  for (const auto& [name, words] : kCases) {
    const auto written = write_file(name, to_bytes("x"));
    ASSERT_FALSE(written) << name;
    EXPECT_EQ(written.error().kind, ErrorKind::kOutput);
    EXPECT_NE(written.error().message.find(words), std::string::npos) << written.error().message;
  }
  EXPECT_EQ(files(), 0u);
  EXPECT_STREQ(pending_output(), "");
}

TEST_F(FileTest, AFullDiskLeavesTheOldFile) {
  ASSERT_TRUE(write_file(path("a"), to_bytes("old")));
  struct rlimit old_limit {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old_limit), 0);
  auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  struct rlimit limit = old_limit;
  limit.rlim_cur = 10000;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  const auto written = write_file(path("a"), std::vector<std::uint8_t>(20000, 'x'));
  ::setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().kind, ErrorKind::kOutput);
  EXPECT_EQ(written.error().message, "cannot write " + path("a") + ": it would exceed the file-size limit");
  EXPECT_EQ(content(path("a")), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(FileTest, DevicesAreWrittenDirectly) {
  EXPECT_TRUE(write_file("/dev/null", to_bytes("x"), false));
  if (::access("/dev/full", W_OK) == 0) {
    const auto written = write_file("/dev/full", to_bytes("x"));
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().message, "cannot write /dev/full: the disk is full");
  }
}

TEST_F(FileTest, ReadingNamesTheReason) {
  const auto missing = read_file(path("nothing"));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, ErrorKind::kInput);
  EXPECT_EQ(missing.error().message, "cannot read " + path("nothing") + ": there is no such file");
  const auto folder = read_file(folder_.string());
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().message, "cannot read " + folder_.string() + ": it is a folder");
}

TEST_F(FileTest, AHandlerFindsTheTemporaryName) {
  // A child stopped by SIGXFSZ while writing requests the name in its handler, removes the file, and ends.
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    struct rlimit limit {
      10000, 10000
    };
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, [](int) { _exit(::unlink(pending_output()) == 0 ? 42 : 43); });
    (void)write_file(path("a"), std::vector<std::uint8_t>(20000, 'x'));
    _exit(44);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 42);
  EXPECT_EQ(files(), 0u);
}

TEST_F(FileTest, MeshesGoToFilesAndBack) {
  const Mesh mesh = test::sample_mesh(true);
  for (const char* name : {"a.glb", "a.obj", "a.ply", "a.stl"}) {
    ASSERT_TRUE(write_mesh(mesh, path(name)));
    const auto back = read_mesh(path(name));
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->triangle_count(), mesh.triangle_count());
  }
  EXPECT_FALSE(write_mesh(mesh, path("a.xyz")));
  EXPECT_TRUE(write_mesh(mesh, path("a.xyz"), MeshFormat::kPly));
  EXPECT_FALSE(write_mesh(mesh, path("a.xyz"), MeshFormat::kPly, false));
  const auto refused = write_mesh(Mesh{}, path("b.glb"));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "cannot write " + path("b.glb") + ": the mesh has no triangles");
}

}  // namespace
}  // namespace scarp
