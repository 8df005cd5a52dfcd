#include "castor/base/child_process.hpp"
#include "castor/wm/filters/predicate_builder.hpp"
#include "castor/wm/values/encoding.hpp"
#include "castor/wm/values/json.hpp"
#include "castor/wm/values/value.hpp"

#include "castor/tests/wm/values/test_types.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

// Two processes: this one has the entry types, the other (opaque_process.cpp) has only the library.

namespace castor::test {

namespace {

using testing::HasSubstr;
using testing::IsEmpty;

struct Result {
  int status = -1;
  Bytes output;
  std::string errors;

  std::string text() const { return {output.begin(), output.end()}; }
};

class Pipe {
public:
  Pipe() {
    if (pipe2(ends_, O_CLOEXEC) != 0)
      throw std::runtime_error("no pipe");
  }

  ~Pipe() {
    close_end(0);
    close_end(1);
  }

  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int reading() const { return ends_[0]; }
  int writing() const { return ends_[1]; }

  void close_end(int i) {
    if (ends_[i] >= 0)
      close(ends_[i]);
    ends_[i] = -1;
  }

  void write_all(const Bytes& bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
      auto n = write(writing(), bytes.data() + done, bytes.size() - done);
      if (n <= 0)
        break;
      done += static_cast<std::size_t>(n);
    }
    close_end(1);
  }

  Bytes read_all() {
    Bytes result;
    std::uint8_t buffer[4096];
    while (auto n = read(reading(), buffer, sizeof(buffer))) {
      if (n < 0)
        throw std::runtime_error("cannot read from the pipe");
      result.insert(result.end(), buffer, buffer + n);
    }
    return result;
  }

private:
  int ends_[2] = {-1, -1};
};

/// Runs the other process with `input` on its standard input, to its end.
Result run(std::vector<std::string> arguments, const Bytes& input) {
  // The process may end without reading all that is written to it.
  std::signal(SIGPIPE, SIG_IGN);
  Pipe in;
  Pipe out;
  Pipe err;
  arguments.insert(arguments.begin(), CASTOR_OPAQUE_PROCESS);
  ChildProcess process{{CASTOR_OPAQUE_PROCESS,
                        std::move(arguments),
                        {},
                        {{in.reading(), 0}, {out.writing(), 1}, {err.writing(), 2}},
                        false}};
  in.close_end(0);
  out.close_end(1);
  err.close_end(1);
  Result result;
  std::thread writer{[&] { in.write_all(input); }};
  std::thread reader{[&] {
    auto text = err.read_all();
    result.errors.assign(text.begin(), text.end());
  }};
  result.output = out.read_all();
  writer.join();
  reader.join();
  result.status = process.wait();
  return result;
}

Result run(std::vector<std::string> arguments, const Value& value) {
  return run(std::move(arguments), encode_self_described(value));
}

/// What the other process thinks of "field op text".
std::string compare(const Value& value, const std::string& field, const std::string& op,
                    const std::string& text) {
  auto result = run({"compare", field, op, text}, value);
  return result.status == 0 ? result.text() : result.errors;
}

} // namespace

TEST(OpaqueProcess, GivesBackWhatItCannotUnderstand) {
  Rich x;
  x.text = "text";
  x.huge = Huge::all;
  x.gaps = {std::nullopt, Point{1, 2, 3}};
  x.box = signed_box();
  x.tree = {"root", {{"leaf", {}}}};
  x.numbers.f64 = std::numeric_limits<double>::infinity();
  auto sent = Value::of(x);
  auto result = run({"echo"}, sent);
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.errors, IsEmpty());
  auto back = decode_self_described(result.output);
  EXPECT_EQ(back, sent);
  ASSERT_TRUE(back.as<Rich>());
  EXPECT_EQ(*back.as<Rich>(), x);
}

TEST(OpaqueProcess, KeepsTheSuperTypes) {
  auto result = run({"echo"}, Value::of(signed_box()));
  auto back = decode_self_described(result.output);
  EXPECT_TRUE(back.type().is_a("Box"));
  EXPECT_EQ(*back.as<Box>(), static_cast<const Box&>(signed_box()));
  EXPECT_EQ(*back.as<SignedBox>(), signed_box());
}

TEST(OpaqueProcess, GivesBackALargeValue) {
  Rich x;
  for (std::size_t i = 0; i < 3'000'000; ++i)
    x.bytes.push_back(static_cast<std::uint8_t>(i * 7));
  auto result = run({"echo"}, Value::of(x));
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_EQ(decode_self_described(result.output).as<Rich>()->bytes, x.bytes);
}

TEST(OpaqueProcess, PrintsWhatItCannotUnderstand) {
  auto result = run({"json"}, Value::of(signed_box()));
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_EQ(result.text(), to_json(Value::of(signed_box())));
  auto json = nlohmann::json::parse(result.text());
  EXPECT_EQ(json["label"], "tea");
  EXPECT_EQ(json["pose"]["position"]["y"], -2.25);
  EXPECT_EQ(json["colours"], nlohmann::json::parse(R"(["red", "", "green"])"));
  EXPECT_EQ(json["side"], "right");
}

