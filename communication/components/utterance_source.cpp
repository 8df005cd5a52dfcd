#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/registry.hpp"
#include "castor/communication/parsing/tokens.hpp"
#include "castor/communication/types.hpp"
#include "castor/wm/failure.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace castor::communication {

namespace {

using namespace std::chrono_literals;

/// Where utterances come from: the command line, a file, or whatever is typed or piped in.
class UtteranceSource final : public UnmanagedComponent {
  void run() override {
    if (!sleep_for(delay_.get()))
      return;
    say(text_.get());
    if (!file_->empty())
      say(content_of(file_));
    if (typed_)
      listen();
  }

  static std::string content_of(const std::string& path) {
    std::ifstream file{path};
    if (!file)
      throw std::runtime_error("--file " + path + " cannot be read");
    std::ostringstream result;
    result << file.rdbuf();
    return result.str();
  }

  void listen() {
    said_ = static_cast<int>(read_all<PhonString>().size());
    std::string line;
    std::array<char, 1024> chunk{};
    while (sleep_for(20ms)) {
      pollfd input{STDIN_FILENO, POLLIN, 0};
      if (poll(&input, 1, 0) <= 0)
        continue;
      auto size = ::read(STDIN_FILENO, chunk.data(), chunk.size());
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
    for (auto& sentence : sentences_of(text)) {
      PhonString utterance;
      utterance.length = static_cast<std::int32_t>(words_of(sentence).size());
      utterance.word_sequence = sentence;
      if (utterance.length == 0)
        continue;
      // One that is started again does not repeat itself.
      try {
        add(here("utterance " + std::to_string(++said_)), std::move(utterance));
      } catch (const AlreadyExistsOnWM&) {
        trace("\"{}\" was said before", sentence);
      }
    }
  }

  Option<std::string> text_{this, "text", "", "sentences that are said when the system begins"};
  Option<std::string> file_{this, "file", "", "a file of more of them"};
  Option<bool> typed_{this, "typed", false, "listen to what is typed, or piped into the process"};
  Option<std::chrono::milliseconds> delay_{this, "delay", 0ms,
                                           "how long to wait before the first is said"};

  int said_ = 0;
};

CASTOR_COMPONENT(UtteranceSource, "says what is typed, or stands in a file")

} // namespace

} // namespace castor::communication
