#include "castor/tests/tools/cli/castor_fixture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

namespace castor::test {

namespace {

namespace fs = std::filesystem;

/// Text that the reader of a message has no use for: of exceptions, of libraries.
constexpr auto raw_texts = {
  "filesystem error", "std::",    "basic_string", "what()",       "errno",     "CLI::", "CLI11",
  "json.exception",   "disk I/O", "terminate",    "Segmentation", "std::bad_", "spdlog"};

/// Replaces all that differs from machine to machine and from run to run.
class Normaliser {
public:
  void add(const std::string& text, const std::string& name) { names_.emplace_back(text, name); }

  std::string operator()(std::string line) const {
    for (auto& [text, name] : names_)
      for (auto i = line.find(text); i != line.npos; i = line.find(text, i + name.size()))
        line.replace(i, text.size(), name);
    line = std::regex_replace(line, std::regex{R"(^\d\d:\d\d:\d\d\.\d+ )"}, "");
    line = std::regex_replace(line, std::regex{R"(\b(running)-\d+)"}, "$1-N");
    line = std::regex_replace(line, std::regex{R"(lasts [0-9.]+ s)"}, "lasts N s");
    // A new command is not a new misuse.
    return std::regex_replace(line, std::regex{R"((needs a command|the commands are): [a-z, ]+)"},
                              "$1: COMMANDS");
  }

private:
  std::vector<std::pair<std::string, std::string>> names_;
};

/// The words of a command line; single and double quotes keep blanks.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> result;
  bool in_word = false;
  char quote = 0;
  for (char c : line) {
    if (quote != 0 ? c == quote : c == '\'' || c == '"') {
      quote = quote != 0 ? '\0' : c;
      if (!in_word)
        result.emplace_back();
      in_word = true;
    } else if (c == ' ' && quote == 0) {
      in_word = false;
    } else {
      if (!in_word)
        result.emplace_back();
      in_word = true;
      result.back() += c;
    }
  }
  return result;
}

/// Commands that users get wrong, each with its exit status and the first line of its message, in
/// tests/cli/misuses.txt: "$ command line", then "status message". To write the answers of the
/// present castor into it, run the test with CASTOR_WRITE_MISUSES=1.
class Misuses : public Castor {
protected:
  static constexpr auto head = "SUBARCHITECTURE a\nCPP WM SubarchitectureWorkingMemory\n"
                               "CPP TM AlwaysPositiveTaskManager\n";

  void SetUp() override {
    Castor::SetUp();
    before_ = fs::current_path();
    fs::current_path(folder);
    write_files();
    normalise_.add(folder.string() + '/', "");
    normalise_.add(folder.string(), "FOLDER");
    normalise_.add(CASTOR_TEST_PLUGIN, "PLUGIN");
    normalise_.add(runtime.string(), "RUNTIME");
  }

  void TearDown() override {
    node_.reset();
    system_.reset();
    fs::current_path(before_);
    Castor::TearDown();
  }

