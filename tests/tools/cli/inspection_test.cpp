#include "castor/tests/tools/cli/castor_fixture.hpp"
#include "castor/tests/tools/cli/operator_name.hpp"

#include "castor/tests/support/eventually.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class Inspection : public Castor {
protected:
  static json ps() {
    auto answer = ask({"ps", "--json"});
    return answer.status == 0 ? json::parse(answer.output) : json{};
  }

  /// Starts a system with a ticker and somebody who hears ticks, and waits until that works.
  std::unique_ptr<Process> start_ticking(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{
      "run", system("CPP UM ticker Ticker\nCPP UM listener Listener --count 1000000\n")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    auto result = std::make_unique<Process>(command(arguments));
    EXPECT_TRUE(result->wait_for_output("hears ticks")) << result->errors();
    return result;
  }

  /// If there is only one.
  std::filesystem::path socket_of_system() const {
    return *std::filesystem::directory_iterator{runtime / "castor"};
  }

  static std::set<std::string> component_names() {
    std::set<std::string> result;
    auto report = ps();
    for (auto& x : report["components"])
      result.insert(x["name"]);
    return result;
  }
};

TEST_F(Inspection, PsShowsASystem) {
  auto castor = start_ticking();
  auto answer = ask({"ps"});
  EXPECT_EQ(answer.status, 0) << answer.errors;
  EXPECT_THAT(answer.output, ContainsRegex("^system: process [0-9]+, .* s old, "));
  EXPECT_THAT(answer.output, ContainsRegex("localhost +up +3 "));
  EXPECT_THAT(answer.output, ContainsRegex("a\\.ticker +Ticker +localhost +running +0 "));
  EXPECT_THAT(answer.output, ContainsRegex("\na +localhost +1 +1 +0 +0 +off\n"));
  EXPECT_THAT(answer.output, Not(HasSubstr("suppressed")));
  EXPECT_THAT(ask({"ps", "--stats"}).output, HasSubstr("suppressed"));
}

TEST_F(Inspection, PsShowsNodesAndTheirLinks) {
  Process castor{command({"run",
                          write("two.cast", "SUBARCHITECTURE a one\n"
                                            "CPP WM SubarchitectureWorkingMemory\n"
                                            "CPP TM AlwaysPositiveTaskManager\n"
                                            "CPP UM ticker Ticker\n"
                                            "SUBARCHITECTURE b two\n"
                                            "CPP WM SubarchitectureWorkingMemory\n"
                                            "CPP TM AlwaysPositiveTaskManager\n"
                                            "CPP UM listener Listener --count 1000000\n"),
                          "--local-nodes"})};
  ASSERT_TRUE(castor.wait_for_output("hears ticks")) << castor.errors();
  auto report = ps();
  ASSERT_EQ(report["nodes"].size(), 3u);
  auto& one = report["nodes"][1];
  EXPECT_EQ(one["name"], "one");
  EXPECT_EQ(one["state"], "up");
  EXPECT_GT(one["memory"], 1'000'000);
  std::optional<json> to_two;
  for (auto& x : one["links"])
    if (x["to"] == "two")
      to_two = x;
  ASSERT_TRUE(to_two) << one;
  EXPECT_GE((*to_two)["events_out"], 10);
  EXPECT_EQ((*to_two)["connections"], 1);
  EXPECT_THAT(ask({"ps", "--stats"}).output, ContainsRegex("one - two +up +[0-9]+ +0 "));
  castor.send_signal(SIGINT);
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
  EXPECT_THAT(castor.output(), ContainsRegex("one - two +[0-9]+ +0 "));
}

TEST_F(Inspection, TheSystemsOwnHealthCanBeLookedInto) {
  Process castor{command({"run", system("CPP UM shaky Shaky\n")})};
  ASSERT_TRUE(castor.wait_for_output("begins life 2")) << castor.errors();
  EXPECT_TRUE(eventually([] {
    auto answer = ask({"wm", "get", "castor/shaky", "--json"});
    return answer.status == 0 && json::parse(answer.output)["type"] == "ComponentUp";
  }));
  EXPECT_THAT(ask({"ps"}).output, ContainsRegex("a\\.shaky +Shaky +localhost +running +1 "));
}

