#include "castor/base/plain_words.hpp"

#include "castor/base/caf.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <system_error>

namespace castor::test {

namespace {

struct Silent : std::exception {
  const char* what() const noexcept override { return nullptr; }
};

} // namespace

TEST(PlainWords, SayOfAFileWhatIsWrongAndWhatToDo) {
  auto text = plain_words(std::filesystem::filesystem_error{
    "open", "/a/b", std::make_error_code(std::errc::permission_denied)});
  EXPECT_TRUE(text.starts_with("/a/b cannot be used: Permission denied; check that it exists"))
    << text;
}

TEST(PlainWords, SayThatAnExceptionSaysNothing) {
  EXPECT_EQ(plain_words(Silent{}), "an exception without a message");
}

TEST(PlainWords, GiveTheTextOfAnActorsErrorWithoutItsNotation) {
  caf::actor_system_config config;
  caf::actor_system system{config};
  EXPECT_EQ(plain_words(caf::make_error(caf::sec::runtime_error, "the disk is full"), system),
            "the disk is full");
}

TEST(PlainWords, GiveTheCodeOfAnErrorThatHasNoText) {
  caf::actor_system_config config;
  caf::actor_system system{config};
  for (auto& x : {caf::make_error(caf::sec::request_timeout),
                  caf::make_error(caf::sec::runtime_error, "two", "texts")})
    EXPECT_EQ(plain_words(x, system), system.render(x));
}

} // namespace castor::test
