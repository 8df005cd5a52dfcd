#include "castor/actors/system/request_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace castor {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string problem(const std::string& line) {
  try {
    parse_request(line);
  } catch (const BadRequest& e) {
    return e.what();
  }
  return "none";
}

TEST(RequestLines, AreCutHoweverTheyArrive) {
  RequestLines lines;
  EXPECT_THAT(lines.take("{\"do\""), IsEmpty());
  EXPECT_THAT(lines.take(": \"ps\"}\n\nx\ny"), ElementsAre("{\"do\": \"ps\"}", "", "x"));
  EXPECT_THAT(lines.take("z\n"), ElementsAre("yz"));
}

TEST(RequestLines, AreOfLimitedLength) {
  RequestLines lines;
  std::string half(longest_request / 2, 'x');
  EXPECT_THAT(lines.take(half + '\n' + half), ElementsAre(half));
  EXPECT_THAT(lines.take(half + '\n'), ElementsAre(half + half));
  lines.take(half);
  lines.take(half);
  EXPECT_THROW(lines.take("x"), BadRequest);
  RequestLines others;
  EXPECT_THROW(others.take(half + half + "x\n"), BadRequest);
}

TEST(Request, IsAnObject) {
  EXPECT_EQ(parse_request("{\"do\": \"ps\"}")["do"], "ps");
  EXPECT_THAT(problem("[1]"), HasSubstr("no JSON object"));
  EXPECT_THAT(problem(""), HasSubstr("cannot be read"));
  EXPECT_THAT(problem("nonsense"), HasSubstr("cannot be read"));
}

TEST(Request, IsUtf8) {
  EXPECT_EQ(problem("{\"\u00e4\U0001f916\": 1}"), "none");
  for (auto bytes : {"\xff", "\x80", "\xc3", "\xc0\xaf", "\xe0\x80\x80", "\xed\xa0\x80",
                     "\xf4\x90\x80\x80", "\xf0\x9f\xa4"})
    EXPECT_THAT(problem(std::string{"{\"do\": \""} + bytes + "\"}"), HasSubstr("UTF-8"));
}

TEST(Request, IsNotNestedTooDeeply) {
  auto nested = [](int depth) {
    auto n = static_cast<std::size_t>(depth - 1);
    return "{\"x\": " + std::string(n, '[') + std::string(n, ']') + "}";
  };
  EXPECT_EQ(problem(nested(deepest_request)), "none");
  EXPECT_THAT(problem(nested(deepest_request + 1)), HasSubstr("within one another"));
  EXPECT_THAT(problem(nested(400'000)), HasSubstr("within one another"));
  EXPECT_EQ(problem("{\"x\": \"\\\"" + std::string(1000, '[') + "\"}"), "none");
}

} // namespace

} // namespace castor