TEST_F(Inspection, WithoutASystemItSaysHowToStartOne) {
  auto answer = ask({"ps"});
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.errors, HasSubstr("start one with `castor run FILE`"));
}

TEST_F(Inspection, EntriesAreListedAndPrinted) {
  auto castor = start_ticking();
  EXPECT_THAT(ask({"wm", "ls"}).output, ContainsRegex("\na +tick +Tick +[0-9]+ +ticker +4\n"));
  EXPECT_THAT(ask({"wm", "ls", "a/Tick"}).output, HasSubstr("ticker"));
  auto by_id = json::parse(ask({"wm", "get", "a/tick", "--json"}).output);
  EXPECT_EQ(by_id["version"], by_id["value"]["number"]);
  EXPECT_THAT(ask({"wm", "get", "a/Tick"}).output, ContainsRegex("\"number\": [0-9]+"));
  auto wrong = ask({"wm", "get", "a/tock"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.errors, HasSubstr("neither an entry nor a type of the name tock"));
  EXPECT_THAT(ask({"wm", "ls", "z"}).errors, HasSubstr("there is no subarchitecture z"));
}

TEST_F(Inspection, ChangesAreWatched) {
  auto castor = start_ticking();
  Process watch{command({"wm", "watch", "a/tick", "--json"})};
  ASSERT_TRUE(watch.wait_for_output("\"value\""));
  ASSERT_TRUE(eventually([&] { return watch.output().find('\n') != std::string::npos; }));
  auto first = json::parse(watch.output().substr(0, watch.output().find('\n')));
  EXPECT_EQ(first["operation"], "OVERWRITE");
  EXPECT_GE(first["value"]["number"], first["version"]);
  EXPECT_EQ(first["changed"], json{"number"});
}

TEST_F(Inspection, EventsAreFilteredByWords) {
  auto castor = start_ticking();
  Process all{command({"events"})};
  EXPECT_TRUE(all.wait_for_output("OVERWRITE"));
  Process some{command({"events", "overwritten", "Tick", "in", "a", "where", "number % 1"})};
  EXPECT_EQ(some.wait(), 2);
  Process few{command({"events", "overwritten", "Tick", "where", "number > 30"})};
  EXPECT_TRUE(few.wait_for_output("OVERWRITE"));
  Process none{command({"events", "in", "z"})};
  EXPECT_EQ(none.wait(), 2);
  EXPECT_THAT(none.errors(), HasSubstr("there is no subarchitecture z"));
}

TEST_F(Inspection, NamesThatNothingHasAreRefusedWithTheNearest) {
  Process castor{command({"run", system("CPP UM ticker Ticker\nCPP UM cook Cook\n")})};
  ASSERT_TRUE(castor.wait_for_output("cooks")) << castor.errors();
  ASSERT_TRUE(eventually([] { return ask({"wm", "get", "a/tick"}).status == 0; }));
  struct Misuse {
    std::vector<std::string> arguments;
    std::string message;
  };
  std::vector<Misuse> misuses{
    {{"events", "added", "Tikc"}, "there is no type Tikc; did you mean 'Tick'?"},
    {{"events", "added", "Tick", "where", "numbr == 1"},
     "Tick has no field numbr; did you mean 'number'?"},
    {{"events", "where", "numbr == 1"}, "no type has a field numbr; did you mean 'number'?"},
    {{"events", "changing", "numbr"}, "did you mean 'number'?"},
    {{"events", "Tick", "changing", "numbr"}, "did you mean 'number'?"},
    {{"events", "from", "tikcer"}, "there is no component tikcer; did you mean 'ticker'?"},
    {{"events", "in", "b"}, "there is no subarchitecture b; there are: a, castor"},
    {{"events", "added", "Call", "where", "request.idd == \"x\""}, "did you mean 'id'?"},
    {{"events", "Order", "where", "portion == \"larg\""},
     "portion of Order is never \"larg\"; did you mean 'large'?"},
    {{"wm", "watch", "a/Tikc"},
     "neither an entry nor a type of the name Tikc; did you mean 'Tick'?"},
    {{"wm", "ls", "a/Tikc"}, "did you mean 'Tick'?"},
    {{"wm", "get", "a/tik"}, "did you mean 'tick'?"},
    {{"remove", "tikcer"}, "did you mean 'ticker'?"},
  };
  for (auto& x : misuses) {
    auto answer = ask(x.arguments);
    EXPECT_EQ(answer.status, 2) << x.message;
    EXPECT_THAT(answer.errors, HasSubstr(x.message));
  }
}

TEST_F(Inspection, WhatMayComeLaterIsWaitedForIfThatIsWanted) {
  auto castor = start_ticking();
  Process events{command({"events", "added", "Tick", "in", "b", "from", "second", "--wait"})};
  Process watch{command({"wm", "watch", "b/Tick", "--wait"})};
  auto added =
    ask({"add", write("more.cast", "SUBARCHITECTURE b\nCPP WM SubarchitectureWorkingMemory\n"
                                   "CPP TM AlwaysPositiveTaskManager\nCPP UM second Ticker\n")});
  ASSERT_EQ(added.status, 0) << added.errors;
  EXPECT_TRUE(watch.wait_for_output("OVERWRITE")) << watch.errors();
  auto third = ask({"add", write("third.cast", "SUBARCHITECTURE b\nCPP UM third Clock\n")});
  ASSERT_EQ(third.status, 0) << third.errors;
  EXPECT_THAT(events.errors(), IsEmpty());
}

TEST_F(Inspection, WhoLooksOnIsNotInTheWayOfTheEnd) {
  auto castor = start_ticking();
  Process events{command({"events"})};
  Process watch{command({"wm", "watch", "a/Tick"})};
  EXPECT_TRUE(events.wait_for_output("OVERWRITE"));
  EXPECT_TRUE(watch.wait_for_output("OVERWRITE"));
  castor->send_signal(SIGINT);
  EXPECT_EQ(castor->wait(), 0) << castor->errors();
  EXPECT_EQ(events.wait(), 0) << events.errors();
  EXPECT_EQ(watch.wait(), 0) << watch.errors();
  EXPECT_TRUE(std::filesystem::is_empty(runtime / "castor"));
}

/// A reader that takes what it is sent when it likes.
class Reader {
public:
  Reader(const std::filesystem::path& path, const std::string& request)
    : fd_(socket(AF_UNIX, SOCK_STREAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.string().copy(address.sun_path, sizeof(address.sun_path) - 1);
    EXPECT_EQ(connect(fd_, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0) << path;
    EXPECT_GT(send(fd_, request.data(), request.size(), MSG_NOSIGNAL), 0);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { close(fd_); }

  /// Empty at the end.
  std::string line() {
    std::string result;
    for (char c = 0; recv(fd_, &c, 1, 0) == 1 && c != '\n';)
      result += c;
    return result;
  }

private:
  int fd_;
};

TEST_F(Inspection, ASlowReaderIsToldOfTheNewest) {
  constexpr int ticks = 30'000;
  auto castor = start_ticking();
  Reader reader{socket_of_system(),
                "{\"do\": \"events\", \"filter\": \"from clock\", \"wait\": true}\n"};
  auto added = ask({"add", write("clock.cast", "SUBARCHITECTURE a\nCPP UM clock Clock --count " +
                                                 std::to_string(ticks) + "\n")});
  ASSERT_EQ(added.status, 0) << added.errors;
  ASSERT_TRUE(eventually([] {
    auto report = ps();
    return report["working_memories"][0]["events"] > ticks;
  }));
  int heard = 0;
  bool coalesced = false;
  json x;
  do {
    x = json::parse(reader.line());
    ++heard;
    coalesced = coalesced || x["coalesced"];
  } while (x["version"] != ticks);
  EXPECT_TRUE(coalesced);
  EXPECT_LT(heard, ticks);
}

TEST_F(Inspection, WhoUsesWhatIsDrawn) {
  auto castor = start_ticking();
  auto dot = ask({"graph"}).output;
  EXPECT_THAT(dot, HasSubstr("digraph \"system\" {"));
  EXPECT_THAT(dot,
              ContainsRegex("\"ticker\" -> \"a/Tick\" \\[label=\"adds 1, overwrites [0-9]+\""));
  EXPECT_THAT(dot, ContainsRegex("\"a/Tick\" -> \"listener\" \\[label=\"events [0-9]+\""));
}

TEST_F(Inspection, WhoUsesWhatIsDrawnAsAPicture) {
  auto castor = start_ticking();
  auto svg = (folder / "system.svg").string();
  auto png = (folder / "system.png").string();
  auto drawn = ask({"graph", "--svg", svg, "--png", png});
  EXPECT_EQ(drawn.status, 0) << drawn.errors;
  EXPECT_THAT(drawn.output, IsEmpty());
  auto picture = read(svg);
  for (auto* text : {">a<", ">ticker<", ">listener<", ">working memory<", ">Tick<"})
    EXPECT_THAT(picture, HasSubstr(text));
  EXPECT_TRUE(read(png).starts_with("\x89PNG"));
  auto refused = ask({"graph", "--svg", (folder / "nowhere" / "x.svg").string()});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.errors, HasSubstr("nowhere to write x.svg into"));
  auto lines = json_lines(ask({"graph", "--json"}).output);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0]["component"], "listener");
}

TEST_F(Inspection, ComponentsJoinAndLeave) {
  auto castor = start_ticking();
  auto more = write("more.cast", "SUBARCHITECTURE a\nCPP UM second Clock\n"
                                 "SUBARCHITECTURE b\nCPP WM SubarchitectureWorkingMemory\n"
                                 "CPP TM AlwaysPositiveTaskManager\n"
                                 "CPP UM hearer Listener --count 1000000 --late\n");
  auto added = ask({"add", more});
  EXPECT_EQ(added.status, 0) << added.errors;
  EXPECT_EQ(added.output, "added 3 components on localhost: second, b_tm, hearer; the "
                          "subarchitecture b\n");
  EXPECT_TRUE(castor->wait_for_output("[b.hearer] hears ticks")) << castor->errors();
  EXPECT_EQ(component_names(),
            (std::set<std::string>{"a_tm", "ticker", "listener", "second", "b_tm", "hearer"}));
  auto again = ask({"add", more});
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.errors, HasSubstr("more.cast:2: error: there is a component second"));
  auto removed = ask({"remove", "second", "--json"});
  EXPECT_EQ(removed.status, 0) << removed.errors;
  EXPECT_EQ(json::parse(removed.output), (json{{"done", true},
                                               {"subarchitectures", json::array()},
                                               {"components",
                                                {{{"name", "second"},
                                                  {"subarchitecture", "a"},
                                                  {"class", "Clock"},
                                                  {"node", "localhost"}}}}}));
  EXPECT_EQ(ask({"remove", "b"}).output,
            "removed 2 components on localhost: b_tm, hearer; the subarchitecture b\n");
  EXPECT_EQ(component_names(), (std::set<std::string>{"a_tm", "ticker", "listener"}));
  EXPECT_EQ(ask({"remove", "b"}).status, 2);
  EXPECT_EQ(ask({"add", more}).status, 0);
  castor->send_signal(SIGINT);
  EXPECT_EQ(castor->wait(), 0) << castor->errors();
  EXPECT_THAT(castor->errors(),
              HasSubstr("stopped, in this order: hearer, b_tm, second, listener"));
}

