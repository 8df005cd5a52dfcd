#include "castor/base/input_file.hpp"

#include <gtest/gtest.h>

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <optional>

namespace castor {

namespace {

using Reason = InputFileError::Reason;
using namespace std::chrono_literals;

class InputFiles : public testing::Test {
protected:
  InputFiles() {
    std::string name = testing::TempDir() + "castor-input-XXXXXX";
    folder_ = ::mkdtemp(name.data());
  }
  ~InputFiles() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& text) const {
    auto result = folder_ / "file";
    std::ofstream{result} << text;
    return result;
  }

  std::filesystem::path folder_;
};

/// Why a file is refused, and that this was known at once.
std::optional<std::pair<Reason, std::string>> refusal_of(const std::filesystem::path& path) {
  auto begin = std::chrono::steady_clock::now();
  std::optional<std::pair<Reason, std::string>> result;
  try {
    read_input_file(path, 1000);
  } catch (const InputFileError& e) {
    result.emplace(e.reason(), e.what());
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 1s);
  return result;
}

TEST_F(InputFiles, AreReadWhole) {
  std::string text(200'000, 'x');
  text += '\0';
  EXPECT_EQ(read_input_file(write(text)), text);
  EXPECT_EQ(read_input_file(write({})), "");
}

TEST_F(InputFiles, AreReadThroughLinks) {
  std::filesystem::create_symlink(write("text"), folder_ / "link");
  EXPECT_EQ(read_input_file(folder_ / "link"), "text");
}

TEST_F(InputFiles, AreReadPieceByPiece) {
  InputFile file{write("one two")};
  EXPECT_EQ(file.size(), 7);
  EXPECT_EQ(file.read(3), "one");
  EXPECT_EQ(file.read(100), " two");
  EXPECT_EQ(file.read(100), "");
}

TEST_F(InputFiles, AreRefusedBeyondTheLimit) {
  EXPECT_EQ(read_input_file(write(std::string(1000, 'x')), 1000).size(), 1000);
  EXPECT_EQ(refusal_of(write(std::string(1001, 'x'))),
            std::pair(Reason::too_long, std::string{"it is longer than 1000 bytes"}));
}

TEST_F(InputFiles, ANamedPipeThatNobodyWritesIsRefused) {
  auto pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::pair expected(Reason::special, std::string{"it is a named pipe, not a regular file"});
  EXPECT_EQ(refusal_of(pipe), expected);
  std::filesystem::create_symlink(pipe, folder_ / "link");
  EXPECT_EQ(refusal_of(folder_ / "link"), expected);
  EXPECT_THROW(require_input_file(pipe), InputFileError);
}

TEST_F(InputFiles, WhatIsNoFileIsRefused) {
  EXPECT_EQ(refusal_of(folder_), std::pair(Reason::folder, std::string{"it is a directory"}));
  EXPECT_EQ(
    refusal_of("/dev/zero"),
    std::pair(Reason::special, std::string{"it is a character device, not a regular file"}));
  auto socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{AF_UNIX, {}};
  auto path = (folder_ / "socket").string();
  path.copy(address.sun_path, path.size());
  ASSERT_EQ(::bind(socket, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
  EXPECT_EQ(refusal_of(path),
            std::pair(Reason::special, std::string{"it is a socket, not a regular file"}));
  ::close(socket);
}

TEST_F(InputFiles, WhatIsNotThereIsMissing) {
  std::pair expected(Reason::missing, std::string{"there is no such file"});
  EXPECT_EQ(refusal_of(folder_ / "nothing"), expected);
  EXPECT_EQ(refusal_of(write("text") / "below"), expected);
}

TEST_F(InputFiles, AProcFileThatHasNothingToSayIsNotWaitedFor) {
  // A regular file to whoever asks, and one that blocks until the kernel logs something.
  try {
    auto text = InputFile{"/proc/kmsg"}.read(std::size_t{64} << 20);
    FAIL() << text.size() << " bytes";
  } catch (const InputFileError& e) {
    EXPECT_EQ(e.reason(), Reason::unreadable) << e.what();
  }
}

} // namespace

} // namespace castor
