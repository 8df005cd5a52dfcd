// What people say to the PlayMate with its arm, as typed dialogues, through the whole system in
// simulated time: prints what was said, what was replied, and where things are in the end, beside
// what was expected, for people to judge.
//
//   dialogue_benchmark FILE [SCENE]
//
// Each line of FILE is a dialogue, its sentences apart by " / ", and what is right in the end after
// " => "; lines that begin with # are comments. Each sentence is said when the robot has done what
// the one before asked for. SCENE is a table, configs/scenes/arm.scene if there is none.

#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/communication/parsing/tokens.hpp"
#include "castor/communication/types.hpp"
#include "castor/planning/manipulation/types.hpp"
#include "castor/planning/motivation/types.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <ranges>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace castor::manipulation {

namespace {

using namespace std::chrono_literals;
using communication::PhonString;
using communication::SpokenOutputItem;
using planning::Motive;
using planning::MotiveStatus;

struct Dialogue {
  std::vector<std::string> sentences;
  std::string expected;
};

struct Transcript {
  std::string words;
  double seconds = 0;
  ArmStatus truth;
  std::atomic<bool> is_over = false;
};

/// Of the dialogue that is being had.
struct Played {
  Dialogue dialogue;
  Transcript transcript;
};

Played& played() {
  static Played instance;
  return instance;
}

/// Says the sentences one after the other, and writes down what is replied.
class Speaker final : public UnmanagedComponent {
  void run() override {
    auto& transcript = played().transcript;
    const auto begun = now();
    // The robot looks at its table.
    sleep_for(8s);
    for (const auto& sentence : played().dialogue.sentences) {
      transcript.words += "  > " + sentence + '\n';
      say(sentence);
      if (!wait_until_done())
        transcript.words += "    (not done after 600 s)\n";
    }
    transcript.seconds = std::chrono::duration<double>(now() - begun).count();
    transcript.truth = *pull<ArmStatus>("arm");
    transcript.is_over = true;
  }

  /// As an UtteranceSource does.
  void say(const std::string& text) {
    for (const auto& sentence : communication::sentences_of(text)) {
      if (is_running())
        say_sentence(sentence);
      sleep_for(1s);
    }
  }

  void say_sentence(const std::string& text) {
    const auto before = read_all_in<PhonString>("communication").size();
    PhonString said;
    said.word_sequence = text;
    said.turn = static_cast<std::int32_t>(before);
    add(Address{"communication", "utterance " + std::to_string(before + 1)}, std::move(said));
  }

  /// Until nothing has been said, and no motive has been pursued, for a while.
  bool wait_until_done() {
    const auto given_up = now() + 600s;
    auto busy = now();
    while (is_running() && now() < given_up) {
      sleep_for(500ms);
      if (hear() || is_pursuing())
        busy = now();
      else if (now() - busy > 6s)
        return true;
    }
    return false;
  }

  bool hear() {
    auto items = read_all_in<SpokenOutputItem>("communication");
    bool is_new = false;
    // The oldest first.
    for (const auto& x : std::views::reverse(items))
      if (heard_.insert(x.address.id + x->text).second) {
        played().transcript.words += "  < " + x->text + '\n';
        is_new = true;
      }
    return is_new;
  }

  bool is_pursuing() {
    return std::ranges::any_of(read_all_in<Motive>("motivation"),
                               [](const auto& x) { return x->status < MotiveStatus::completed; });
  }

  std::set<std::string> heard_;
};
CASTOR_COMPONENT(Speaker, "says the sentences of a dialogue")

std::vector<Dialogue> dialogues_of(const std::string& file) {
  std::ifstream in{file};
  if (!in)
    throw std::runtime_error("cannot read " + file);
  std::vector<Dialogue> result;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.starts_with('#'))
      continue;
    Dialogue dialogue;
    if (const auto arrow = line.find(" => "); arrow != std::string::npos) {
      dialogue.expected = line.substr(arrow + 4);
      line.resize(arrow);
    }
    for (std::size_t begin = 0; begin != std::string::npos;) {
      const auto end = line.find(" / ", begin);
      dialogue.sentences.push_back(line.substr(begin, end - begin));
      begin = end == std::string::npos ? end : end + 3;
    }
    result.push_back(std::move(dialogue));
  }
  return result;
}

void play(Dialogue dialogue, const std::string& scene) {
  played().dialogue = std::move(dialogue);
  auto& transcript = played().transcript;
  transcript.words.clear();
  transcript.truth = {};
  transcript.is_over = false;
  TestSystemOptions options;
  options.file = CASTOR_CONFIGS "/playmate.cast";
  options.simulated_time = true;
  options.patience = 3000s;
  options.variables = {{"arm", "true"}};
  if (!scene.empty())
    options.variables["table"] = scene;
  std::ifstream in{options.file};
  const std::string cast{std::istreambuf_iterator<char>(in), {}};
  TestSystem system(cast + "SUBARCHITECTURE listening\nCPP WM SubarchitectureWorkingMemory\n"
                           "CPP TM AlwaysPositiveTaskManager\nCPP UM speaker Speaker\n"
                           "ACCESS listening WRITES communication\n",
                    options);
  system.wait_until("the dialogue is over", [] { return played().transcript.is_over.load(); });
}

int measure(const std::string& file, const std::string& scene) {
  int number = 0;
  for (const auto& dialogue : dialogues_of(file)) {
    play(dialogue, scene);
    const auto& transcript = played().transcript;
    fmt::print("{}.\n{}", ++number, transcript.words);
    for (const auto& x : transcript.truth.things)
      fmt::print("  {} at {:.2f} {:.2f} on {};", x.name, x.pose.position.x, x.pose.position.y,
                 x.support);
    fmt::print(" {} collisions, {:.0f} s\n  expected: {}\n\n", transcript.truth.collisions,
               transcript.seconds, dialogue.expected);
    std::fflush(stdout);
  }
  return 0;
}

} // namespace

} // namespace castor::manipulation

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: dialogue_benchmark FILE [SCENE]\n");
    return 2;
  }
  try {
    return castor::manipulation::measure(argv[1], argc > 2 ? argv[2] : "");
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
