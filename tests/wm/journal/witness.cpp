#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/wm/values/reflect.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

namespace castor::test {

namespace {

struct Mark {
  std::int64_t slot = 0;
  /// How often the slot was written before.
  std::int64_t number = 0;
};
CASTOR_REFLECT(Mark, slot, number)

/// Overwrites a few entries in turn and keeps in a file which of its writes were acknowledged. Each
/// of its lives begins by looking whether the working memory, which may have been killed, has all
/// of them, each once.
class Witness final : public UnmanagedComponent {
  void start() override {
    std::map<std::int64_t, std::int64_t> acknowledged;
    std::int64_t lives = 0;
    std::ifstream file{file_.get()};
    for (std::int64_t slot = 0, number = 0; file >> slot >> number;) {
      lives += slot < 0;
      acknowledged[slot] = std::max(acknowledged[slot], number);
    }
    for (auto& x : read_all<Mark>()) {
      marks_[x->slot] = x->number;
      // Every write raises the version by one, so a write that was made twice shows.
      if (x.version != static_cast<Version>(x->number))
        wrong("slot " + std::to_string(x->slot) + " was written " + std::to_string(x.version) +
              " times, but says " + std::to_string(x->number));
    }
    for (auto& [slot, number] : acknowledged)
      if (slot >= 0 && (marks_.count(slot) == 0 || marks_[slot] < number))
        wrong("write " + std::to_string(number) + " of slot " + std::to_string(slot) +
              " was acknowledged, but is not there");
    out_.open(file_.get(), std::ios::app);
    note(-1, lives);
    info("life {}: {} slots, {} of them were acknowledged", lives + 1, marks_.size(),
         acknowledged.size());
    if (lives >= kills_)
      end_system(0, "all is there after " + std::to_string(lives) + " kills");
  }

  void run() override {
    for (std::int64_t i = 0; is_running(); ++i) {
      auto slot = i % slots_.get();
      auto where = here("slot-" + std::to_string(slot));
      auto known = marks_.find(slot);
      if (known == marks_.end()) {
        add(where, Mark{slot, 0});
        known = marks_.emplace(slot, 0).first;
      } else {
        overwrite(where, Mark{slot, known->second + 1});
        ++known->second;
      }
      note(slot, known->second);
    }
  }

  void note(std::int64_t slot, std::int64_t number) {
    out_ << slot << ' ' << number << '\n' << std::flush;
  }

  void wrong(const std::string& what) { end_system(3, what); }

  Option<std::string> file_{this, "file", "", "where to note what was acknowledged"};
  Option<std::int64_t> slots_{this, "slots", 20, "how many entries to write"};
  Option<std::int64_t> kills_{this, "kills", 1000, "after how many lives to end"};

  std::map<std::int64_t, std::int64_t> marks_;
  std::ofstream out_;
};

CASTOR_COMPONENT(Witness, "remembers what was acknowledged, and looks whether it is there")

} // namespace

} // namespace castor::test
