#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/registry.hpp"
#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/parsing/tokens.hpp"
#include "castor/communication/types.hpp"
#include "castor/wm/failure.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor::communication {

namespace {

/// Parses each utterance word by word. After every word its packed logical form is overwritten, so
/// that others can use what has been understood so far, and say which readings they support.
class UtteranceParser final : public UnmanagedComponent {
  void configure() override {
    ParserOptions options;
    options.readings = readings_;
    parser_.emplace(english_lexicon(), options);
  }

  void start() override {
    on_change(added<PhonString>(), [this](const ChangeEvent& event) { parse(event.address); });
    // What a predecessor did not get to.
    for (auto& x : read_all<PhonString>())
      if (!is_finished(form_of(x.address)))
        parse(x.address);
  }

  static std::string form_id(const Address& utterance) { return "form of " + utterance.id; }

  std::optional<PackedLogicalForm> form_of(const Address& utterance) {
    try {
      return *read<PackedLogicalForm>(here(form_id(utterance)));
    } catch (const DoesNotExistOnWM&) {
      return std::nullopt;
    }
  }

  static bool is_finished(const std::optional<PackedLogicalForm>& x) {
    return x && x->state != InterpretationState::unfinished;
  }

  void parse(const Address& address) {
    auto utterance = read<PhonString>(address);
    IncrementalParse parse{*parser_};
    for (auto& word : words_of(utterance->word_sequence)) {
      parse.add(word);
      tell(address, parse.form(), utterance->word_sequence);
    }
    parse.finish();
    tell(address, parse.form(), utterance->word_sequence);
  }

  void tell(const Address& utterance, PackedLogicalForm form, const std::string& text) {
    form.utterance = text;
    auto address = here(form_id(utterance));
    if (form_of(utterance))
      overwrite(address, std::move(form));
    else
      add(address, std::move(form));
  }

  Option<std::uint32_t> readings_{this, "readings", 16,
                                  "how many readings of an utterance are kept"};

  std::optional<Parser> parser_;
};

CASTOR_COMPONENT(UtteranceParser, "parses utterances word by word into packed logical forms")

} // namespace

} // namespace castor::communication