  void write_files() const {
    const std::string a = head;
    write("good.cast", a + "CPP UM clock Clock --count 1\n");
    write("variables.cast", "VARDEFAULT source=scene\nVARDEFAULT tracker=no\nIFTRUE(%(tracker))\n"
                            "SETVAR speed=1\nENDIF\n" +
                              a + "CPP UM clock Clock --count 1\n#EXPAND %(source)\n");
    write("hosts.cast",
          "HOSTNAME camera camera.test\nHOSTNAME arm arm.test\nHOSTNAME here localhost\n" + a +
            "[camera] CPP UM clock Clock\n[arm] CPP UM other Clock\n");
    write("node.cast", "HOSTNAME camera 127.0.0.1:9\n" + a + "[camera] CPP UM clock Clock\n");
    write("address.cast", a + "far.test:99999 CPP UM clock Clock\n");
    write("addition.cast", "SUBARCHITECTURE a\nCPP UM more Clock\n");
    write("empty.cast", "");
    write("half.cast",
          "SUBARCHITECTURE a\nCPP WM SubarchitectureWorkingMemory\nCPP UM clock Clock\n");
    write("syntax.cast",
          "VARDEFALT x=1\n" + a + "CPP UM clock Clok\nCPP UM second Clock --cuont 3\n");
    write("class.cast", a + "CPP UM clock Clok\n");
    write("kind.cast", a + "CPP MG clock Clock\n");
    write("option.cast", a + "CPP UM clock Clock --cuont 3\n");
    write("value.cast", a + "CPP UM clock Clock --count many\n");
    write("library.cast", a + "CPP UM clock Clock@nowhere\n");
    write("camera.cast", a + "CPP UM detector ChangeDetector\n");
    write("camra.cast",
          "COMPONENT CPP camera Camera\n" + a + "CPP UM detector ChangeDetector --camera camra\n");
    write("managed-camera.cast",
          a + "CPP UM clock Clock\nCPP UM detector ChangeDetector --camera clock\n");
    write("subarchitecture.cast",
          "COMPONENT CPP camera Camera\n" + a + "CPP MG scene SceneManager --vision b\n");
    write("include.cast", "INCLUDE nowhere.cast\n" + a);
    write("journal.cast", "SUBARCHITECTURE a\nCPP WM SubarchitectureWorkingMemory --journal full "
                          "--journal-dir /proc/nowhere\nCPP TM AlwaysPositiveTaskManager\n"
                          "CPP UM clock Clock\n");
    write("running.cast", a + "CPP UM ticker Ticker\nCPP UM listener Listener --count 1000000\n");
    write("camera-addition.cast", "SUBARCHITECTURE a\nCPP UM detector ChangeDetector\n");
    write("class-addition.cast", "SUBARCHITECTURE a\nCPP UM more Clok\nCPP UMM clock Clock\n");
    write("taken.cast", "SUBARCHITECTURE a\nCPP UM ticker Ticker\n");
    write("no-journal.castor-journal", "nothing");
    write("no-plan.txt", "at noon: explode\n");
    write("text.so", "nothing");
    fs::create_directories(folder / "empty");
    // Certificates for these nodes and from another CA, one with a key that is not its own.
    run({CASTOR_MAKE_CERTS, "certs", "camera", "run"});
    run({CASTOR_MAKE_CERTS, "other-certs", "run"});
    fs::copy(folder / "certs/run", folder / "wrong-key");
    fs::copy_file(folder / "certs/camera/node.key", folder / "wrong-key/node.key",
                  fs::copy_options::overwrite_existing);
    fs::copy(folder / "certs/run", folder / "damaged");
    std::ofstream{folder / "damaged/node.pem"} << "nothing";
    run({CASTOR_EXECUTABLE, "--plugin", CASTOR_TEST_PLUGIN, "run", "good.cast", "--record",
         "recording", "--until-quiet", "100ms"});
  }

  static void run(const std::vector<std::string>& words) {
    Process process{words};
    EXPECT_EQ(process.wait(), 0) << process.errors();
  }

  void start_system(const std::string& file) {
    system_ = std::make_unique<Process>(command({"run", file}));
    ASSERT_TRUE(system_->wait_for_output("ticks")) << system_->errors();
  }

  /// A node which listens at PORT.
  void start_node(const std::string& name, const std::vector<std::string>& options = {}) {
    std::vector<std::string> words{CASTOR_EXECUTABLE, "node",       "--name", name,
                                   "--listen",        "127.0.0.1:0"};
    words.insert(words.end(), options.begin(), options.end());
    node_ = std::make_unique<Process>(words);
    ASSERT_TRUE(node_->wait_for_output("listens at")) << node_->errors();
    auto said = node_->output();
    auto colon = said.rfind(':');
    port_ = said.substr(colon + 1, said.find('\n', colon) - colon - 1);
    normalise_.add("127.0.0.1:" + port_, "127.0.0.1:PORT");
  }