TEST_F(Inspection, WhatJoinsIsLookedForWhereTheCommandIsGiven) {
  auto castor = start_ticking();
  write("clock.cast", "SUBARCHITECTURE a\nCPP UM clock Clock\n");
  auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder);
  auto added = ask({"add", "clock.cast"});
  std::filesystem::current_path(before);
  EXPECT_EQ(added.status, 0) << added.errors;
  EXPECT_EQ(component_names().count("clock"), 1U);
}

TEST_F(Inspection, WhatCannotJoinLeavesNothingBehind) {
  auto castor = start_ticking();
  auto before = component_names();
  auto wrong = ask({"add", write("wrong.cast", "SUBARCHITECTURE a\nCPP UM good Ticker\n"
                                               "CPP UM bad NoSuchClass\n")});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.errors, HasSubstr("wrong.cast:3: error: "));
  auto far = ask({"add", write("far.cast", "SUBARCHITECTURE a\n127.0.0.1:1 CPP UM good Ticker\n")});
  EXPECT_EQ(far.status, 2);
  EXPECT_THAT(far.errors, HasSubstr("cannot reach the node 127.0.0.1:1"));
  auto nonsense = ask({"add", write("nonsense.cast", "SUBARCHITECTURE\n")});
  EXPECT_EQ(nonsense.status, 2);
  EXPECT_THAT(nonsense.errors, HasSubstr("nonsense.cast:1: error: "));
  EXPECT_EQ(component_names(), before);
  EXPECT_EQ(ps()["nodes"].size(), 1u);
}

