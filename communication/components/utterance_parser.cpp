#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/communication/components/uses_lexicon.hpp"
#include "castor/communication/dialogue/understanding.hpp"
#include "castor/communication/parsing/packing.hpp"
#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/parsing/tokens.hpp"
#include "castor/communication/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <chrono>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor::communication {

namespace {

/// Parses each utterance word by word, one utterance after the other. After every word its packed
/// logical form is overwritten, so that others can use what has been understood so far. If there is
/// somebody who knows which readings the rest of the system supports, a finished form waits for
/// that.
class UtteranceParser final : public UsesLexicon<UnmanagedComponent> {
  void configure() override {
    UsesLexicon::configure();
    ParserOptions options;
    options.readings = readings_;
    parser_.emplace(lexicon(), options);
  }

  void start() override {
    on_change(added<PhonString>(),
              [this](const ChangeEvent& event) { utterances_.push_back(event.address); });
    on_change(added<ContextInfo>(), [](const ChangeEvent&) {});
    on_change(deleted<ContextSource>(), [](const ChangeEvent&) {});
  }

  void run() override {
    // What a predecessor did not get to.
    auto said = read_all<PhonString>();
    std::ranges::sort(said, {}, [](auto& x) { return x->turn; });
    for (auto& x : said)
      if (std::ranges::find(utterances_, x.address) == utterances_.end())
        utterances_.push_back(x.address);
    do
      while (!utterances_.empty()) {
        auto next = utterances_.front();
        utterances_.pop_front();
        interpret(next);
      }
    while (wait_for_changes() || is_running());
  }

  static std::string form_id(const Address& utterance) { return "form of " + utterance.id; }

  std::optional<PackedLogicalForm> form_of(const Address& utterance) {
    try {
      return *read<PackedLogicalForm>(here(form_id(utterance)));
    } catch (const DoesNotExistOnWM&) {
      return std::nullopt;
    }
  }

  void interpret(const Address& address) {
    try {
      auto form = form_of(address);
      if (!form || form->state == InterpretationState::unfinished)
        form = parse(address);
      if (form->state == InterpretationState::finished)
        prune_by_context(address, std::move(*form));
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    }
  }

  PackedLogicalForm parse(const Address& address) {
    auto utterance = read<PhonString>(address);
    auto form = understood(*parser_, words_of(utterance->word_sequence),
                           [&](const PackedLogicalForm& part) { tell(address, part, *utterance); });
    return tell(address, std::move(form), *utterance);
  }

  PackedLogicalForm tell(const Address& address, PackedLogicalForm form,
                         const PhonString& utterance) {
    form.utterance = {address};
    form.text = utterance.word_sequence;
    form.turn = utterance.turn;
    put(here(form_id(address)), form);
    return form;
  }

  void prune_by_context(const Address& utterance, PackedLogicalForm form) {
    auto supports = context_of(form_id(utterance));
    if (prune(form, supports))
      debug("\"{}\": {} readings are supported", form.text, form.readings.size());
    form.state = InterpretationState::pruned;
    put(here(form_id(utterance)), std::move(form));
  }

  /// What others know of a form; nothing if there is nobody to ask, or no answer in time.
  std::vector<InterpretationSupport> context_of(const std::string& form) {
    const auto deadline = now() + patience_.get();
    while (!read_all<ContextSource>(1).empty() && now() < deadline && is_running()) {
      try {
        return read<ContextInfo>(here("context of " + form))->supports;
      } catch (const DoesNotExistOnWM&) {
        wait_for_changes(deadline - now());
      }
    }
    return {};
  }

  Option<std::uint32_t> readings_{this, "readings", 16,
                                  "how many readings of an utterance are kept"};
  Option<std::chrono::milliseconds> patience_{
    this, "patience", std::chrono::seconds{5},
    "how long to wait for reports on which readings are supported"};

  std::optional<Parser> parser_;
  std::deque<Address> utterances_;
};

CASTOR_COMPONENT(UtteranceParser, "parses utterances word by word into packed logical forms")

} // namespace

} // namespace castor::communication