  /// What a user sees, and whether it is fit to be seen.
  std::string answer(const std::string& line) const {
    auto words = words_of(line);
    for (auto& x : words) {
      if (x == "PLUGIN")
        x = CASTOR_TEST_PLUGIN;
      if (auto i = x.find("PORT"); i != x.npos)
        x.replace(i, 4, port_);
    }
    EXPECT_EQ(words.front(), "castor") << line;
    words.front() = CASTOR_EXECUTABLE;
    // The test components are there wherever the line does not say otherwise.
    if (std::ranges::find(words, "--plugin") == words.end() && words.size() > 1)
      words.insert(words.begin() + 1, {"--plugin", CASTOR_TEST_PLUGIN});
    words.insert(words.begin(), {"timeout", "--kill-after=5", "30"});
    Process castor{words};
    auto status = castor.wait();
    auto errors = castor.errors();
    EXPECT_NE(status, 0) << line << "\nsucceeds\n" << castor.output();
    EXPECT_NE(status, 124) << line << "\ngoes on for ever\n" << errors;
    EXPECT_LT(status, 124) << line << "\nis killed\n" << errors;
    for (auto* x : raw_texts)
      EXPECT_EQ(errors.find(x), errors.npos) << line << "\nshows \"" << x << "\":\n" << errors;
    auto first = errors.substr(0, errors.find('\n'));
    EXPECT_GT(first.size(), 10U) << line << "\nsays nothing";
    return std::to_string(status) + ' ' + normalise_(first);
  }

  std::unique_ptr<Process> system_;
  std::unique_ptr<Process> node_;

private:
  std::string port_;
  fs::path before_;
  Normaliser normalise_;
};

TEST_F(Misuses, EachIsRefusedWithAMessageThatSaysWhatToDo) {
  std::ifstream in{CASTOR_MISUSES};
  ASSERT_TRUE(in) << CASTOR_MISUSES;
  std::ostringstream present;
  std::size_t count = 0;
  for (std::string line; std::getline(in, line);) {
    // Answers are made anew.
    if (!line.empty() && std::isdigit(static_cast<unsigned char>(line.front())))
      continue;
    present << line << '\n';
    if (line == "@ node")
      start_node("other");
    else if (line == "@ secure node")
      start_node("camera", {"--tls", "certs/camera"});
    else if (line.starts_with("@ "))
      start_system(line.substr(2));
    if (!line.starts_with("$ "))
      continue;
    ++count;
    present << answer(line.substr(2)) << '\n';
  }
  EXPECT_GE(count, 80U);
  if (std::getenv("CASTOR_WRITE_MISUSES")) {
    std::ofstream{CASTOR_MISUSES} << present.str();
    return;
  }
  auto wanted = read(CASTOR_MISUSES);
  std::istringstream was{wanted};
  std::istringstream is{present.str()};
  std::string command;
  for (std::string a, b; std::getline(was, a) && std::getline(is, b);) {
    if (a.starts_with("$ "))
      command = a;
    EXPECT_EQ(a, b) << command;
    if (a.starts_with("$ ") != b.starts_with("$ "))
      break;
  }
  EXPECT_EQ(std::ranges::count(wanted, '\n'), std::ranges::count(present.str(), '\n'));
}

/// Permissions mean nothing to root, as whom tests often run.
TEST_F(Misuses, FoldersThatOthersOwnAreRefusedBeforeTheRun) {
  fs::permissions(folder, fs::perms{0755});
  fs::permissions(folder / "empty", fs::perms{0555});
  std::vector<std::string> as_nobody;
  if (geteuid() == 0)
    as_nobody = {"setpriv", "--reuid=65534", "--clear-groups"};
  auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), as_nobody.begin(), as_nobody.end());
    Process castor{arguments};
    return std::pair{castor.wait(), castor.errors()};
  };
  if (run({CASTOR_EXECUTABLE, "--version"}).first != 0)
    GTEST_SKIP() << "nobody else may run the castor of this build";
  for (auto& [option, place] : std::vector<std::pair<std::string, std::string>>{
         {"--output", "empty/out"}, {"--output", "empty"}, {"--timeline", "empty/run.html"}}) {
    auto [status, errors] = run({CASTOR_EXECUTABLE, "run", "good.cast", option, place});
    EXPECT_EQ(status, 2) << option << ' ' << place;
    EXPECT_NE(errors.find(option + ": cannot write into the folder empty: Permission denied"),
              errors.npos)
      << errors;
  }
}

} // namespace

} // namespace castor::test