/// A node of the name `late`, and a subarchitecture for it.
class LateNode : public Inspection {
protected:
  /// Waits until it listens.
  void start_node(const std::string& at = "127.0.0.1:0") {
    node = std::make_unique<Process>(command({"node", "--name", "late", "--listen", at}));
    ASSERT_TRUE(node->wait_for_output("listens at ")) << node->errors();
    ASSERT_TRUE(eventually([&] { return node->output().ends_with("\n"); }));
    auto output = node->output();
    auto begin = output.rfind(' ') + 1;
    address = output.substr(begin, output.size() - begin - 1);
  }

  std::string addition() const {
    return write("late.cast", "HOSTNAME late " + address +
                                "\nSUBARCHITECTURE b [late]\n"
                                "CPP WM SubarchitectureWorkingMemory\n"
                                "CPP TM AlwaysPositiveTaskManager\n"
                                "CPP UM hearer Listener --count 1000000 --late\n");
  }

  std::unique_ptr<Process> node;
  std::string address;
};

TEST_F(LateNode, Joins) {
  start_node();
  auto castor = start_ticking();
  auto added = ask({"add", addition()});
  EXPECT_EQ(added.status, 0) << added.errors;
  EXPECT_TRUE(node->wait_for_output("[b.hearer] hears ticks")) << node->errors();
  EXPECT_EQ(ask({"remove", "b"}).status, 0);
  EXPECT_EQ(ask({"add", addition()}).status, 0);
  castor->send_signal(SIGINT);
  EXPECT_EQ(castor->wait(), 0) << castor->errors();
  EXPECT_TRUE(node->wait_for_output("late leaves"));
}

