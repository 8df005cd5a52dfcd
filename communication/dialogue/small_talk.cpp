#include "castor/communication/dialogue/small_talk.hpp"

#include "castor/communication/parsing/hybrid_logic.hpp"

namespace castor::communication {

std::string small_talk(const LogicalForm& form, const WordMeanings& meanings) {
  const auto* root = find_nominal(form, form.root);
  const auto reply =
    root == nullptr ? meanings.replies.end() : meanings.replies.find(root->proposition);
  return reply == meanings.replies.end() ? "I do not know what to say to that." : reply->second;
}

} // namespace castor::communication
