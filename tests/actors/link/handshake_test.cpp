#include "castor/actors/link/handshake.hpp"

#include "castor/actors/link/dial.hpp"
#include "castor/actors/link/session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace castor {

namespace {

using testing::HasSubstr;

Bytes written(const Greeting& x) {
  std::vector<char> out;
  write_greeting(out, x);
  return {out.begin(), out.end()};
}

std::string problem(Bytes bytes) {
  try {
    read_greeting(bytes);
  } catch (const LinkError& e) {
    return e.what();
  }
  return "none";
}

TEST(Greeting, ArrivesHoweverItIsCut) {
  auto all = written(Hello{"robot", "vision-7", 11, 3, 4, 12, 99, 7});
  Bytes received;
  for (auto x : all) {
    ASSERT_FALSE(read_greeting(received));
    received.push_back(x);
  }
  received.push_back('!');
  auto greeting = read_greeting(received);
  ASSERT_TRUE(greeting);
  auto& hello = std::get<Hello>(*greeting);
  EXPECT_EQ(hello.node, "robot");
  EXPECT_EQ(hello.system, "vision-7");
  EXPECT_EQ(hello.incarnation, 11u);
  EXPECT_EQ(hello.process, 3u);
  EXPECT_EQ(hello.receiver, 4u);
  EXPECT_EQ(hello.known, 12u);
  EXPECT_EQ(hello.received, 99u);
  EXPECT_EQ(hello.attempt, 7u);
  EXPECT_EQ(received, Bytes{'!'});
}

TEST(Greeting, CanBeARefusal) {
  auto bytes = written(Refusal{"there is no such system", true});
  auto greeting = read_greeting(bytes);
  ASSERT_TRUE(greeting);
  EXPECT_EQ(std::get<Refusal>(*greeting).reason, "there is no such system");
  EXPECT_TRUE(std::get<Refusal>(*greeting).final);
}

TEST(Greeting, WhateverElseIsRefusedAtItsFirstWrongByte) {
  EXPECT_THAT(problem({'G', 'E', 'T'}), HasSubstr("does not speak"));
  EXPECT_EQ(problem({'C', 'A'}), "none");
  EXPECT_THAT(problem({'C', 'A', 'T'}), HasSubstr("does not speak"));
  auto other_version = written(Refusal{});
  other_version[7] = 77;
  EXPECT_THAT(problem(other_version), HasSubstr("another version"));
  auto huge = written(Refusal{});
  huge[11] = 0x7f;
  EXPECT_THAT(problem(huge), HasSubstr("a greeting of 2130706"));
  auto cut = written(Hello{"robot", "s", 1, 1, 1, 1, 1});
  cut[8] = static_cast<std::uint8_t>(cut[8] - 1);
  EXPECT_THAT(problem(cut), HasSubstr("cannot be read"));
}

TEST(Endpoint, IsReadAndWritten) {
  EXPECT_EQ(parse_endpoint("robot", 7117), (Endpoint{"robot", 7117}));
  EXPECT_EQ(parse_endpoint("robot:80", 7117), (Endpoint{"robot", 80}));
  EXPECT_EQ(parse_endpoint("[::1]:80", 7117), (Endpoint{"::1", 80}));
  EXPECT_EQ(parse_endpoint("[::1]", 7117), (Endpoint{"::1", 7117}));
  EXPECT_EQ(parse_endpoint("fe80::1", 7117), (Endpoint{"fe80::1", 7117}));
  EXPECT_EQ(parse_endpoint("unix:/run/x/links-1/0", 7117), (Endpoint{"/run/x/links-1/0", 0}));
  EXPECT_EQ(to_string(Endpoint{"/run/x/links-1/0", 0}), "unix:/run/x/links-1/0");
  EXPECT_EQ(to_string(Endpoint{"::1", 80}), "[::1]:80");
  EXPECT_EQ(to_string(Endpoint{"robot", 80}), "robot:80");
  for (auto* wrong : {"robot:", "robot:http", "robot:70000", "robot:80x", "[::1", "[::1]80",
                      "unix:", "unix:links/0"})
    EXPECT_THROW(parse_endpoint(wrong, 7117), std::invalid_argument) << wrong;
}

TEST(Endpoint, KnowsLoopback) {
  EXPECT_TRUE(is_loopback("127.0.0.1"));
  EXPECT_TRUE(is_loopback("::1"));
  EXPECT_TRUE(is_loopback("localhost"));
  EXPECT_TRUE(is_loopback("/run/x/links-1/0"));
  EXPECT_FALSE(is_loopback("0.0.0.0"));
  EXPECT_FALSE(is_loopback("192.0.2.1"));
}

} // namespace

} // namespace castor