TEST_F(LateNode, JoinsAgainAfterItWasLost) {
  start_node();
  auto castor = start_ticking();
  EXPECT_EQ(ask({"add", addition()}).status, 0);
  node->send_signal(SIGKILL);
  node->wait();
  start_node(address);
  EXPECT_TRUE(castor->wait_for_output("node late is lost")) << castor->errors();
  EXPECT_EQ(ask({"add", addition()}).status, 2) << "they are still there, as lost";
  EXPECT_EQ(ask({"remove", "b"}).status, 0);
  auto added = ask({"add", addition()});
  EXPECT_EQ(added.status, 0) << added.errors;
  EXPECT_TRUE(node->wait_for_output("[b.hearer] hears ticks")) << node->errors();
}

TEST_F(Inspection, SystemsAreToldApart) {
  auto first = start_ticking();
  auto second = start_ticking();
  auto both = ask({"wm", "ls"});
  EXPECT_EQ(both.status, 2);
  EXPECT_THAT(both.errors, ContainsRegex("choose one with --system: system-[0-9]+, system-[0-9]+"));
  EXPECT_EQ(json_lines(ask({"ps", "--json"}).output).size(), 2u);
  second->send_signal(SIGKILL);
  second->wait();
  auto one = ask({"wm", "ls"});
  EXPECT_EQ(one.status, 0) << one.errors;
  EXPECT_THAT(ask({"wm", "ls", "--system", "other"}).errors,
              HasSubstr("no system of the name other runs here"));
}

