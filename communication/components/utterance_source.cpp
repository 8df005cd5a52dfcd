#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/base/input_file.hpp"
#include "castor/binding/types.hpp"
#include "castor/communication/components/program.hpp"
#include "castor/communication/parsing/tokens.hpp"
#include "castor/communication/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

namespace castor::communication {

namespace {

using namespace std::chrono_literals;

/// Where utterances come from: the command line, a file, or whatever is typed or piped in.
class UtteranceSource final : public UnmanagedComponent {
  void start() override {
    on_change(changed<SpokenOutputItem>(), [this](const ChangeEvent& event) {
      try {
        answered_.insert(read<SpokenOutputItem>(event.address)->utterance);
      } catch (const DoesNotExistOnWM& e) {
        debug("{}", e.what());
      }
    });
    if (settled_.get() == 0ms)
      return;
    try {
      on_change(changed<binding::BindingUnion>().in(binding_),
                [this](const ChangeEvent&) { last_change_ = now(); });
    } catch (const UnknownSubarchitectureException&) {
      debug("there is no binding to wait for");
      is_waiting_ = false;
    }
  }

  void run() override {
    if (!sleep_for(delay_.get()) || !wait_until_settled())
      return;
    say(text_.get());
    if (!file_->empty())
      say(content_of(file_));
    said_ = std::max(said_, static_cast<int>(read_all<PhonString>().size()));
    if (!program_->empty())
      hear();
    else if (typed_) {
      if (isatty(STDIN_FILENO) != 0)
        std::puts("Type sentences, such as: where is the ball? Ctrl-D ends the conversation.");
      listen(STDIN_FILENO);
      if (is_running() && await_all_replies())
        end_system(0, "there is no more input");
    }
  }

  /// Until everything was replied to and the replies were spoken; false if the component is stopped
  /// before.
  bool await_all_replies() {
    const auto deadline = now() + patience_.get();
    while (is_running() && !is_everything_spoken()) {
      if (now() >= deadline) {
        warning("not everything was replied to within {} s",
                std::chrono::duration_cast<std::chrono::seconds>(patience_.get()).count());
        return true;
      }
      wait_for_changes(deadline - now());
    }
    return is_running();
  }

  bool is_everything_spoken() {
    std::set<EntryPointer<PhonString>> answered;
    for (auto& x : read_all<ContentPlanningGoal>())
      if (!exists(here(spoken_id(x.address))))
        return false;
    for (auto& x : read_all<SpokenOutputItem>()) {
      if (!x->spoken)
        return false;
      answered.insert(x->utterance);
    }
    return std::ranges::all_of(read_all<PhonString>(),
                               [&](auto& x) { return answered.contains({x.address}); });
  }

  /// What a speech recogniser hears, line by line.
  void hear() {
    Program recogniser{program_.get()};
    listen(recogniser.output());
    if (is_running() && recogniser.has_ended() && recogniser.status() != 0)
      warning("--program {} ended with status {}; is it installed?", program_.get(),
              recogniser.status());
  }

  /// Until something is bound and nothing has been bound anew for a while. Talking about a table
  /// makes sense once it has been seen.
  bool wait_until_settled() {
    const auto deadline = now() + patience_.get();
    while (settled_.get() > 0ms && is_waiting_ && now() < deadline)
      if (last_change_ && now() - *last_change_ >= settled_.get() && everything_is_bound())
        return true;
      else if (!sleep_for(20ms))
        return false;
    return true;
  }

  bool everything_is_bound() {
    try {
      return read<binding::BinderStatus>({binding_, binding::binder_status})->stable;
    } catch (const DoesNotExistOnWM&) {
      return false;
    }
  }

  /// Bytes of --file, of which each sentence has some tens.
  static constexpr std::size_t longest_file = std::size_t{16} << 20;

  static std::string content_of(const std::string& path) {
    try {
      return read_input_file(path, longest_file);
    } catch (const InputFileError& e) {
      throw std::runtime_error("--file " + path + " cannot be read: " + e.what());
    }
  }

  void listen(int descriptor) {
    std::string line;
    std::array<char, 1024> chunk{};
    while (sleep_for(20ms)) {
      pollfd input{descriptor, POLLIN, 0};
      if (poll(&input, 1, 0) <= 0)
        continue;
      auto size = ::read(descriptor, chunk.data(), chunk.size());
      if (size <= 0) {
        say(line);
        return;
      }
      line.append(chunk.data(), static_cast<std::size_t>(size));
      for (auto end = line.find('\n'); end != line.npos; end = line.find('\n')) {
        say(std::string_view{line}.substr(0, end));
        line.erase(0, end + 1);
      }
    }
  }

  void say(std::string_view text) {
    auto sentences = sentences_of(text);
    // "?" deserves a reply, too.
    if (sentences.empty() && text.find_first_not_of(" \t\r") != text.npos)
      sentences.emplace_back(text);
    for (auto& sentence : sentences) {
      PhonString utterance;
      utterance.length = static_cast<std::int32_t>(words_of(sentence).size());
      utterance.word_sequence = sentence;
      utterance.turn = static_cast<std::int32_t>(read_all<PhonString>().size());
      // One that is started again does not repeat itself.
      auto address = here("utterance " + std::to_string(++said_));
      try {
        add(address, std::move(utterance));
      } catch (const AlreadyExistsOnWM&) {
        trace("\"{}\" was said before", sentence);
        continue;
      }
      await_reply_to({address});
    }
  }

  /// People wait for an answer, though not for ever.
  void await_reply_to(const EntryPointer<PhonString>& utterance) {
    const auto deadline = now() + turn_.get();
    while (is_running() && now() < deadline && !answered_.contains(utterance))
      wait_for_changes(deadline - now());
    answered_.clear();
  }

  Option<std::string> text_{this, "text", "", "sentences that are said when the system begins"};
  Option<std::string> file_{this, "file", "", "a file of further sentences"};
  Option<bool> typed_{this, "typed", false, "listen to what is typed, or piped into the process"};
  Option<std::string> program_{
    this, "program", "",
    "a program that prints what it hears, line by line, such as pocketsphinx_continuous"};
  Option<std::chrono::milliseconds> delay_{this, "delay", 0ms,
                                           "how long to wait before the first is said"};

  Option<std::chrono::milliseconds> settled_{
    this, "settled", 0ms,
    "before the first sentence, wait until binding has bound something and then been idle for so "
    "long; 0: do not wait"};
  Option<std::chrono::milliseconds> patience_{this, "patience", 20s,
                                              "the longest wait for binding to be idle"};
  Option<std::chrono::milliseconds> turn_{
    this, "turn", 0ms, "how long to wait for an answer before the next sentence"};
  Option<SubarchitectureName> binding_{this, "binding", "binding", "the binding subarchitecture"};

  int said_ = 0;
  /// Since something was said.
  std::set<EntryPointer<PhonString>> answered_;
  bool is_waiting_ = true;
  std::optional<Timestamp> last_change_;
};

CASTOR_COMPONENT(UtteranceSource, "adds utterances that are typed, or read from a file")

} // namespace

} // namespace castor::communication
