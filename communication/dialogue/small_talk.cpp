#include "castor/communication/dialogue/small_talk.hpp"

#include "castor/communication/parsing/hybrid_logic.hpp"

#include <array>
#include <string_view>

namespace castor::communication {

namespace {

struct Reply {
  std::string_view about;
  std::string_view text;
};

constexpr std::array replies{
  Reply{"thanks", "You are welcome."},
  Reply{"apology", "Never mind."},
  Reply{"praise", "Thank you."},
  Reply{"identity", "I am a robot that sees what lies on the table and talks about it."},
  Reply{"wellbeing", "I am fine, thank you."},
  Reply{"age", "I do not know."},
  Reply{"certainty", "Yes, as far as I can see."},
  Reply{"ability", "I can tell you what lies on the table: what there is, what it looks like, how "
                   "many there are, and where. You can also tell me what things are."},
  Reply{"help", "Ask me about what lies on the table, for example: What do you see? What colour is "
                "the ball? How many things are left of the cube? Is the largest thing red?"}};

} // namespace

std::string small_talk(const LogicalForm& form) {
  const auto* root = find_nominal(form, form.root);
  for (auto& reply : replies)
    if (root != nullptr && root->proposition == reply.about)
      return std::string{reply.text};
  return "I do not know what to say to that.";
}

} // namespace castor::communication