TEST_F(Inspection, OnlyTheUserReachesASystem) {
  auto castor = start_ticking();
  struct stat status {};
  ASSERT_EQ(stat((runtime / "castor").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0700u);
  for (auto& x : std::filesystem::directory_iterator{runtime / "castor"}) {
    ASSERT_EQ(stat(x.path().c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0600u);
  }
}

TEST_F(Inspection, AFolderThatIsOpenToOthersIsNotUsed) {
  std::filesystem::create_directory(runtime / "castor");
  chmod((runtime / "castor").c_str(), 0755);
  Process castor{command({"run", system("CPP UM clock Clock --status 0\n")})};
  EXPECT_EQ(castor.wait(), 0);
  EXPECT_THAT(castor.errors(), HasSubstr("is open to others"));
}

/// A request of docs/introspection.md, and the answer that stands there.
struct Example {
  std::string request;
  std::vector<std::string> answer;
};

std::vector<Example> examples_in(const std::string& page) {
  std::vector<Example> result;
  std::istringstream in{page};
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```")) {
      inside = line == "```json";
      if (inside)
        result.emplace_back();
    } else if (inside && result.back().request.empty()) {
      result.back().request = line;
    } else if (inside) {
      result.back().answer.push_back(line);
    }
  }
  return result;
}

/// The same without what its numbers say, which differ each time.
json shape_of(json x) {
  if (x.is_number())
    return 0;
  if (x.is_structured())
    for (auto& value : x)
      value = shape_of(value);
  return x;
}

/// What stands on the page for what differs: the folder of the test, and its user.
std::string with_names(std::string text, const std::string& folder, const std::string& user) {
  const std::pair<std::string, std::string> placeholders[]{{"/home/ann", folder},
                                                           {"operator:ann", user}};
  for (auto& [placeholder, replacement] : placeholders)
    for (auto i = text.find(placeholder); i != text.npos; i = text.find(placeholder, i + 1))
      text.replace(i, placeholder.size(), replacement);
  return text;
}

TEST_F(Inspection, EveryRequestIsAnsweredAsItsPageSays) {
  const std::string tail = "\nCPP TM AlwaysPositiveTaskManager\n";
  const std::string kitchen = "SUBARCHITECTURE kitchen\n";
  auto recorded = write("recorded.cast", kitchen +
                                           "CPP WM SubarchitectureWorkingMemory --journal full "
                                           "--journal-dir " +
                                           (folder / "journals").string() + tail +
                                           "CPP UM clock Clock --status 0\n");
  ASSERT_EQ(ask({"run", recorded}).status, 0);
  write("more.cast", "VARDEFAULT count=3\n" + kitchen +
                       "CPP UM clock Clock --count %(count)\nCPP UM cook Cook\n");
  auto system = write("kitchen.cast", kitchen + "CPP WM SubarchitectureWorkingMemory" + tail +
                                        "CPP UM ticker Ticker\n");
  Process castor{command({"run", system})};
  ASSERT_TRUE(eventually([] { return ps()["components"][1]["writes"] > 5; }));
  auto examples = examples_in(read(CASTOR_INTROSPECTION_PAGE));
  EXPECT_GE(examples.size(), 20U);
  for (auto& example : examples) {
    SCOPED_TRACE(example.request);
    Reader reader{socket_of_system(),
                  with_names(example.request, folder, operator_of_this_user()) + '\n'};
    for (auto& line : example.answer) {
      auto expected = shape_of(json::parse(with_names(line, folder, operator_of_this_user())));
      auto got = shape_of(json::parse(reader.line()));
      if (expected.contains("file"))
        expected["file"] = system;
      EXPECT_EQ(got, expected);
    }
  }
}

TEST_F(Inspection, StrangeRequestsAreRefused) {
  auto castor = start_ticking();
  EXPECT_THAT((Reader{socket_of_system(), "nonsense\n"}.line()), HasSubstr("cannot be read"));
  EXPECT_THAT((Reader{socket_of_system(), "{\"do\": \"sing\"}\n"}.line()),
              HasSubstr("there is no request sing"));
  EXPECT_THAT((Reader{socket_of_system(), "{\"do\": \"\xff\"}\n"}.line()), HasSubstr("not UTF-8"));
  EXPECT_THAT((Reader{socket_of_system(), std::string(100'000, '[') + '\n'}.line()),
              HasSubstr("within one another"));
  EXPECT_THAT((Reader{socket_of_system(), std::string(1'100'000, 'x')}.line()),
              HasSubstr("longer than 1048576 bytes"));
  // Without a line break for ever.
  EXPECT_THAT((Reader{socket_of_system(), "{\"do\": \"ps\"}"}.line()),
              HasSubstr("no request within 10 s"));
  EXPECT_EQ(ask({"ps"}).status, 0);
}

} // namespace

} // namespace castor::test