TEST(OpaqueProcess, ComparesNestedNumbers) {
  auto x = Value::of(signed_box());
  EXPECT_EQ(compare(x, "pose.position.x", "==", "1.5"), "true");
  EXPECT_EQ(compare(x, "pose.position.y", "<", "-2"), "true");
  EXPECT_EQ(compare(x, "pose.position.z", ">=", "0.5"), "true");
  EXPECT_EQ(compare(x, "pose.position.z", ">", "0.5"), "false");
  EXPECT_EQ(compare(x, "pose.heading", "==", "3"), "true");
  EXPECT_EQ(compare(x, "pose.heading", "!=", "3"), "false");
}

TEST(OpaqueProcess, ComparesEnumerators) {
  auto x = Value::of(signed_box());
  EXPECT_EQ(compare(x, "side", "==", "right"), "true");
  EXPECT_EQ(compare(x, "side", "==", "left"), "false");
  EXPECT_EQ(compare(x, "side", "!=", "left"), "true");
}

TEST(OpaqueProcess, ComparesTexts) {
  auto x = Value::of(signed_box());
  EXPECT_EQ(compare(x, "label", "==", "tea"), "true");
  EXPECT_EQ(compare(x, "label", "<", "tee"), "true");
  EXPECT_EQ(compare(x, "signature", "==", "Nick"), "true");
  EXPECT_EQ(compare(x, "signature", "==", ""), "false");
}

TEST(OpaqueProcess, ComparesIntegersAndTruthValues) {
  Numbers numbers;
  numbers.truth = true;
  numbers.u64 = std::numeric_limits<std::uint64_t>::max();
  numbers.i64 = std::numeric_limits<std::int64_t>::min();
  auto x = Value::of(numbers);
  EXPECT_EQ(compare(x, "truth", "==", "true"), "true");
  EXPECT_EQ(compare(x, "truth", "==", "false"), "false");
  EXPECT_EQ(compare(x, "u64", "==", "18446744073709551615"), "true");
  EXPECT_EQ(compare(x, "u64", ">", "-1"), "true");
  EXPECT_EQ(compare(x, "i64", "<=", "-9223372036854775808"), "true");
}

TEST(OpaqueProcess, FindsAnAbsentOptionalUnequal) {
  auto box = signed_box();
  box.signature.reset();
  auto x = Value::of(box);
  EXPECT_EQ(compare(x, "signature", "==", "Nick"), "false");
  EXPECT_EQ(compare(x, "signature", "!=", "Nick"), "true");
}

TEST(OpaqueProcess, EvaluatesPredicates) {
  auto x = Value::of(signed_box());
  auto expect = [&](const Predicate& predicate) {
    auto result = run({"where", predicate.text()}, x);
    EXPECT_EQ(result.errors, "");
    EXPECT_EQ(result.text(), predicate.matches(x) ? "true" : "false") << predicate.text();
    return predicate.matches(x);
  };
  auto near = distance(field(&Box::pose, &Pose::position), Point{1, -2, 0.5f}) < 1;
  EXPECT_TRUE(expect(near && field(&SignedBox::side) == Side::right));
  EXPECT_FALSE(expect(!near || field(&Box::label) != "tea"));
  EXPECT_TRUE(expect(has(field(&SignedBox::signature))));
  auto result = run({"where", "label == 3"}, x);
  EXPECT_THAT(result.errors, HasSubstr("label of SignedBox is a text"));
}

TEST(OpaqueProcess, SaysWhatIsWrongWithAQuestion) {
  auto x = Value::of(signed_box());
  auto expect_error = [&](std::vector<std::string> arguments, const std::string& why) {
    auto result = run(std::move(arguments), x);
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.output, IsEmpty());
    EXPECT_THAT(result.errors, HasSubstr(why));
  };
  expect_error({"compare", "pose.w", "==", "1"}, "Pose has no field w; it has position, heading");
  expect_error({"compare", "colours", "==", "1"}, "cannot be compared as a whole");
  expect_error({"compare", "pose.heading", "==", "high"}, "cannot be compared with one another");
  expect_error({"compare", "label", "~", "1"}, "no comparison");
  expect_error({"nonsense"}, "usage");
}

TEST(OpaqueProcess, RefusesBytesThatAreNoValue) {
  auto bytes = encode_self_described(Value::of(signed_box()));
  bytes.pop_back();
  for (auto& input : {bytes, Bytes{}, Bytes(1000, 0xff)}) {
    auto result = run({"json"}, input);
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.output, IsEmpty());
    EXPECT_THAT(result.errors, HasSubstr("ends early"));
  }
}

} // namespace castor::test
